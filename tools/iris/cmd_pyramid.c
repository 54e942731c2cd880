#include <stdio.h>

#include "commands.h"
#include "iris/copy.h"
#include "iris/pyramid.h"
#include "operation.h"

static const char help[] =
    "usage: iris pyramid [--levels N | --level K | --up] [--border RULE] [--json] IN... -o OUT\n\n"
    "Pictures smoothed and halved, again and again: level 0 is the picture, level 1 half its\n"
    "size, and so on (rounded up).\n\n"
    "  --levels N        N levels in one picture, 1 to 16 (the default: 4): level 0 at the left,\n"
    "                    the others below each other beside it\n"
    "  --level K         level K alone, 0 to 15\n"
    "  --up              the other way: twice the size, smoothed\n"
    "  --border RULE     beyond the edge: replicate (the default), reflect (mirrored at the\n"
    "                    outermost pixel), or constant (black; constant:N for level N)\n"
    "  --json            one JSON object per picture, with the place of each level in it\n"
    "  -o OUT            .bmp, .pgm, or .ppm; a folder for several inputs; -: standard output\n\n"
    "example: iris pyramid --level 2 photo.bmp -o quarter.bmp\n";

typedef struct {
    int32_t levels; /* in one picture; 0: one alone */
    int32_t level;
    int up;
} pyramid_settings;

/* What is reported; the levels' pixels lie behind it in the stage's room. */
typedef struct {
    iris_pyramid pyramid;
    iris_rect places[IRIS_PYRAMID_LEVELS_MAX];
    int32_t first, end; /* levels in the result */
} pyramid_finding;

/* Where each level goes. Returns the size of all. */
static iris_size arrange(pyramid_finding *found)
{
    const iris_image *level = found->pyramid.level;
    iris_size size = {level[0].w, level[0].h};
    found->places[0] = (iris_rect){0, 0, level[0].w, level[0].h};
    for (int32_t i = 1, y = 0; i < found->pyramid.levels; i++) {
        found->places[i] = (iris_rect){level[0].w, y, level[i].w, level[i].h};
        size.w = level[0].w + level[1].w;
        y += level[i].h;
        size.h = y > size.h ? y : size.h;
    }
    return size;
}

static int show_all(iris_image *result, pyramid_finding *found, operation_stage *stage)
{
    const iris_image *canvas = stage_picture(stage, arrange(found), found->pyramid.level[0].format);
    if (!canvas) {
        return EXIT_BAD_DATA;
    }
    iris_fill(canvas, 0);
    for (int32_t i = 0; i < found->pyramid.levels; i++) {
        iris_paste(canvas, &found->pyramid.level[i], found->places[i].x, found->places[i].y);
    }
    *result = *canvas;
    return EXIT_DONE;
}

static int double_size(iris_image *result, const iris_image *from, operation_stage *stage)
{
    const int channels = from->format == IRIS_GRAY8 ? 1 : 3;
    const iris_image *large = stage_picture(stage, (iris_size){2 * from->w, 2 * from->h}, from->format);
    iris_scratch *scratch =
        large ? stage_scratch(stage, IRIS_PYRAMID_UP_SCRATCH_BYTES(from->w, channels)) : NULL;
    if (!scratch) {
        return EXIT_BAD_DATA;
    }
    *result = *large;
    return stage_exit(stage, iris_pyramid_up(large, from, stage->border, scratch));
}

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const pyramid_settings *with = stage->settings;
    const iris_image *from = stage_levels(stage, input);
    if (!from) {
        return EXIT_BAD_DATA;
    }
    if (with->up) {
        return double_size(result, from, stage);
    }
    const int channels = from->format == IRIS_GRAY8 ? 1 : 3;
    const int32_t levels = with->levels ? with->levels : with->level + 1;
    size_t bytes = IRIS_PYRAMID_BYTES(from->w, from->h, channels, levels);
    pyramid_finding *found = stage_room(stage, sizeof *found + bytes);
    iris_scratch *scratch =
        found ? stage_scratch(stage, IRIS_PYRAMID_SCRATCH_BYTES(from->w, channels)) : NULL;
    if (!scratch) {
        return EXIT_BAD_DATA;
    }
    iris_status status = iris_pyramid_wrap(&found->pyramid, from, levels, found + 1, bytes);
    if (status == IRIS_OK) {
        status = iris_pyramid_build(&found->pyramid, stage->border, scratch);
    }
    if (status != IRIS_OK) {
        return stage_exit(stage, status);
    }
    stage->finding = found;
    found->end = levels;
    if (with->levels) {
        return show_all(result, found, stage);
    }
    found->first = levels - 1;
    *result = found->pyramid.level[found->first];
    found->places[found->first] = (iris_rect){0, 0, result->w, result->h};
    return EXIT_DONE;
}

static void report(json_writer *json, const operation_stage *stage)
{
    const pyramid_finding *found = stage->finding;
    json_key(json, "levels");
    json_open(json, '[');
    for (int32_t i = found ? found->first : 0; found && i < found->end; i++) {
        const int32_t numbers[] = {i, found->places[i].x, found->places[i].y, found->places[i].w,
                                   found->places[i].h};
        static const char *const names[] = {"level", "x", "y", "w", "h"};
        json_open(json, '{');
        for (int k = 0; k < 5; k++) {
            json_key(json, names[k]);
            json_integer(json, numbers[k]);
        }
        json_close(json, '}');
    }
    json_close(json, ']');
}

/* Reads a number from `least` on, IRIS_PYRAMID_LEVELS_MAX of them. Returns 0 after complaining. */
static int read_count(int32_t *number, const char *option, int32_t least, const char *text)
{
    int32_t most = least + IRIS_PYRAMID_LEVELS_MAX - 1;
    if (!args_numbers(number, 1, ',', text) || *number < least || *number > most) {
        complain(option, "%d to %d, not '%s'", (int)least, (int)most, text);
        return 0;
    }
    return 1;
}

static int parse(void *settings, operation_words *words)
{
    pyramid_settings *with = settings;
    const char *levels = NULL, *level = NULL;
    const args_option options[] = {
        {"levels", 0, NULL, &levels}, {"level", 0, NULL, &level}, {"up", 0, &with->up, NULL}};
    if (!operation_options(words, options, sizeof options / sizeof options[0])) {
        return 0;
    }
    if ((levels != NULL) + (level != NULL) + with->up > 1) {
        complain(NULL, "one of --levels, --level, and --up");
        return 0;
    }
    if (words->stage->border.rule == IRIS_BORDER_SKIP) {
        complain("--border", "not skip: pixels would be left without a value");
        return 0;
    }
    with->levels = level ? 0 : 4;
    return (!levels || read_count(&with->levels, "--levels", 1, levels)) &&
           (!level || read_count(&with->level, "--level", 0, level));
}

const operation operation_pyramid = {.name = "pyramid",
                                     .summary = "smoothed at half the size, and half of that",
                                     .help = help,
                                     .parse = parse,
                                     .apply = apply,
                                     .report = report,
                                     .has_border = 1,
                                     .reshapes = 1};
