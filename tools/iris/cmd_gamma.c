#include "commands.h"
#include "tone_stage.h"

static const char help[] =
    "usage: iris gamma --gamma G [--roi x,y,w,h] [--json] IN... -o OUT\n\n"
    "Every level p becomes 255 (p / 255)^G: brighter below 1, darker above. 0 and 255 stay.\n\n"
    "  --gamma G         0.001 to 1000\n" OPERATION_OPTIONS "\n"
    "example: iris gamma --gamma 0.5 dark.bmp -o brighter.bmp\n";

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    return tone_stage_apply(result, input, stage, stage->settings);
}

static int parse(void *settings, operation_words *words)
{
    iris_q16 g = 0;
    const char *gamma = NULL;
    const args_option options[] = {{"gamma", 0, NULL, &gamma}};
    if (!operation_options(words, options, 1)) {
        return 0;
    }
    if (!gamma) {
        complain(NULL, "--gamma is missing: below 1 is brighter, above 1 darker (see --help)");
        return 0;
    }
    if (!args_q16(&g, 66, 1000 * IRIS_Q16_ONE, gamma)) {
        complain("--gamma", "0.001 to 1000, not '%s'", gamma);
        return 0;
    }
    iris_tone_identity(settings);
    return iris_tone_gamma(settings, g) == IRIS_OK;
}

const operation operation_gamma = {.name = "gamma",
                                   .summary = "brighter or darker between black and white",
                                   .help = help,
                                   .parse = parse,
                                   .apply = apply};
