#include <string.h>

#include "iris/quadtree.h"
#include "stereo_costs.h"
#include "stereo_pick.h"

#define TILE  4  /* pixels: the least side of a leaf */
#define SKIP  2  /* of so many rows one is compared */
#define BLOCK 16 /* pixels: a larger leaf is cut into blocks of at most that */

/* Weights of a window's tiles: of the block, outside of it and as bright as the leaf, and others. */
enum { OWN = 6, ALIKE = 4, OTHER = 1 };

#define ALIKE_LEVELS 10 /* at most so many gray levels between the means */

/* The costs of all tiles, TILE x TILE pixels each. */
typedef struct {
    int32_t columns, rows, steps;
    uint16_t *costs;  /* rows times columns times steps */
    uint8_t *means;   /* gray levels, one per tile */
    uint32_t *sums;   /* of a window: steps */
    uint16_t *halves; /* of these: they are below 2^17 */
} tiles;

void iris_stereo_quadtree_defaults(iris_stereo_quadtree_config *config)
{
    if (config) {
        *config = (iris_stereo_quadtree_config){63, IRIS_STEREO_CENSUS, 20};
    }
}

static void fill_tiles(const tiles *t, const iris_stereo_costs *c)
{
    size_t row = (size_t)t->columns * (size_t)t->steps;
    memset(t->costs, 0, 2 * row * (size_t)t->rows);
    for (int32_t y = 0; y < c->left->h; y += SKIP) {
        const uint8_t *costs = iris_stereo_costs_pixels(c, y);
        uint16_t *to = t->costs + (size_t)(y / TILE) * row;
        for (int32_t x = 0; x < c->w; x++) {
            for (int32_t d = 0; d < t->steps; d++) {
                to[d] = (uint16_t)(to[d] + costs[d]);
            }
            costs += t->steps;
            to += x % TILE == TILE - 1 ? t->steps : 0;
        }
    }
}

static void fill_means(const tiles *t, const iris_image *left)
{
    for (int32_t i = 0; i < t->columns * t->rows; i++) {
        int32_t x = i % t->columns * TILE, y = i / t->columns * TILE, sum = 0;
        int32_t w = left->w - x < TILE ? left->w - x : TILE, h = left->h - y < TILE ? left->h - y : TILE;
        for (int32_t k = 0; k < h; k++) {
            const uint8_t *row = (const uint8_t *)iris_image_row(left, y + k) + x;
            for (int32_t n = 0; n < w; n++) {
                sum += row[n];
            }
        }
        t->means[i] = (uint8_t)(sum / (w * h));
    }
}

/* Tiles that a side of a block touches, and one more at each end. */
static void reach(int32_t *first, int32_t *last, int32_t at, int32_t side, int32_t count)
{
    *first = at / TILE - 1 < 0 ? 0 : at / TILE - 1;
    *last = (at + side - 1) / TILE + 1 >= count ? count - 1 : (at + side - 1) / TILE + 1;
}

static uint32_t weight_of(const tiles *t, int32_t x, int32_t y, const iris_rect *block, int32_t mean)
{
    int32_t apart = t->means[y * t->columns + x] - mean;
    int inside = x >= block->x / TILE && x <= (block->x + block->w - 1) / TILE && y >= block->y / TILE &&
                 y <= (block->y + block->h - 1) / TILE;
    return inside ? OWN : apart <= ALIKE_LEVELS && -apart <= ALIKE_LEVELS ? ALIKE : OTHER;
}

static void sum_window(const tiles *t, const iris_rect *block, int32_t mean)
{
    int32_t left, right, top, bottom;
    reach(&left, &right, block->x, block->w, t->columns);
    reach(&top, &bottom, block->y, block->h, t->rows);
    memset(t->sums, 0, 4 * (size_t)t->steps);
    for (int32_t y = top; y <= bottom; y++) {
        const uint16_t *costs = t->costs + ((size_t)y * (size_t)t->columns + (size_t)left) * (size_t)t->steps;
        for (int32_t x = left; x <= right; x++, costs += t->steps) {
            uint32_t weight = weight_of(t, x, y, block, mean);
            for (int32_t d = 0; d < t->steps; d++) {
                t->sums[d] += weight * costs[d];
            }
        }
    }
    for (int32_t d = 0; d < t->steps; d++) {
        t->halves[d] = (uint16_t)(t->sums[d] / 2);
    }
}

static void match_block(const iris_image *disparity, const tiles *t, iris_rect block, int32_t mean)
{
    int32_t center = block.x + block.w / 2;
    sum_window(t, &block, mean);
    uint16_t found = iris_stereo_best(t->halves, center < t->steps - 1 ? center + 1 : t->steps);
    for (int32_t y = 0; y < block.h; y++) {
        uint16_t *row = (uint16_t *)iris_image_row(disparity, block.y + y) + block.x;
        for (int32_t x = 0; x < block.w; x++) {
            row[x] = found;
        }
    }
}

/* A leaf, block by block. */
static void match_leaf(const iris_image *disparity, const tiles *t, const iris_quadtree_leaf *leaf)
{
    for (int32_t y = 0; y < leaf->h; y += BLOCK) {
        for (int32_t x = 0; x < leaf->w; x += BLOCK) {
            int32_t w = leaf->w - x < BLOCK ? leaf->w - x : BLOCK,
                    h = leaf->h - y < BLOCK ? leaf->h - y : BLOCK;
            match_block(disparity, t, (iris_rect){leaf->x + x, leaf->y + y, w, h}, leaf->mean.g);
        }
    }
}

static iris_status match(const iris_image *disparity, const iris_image *left, const iris_image *right,
                         const iris_stereo_quadtree_config *config, iris_scratch *scratch)
{
    const iris_stereo_config common = {config->max_disparity, config->cost, 255, 0, 0, 0};
    iris_stereo_costs costs;
    tiles t = {.columns = (left->w + TILE - 1) / TILE,
               .rows = (left->h + TILE - 1) / TILE,
               .steps = config->max_disparity + 1};
    size_t count = IRIS_STEREO_TILES(left->w, left->h);
    if (count > SIZE_MAX / 4 / (size_t)t.steps) {
        return IRIS_ERR_RANGE;
    }
    iris_status status = iris_stereo_costs_begin(&costs, left, right, &common, 0, scratch);
    t.costs = iris_scratch_take(scratch, 2 * count * (size_t)t.steps);
    t.means = iris_scratch_take(scratch, count);
    t.sums = iris_scratch_take(scratch, 4 * (size_t)t.steps);
    t.halves = iris_scratch_take(scratch, 2 * (size_t)t.steps);
    iris_quadtree tree = {.leaves = iris_scratch_take(scratch, count * sizeof *tree.leaves),
                          .capacity = (int32_t)count};
    if (status != IRIS_OK || !t.costs || !t.means || !t.sums || !t.halves || !tree.leaves) {
        return IRIS_ERR_SCRATCH;
    }
    fill_tiles(&t, &costs);
    fill_means(&t, left);
    status = iris_quadtree_segment(&tree, left, &(iris_quadtree_config){config->tolerance, TILE});
    for (int32_t i = 0; i < tree.count && status == IRIS_OK; i++) {
        match_leaf(disparity, &t, &tree.leaves[i]);
    }
    return status;
}

iris_status iris_stereo_quadtree(const iris_image *disparity, const iris_image *left, const iris_image *right,
                                 const iris_stereo_quadtree_config *config, iris_scratch *scratch)
{
    iris_stereo_quadtree_config defaults;
    iris_stereo_quadtree_defaults(&defaults);
    config = config ? config : &defaults;
    if (!disparity || !left || !right || !scratch || config->tolerance < 0 || config->tolerance > 255) {
        return IRIS_ERR_ARG;
    }
    const iris_stereo_config common = {config->max_disparity, config->cost, 255, 0, 0, 0};
    iris_status status = iris_stereo_check(disparity, left, right, &common);
    if (status == IRIS_OK) {
        size_t mark = iris_scratch_mark(scratch);
        status = match(disparity, left, right, config, scratch);
        iris_scratch_release(scratch, mark);
    }
    return status;
}
