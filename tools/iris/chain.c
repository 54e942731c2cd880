#include "chain.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "file_name.h"
#include "frame_reader.h"
#include "inputs.h"
#include "iris/xt/threshold.h"
#include "picture_write.h"
#include "progress.h"
#include "system.h"

/* Where the picture of an input goes in the folder `folder`: under its own name, with the extension that fits.
 * Returns 0 when the path would be too long. */
static int path_in_folder(char path[PATH_MAX], const char *folder, const char *input, iris_format format)
{
    const char *name = strcmp(input, "-") == 0 ? "stdin" : file_name(input);
    const char *dot = strrchr(name, '.');
    int length = dot && dot != name ? (int)(dot - name) : (int)strlen(name);
    picture_container container = picture_container_of(name);
    const char *extension =
        picture_extension(container == CONTAINER_UNKNOWN ? CONTAINER_BMP : container, format);
    return snprintf(path, PATH_MAX, "%s/%.*s%s", folder, length, name, extension) < PATH_MAX;
}

static const char *kind_of(iris_format format)
{
    return format == IRIS_MASK1 ? "mask" : format == IRIS_GRAY8 ? "gray" : "color";
}

/* output: null when no picture was written; the picture is the input then. */
static void report(const operation_chain *chain, const char *file, const char *output,
                   const iris_image *picture)
{
    const operation_stage *last = &chain->stages[chain->count - 1];
    json_writer json = json_to(stdout);
    json_open(&json, '{');
    json_key(&json, "file");
    json_string(&json, file);
    if (output) {
        json_key(&json, "output");
        json_string(&json, output);
    }
    json_key(&json, "width");
    json_integer(&json, picture->w);
    json_key(&json, "height");
    json_integer(&json, picture->h);
    json_key(&json, "kind");
    json_string(&json, kind_of(picture->format));
    if (last->operation->report) {
        last->operation->report(&json, last);
    }
    json_close(&json, '}');
}

/* The reading of inputs and what goes through the stages. */
typedef struct {
    operation_chain *chain;
    frame_reader reader;
    picture_buffer input, mask;
    const char *file;
    int folder; /* chain->output is one */
} job;

/* The picture that was read; one bit per pixel, black and white, as a mask. Null after complaining. */
static const iris_image *input_of(job *run)
{
    const iris_image *input = &run->input.image;
    if (!run->reader.is_gray || run->reader.bits != 1) {
        return input;
    }
    for (int32_t y = 0; y < input->h; y++) {
        const uint8_t *row = iris_image_row(input, y);
        for (int32_t x = 0; x < input->w; x++) {
            if (row[x] != 0 && row[x] != 255) { /* a palette of other grays */
                return input;
            }
        }
    }
    iris_size size = {input->w, input->h};
    iris_status status = picture_reserve(&run->mask, size, IRIS_MASK1);
    if (status != IRIS_OK) {
        complain(run->file, "%s", picture_problem(status, size));
        return NULL;
    }
    iris_threshold(&run->mask.image, input, 127, IRIS_SELECT_BRIGHT);
    return &run->mask.image;
}

/* Does the last operation answer in text, with neither -o nor --json? */
static int prints(const operation_chain *chain)
{
    return !chain->output && !chain->json && chain->stages[chain->count - 1].operation->print;
}

/* Writes the result, and reports. Returns an exit code. */
static int finish_one(const job *run, const iris_image *input, const iris_image *result)
{
    const operation_chain *chain = run->chain;
    char path[PATH_MAX];
    const char *output = run->folder ? path : chain->output;
    if (run->folder && !path_in_folder(path, chain->output, run->file, result->format)) {
        complain(run->file, "%s", strerror(ENAMETOOLONG));
        return EXIT_BAD_DATA;
    }
    if (output && !picture_write(output, result)) {
        return EXIT_BAD_DATA;
    }
    if (chain->json) {
        report(chain, run->file, output, output ? result : input);
    }
    if (prints(chain)) {
        const operation_stage *last = &chain->stages[chain->count - 1];
        last->operation->print(stdout, last);
    }
    return EXIT_DONE;
}

/* Works on the input that was read, and writes. Returns an exit code. */
static int convert_one(job *run)
{
    const iris_image *input = input_of(run), *picture = input;
    iris_image results[2];
    int exit_code = input ? EXIT_DONE : EXIT_BAD_DATA;
    for (int i = 0; i < run->chain->count && exit_code == EXIT_DONE; i++) {
        operation_stage *stage = &run->chain->stages[i];
        stage->file = run->file;
        exit_code = stage_apply(&results[i % 2], picture, stage);
        picture = &results[i % 2];
    }
    return exit_code == EXIT_DONE ? finish_one(run, input, picture) : exit_code;
}

/* The first picture of the file; from standard input to standard output every one, until the input ends. */
static int run_one(job *run)
{
    frame_reader *reader = &run->reader;
    int is_filter =
        strcmp(run->file, "-") == 0 && (!run->chain->output || strcmp(run->chain->output, "-") == 0);
    int exit_code = EXIT_DONE;
    iris_status status = frame_reader_open(reader, run->file);
    reader->raw = run->chain->raw.format ? &run->chain->raw : NULL;
    do {
        if (status == IRIS_OK) {
            status = frame_reader_next(reader, &run->input, 0);
        }
        if (status == IRIS_OK) {
            if (!is_filter) { /* an open file cannot be replaced on every system */
                frame_reader_close(reader);
            }
            exit_code = convert_one(run);
        }
    } while (is_filter && status == IRIS_OK && exit_code == EXIT_DONE);
    frame_reader_close(reader);
    if (status != IRIS_OK && !(status == IRIS_ERR_END && reader->frames > 0)) {
        complain(run->file, "%s", frame_reader_problem(reader));
        exit_code = EXIT_BAD_DATA;
    }
    return exit_code;
}

static int is_folder(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

static int by_text(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* In a folder, two inputs of one name would overwrite each other. Formats do not matter: a name is taken as gray.
 * Returns 0 after complaining. */
static int names_differ(const char *folder, const input_list *inputs)
{
    char **names = calloc((size_t)inputs->count, sizeof *names);
    int differ = names != NULL;
    for (int i = 0; i < inputs->count && differ; i++) {
        char path[PATH_MAX];
        path_in_folder(path, folder, inputs->paths[i], IRIS_GRAY8);
        names[i] = strdup(path);
        differ = names[i] != NULL;
    }
    if (!differ) {
        complain(NULL, "not enough memory");
    } else {
        qsort(names, (size_t)inputs->count, sizeof *names, by_text);
    }
    for (int i = 1; i < inputs->count && differ; i++) {
        if (strcmp(names[i - 1], names[i]) == 0) {
            complain(names[i], "more than one input would be written there");
            differ = 0;
        }
    }
    for (int i = 0; names && i < inputs->count; i++) {
        free(names[i]);
    }
    free(names);
    return differ;
}

/* Is -o (or its absence) good for these inputs? Sets *folder. Returns an exit code, after complaining. */
static int check_output(operation_chain *chain, const input_list *inputs, int *folder)
{
    const operation *last = chain->stages[chain->count - 1].operation;
    if (prints(chain) || (!chain->output && chain->json && last->reports_alone)) {
        return EXIT_DONE;
    }
    if (!chain->output || strcmp(chain->output, "-") == 0) {
        if (system_is_terminal(STDOUT_FILENO)) {
            complain(NULL, "no output: -o FILE, or a pipe behind standard output");
            return EXIT_BAD_CALL;
        }
        if (chain->json) {
            complain(NULL, "--json needs -o FILE: standard output takes pictures or JSON");
            return EXIT_BAD_CALL;
        }
        chain->output = "-";
        *folder = 0;
        return EXIT_DONE;
    }
    *folder = is_folder(chain->output);
    if (*folder) {
        return names_differ(chain->output, inputs) ? EXIT_DONE : EXIT_BAD_CALL;
    }
    if (inputs->count > 1 || inputs->has_folder) {
        struct stat status;
        complain(chain->output, "%s (several inputs need a folder)",
                 strerror(stat(chain->output, &status) == 0 ? ENOTDIR : errno));
        return EXIT_BAD_DATA;
    }
    if (picture_container_of(chain->output) == CONTAINER_UNKNOWN) {
        complain(chain->output, "only .bmp, .pgm, .ppm, and .pnm can be written");
        return EXIT_BAD_CALL;
    }
    return EXIT_DONE;
}

int chain_run(operation_chain *chain, const arguments *args)
{
    static job run;
    input_list inputs;
    if (args->operand_count == 0) {
        complain(NULL, "no input (see --help)");
        return EXIT_BAD_CALL;
    }
    run.chain = chain;
    int exit_code = inputs_expand(&inputs, args->operand_count, args->operands);
    int output_code = inputs.count > 0 ? check_output(chain, &inputs, &run.folder) : EXIT_BAD_DATA;
    for (int i = 0; i < inputs.count && output_code == EXIT_DONE; i++) {
        run.file = inputs.paths[i];
        progress_show(chain->command, i + 1, inputs.count, run.file);
        int code = run_one(&run);
        if (code != EXIT_DONE) {
            exit_code = inputs.count > 1 ? EXIT_BAD_DATA : code;
        }
    }
    progress_clear();
    inputs_free(&inputs);
    picture_free(&run.input);
    picture_free(&run.mask);
    return output_code != EXIT_DONE ? output_code : exit_code;
}

operation_stage *chain_stages(size_t count)
{
    operation_stage *stages = calloc(count, sizeof *stages);
    if (!stages) {
        complain(NULL, "not enough memory");
    }
    return stages;
}

void chain_free(operation_stage *stages, int count)
{
    for (int i = 0; i < count; i++) {
        stage_free(&stages[i]);
    }
    free(stages);
}

int chain_command(const operation *run, int argc, char **argv)
{
    operation_stage *only = chain_stages(1);
    if (!only) {
        return EXIT_BAD_DATA;
    }
    only->operation = run;
    operation_words words = {.argc = argc, .argv = argv, .stage = only};
    int exit_code = operation_parse(&words);
    if (exit_code == ARGS_GO) {
        operation_chain chain = {.command = run->name,
                                 .stages = only,
                                 .count = 1,
                                 .output = words.output,
                                 .raw = words.raw,
                                 .json = words.json};
        exit_code = chain_run(&chain, &words.arguments);
    }
    chain_free(only, 1);
    return exit_code;
}
