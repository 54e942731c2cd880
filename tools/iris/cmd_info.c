#include <stdio.h>
#include <string.h>

#include "args.h"
#include "commands.h"
#include "complain.h"
#include "frame_reader.h"
#include "inputs.h"
#include "json.h"
#include "one_line.h"
#include "progress.h"

static const char help[] =
    "usage: iris info [--json] IN...\n\n"
    "Says what each picture is, after reading all of it.\n"
    "IN is a BMP, PGM, or PPM file, a folder of them, or - for standard input, which may\n"
    "hold several one after another.\n\n"
    "  --json    one JSON object per picture: file, format, width, height, bits per pixel,\n"
    "            kind (mask, gray, color), coding (raw, palette, bitfields, rle), and rows\n"
    "            (top-down, bottom-up)\n\n"
    "example: iris info --json frames/*.bmp\n";

static const char *kind(const frame_reader *reader)
{
    return !reader->is_gray ? "color" : reader->bits == 1 ? "mask" : "gray";
}

static void print_json(const frame_reader *reader, const char *file)
{
    json_writer json = json_to(stdout);
    json_open(&json, '{');
    json_key(&json, "file");
    json_string(&json, file);
    json_key(&json, "format");
    json_string(&json, reader->format);
    json_key(&json, "width");
    json_integer(&json, reader->size.w);
    json_key(&json, "height");
    json_integer(&json, reader->size.h);
    json_key(&json, "bits");
    json_integer(&json, reader->bits);
    json_key(&json, "kind");
    json_string(&json, kind(reader));
    json_key(&json, "coding");
    json_string(&json, reader->coding);
    json_key(&json, "rows");
    json_string(&json, reader->top_down ? "top-down" : "bottom-up");
    json_close(&json, '}');
}

static void print_text(const frame_reader *reader, const char *file)
{
    one_line(stdout, file);
    printf(": %s %dx%d, %d bit%s, %s, %s, %s\n", reader->format, (int)reader->size.w, (int)reader->size.h,
           reader->bits, reader->bits == 1 ? "" : "s", kind(reader), reader->coding,
           reader->top_down ? "top-down" : "bottom-up");
    fflush(stdout);
}

/* The first picture of a file; of standard input every one. Returns an exit code. */
static int info(const char *file, int json)
{
    static frame_reader reader;
    iris_status status = frame_reader_open(&reader, file);
    do {
        status = status == IRIS_OK ? frame_reader_begin(&reader) : status;
        status = status == IRIS_OK ? frame_reader_skip(&reader) : status;
        if (status == IRIS_OK) {
            progress_clear();
            (json ? print_json : print_text)(&reader, file);
        }
    } while (status == IRIS_OK && strcmp(file, "-") == 0 && !ferror(stdout));
    frame_reader_close(&reader);
    if (status != IRIS_OK && !(status == IRIS_ERR_END && reader.frames > 0)) {
        complain(file, "%s", frame_reader_problem(&reader));
        return EXIT_BAD_DATA;
    }
    return EXIT_DONE;
}

int cmd_info(int argc, char **argv)
{
    int json = 0;
    const args_option options[] = {{"json", 0, &json, NULL}};
    arguments args = {help, options, sizeof options / sizeof options[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    if (args.operand_count == 0) {
        complain(NULL, "no input (see --help)");
        return EXIT_BAD_CALL;
    }
    input_list inputs;
    exit_code = inputs_expand(&inputs, args.operand_count, args.operands);
    for (int i = 0; i < inputs.count && !ferror(stdout); i++) {
        progress_show(argv[0], i + 1, inputs.count, inputs.paths[i]);
        if (info(inputs.paths[i], json) != EXIT_DONE) {
            exit_code = EXIT_BAD_DATA;
        }
    }
    progress_clear();
    inputs_free(&inputs);
    return exit_code;
}
