#include <string.h>

#include "args.h"
#include "camera_tables.h"
#include "commands.h"
#include "complain.h"

static const char help[] =
    "usage: iris controls --device D [--json] [NAME=VALUE...]\n\n"
    "Lists what a camera lets be set, or sets it, in the order given, and says what the camera made of it.\n"
    "Settings stay until the camera is unplugged. VALUE is a number, on or off, or a choice of\n"
    "a menu, whose first words will do: manual for manual-mode.\n"
    "What another control rules is inactive: set that one first, such as exposure-auto before exposure.\n\n"
    "  --device D  such as /dev/video0\n"
    "  --json      one JSON object per control\n\n"
    "example: iris controls --device /dev/video0\n"
    "         iris controls --device /dev/video0 exposure-auto=manual exposure=120 gain=16\n";

int cmd_controls(int argc, char **argv)
{
    int json = 0;
    const char *device = NULL;
    const args_option known[] = {{"device", 0, NULL, &device}, {"json", 0, &json, NULL}};
    arguments args = {help, known, sizeof known / sizeof known[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    if (!device) {
        complain(NULL, "no --device (see iris cameras)");
        return EXIT_BAD_CALL;
    }
    for (int i = 0; i < args.operand_count; i++) {
        const char *equals = strchr(args.operands[i], '=');
        if (!equals || equals == args.operands[i] || equals[1] == '\0') {
            complain(args.operands[i], "NAME=VALUE, such as gain=16");
            return EXIT_BAD_CALL;
        }
    }
    return args.operand_count > 0 ? camera_tables_set(device, args.operand_count, args.operands, json)
                                  : camera_tables_controls(device, json);
}
