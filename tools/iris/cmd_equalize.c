#include <string.h>

#include "commands.h"
#include "iris/xt/equalize.h"
#include "operation.h"

static const char help[] =
    "usage: iris equalize [--local TILES,LIMIT] [--roi x,y,w,h] [--json] IN... -o OUT\n\n"
    "Spreads the levels so that all are used alike. Of color, the lightness; hue and saturation are kept.\n\n"
    "  --local TILES,LIMIT   by the surroundings, for uneven light: in TILES x TILES tiles (1 to 64;\n"
    "                    8 is usual), with the contrast raised at most about LIMIT times (2 to 4 is\n"
    "                    usual, at most 256, 0: any)\n" OPERATION_OPTIONS "\n"
    "example: iris equalize --local 8,3 glare.bmp -o even.bmp\n";

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const iris_equalize_local_config *by = stage->settings;
    const iris_image *levels = stage_levels(stage, input);
    const iris_image *made =
        levels ? stage_picture(stage, (iris_size){input->w, input->h}, levels->format) : NULL;
    if (by->tiles > input->w || by->tiles > input->h) {
        complain(stage->file, "--local: more tiles than the picture of %dx%d has pixels in a row or column",
                 (int)input->w, (int)input->h);
        return EXIT_BAD_CALL;
    }
    size_t bytes = by->tiles > 0 ? IRIS_EQUALIZE_LOCAL_SCRATCH_BYTES(by->tiles) : IRIS_EQUALIZE_SCRATCH_BYTES;
    iris_scratch *scratch = made ? stage_scratch(stage, bytes) : NULL;
    if (!scratch) {
        return EXIT_BAD_DATA;
    }
    *result = *made;
    return stage_exit(stage, by->tiles > 0 ? iris_equalize_local(made, levels, by, scratch)
                                           : iris_equalize(made, levels, scratch));
}

static int read_local(iris_equalize_local_config *by, const char *text)
{
    char tiles[16];
    size_t length = strcspn(text, ",");
    if (length >= sizeof tiles || text[length] != ',') {
        return 0;
    }
    memcpy(tiles, text, length);
    tiles[length] = '\0';
    return args_numbers(&by->tiles, 1, ',', tiles) && by->tiles >= 1 &&
           by->tiles <= IRIS_EQUALIZE_TILES_MAX &&
           args_q16(&by->limit_q16, 0, 256 * IRIS_Q16_ONE, text + length + 1);
}

static int parse(void *settings, operation_words *words)
{
    const char *local = NULL;
    const args_option options[] = {{"local", 0, NULL, &local}};
    if (!operation_options(words, options, 1)) {
        return 0;
    }
    if (local && !read_local(settings, local)) {
        complain("--local", "TILES,LIMIT such as 8,3 with TILES 1 to %d and LIMIT 0 to 256, not '%s'",
                 IRIS_EQUALIZE_TILES_MAX, local);
        return 0;
    }
    return 1;
}

const operation operation_equalize = {.name = "equalize",
                                      .summary = "all levels used alike, everywhere or locally",
                                      .help = help,
                                      .parse = parse,
                                      .apply = apply};
