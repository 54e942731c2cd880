#include "commands.h"
#include "tone_stage.h"

static const char help[] = "usage: iris negative [--roi x,y,w,h] [--json] IN... -o OUT\n\n"
                           "The negative: every channel becomes 255 less what it was, and a mask selects the "
                           "rest.\n\n" OPERATION_OPTIONS "\n"
                           "example: iris negative photo.bmp -o negative.bmp\n";

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    iris_tone tone;
    iris_tone_identity(&tone);
    iris_tone_negate(&tone);
    return tone_stage_apply(result, input, stage, &tone);
}

static int parse(void *settings, operation_words *words)
{
    (void)settings;
    return operation_options(words, NULL, 0);
}

const operation operation_negative = {.name = "negative",
                                      .summary = "the negative of pictures and masks",
                                      .help = help,
                                      .parse = parse,
                                      .apply = apply};
