#include "iris/quadtree.h"

#include <stdbool.h>
#include <string.h>

#include "mean.h"
#include "views.h"

/* Sides of up to 32767 pixels are halved at most 15 times; each time up to three blocks wait for the first. */
#define DEPTH_MAX 15
#define WAITING   (3 * DEPTH_MAX + 1)

typedef struct {
    uint16_t x, y, w, h;
} block;

/* What was seen of a block, per channel as it lies in memory. */
typedef struct {
    uint8_t low[3], high[3];
    uint64_t sum[3];
} levels;

void iris_quadtree_defaults(iris_quadtree_config *config)
{
    if (config) {
        *config = (iris_quadtree_config){51, 1};
    }
}

static void add_row(levels *seen, const uint8_t *row, int32_t n, int32_t channels)
{
    for (int32_t c = 0; c < channels; c++) {
        uint32_t low = seen->low[c], high = seen->high[c], sum = 0;
        const uint8_t *end = row + (ptrdiff_t)n * channels;
        for (const uint8_t *p = row + c; p < end; p += channels) {
            low = *p < low ? *p : low;
            high = *p > high ? *p : high;
            sum += *p;
        }
        seen->low[c] = (uint8_t)low;
        seen->high[c] = (uint8_t)high;
        seen->sum[c] += sum;
    }
}

static int32_t range_of(const levels *seen, int32_t channels)
{
    int32_t range = 0;
    for (int32_t c = 0; c < channels; c++) {
        int32_t here = seen->high[c] - seen->low[c];
        range = here > range ? here : range;
    }
    return range;
}

/* Looks at a block, row by row while its range is at most `tolerance`. Returns the range. */
static int32_t look(levels *seen, const iris_image *image, const block *b, int32_t tolerance)
{
    int32_t channels = image->format == IRIS_GRAY8 ? 1 : 3, range = 0;
    *seen = (levels){{255, 255, 255}, {0, 0, 0}, {0, 0, 0}};
    for (int32_t y = 0; y < b->h && range <= tolerance; y++) {
        const uint8_t *row = (const uint8_t *)iris_image_row(image, b->y + y);
        add_row(seen, row + (ptrdiff_t)b->x * channels, b->w, channels);
        range = range_of(seen, channels);
    }
    return range;
}

static iris_quadtree_leaf leaf_of(const block *b, const levels *seen, int32_t range, iris_format format)
{
    uint32_t area = (uint32_t)b->w * b->h;
    iris_quadtree_leaf leaf = {b->x, b->y, b->w, b->h, {0, 0, 0}, (uint8_t)range};
    leaf.mean.r = iris_mean_u8(seen->sum[0], area);
    leaf.mean.g = format == IRIS_GRAY8 ? leaf.mean.r : iris_mean_u8(seen->sum[1], area);
    leaf.mean.b = format == IRIS_GRAY8 ? leaf.mean.r : iris_mean_u8(seen->sum[2], area);
    if (format == IRIS_BGR888) {
        uint8_t red = leaf.mean.b;
        leaf.mean.b = leaf.mean.r;
        leaf.mean.r = red;
    }
    return leaf;
}

/* The smaller half of a side, 0 if it cannot be halved. */
static int32_t half_of(int32_t side, int32_t least_side)
{
    return side / 2 >= least_side ? side / 2 : 0;
}

/* Puts the parts of a block with the smaller halves w2, h2 on the stack, the first one on top. Returns its new height. */
static int32_t divide(block *waiting, int32_t count, block b, int32_t w2, int32_t h2)
{
    uint16_t w1 = (uint16_t)(b.w - w2), h1 = (uint16_t)(b.h - h2);
    uint16_t x2 = (uint16_t)(b.x + w1), y2 = (uint16_t)(b.y + h1);
    if (w2 > 0 && h2 > 0) {
        waiting[count++] = (block){x2, y2, (uint16_t)w2, (uint16_t)h2};
    }
    if (h2 > 0) {
        waiting[count++] = (block){b.x, y2, w1, (uint16_t)h2};
    }
    if (w2 > 0) {
        waiting[count++] = (block){x2, b.y, (uint16_t)w2, h1};
    }
    waiting[count++] = (block){b.x, b.y, w1, h1};
    return count;
}

/* Writes the leaves there is room for, and returns how many there are; stops at `most`. */
static int32_t walk(iris_quadtree *tree, const iris_image *image, int32_t tolerance, int32_t least_side,
                    int32_t most)
{
    block waiting[WAITING];
    int32_t leaves = 0, count = 1;
    waiting[0] = (block){0, 0, (uint16_t)image->w, (uint16_t)image->h};
    while (count > 0 && leaves < most) {
        block b = waiting[--count];
        int32_t w2 = half_of(b.w, least_side), h2 = half_of(b.h, least_side);
        bool is_last = w2 == 0 && h2 == 0;
        levels seen;
        int32_t range = look(&seen, image, &b, is_last ? 255 : tolerance);
        if (!is_last && range > tolerance) {
            count = divide(waiting, count, b, w2, h2);
            continue;
        }
        if (leaves < tree->capacity) {
            tree->leaves[leaves] = leaf_of(&b, &seen, range, image->format);
        }
        leaves++;
    }
    return leaves;
}

iris_status iris_quadtree_segment(iris_quadtree *tree, const iris_image *image,
                                  const iris_quadtree_config *config)
{
    iris_quadtree_config by;
    iris_quadtree_defaults(&by);
    by = config ? *config : by;
    if (!tree || !image || !tree->leaves || tree->capacity < 1 || by.tolerance < 0 || by.tolerance > 255 ||
        by.least_side < 1 || by.least_side > IRIS_SIDE_MAX) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_image_check(image);
    if (status != IRIS_OK || !iris_format_is_levels(image->format)) {
        return status != IRIS_OK ? status : IRIS_ERR_FORMAT;
    }
    tree->wanted = walk(tree, image, by.tolerance, by.least_side, INT32_MAX);
    tree->count = tree->wanted;
    while (tree->count > tree->capacity) {
        by.least_side *= 2; /* at the latest, the whole picture is one block */
        tree->count = walk(tree, image, by.tolerance, by.least_side, tree->capacity + 1);
    }
    tree->tolerance = by.tolerance;
    tree->least_side = by.least_side;
    tree->size = (iris_size){image->w, image->h};
    tree->format = image->format;
    return tree->count < tree->wanted ? IRIS_ERR_FULL : IRIS_OK;
}

static void fill(uint8_t *row, const iris_quadtree_leaf *leaf, iris_format format)
{
    if (format == IRIS_GRAY8) {
        memset(row, leaf->mean.r, leaf->w);
        return;
    }
    uint8_t first = format == IRIS_RGB888 ? leaf->mean.r : leaf->mean.b;
    uint8_t last = format == IRIS_RGB888 ? leaf->mean.b : leaf->mean.r;
    for (int32_t x = 0; x < leaf->w; x++, row += 3) {
        row[0] = first;
        row[1] = leaf->mean.g;
        row[2] = last;
    }
}

iris_status iris_quadtree_check(const iris_quadtree *tree)
{
    if (!tree || !tree->leaves || tree->count < 1) {
        return IRIS_ERR_ARG;
    }
    if (!iris_format_is_levels(tree->format)) {
        return IRIS_ERR_FORMAT;
    }
    iris_size size = tree->size;
    if (size.w < 1 || size.w > IRIS_SIDE_MAX || size.h < 1 || size.h > IRIS_SIDE_MAX) {
        return IRIS_ERR_RANGE;
    }
    uint32_t left = (uint32_t)size.w * (uint32_t)size.h; /* pixels of the picture without a leaf */
    for (int32_t i = 0; i < tree->count; i++) {
        const iris_quadtree_leaf *leaf = &tree->leaves[i];
        uint32_t area = (uint32_t)leaf->w * leaf->h;
        if (leaf->x + leaf->w > size.w || leaf->y + leaf->h > size.h || area == 0 || area > left) {
            return IRIS_ERR_RANGE;
        }
        left -= area;
    }
    return left == 0 ? IRIS_OK : IRIS_ERR_RANGE;
}

iris_status iris_quadtree_means(const iris_image *dst, const iris_quadtree *tree)
{
    iris_status status = dst ? iris_image_check(dst) : IRIS_ERR_ARG;
    if (status == IRIS_OK) {
        status = iris_quadtree_check(tree);
    }
    if (status != IRIS_OK) {
        return status;
    }
    if (!iris_format_is_levels(dst->format) || (dst->format == IRIS_GRAY8 && tree->format != IRIS_GRAY8)) {
        return IRIS_ERR_FORMAT;
    }
    if (dst->w != tree->size.w || dst->h != tree->size.h) {
        return IRIS_ERR_RANGE;
    }
    int32_t channels = dst->format == IRIS_GRAY8 ? 1 : 3;
    for (int32_t i = 0; i < tree->count; i++) {
        const iris_quadtree_leaf *leaf = &tree->leaves[i];
        for (int32_t y = 0; y < leaf->h; y++) {
            uint8_t *row = (uint8_t *)iris_image_row(dst, leaf->y + y);
            fill(row + (ptrdiff_t)leaf->x * channels, leaf, dst->format);
        }
    }
    return IRIS_OK;
}
