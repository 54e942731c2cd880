#include <string.h>

#include "commands.h"
#include "iris/copy.h"
#include "iris/turn.h"
#include "operation.h"

static const char help[] =
    "usage: iris convert [--raw FORMAT:WxH] [--crop x,y,w,h] [--flip WAY] [--turn DEG]\n"
    "                    [--resize WxH [--area | --nearest]] [--format FORMAT] [--json]\n"
    "                    IN... -o OUT\n\n"
    "Another part, side, size, or format of pictures, in this order.\n\n" RAW_PICTURE_OPTION
    "  --crop x,y,w,h    the part whose top left pixel is x,y; wholly inside\n"
    "  --flip horizontal left and right exchanged\n"
    "  --flip vertical   top and bottom exchanged\n"
    "  --turn DEG        clockwise by 90, 180, or 270 degrees\n"
    "  --resize WxH      to W by H pixels, bilinear: nothing is averaged\n"
    "  --area            averages all that a new pixel covers: to make pictures smaller\n"
    "  --nearest         takes the nearest pixel instead\n"
    "  --format gray     8 bits (luma)\n"
    "  --format rgb      24 bits\n"
    "  --format mask     1 bit: white where luma is above 127\n"
    "  --json            one JSON object per picture\n"
    "  -o OUT            .bmp, .pgm, or .ppm; a folder for several inputs; -: standard output\n"
    "                    (IN - and OUT -: every picture that comes, in turn)\n\n"
    "example: iris convert --crop 0,120,320,120 --resize 160x60 frame.bmp -o near.pgm\n";

typedef struct {
    int crops, resizes, nearest, area;
    iris_rect crop;
    iris_turning flip, turn; /* turn: both, once parse has ended */
    iris_size size;
    iris_format format; /* 0: as it is */
} conversion;

/* Masks are resized as gray and cut again. */
static int resize(iris_image *image, operation_stage *stage, const conversion *to)
{
    int is_mask = image->format == IRIS_MASK1;
    const iris_image *from = stage_levels(stage, image);
    const iris_image *resized = from ? stage_picture(stage, to->size, from->format) : NULL;
    if (!resized) {
        return EXIT_BAD_DATA;
    }
    int exit_code = stage_exit(stage, to->nearest ? iris_resize_nearest(resized, from)
                                      : to->area  ? iris_resize_area(resized, from)
                                                  : iris_resize_bilinear(resized, from));
    if (exit_code == EXIT_DONE && is_mask) {
        resized = stage_mask(stage, resized);
    }
    if (!resized) {
        return EXIT_BAD_DATA;
    }
    *image = *resized;
    return exit_code;
}

/* A mask's part begins at any pixel, so that it is a copy. */
static int crop(iris_image *image, operation_stage *stage, iris_rect part)
{
    if (part.x > image->w - part.w || part.y > image->h - part.h) {
        complain(stage->file, "--crop is not wholly inside the picture of %dx%d pixels", (int)image->w,
                 (int)image->h);
        return EXIT_BAD_CALL;
    }
    if (image->format != IRIS_MASK1) {
        return stage_exit(stage, iris_image_crop(image, image, part));
    }
    const iris_image *copy = stage_picture(stage, (iris_size){part.w, part.h}, IRIS_MASK1);
    if (!copy) {
        return EXIT_BAD_DATA;
    }
    iris_mask_copy(copy, image, part.x, part.y);
    *image = *copy;
    return EXIT_DONE;
}

static int turn(iris_image *image, operation_stage *stage, iris_turning turning)
{
    iris_size size =
        turning >= IRIS_TRANSPOSE ? (iris_size){image->h, image->w} : (iris_size){image->w, image->h};
    const iris_image *turned = stage_picture(stage, size, image->format);
    if (!turned) {
        return EXIT_BAD_DATA;
    }
    int exit_code = stage_exit(stage, iris_turn(turned, image, turning));
    *image = *turned;
    return exit_code;
}

static int reformat(iris_image *image, operation_stage *stage, iris_format format)
{
    const iris_image *made = format == IRIS_MASK1   ? stage_mask(stage, image)
                             : format == IRIS_GRAY8 ? stage_gray(stage, image)
                                                    : stage_color(stage, image);
    if (made) {
        *image = *made;
    }
    return made ? EXIT_DONE : EXIT_BAD_DATA;
}

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const conversion *to = stage->settings;
    int exit_code = EXIT_DONE;
    *result = *input;
    if (to->crops) {
        exit_code = crop(result, stage, to->crop);
    }
    if (exit_code == EXIT_DONE && to->turn) {
        exit_code = turn(result, stage, to->turn);
    }
    if (exit_code == EXIT_DONE && to->resizes) {
        exit_code = resize(result, stage, to);
    }
    if (exit_code == EXIT_DONE && to->format) {
        exit_code = reformat(result, stage, to->format);
    }
    return exit_code;
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

static int read_flip(conversion *to, const char *text)
{
    to->flip = strcmp(text, "horizontal") == 0 ? IRIS_FLIP_HORIZONTAL
               : strcmp(text, "vertical") == 0 ? IRIS_FLIP_VERTICAL
                                               : IRIS_TURN_NONE;
    if (!to->flip) {
        complain("--flip", "horizontal or vertical, not '%s'", text);
    }
    return to->flip != IRIS_TURN_NONE;
}

static int read_turn(conversion *to, const char *text)
{
    to->turn = strcmp(text, "90") == 0    ? IRIS_TURN_90
               : strcmp(text, "180") == 0 ? IRIS_TURN_180
               : strcmp(text, "270") == 0 ? IRIS_TURN_270
                                          : IRIS_TURN_NONE;
    if (!to->turn) {
        complain("--turn", "90, 180, or 270 degrees, not '%s'", text);
    }
    return to->turn != IRIS_TURN_NONE;
}

/* One turning for both: a flip before a transposition is the other flip behind it. */
static iris_turning flipped_and_turned(iris_turning flip, iris_turning turn)
{
    int flips = turn < IRIS_TRANSPOSE ? (int)flip : (int)flip >> 1 | ((int)flip & 1) << 1;
    return (iris_turning)(flips ^ (int)turn);
}

static int parse(void *settings, operation_words *words)
{
    conversion *to = settings;
    const char *part = NULL, *flip = NULL, *turned = NULL, *size = NULL, *format = NULL, *raw = NULL;
    const args_option options[] = {{"crop", 0, NULL, &part},           {"flip", 0, NULL, &flip},
                                   {"turn", 0, NULL, &turned},         {"resize", 0, NULL, &size},
                                   {"nearest", 0, &to->nearest, NULL}, {"area", 0, &to->area, NULL},
                                   {"format", 0, NULL, &format},       {"raw", 0, NULL, &raw}};
    if (!operation_options(words, options, sizeof options / sizeof options[0])) {
        return 0;
    }
    if (raw && words->in_pipe) {
        complain("--raw", "stands before the operations of a pipe: iris pipe --raw %s ...", raw);
        return 0;
    }
    if ((raw && !raw_layout_parse(&words->raw, raw)) || (flip && !read_flip(to, flip)) ||
        (turned && !read_turn(to, turned))) {
        return 0;
    }
    if ((part && !args_rect(&to->crop, "--crop", part)) || (size && !read_size(to, size)) ||
        (format && !read_format(to, format))) {
        return 0;
    }
    to->crops = part != NULL;
    to->turn = flipped_and_turned(to->flip, to->turn);
    if ((to->nearest || to->area) && !to->resizes) {
        complain(to->nearest ? "--nearest" : "--area", "only together with --resize");
        return 0;
    }
    if (to->nearest && to->area) {
        complain("--area", "not together with --nearest");
        return 0;
    }
    return 1;
}

const operation operation_convert = {.name = "convert",
                                     .summary = "another format, size, side, or part of pictures",
                                     .help = help,
                                     .parse = parse,
                                     .apply = apply,
                                     .reshapes = 1};
