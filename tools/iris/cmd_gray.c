#include <string.h>

#include "commands.h"
#include "iris/color.h"
#include "operation.h"

static const char help[] = "usage: iris gray [--method METHOD] [--roi x,y,w,h] [--json] IN... -o OUT\n\n"
                           "Color pictures to gray. Gray ones stay as they are.\n\n"
                           "  --method luma     0.299 R + 0.587 G + 0.114 B (the default)\n"
                           "  --method average  (R + G + B) / 3\n"
                           "  --method green    G alone\n" OPERATION_OPTIONS "\n"
                           "example: iris gray --method green photo.bmp -o photo.pgm\n";

typedef struct {
    iris_gray_method method;
} graying;

static int parse(void *settings, operation_words *words)
{
    static const struct {
        const char *name;
        iris_gray_method method;
    } methods[] = {{"luma", IRIS_GRAY_LUMA}, {"average", IRIS_GRAY_AVERAGE}, {"green", IRIS_GRAY_GREEN}};
    graying *by = settings;
    const char *name = "luma";
    const args_option options[] = {{"method", 0, NULL, &name}};
    if (!operation_options(words, options, 1)) {
        return 0;
    }
    for (size_t i = 0; i < sizeof methods / sizeof methods[0]; i++) {
        if (strcmp(methods[i].name, name) == 0) {
            by->method = methods[i].method;
            return 1;
        }
    }
    complain("--method", "luma, average, or green, not '%s'", name);
    return 0;
}

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const graying *by = stage->settings;
    const iris_image *levels = stage_levels(stage, input);
    const iris_image *gray =
        levels ? stage_picture(stage, (iris_size){input->w, input->h}, IRIS_GRAY8) : NULL;
    if (!gray) {
        return EXIT_BAD_DATA;
    }
    *result = *gray;
    return stage_exit(stage, iris_color_gray(gray, levels, by->method));
}

const operation operation_gray = {
    .name = "gray", .summary = "color pictures to gray", .help = help, .parse = parse, .apply = apply};
