#include "commands.h"
#include "iris/copy.h"
#include "iris/xt/hitmiss.h"
#include "operation.h"

static const char help[] =
    "usage: iris hitmiss --pattern TEXT [--border RULE] [--roi x,y,w,h] [--json] IN... -o OUT\n\n"
    "Where a pattern occurs in a mask. Gray and color pictures count as white above 127.\n\n"
    "  --pattern TEXT    rows from the top with / between: 1 white, 0 black, . no matter;\n"
    "                    up to 8x8. Its middle (of an even size the upper left of the\n"
    "                    four) lies on the pixel that is asked about\n" OPERATION_BORDER_OPTIONS "\n"
    "With --border skip the pattern is found nowhere where it would leave the picture.\n\n"
    "example: iris hitmiss --pattern 000/011/000 lines.bmp -o left_ends.bmp\n";

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const iris_hitmiss_pattern *pattern = stage->settings;
    const iris_image *mask = stage_mask(stage, input);
    const iris_image *found = mask ? stage_picture(stage, (iris_size){mask->w, mask->h}, IRIS_MASK1) : NULL;
    iris_scratch *scratch =
        found ? stage_scratch(stage, IRIS_HITMISS_SCRATCH_BYTES(mask->w, pattern->w, pattern->h)) : NULL;
    if (!scratch) {
        return EXIT_BAD_DATA;
    }
    iris_fill(found, 0);
    *result = *found;
    return stage_exit(stage, iris_hitmiss_find(found, mask, pattern, stage->border, scratch));
}

static int parse(void *settings, operation_words *words)
{
    const char *text = NULL;
    const args_option options[] = {{"pattern", 0, NULL, &text}};
    if (!operation_options(words, options, 1)) {
        return 0;
    }
    if (!text) {
        complain(NULL, "no --pattern (see --help)");
        return 0;
    }
    if (iris_hitmiss_pattern_read(settings, text) != IRIS_OK) {
        complain("--pattern", "rows of the same 1 to 8 letters 1, 0, and ., up to 8 with / between, not '%s'",
                 text);
        return 0;
    }
    return 1;
}

const operation operation_hitmiss = {.name = "hitmiss",
                                     .summary = "where a pattern occurs in a mask",
                                     .help = help,
                                     .parse = parse,
                                     .apply = apply};
