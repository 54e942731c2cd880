#include "commands.h"
#include "iris/color.h"
#include "iris/xt/tone.h"
#include "operation.h"

static const char help[] =
    "usage: iris adjust [--red N] [--green N] [--blue N] [--hue DEG] [--saturation N] [--lightness N]\n"
    "                   [--roi x,y,w,h] [--json] IN... -o OUT\n\n"
    "Adds to each channel by itself, first to red, green, and blue, then to hue, saturation, and lightness.\n"
    "A gray picture stays gray when red, green, and blue get the same.\n\n"
    "  --red N --green N --blue N    levels, -255 to 255\n"
    "  --hue DEG         whole degrees; 120 turns red into green, green into blue, blue into red\n"
    "  --saturation N    percent points, -100 (gray) to 100; gray stays gray\n"
    "  --lightness N     percent points, -100 (black) to 100 (white)\n" OPERATION_OPTIONS "\n"
    "example: iris adjust --hue 20 --saturation -15 photo.bmp -o photo2.bmp\n";

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const iris_adjustment *by = stage->settings;
    const iris_image *color = stage_color(stage, input);
    const iris_image *made =
        color ? stage_picture(stage, (iris_size){input->w, input->h}, IRIS_RGB888) : NULL;
    if (!made) {
        return EXIT_BAD_DATA;
    }
    int exit_code = stage_exit(stage, iris_adjust(made, color, by));
    if (input->format != IRIS_RGB888 && by->red == by->green && by->green == by->blue) {
        made = stage_gray(stage, made);
    }
    if (!made) {
        return EXIT_BAD_DATA;
    }
    *result = *made;
    return exit_code;
}

static int parse(void *settings, operation_words *words)
{
    iris_adjustment *by = settings;
    const char *text[6] = {NULL};
    const struct {
        const char *name, *option;
        int32_t *number;
        int32_t limit;
    } numbers[6] = {{"red", "--red", &by->red, 255},
                    {"green", "--green", &by->green, 255},
                    {"blue", "--blue", &by->blue, 255},
                    {"hue", "--hue", &by->hue, INT32_MAX},
                    {"saturation", "--saturation", &by->saturation, 100},
                    {"lightness", "--lightness", &by->lightness, 100}};
    args_option options[6];
    for (int i = 0; i < 6; i++) {
        options[i] = (args_option){numbers[i].name, 0, NULL, &text[i]};
    }
    if (!operation_options(words, options, 6)) {
        return 0;
    }
    for (int i = 0; i < 6; i++) {
        int32_t limit = numbers[i].limit, *number = numbers[i].number;
        if (text[i] && (!args_numbers(number, 1, ',', text[i]) || *number < -limit || *number > limit)) {
            complain(numbers[i].option, "a whole number from %d to %d, not '%s'", (int)-limit, (int)limit,
                     text[i]);
            return 0;
        }
    }
    return 1;
}

const operation operation_adjust = {.name = "adjust",
                                    .summary = "red, green, blue, hue, saturation, lightness",
                                    .help = help,
                                    .parse = parse,
                                    .apply = apply};
