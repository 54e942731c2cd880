#include <string.h>

#include "canvas.h"
#include "commands.h"
#include "floor_option.h"
#include "iris/xt/line_mask.h"
#include "iris/xt/paths.h"
#include "operation.h"

static const char help[] =
    "usage: iris paths [--line dark|bright] [--method skeleton|quadtree] [--floor FLOOR] [--roi x,y,w,h]\n"
    "                  [--json] IN... [-o OUT]\n\n"
    "The lines on a floor, told apart, the longest first. Of a mask the white lines, of a gray or color\n"
    "picture those that are darker than the floor around them.\n\n"
    "  --line KIND        dark (the default) or bright lines\n"
    "  --method skeleton  lines followed along their middles, and straight through crossings (the default)\n"
    "  --method quadtree  by blocks: coarser, and lines that cross or touch are not told "
    "apart\n" FLOOR_OPTION_HELP OPERATION_OPTIONS "\n"
    "JSON has paths: x0, y0, x1, y1 (the ends, the lower one first), width, angle_deg (0 straight up, "
    "positive\n"
    "when it leans right), and length. With --floor also x0_mm, y0_mm, x1_mm, y1_mm, length_mm (of\n"
    "the straight way), and true_deg, the direction from x0, y0 to x1, y1 on the floor (0 straight ahead,\n"
    "right positive); null beyond the horizon. With -o a picture with each line in a color of its own.\n\n"
    "example: iris paths --json floor.bmp -o lines.bmp\n";

enum { PATHS_MAX = 64, LEAVES_MAX = 65536, REGIONS_MAX = 4096 };

typedef struct {
    int bright, quadtree;
    floor_option floor;
} settings;

/* What apply leaves for report. */
typedef struct {
    iris_path paths[PATHS_MAX];
    int32_t count;
    iris_region regions[REGIONS_MAX];
    iris_quadtree_leaf leaves[LEAVES_MAX];
    int32_t labels[LEAVES_MAX];
} finding;

static int32_t shown(const finding *found)
{
    return found->count < PATHS_MAX ? found->count : PATHS_MAX;
}

static iris_status by_skeleton(finding *found, const iris_image *mask, operation_stage *stage)
{
    iris_scratch *scratch = stage_scratch(stage, IRIS_PATHS_SCRATCH_BYTES(mask->w, mask->h));
    return scratch ? iris_paths_find(found->paths, PATHS_MAX, &found->count, mask, NULL, scratch)
                   : IRIS_ERR_SCRATCH;
}

static const iris_image *mask_of(const iris_image *gray, operation_stage *stage)
{
    const settings *by = stage->settings;
    const iris_line_mask_config config = {by->bright, 300};
    const iris_image *mask = stage_picture(stage, (iris_size){gray->w, gray->h}, IRIS_MASK1);
    iris_scratch *scratch =
        mask ? stage_scratch(stage, IRIS_LINE_MASK_SCRATCH_BYTES(gray->w, gray->h)) : NULL;
    return scratch && stage_exit(stage, iris_line_mask(NULL, mask, gray, &config, scratch)) == EXIT_DONE
               ? mask
               : NULL;
}

static iris_status by_blocks(finding *found, const iris_image *gray, int bright, operation_stage *stage)
{
    iris_quadtree tree = {.leaves = found->leaves, .capacity = LEAVES_MAX};
    iris_region_table table = {found->regions, REGIONS_MAX, found->labels, 0};
    iris_paths_config config;
    iris_paths_defaults(&config);
    config.bright = bright;
    iris_status status = iris_quadtree_segment(&tree, gray, NULL);
    iris_scratch *scratch =
        stage_scratch(stage, IRIS_REGION_SCRATCH_BYTES(gray->w, gray->h, tree.count > 0 ? tree.count : 1));
    if (!scratch || (status != IRIS_OK && status != IRIS_ERR_FULL)) {
        return scratch ? status : IRIS_ERR_SCRATCH;
    }
    status = iris_region_merge(&table, &tree, NULL, scratch);
    if (status == IRIS_ERR_FULL) { /* the largest are enough */
        table.count = REGIONS_MAX;
        status = IRIS_OK;
    }
    return status == IRIS_OK
               ? iris_paths_of_regions(found->paths, PATHS_MAX, &found->count, &tree, &table, &config)
               : status;
}

static const iris_image *overlay(const iris_image *input, const finding *found, operation_stage *stage)
{
    const iris_image *color = stage_color(stage, input);
    color = color ? stage_copy(stage, color) : NULL;
    for (int32_t i = 0; color && i < shown(found); i++) {
        canvas on = canvas_plain(color);
        const iris_path *p = &found->paths[i];
        canvas_line(&on, (canvas_point){p->x0, p->y0}, (canvas_point){p->x1, p->y1}, canvas_color(i));
        canvas_circle(&on, (canvas_point){p->x0, p->y0}, p->width_px / 2.0 + 1, canvas_color(i));
        canvas_circle(&on, (canvas_point){p->x1, p->y1}, p->width_px / 2.0 + 1, canvas_color(i));
    }
    return color;
}

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const settings *by = stage->settings;
    finding *found = stage_room(stage, sizeof *found);
    int is_mask = input->format == IRIS_MASK1;
    const iris_image *seen = NULL;
    if (!floor_option_fits(&by->floor, stage)) {
        return EXIT_BAD_DATA;
    }
    if (found && !(is_mask && !by->quadtree)) {
        seen = stage_gray(stage, input);
        seen = seen && !by->quadtree ? mask_of(seen, stage) : seen;
    } else if (found) {
        seen = input;
    }
    if (!seen) {
        return EXIT_BAD_DATA;
    }
    iris_status status =
        by->quadtree ? by_blocks(found, seen, by->bright || is_mask, stage) : by_skeleton(found, seen, stage);
    int exit_code = status == IRIS_ERR_FULL ? EXIT_DONE : stage_exit(stage, status);
    const iris_image *drawn = exit_code == EXIT_DONE ? overlay(input, found, stage) : NULL;
    if (!drawn) {
        return EXIT_BAD_DATA;
    }
    stage->finding = found;
    *result = *drawn;
    return EXIT_DONE;
}

static void report(json_writer *json, const operation_stage *stage)
{
    static const char *const names[] = {"x0", "y0", "x1", "y1", "width"};
    const settings *by = stage->settings;
    const finding *found = stage->finding;
    int32_t x, y;
    stage_origin(&x, &y, stage);
    json_key(json, "count");
    json_integer(json, found->count);
    json_key(json, "paths");
    json_open(json, '[');
    for (int32_t i = 0; i < shown(found); i++) {
        const iris_path *p = &found->paths[i];
        const int32_t values[] = {p->x0 + x, p->y0 + y, p->x1 + x, p->y1 + y, p->width_px};
        json_open(json, '{');
        for (int k = 0; k < 5; k++) {
            json_key(json, names[k]);
            json_integer(json, values[k]);
        }
        json_key(json, "angle_deg");
        json_number(json, iris_angle_to_centidegrees(p->angle) / 100.0, 1);
        json_key(json, "length");
        json_integer(json, p->length_px);
        floor_option_json_line(json, &by->floor, iris_place_of(values[0], values[1]),
                               iris_place_of(values[2], values[3]));
        json_close(json, '}');
    }
    json_close(json, ']');
}

static void print(FILE *out, const operation_stage *stage)
{
    const settings *by = stage->settings;
    const finding *found = stage->finding;
    int32_t x, y;
    stage_origin(&x, &y, stage);
    fprintf(out, "%d line%s\n", (int)found->count, found->count == 1 ? "" : "s");
    for (int32_t i = 0; i < shown(found); i++) {
        const iris_path *p = &found->paths[i];
        fprintf(out, "  %d,%d to %d,%d  width %d  angle %+.1f  length %d", (int)(p->x0 + x), (int)(p->y0 + y),
                (int)(p->x1 + x), (int)(p->y1 + y), (int)p->width_px,
                iris_angle_to_centidegrees(p->angle) / 100.0, (int)p->length_px);
        floor_option_print_line(out, &by->floor, iris_place_of(p->x0 + x, p->y0 + y),
                                iris_place_of(p->x1 + x, p->y1 + y));
        fputc('\n', out);
    }
}

/* Which of the two words; -1 after complaining. */
static int word_of(const char *option, const char *first, const char *second, const char *text)
{
    if (strcmp(text, first) != 0 && strcmp(text, second) != 0) {
        complain(option, "%s or %s, not '%s'", first, second, text);
        return -1;
    }
    return strcmp(text, second) == 0;
}

static int parse(void *memory, operation_words *words)
{
    settings *by = memory;
    const char *line = "dark", *method = "skeleton", *floor = NULL;
    const args_option options[] = {
        {"line", 0, NULL, &line}, {"method", 0, NULL, &method}, {"floor", 0, NULL, &floor}};
    if (!operation_options(words, options, 3)) {
        return 0;
    }
    by->bright = word_of("--line", "dark", "bright", line);
    by->quadtree = by->bright < 0 ? -1 : word_of("--method", "skeleton", "quadtree", method);
    return by->quadtree >= 0 && floor_option_read(&by->floor, floor, words);
}

const operation operation_paths = {.name = "paths",
                                   .summary = "the lines on a floor, told apart",
                                   .help = help,
                                   .parse = parse,
                                   .apply = apply,
                                   .report = report,
                                   .print = print,
                                   .reports_alone = 1};
