#include "args.h"
#include "camera_tables.h"
#include "commands.h"
#include "complain.h"

static const char help[] =
    "usage: iris cameras [--json]\n\n"
    "Lists the cameras that are there, and of each its formats, sizes, and rates (frames per second). A\n"
    "format is followed by its name for --format of iris capture and iris follow, or by \"not read\".\n\n"
    "  --json  one JSON object per camera\n\n"
    "example: iris cameras\n";

int cmd_cameras(int argc, char **argv)
{
    int json = 0;
    const args_option known[] = {{"json", 0, &json, NULL}};
    arguments args = {help, known, sizeof known / sizeof known[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    if (args.operand_count > 0) {
        complain(args.operands[0], "iris cameras takes no input");
        return EXIT_BAD_CALL;
    }
    return camera_tables_cameras(json);
}
