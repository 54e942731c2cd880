#include <string.h>

#include "args.h"
#include "commands.h"
#include "complain.h"
#include "iris/color.h"
#include "iris/copy.h"
#include "iris/xt/threshold.h"
#include "picture_job.h"

static const char help[] =
    "usage: iris convert [--crop x,y,w,h] [--resize WxH [--nearest]] [--format FORMAT]\n"
    "                    [--json] IN... -o OUT\n\n"
    "Another part, size, or format of pictures, in this order.\n\n"
    "  --crop x,y,w,h    the part whose top left pixel is x,y; wholly inside\n"
    "  --resize WxH      to W by H pixels, bilinear (nothing is averaged: blur before you\n"
    "                    go below half the size)\n"
    "  --nearest         takes the nearest pixel instead\n"
    "  --format gray     8 bits (luma)\n"
    "  --format rgb      24 bits\n"
    "  --format mask     1 bit: white where luma is above 127\n"
    "  --json            one JSON object per picture: file, output, width, height, kind\n"
    "  -o OUT            .bmp, .pgm, or .ppm; a folder for several inputs; -: standard output\n"
    "                    (IN - and OUT -: every picture that comes, in turn)\n\n"
    "example: iris convert --crop 0,120,320,120 --resize 160x60 frame.bmp -o near.pgm\n";

typedef struct {
    int crops, resizes, nearest;
    iris_rect crop;
    iris_size size;
    iris_format format; /* 0: as it is */
} conversion;

static int resize(iris_image *image, picture_job *job, const conversion *to)
{
    if (!picture_job_reserve(job, &job->first, to->size, image->format)) {
        return EXIT_BAD_DATA;
    }
    iris_status status = to->nearest ? iris_resize_nearest(&job->first.image, image)
                                     : iris_resize_bilinear(&job->first.image, image);
    if (status != IRIS_OK) {
        complain(job->file, "%s", iris_status_text(status));
        return EXIT_BAD_DATA;
    }
    *image = job->first.image;
    return EXIT_DONE;
}

static int reformat(iris_image *image, picture_job *job, iris_format format)
{
    iris_size size = {image->w, image->h};
    if (format == IRIS_MASK1) {
        if (image->format != IRIS_GRAY8 && reformat(image, job, IRIS_GRAY8) != EXIT_DONE) {
            return EXIT_BAD_DATA;
        }
        picture_buffer *room = image->data == job->second.memory ? &job->first : &job->second;
        if (!picture_job_reserve(job, room, size, IRIS_MASK1)) {
            return EXIT_BAD_DATA;
        }
        iris_threshold(&room->image, image, 127, IRIS_SELECT_BRIGHT);
        *image = room->image;
    } else if (format != image->format) {
        if (!picture_job_reserve(job, &job->second, size, format)) {
            return EXIT_BAD_DATA;
        }
        iris_color_convert(&job->second.image, image);
        *image = job->second.image;
    }
    return EXIT_DONE;
}

static int work(iris_image *result, const iris_image *input, picture_job *job)
{
    const conversion *to = job->options;
    int exit_code = EXIT_DONE;
    *result = *input;
    if (to->crops && iris_image_crop(result, input, to->crop) != IRIS_OK) {
        complain(job->file, "--crop is not wholly inside the picture of %dx%d pixels", (int)input->w,
                 (int)input->h);
        return EXIT_BAD_CALL;
    }
    if (to->resizes) {
        exit_code = resize(result, job, to);
    }
    if (exit_code == EXIT_DONE && to->format) {
        exit_code = reformat(result, job, to->format);
    }
    return exit_code;
}

static int read_crop(conversion *to, const char *text)
{
    int32_t n[4];
    if (!args_numbers(n, 4, ',', text) || n[0] < 0 || n[1] < 0 || n[2] < 1 || n[3] < 1) {
        complain("--crop", "x,y,w,h in pixels, not '%s'", text);
        return 0;
    }
    to->crop = (iris_rect){n[0], n[1], n[2], n[3]};
    to->crops = 1;
    return 1;
}

static int read_size(conversion *to, const char *text)
{
    int32_t n[2];
    if (!args_numbers(n, 2, 'x', text) || n[0] < 1 || n[1] < 1 || n[0] > IRIS_SIDE_MAX ||
        n[1] > IRIS_SIDE_MAX) {
        complain("--resize", "WxH, 1 to %d pixels each, not '%s'", IRIS_SIDE_MAX, text);
        return 0;
    }
    to->size = (iris_size){n[0], n[1]};
    to->resizes = 1;
    return 1;
}

static int read_format(conversion *to, const char *text)
{
    to->format = strcmp(text, "gray") == 0   ? IRIS_GRAY8
                 : strcmp(text, "rgb") == 0  ? IRIS_RGB888
                 : strcmp(text, "mask") == 0 ? IRIS_MASK1
                                             : 0;
    if (!to->format) {
        complain("--format", "gray, rgb, or mask, not '%s'", text);
    }
    return to->format != 0;
}

int cmd_convert(int argc, char **argv)
{
    conversion to = {0};
    const char *crop = NULL, *size = NULL, *format = NULL;
    picture_job job = {.command = argv[0], .work = work, .options = &to};
    const args_option options[] = {{"crop", 0, NULL, &crop},           {"resize", 0, NULL, &size},
                                   {"nearest", 0, &to.nearest, NULL},  {"format", 0, NULL, &format},
                                   {"output", 'o', NULL, &job.output}, {"json", 0, &job.json, NULL}};
    arguments args = {help, options, sizeof options / sizeof options[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    if ((crop && !read_crop(&to, crop)) || (size && !read_size(&to, size)) ||
        (format && !read_format(&to, format))) {
        return EXIT_BAD_CALL;
    }
    if (to.nearest && !to.resizes) {
        complain("--nearest", "only together with --resize");
        return EXIT_BAD_CALL;
    }
    return picture_job_run(&job, &args);
}
