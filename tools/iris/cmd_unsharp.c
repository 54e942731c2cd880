#include "commands.h"
#include "iris/xt/unsharp.h"
#include "operation.h"

static const char help[] =
    "usage: iris unsharp [--sigma S] [--amount A] [--threshold T] [--border RULE] [--roi x,y,w,h]\n"
    "                    [--json] IN... -o OUT\n\n"
    "Unsharp mask: adds A times what a Gaussian blur takes away, so that edges get steeper. Gray, or each\n"
    "channel of color. A mask turns gray.\n\n"
    "  --sigma S         of the blur, 0.1 to 40 pixels; 1 when not given\n"
    "  --amount A        0 to 16; 1 when not given\n"
    "  --threshold T     differences of up to T levels are noise and stay, 0 (when not given) to\n"
    "                    255\n" OPERATION_BORDER_OPTIONS "\n"
    "example: iris unsharp --sigma 1.5 --amount 0.8 --threshold 3 soft.bmp -o sharp.bmp\n";

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const iris_unsharp_config *config = stage->settings;
    const iris_image *levels = stage_levels(stage, input);
    const iris_image *sharp = levels ? stage_copy(stage, levels) : NULL;
    size_t channels = levels && levels->format == IRIS_GRAY8 ? 1 : 3;
    size_t bytes = IRIS_UNSHARP_SCRATCH_BYTES(input->w, channels, config->sigma_q16);
    iris_scratch *scratch = sharp ? stage_scratch(stage, bytes) : NULL;
    if (!scratch) {
        return EXIT_BAD_DATA;
    }
    *result = *sharp;
    return stage_exit(stage, iris_unsharp(sharp, sharp, config, stage->border, scratch));
}

static int parse(void *settings, operation_words *words)
{
    iris_unsharp_config *config = settings;
    const char *sigma = NULL, *amount = NULL, *threshold = NULL;
    const args_option options[] = {
        {"sigma", 0, NULL, &sigma}, {"amount", 0, NULL, &amount}, {"threshold", 0, NULL, &threshold}};
    if (!operation_options(words, options, sizeof options / sizeof options[0])) {
        return 0;
    }
    iris_unsharp_defaults(config);
    if (sigma && !args_q16(&config->sigma_q16, IRIS_BLUR_SIGMA_MIN, IRIS_BLUR_SIGMA_MAX, sigma)) {
        complain("--sigma", "0.1 to 40 pixels, not '%s'", sigma);
        return 0;
    }
    if (amount && !args_q16(&config->amount_q16, 0, IRIS_UNSHARP_AMOUNT_MAX, amount)) {
        complain("--amount", "0 to 16, not '%s'", amount);
        return 0;
    }
    if (threshold && (!args_numbers(&config->threshold, 1, ',', threshold) || config->threshold < 0 ||
                      config->threshold > 255)) {
        complain("--threshold", "0 to 255 levels, not '%s'", threshold);
        return 0;
    }
    return 1;
}

const operation operation_unsharp = {.name = "unsharp",
                                     .summary = "makes edges steeper by what a blur takes away",
                                     .help = help,
                                     .parse = parse,
                                     .apply = apply};
