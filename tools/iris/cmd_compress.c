#include "commands.h"
#include "tone_stage.h"

static const char help[] =
    "usage: iris compress [--constant C] [--roi x,y,w,h] [--json] IN... -o OUT\n\n"
    "Range compression: every level p becomes C ln(1 + p), which opens up the dark ones.\n\n"
    "  --constant C      0 to 32767; 45.986 when not given, so that 255 stays 255\n" OPERATION_OPTIONS "\n"
    "example: iris compress night.bmp -o night_seen.bmp\n";

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    return tone_stage_apply(result, input, stage, stage->settings);
}

static int parse(void *settings, operation_words *words)
{
    iris_q16 c = IRIS_TONE_COMPRESS_C;
    const char *constant = NULL;
    const args_option options[] = {{"constant", 0, NULL, &constant}};
    if (!operation_options(words, options, 1)) {
        return 0;
    }
    if (constant && !args_q16(&c, 0, 32767 * IRIS_Q16_ONE, constant)) {
        complain("--constant", "0 to 32767, such as 45.986, not '%s'", constant);
        return 0;
    }
    iris_tone_identity(settings);
    return iris_tone_compress(settings, c) == IRIS_OK;
}

const operation operation_compress = {.name = "compress",
                                      .summary = "dark levels spread, bright ones drawn together",
                                      .help = help,
                                      .parse = parse,
                                      .apply = apply};
