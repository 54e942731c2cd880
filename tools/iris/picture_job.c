#include "picture_job.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "complain.h"
#include "frame_reader.h"
#include "inputs.h"
#include "iris/color.h"
#include "json.h"
#include "picture_write.h"
#include "progress.h"

int picture_job_reserve(picture_job *job, picture_buffer *picture, iris_size size, iris_format format)
{
    iris_status status = picture_reserve(picture, size, format);
    if (status != IRIS_OK) {
        complain(job->file, "%s", picture_problem(status, size));
    }
    return status == IRIS_OK;
}

const iris_image *picture_job_gray(picture_job *job, const iris_image *input)
{
    if (input->format == IRIS_GRAY8) {
        return input;
    }
    if (!picture_job_reserve(job, &job->first, (iris_size){input->w, input->h}, IRIS_GRAY8)) {
        return NULL;
    }
    iris_color_gray(&job->first.image, input, IRIS_GRAY_LUMA);
    return &job->first.image;
}

/* Where the picture of an input goes in the folder `folder`: under its own name, with the extension that fits.
 * Returns 0 when the path would be too long. */
static int path_in_folder(char path[PATH_MAX], const char *folder, const char *input, iris_format format)
{
    const char *slash = strrchr(input, '/');
    const char *name = strcmp(input, "-") == 0 ? "stdin" : slash ? slash + 1 : input;
    const char *dot = strrchr(name, '.');
    int length = dot && dot != name ? (int)(dot - name) : (int)strlen(name);
    picture_container container = picture_container_of(name);
    const char *extension =
        picture_extension(container == CONTAINER_UNKNOWN ? CONTAINER_BMP : container, format);
    return snprintf(path, PATH_MAX, "%s/%.*s%s", folder, length, name, extension) < PATH_MAX;
}

static void report(const picture_job *job, const char *output, const iris_image *result)
{
    json_writer json = json_to(stdout);
    json_open(&json, '{');
    json_key(&json, "file");
    json_string(&json, job->file);
    json_key(&json, "output");
    json_string(&json, output);
    json_key(&json, "width");
    json_integer(&json, result->w);
    json_key(&json, "height");
    json_integer(&json, result->h);
    json_key(&json, "kind");
    json_string(&json, result->format == IRIS_MASK1   ? "mask"
                       : result->format == IRIS_GRAY8 ? "gray"
                                                      : "color");
    if (job->has_threshold) {
        json_key(&json, "threshold");
        (job->threshold < 0) ? json_null(&json) : json_integer(&json, job->threshold);
    }
    json_close(&json, '}');
}

/* Works on the input that was read, and writes. folder: job->output is one. Returns an exit code. */
static int convert_one(picture_job *job, int folder)
{
    char path[PATH_MAX];
    const char *output = folder ? path : job->output;
    iris_image result;
    int exit_code = job->work(&result, &job->input.image, job);
    if (exit_code != EXIT_DONE) {
        return exit_code;
    }
    if (folder && !path_in_folder(path, job->output, job->file, result.format)) {
        complain(job->file, "%s", strerror(ENAMETOOLONG));
        return EXIT_BAD_DATA;
    }
    if (!picture_write(output, &result)) {
        return EXIT_BAD_DATA;
    }
    if (job->json) {
        report(job, output, &result);
    }
    return EXIT_DONE;
}

/* The first picture of the file; from standard input to standard output every one, until the input ends. */
static int run_one(picture_job *job, int folder)
{
    static frame_reader reader;
    int is_filter = strcmp(job->file, "-") == 0 && strcmp(job->output, "-") == 0;
    int exit_code = EXIT_DONE;
    iris_status status = frame_reader_open(&reader, job->file);
    do {
        if (status == IRIS_OK) {
            status = frame_reader_next(&reader, &job->input, 0);
        }
        if (status == IRIS_OK) {
            exit_code = convert_one(job, folder);
        }
    } while (is_filter && status == IRIS_OK && exit_code == EXIT_DONE);
    frame_reader_close(&reader);
    if (status != IRIS_OK && !(status == IRIS_ERR_END && reader.frames > 0)) {
        complain(job->file, "%s", frame_reader_problem(&reader));
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
static int check_output(picture_job *job, const input_list *inputs, int *folder)
{
    if (!job->output || strcmp(job->output, "-") == 0) {
        if (isatty(STDOUT_FILENO)) {
            complain(NULL, "no output: -o FILE, or a pipe behind standard output");
            return EXIT_BAD_CALL;
        }
        if (job->json) {
            complain(NULL, "--json needs -o FILE: standard output takes pictures or JSON");
            return EXIT_BAD_CALL;
        }
        job->output = "-";
        *folder = 0;
        return EXIT_DONE;
    }
    *folder = is_folder(job->output);
    if (*folder) {
        return names_differ(job->output, inputs) ? EXIT_DONE : EXIT_BAD_CALL;
    }
    if (inputs->count > 1 || inputs->has_folder) {
        struct stat status;
        complain(job->output, "%s (several inputs need a folder)",
                 strerror(stat(job->output, &status) == 0 ? ENOTDIR : errno));
        return EXIT_BAD_DATA;
    }
    if (picture_container_of(job->output) == CONTAINER_UNKNOWN) {
        complain(job->output, "only .bmp, .pgm, .ppm, and .pnm can be written");
        return EXIT_BAD_CALL;
    }
    return EXIT_DONE;
}

int picture_job_run(picture_job *job, const arguments *args)
{
    input_list inputs;
    int folder = 0;
    if (args->operand_count == 0) {
        complain(NULL, "no input (see --help)");
        return EXIT_BAD_CALL;
    }
    int exit_code = inputs_expand(&inputs, args->operand_count, args->operands);
    int output_code = inputs.count > 0 ? check_output(job, &inputs, &folder) : EXIT_BAD_DATA;
    for (int i = 0; i < inputs.count && output_code == EXIT_DONE; i++) {
        job->file = inputs.paths[i];
        job->threshold = -1;
        progress_show(job->command, i + 1, inputs.count, job->file);
        int code = run_one(job, folder);
        if (code != EXIT_DONE) {
            exit_code = inputs.count > 1 ? EXIT_BAD_DATA : code;
        }
    }
    progress_clear();
    inputs_free(&inputs);
    picture_free(&job->input);
    picture_free(&job->first);
    picture_free(&job->second);
    return output_code != EXIT_DONE ? output_code : exit_code;
}
