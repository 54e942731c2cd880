#include <string.h>

#include "args.h"
#include "commands.h"
#include "complain.h"
#include "iris/color.h"
#include "picture_job.h"

static const char help[] =
    "usage: iris gray [--method METHOD] [--json] IN... -o OUT\n\n"
    "Color pictures to gray. Gray ones stay as they are.\n\n"
    "  --method luma       0.299 R + 0.587 G + 0.114 B (the default)\n"
    "  --method average    (R + G + B) / 3\n"
    "  --method green      G alone\n"
    "  --json              one JSON object per picture: file, output, width, height, kind\n"
    "  -o OUT              .bmp, .pgm, or .ppm; a folder for several inputs; -: standard output\n"
    "                      (IN - and OUT -: every picture that comes, in turn)\n\n"
    "example: iris gray --method green photo.bmp -o photo.pgm\n";

static int work(iris_image *result, const iris_image *input, picture_job *job)
{
    const iris_gray_method *method = job->options;
    if (!picture_job_reserve(job, &job->first, (iris_size){input->w, input->h}, IRIS_GRAY8)) {
        return EXIT_BAD_DATA;
    }
    iris_color_gray(&job->first.image, input, *method);
    *result = job->first.image;
    return EXIT_DONE;
}

int cmd_gray(int argc, char **argv)
{
    static const struct {
        const char *name;
        iris_gray_method method;
    } methods[] = {{"luma", IRIS_GRAY_LUMA}, {"average", IRIS_GRAY_AVERAGE}, {"green", IRIS_GRAY_GREEN}};
    const char *name = "luma";
    const iris_gray_method *method = NULL;
    picture_job job = {.command = argv[0], .work = work};
    const args_option options[] = {
        {"method", 0, NULL, &name}, {"output", 'o', NULL, &job.output}, {"json", 0, &job.json, NULL}};
    arguments args = {help, options, sizeof options / sizeof options[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    for (size_t i = 0; i < sizeof methods / sizeof methods[0]; i++) {
        method = strcmp(methods[i].name, name) == 0 ? &methods[i].method : method;
    }
    if (!method) {
        complain("--method", "luma, average, or green, not '%s'", name);
        return EXIT_BAD_CALL;
    }
    job.options = method;
    return picture_job_run(&job, &args);
}
