#include <string.h>

#include "commands.h"
#include "iris/draw.h"
#include "iris/xt/region.h"
#include "operation.h"

static const char help[] =
    "usage: iris quadtree [--tolerance T] [--min N] [--merge M] [--area A] [--show means|regions]\n"
    "                     [--grid] [--roi x,y,w,h] [--json] IN... [-o OUT]\n\n"
    "Divides a picture into blocks, each block into four, until maximum - minimum <= T in every\n"
    "channel, and merges neighboring blocks of similar color into regions.\n\n"
    "  --tolerance T     0 to 255 (default 51, a fifth of the range)\n"
    "  --min N           no side of a block gets below N pixels (default 1)\n"
    "  --merge M         regions and blocks whose means differ by at most M in every channel are\n"
    "                    merged, 0 to 255 (default 25)\n"
    "  --area A          regions below A pixels join a neighbor (default 64)\n"
    "  --show means      each block filled with its mean (the default)\n"
    "  --show regions    each region filled with its mean\n"
    "  --grid            draws the upper and the left edges of all blocks\n" OPERATION_OPTIONS "\n"
    "JSON has leaves (the blocks: x, y, w, h, mean, and region, which counts from 0) and regions,\n"
    "the largest first (mean, area in pixels, leaves, and x, y, w, h of the box around it). mean is\n"
    "a number for gray pictures, [r,g,b] for color; x and y count in the whole picture.\n\n"
    "example: iris quadtree --tolerance 30 --min 2 --grid photo.bmp -o blocks.bmp\n";

typedef struct {
    iris_quadtree_config divide;
    iris_region_config merge;
    int shows_regions, grid;
} settings;

/* What apply leaves for report; the arrays lie behind it. */
typedef struct {
    iris_quadtree tree;
    iris_region_table regions;
} finding;

/* Room for so many leaves, labels, and regions. Null after complaining. */
static finding *make_room(operation_stage *stage, int32_t leaves)
{
    size_t count = (size_t)leaves, each = sizeof(iris_quadtree_leaf) + sizeof(iris_region) + sizeof(int32_t);
    finding *found = stage_room(stage, sizeof *found + count * each);
    if (found) {
        iris_region *regions = (iris_region *)(found + 1);
        int32_t *labels = (int32_t *)(regions + count);
        found->tree.leaves = (iris_quadtree_leaf *)(labels + count);
        found->tree.capacity = leaves;
        found->regions = (iris_region_table){regions, leaves, labels, 0};
        stage->finding = found;
    }
    return found;
}

/* The tree and its regions. Null after complaining. */
static finding *divide(operation_stage *stage, const iris_image *image)
{
    const settings *by = stage->settings;
    iris_quadtree_leaf one;
    iris_quadtree all = {.leaves = &one, .capacity = 1}; /* says how many leaves there are */
    iris_status status = iris_quadtree_segment(&all, image, &by->divide);
    if (status != IRIS_OK && status != IRIS_ERR_FULL) {
        stage_exit(stage, status);
        return NULL;
    }
    finding *found = make_room(stage, all.wanted);
    iris_scratch *scratch =
        found ? stage_scratch(stage, IRIS_REGION_SCRATCH_BYTES(image->w, image->h, all.wanted)) : NULL;
    if (!scratch) {
        return NULL;
    }
    status = iris_quadtree_segment(&found->tree, image, &by->divide);
    if (status == IRIS_OK) {
        status = iris_region_merge(&found->regions, &found->tree, &by->merge, scratch);
    }
    return stage_exit(stage, status) == EXIT_DONE ? found : NULL;
}

static void fill_regions(const iris_image *image, const finding *found)
{
    for (int32_t i = 0; i < found->tree.count; i++) {
        const iris_quadtree_leaf *leaf = &found->tree.leaves[i];
        iris_draw_rect_filled(image, (iris_rect){leaf->x, leaf->y, leaf->w, leaf->h},
                              found->regions.regions[found->regions.labels[i]].mean);
    }
}

/* Halfway from the mean to white on dark blocks, to black on bright ones. */
static iris_color line_color(iris_color mean)
{
    int end = 77 * mean.r + 150 * mean.g + 29 * mean.b < 128 * 256 ? 255 : 0;
    return (iris_color){(uint8_t)((mean.r + end) / 2), (uint8_t)((mean.g + end) / 2),
                        (uint8_t)((mean.b + end) / 2)};
}

static void draw_grid(const iris_image *image, const iris_quadtree *tree)
{
    for (int32_t i = 0; i < tree->count; i++) {
        const iris_quadtree_leaf *leaf = &tree->leaves[i];
        iris_color color = line_color(leaf->mean);
        iris_draw_line(image, leaf->x, leaf->y, leaf->x + leaf->w - 1, leaf->y, color);
        iris_draw_line(image, leaf->x, leaf->y, leaf->x, leaf->y + leaf->h - 1, color);
    }
}

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const settings *by = stage->settings;
    const iris_image *levels = stage_levels(stage, input);
    const iris_image *blocks =
        levels ? stage_picture(stage, (iris_size){input->w, input->h}, levels->format) : NULL;
    finding *found = blocks ? divide(stage, levels) : NULL;
    if (!found) {
        return EXIT_BAD_DATA;
    }
    *result = *blocks;
    if (by->shows_regions) {
        fill_regions(blocks, found);
    } else {
        iris_quadtree_means(blocks, &found->tree);
    }
    if (by->grid) {
        draw_grid(blocks, &found->tree);
    }
    return EXIT_DONE;
}

static void report_place(json_writer *json, const operation_stage *stage, iris_rect place)
{
    int32_t x, y;
    stage_origin(&x, &y, stage);
    json_key(json, "x");
    json_integer(json, x + place.x);
    json_key(json, "y");
    json_integer(json, y + place.y);
    json_key(json, "w");
    json_integer(json, place.w);
    json_key(json, "h");
    json_integer(json, place.h);
}

static void report_mean(json_writer *json, iris_color mean, iris_format format)
{
    json_key(json, "mean");
    if (format == IRIS_GRAY8) {
        json_integer(json, mean.g);
        return;
    }
    json_open(json, '[');
    json_integer(json, mean.r);
    json_integer(json, mean.g);
    json_integer(json, mean.b);
    json_close(json, ']');
}

static void report(json_writer *json, const operation_stage *stage)
{
    const finding *found = stage->finding;
    json_key(json, "leaves");
    json_open(json, '[');
    for (int32_t i = 0; i < found->tree.count; i++) {
        const iris_quadtree_leaf *leaf = &found->tree.leaves[i];
        json_open(json, '{');
        report_place(json, stage, (iris_rect){leaf->x, leaf->y, leaf->w, leaf->h});
        report_mean(json, leaf->mean, found->tree.format);
        json_key(json, "region");
        json_integer(json, found->regions.labels[i]);
        json_close(json, '}');
    }
    json_close(json, ']');
    json_key(json, "regions");
    json_open(json, '[');
    for (int32_t i = 0; i < found->regions.count; i++) {
        const iris_region *region = &found->regions.regions[i];
        json_open(json, '{');
        report_mean(json, region->mean, found->tree.format);
        json_key(json, "area");
        json_integer(json, region->area);
        json_key(json, "leaves");
        json_integer(json, region->leaves);
        report_place(json, stage, region->box);
        json_close(json, '}');
    }
    json_close(json, ']');
}

/* A number of the range, of the option; text null: it stays as it is. Returns 0 after complaining. */
static int read_number(int32_t *number, int32_t least, int32_t most, const char *option, const char *text)
{
    int32_t read;
    if (!text) {
        return 1;
    }
    if (!args_numbers(&read, 1, ',', text) || read < least || read > most) {
        complain(option, "%d to %d, not '%s'", (int)least, (int)most, text);
        return 0;
    }
    *number = read;
    return 1;
}

static int parse(void *memory, operation_words *words)
{
    settings *by = memory;
    const char *tolerance = NULL, *least = NULL, *merge = NULL, *area = NULL, *show = "means";
    const args_option options[] = {{"tolerance", 0, NULL, &tolerance}, {"min", 0, NULL, &least},
                                   {"merge", 0, NULL, &merge},         {"area", 0, NULL, &area},
                                   {"show", 0, NULL, &show},           {"grid", 0, &by->grid, NULL}};
    iris_quadtree_defaults(&by->divide);
    iris_region_defaults(&by->merge);
    if (!operation_options(words, options, sizeof options / sizeof options[0]) ||
        !read_number(&by->divide.tolerance, 0, 255, "--tolerance", tolerance) ||
        !read_number(&by->divide.least_side, 1, IRIS_SIDE_MAX, "--min", least) ||
        !read_number(&by->merge.tolerance, 0, 255, "--merge", merge) ||
        !read_number(&by->merge.least_area, 0, INT32_MAX, "--area", area)) {
        return 0;
    }
    by->shows_regions = strcmp(show, "regions") == 0;
    if (!by->shows_regions && strcmp(show, "means") != 0) {
        complain("--show", "means or regions, not '%s'", show);
        return 0;
    }
    return 1;
}

const operation operation_quadtree = {.name = "quadtree",
                                      .summary = "even blocks, and regions of similar color",
                                      .help = help,
                                      .parse = parse,
                                      .apply = apply,
                                      .report = report,
                                      .reports_alone = 1};
