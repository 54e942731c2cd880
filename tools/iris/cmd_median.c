#include "commands.h"
#include "iris/xt/median.h"
#include "operation.h"

static const char help[] =
    "usage: iris median [--size N] [--border RULE] [--roi x,y,w,h] [--json] IN... -o OUT\n\n"
    "Each pixel becomes the middle one of its surroundings: single wrong pixels and thin lines go, edges\n"
    "stay. Gray, each channel of color, and masks.\n\n"
    "  --size N          of NxN pixels, 3 (when not given) or 5\n" OPERATION_BORDER_OPTIONS "\n"
    "example: iris median --size 5 speckled.bmp -o clean.bmp\n";

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const int32_t *side = stage->settings;
    const iris_image *levels = stage_levels(stage, input);
    const iris_image *middle = levels ? stage_copy(stage, levels) : NULL;
    size_t channels = levels && levels->format == IRIS_GRAY8 ? 1 : 3;
    iris_scratch *scratch =
        middle ? stage_scratch(stage, IRIS_MEDIAN_SCRATCH_BYTES(input->w, channels, *side)) : NULL;
    if (!scratch) {
        return EXIT_BAD_DATA;
    }
    int exit_code = stage_exit(stage, iris_median(middle, middle, *side, stage->border, scratch));
    if (input->format == IRIS_MASK1 && stage->border.value % 255 == 0) {
        middle = stage_mask(stage, middle);
    }
    if (!middle) {
        return EXIT_BAD_DATA;
    }
    *result = *middle;
    return exit_code;
}

static int parse(void *settings, operation_words *words)
{
    int32_t *side = settings;
    const char *size = NULL;
    const args_option options[] = {{"size", 0, NULL, &size}};
    if (!operation_options(words, options, sizeof options / sizeof options[0])) {
        return 0;
    }
    *side = 3;
    if (size && (!args_numbers(side, 1, ',', size) || (*side != 3 && *side != 5))) {
        complain("--size", "3 or 5, not '%s'", size);
        return 0;
    }
    return 1;
}

const operation operation_median = {.name = "median",
                                    .summary = "the middle one of the surroundings: specks go, edges stay",
                                    .help = help,
                                    .parse = parse,
                                    .apply = apply};
