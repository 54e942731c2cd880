#include "stereo_level.h"

#include <string.h>

#define TILE IRIS_STEREO_TILE
#define SKIP 2 /* of so many rows one is compared */

#define NEAR 1 /* pixels around what the coarser level found that cost less, too */
#define LESS 6 /* by so much for a tile: less than a bit of each pixel compared */

int32_t iris_stereo_plane_at(const iris_stereo_patch *patch, int32_t x2, int32_t y2, int32_t most)
{
    int64_t dx = x2 - 2 * patch->x - patch->w + 1, dy = y2 - 2 * patch->y - patch->h + 1;
    int64_t d = patch->d + (patch->a * dx + patch->b * dy) / 2, end = (int64_t)most << IRIS_STEREO_FRACTION;
    return (int32_t)(d < 0 ? 0 : d > end ? end : d);
}

int32_t iris_stereo_tile_at(const iris_stereo_level *level, const iris_stereo_patch *patch, int32_t column,
                            int32_t row)
{
    return iris_stereo_plane_at(patch, 2 * TILE * column + TILE - 1, 2 * TILE * row + TILE - 1, level->most);
}

/* --- costs --- */

static void fill_costs(const iris_stereo_level *l, const iris_stereo_costs *c)
{
    size_t row = (size_t)l->columns * (size_t)l->steps;
    memset(l->costs, 0, 2 * row * (size_t)l->rows);
    for (int32_t y = 0; y < l->left->h; y += SKIP) {
        uint16_t *to = l->costs + (size_t)(y / TILE) * row;
        iris_row_tiles_u16(to, iris_stereo_costs_pixels(c, y), l->steps, c->w);
    }
}

static void fill_means(const iris_stereo_level *l)
{
    for (int32_t i = 0; i < l->columns * l->rows; i++) {
        int32_t x = i % l->columns * TILE, y = i / l->columns * TILE, sum = 0;
        int32_t w = l->left->w - x < TILE ? l->left->w - x : TILE;
        int32_t h = l->left->h - y < TILE ? l->left->h - y : TILE;
        for (int32_t k = 0; k < h; k++) {
            const uint8_t *row = (const uint8_t *)iris_image_row(l->left, y + k) + x;
            for (int32_t n = 0; n < w; n++) {
                sum += row[n];
            }
        }
        l->means[i] = (uint8_t)(sum / (w * h));
    }
}

/* From the least to the greatest whole disparity that the coarser level found around a tile, and some more. */
static void range_of(int32_t *least, int32_t *most, const iris_stereo_level *coarser, int32_t column,
                     int32_t row)
{
    *least = INT32_MAX;
    *most = 0;
    for (int32_t k = 0; k < 9; k++) {
        int32_t x = column / 2 + k % 3 - 1, y = row / 2 + k / 3 - 1;
        if (x >= 0 && y >= 0 && x < coarser->columns && y < coarser->rows) {
            const iris_stereo_patch *patch = &coarser->patches[coarser->owner[y * coarser->columns + x]];
            int32_t found = iris_stereo_tile_at(coarser, patch, x, y), d = (found + (1 << 14)) >> 15;
            *least = d < *least ? d : *least;
            *most = d > *most ? d : *most;
        }
    }
    *least -= NEAR;
    *most += NEAR;
}

static void prefer_found(const iris_stereo_level *l, const iris_stereo_level *coarser)
{
    uint16_t *costs = l->costs;
    for (int32_t i = 0; i < l->columns * l->rows; i++, costs += l->steps) {
        int32_t least, most;
        range_of(&least, &most, coarser, i % l->columns, i / l->columns);
        for (int32_t d = least < 0 ? 0 : least; d <= most && d < l->steps; d++) {
            costs[d] = (uint16_t)(costs[d] > LESS ? costs[d] - LESS : 0);
        }
    }
}

iris_status iris_stereo_level_fill(const iris_stereo_level *level, const iris_stereo_level *coarser,
                                   iris_stereo_cost cost, iris_scratch *scratch)
{
    iris_stereo_costs costs;
    const iris_stereo_config config = {level->steps - 1, cost, 255, 0, 0, 0};
    size_t mark = iris_scratch_mark(scratch);
    iris_status status = iris_stereo_costs_begin(&costs, level->left, level->right, &config, 0, scratch);
    if (status == IRIS_OK) {
        fill_costs(level, &costs);
        fill_means(level);
        if (coarser) {
            prefer_found(level, coarser);
        }
    }
    iris_scratch_release(scratch, mark);
    return status;
}

/* --- patches --- */

/* The tiles whose middle is in the patch, or its last pixel where the picture ends before. */
static void own_tiles(const iris_stereo_level *l, int32_t index)
{
    const iris_stereo_patch *p = &l->patches[index];
    for (int32_t row = p->y / TILE; row <= (p->y + p->h - 1) / TILE; row++) {
        int32_t y = row * TILE + TILE / 2 < l->left->h ? row * TILE + TILE / 2 : l->left->h - 1;
        for (int32_t column = p->x / TILE; column <= (p->x + p->w - 1) / TILE; column++) {
            int32_t x = column * TILE + TILE / 2 < l->left->w ? column * TILE + TILE / 2 : l->left->w - 1;
            if (x >= p->x && x < p->x + p->w && y >= p->y && y < p->y + p->h) {
                l->owner[row * l->columns + column] = index;
            }
        }
    }
}

/* Into patches of nearly the same size. */
static void cut(iris_stereo_level *l, const iris_quadtree_leaf *leaf)
{
    int32_t across = (leaf->w + IRIS_STEREO_PATCH - 1) / IRIS_STEREO_PATCH;
    int32_t down = (leaf->h + IRIS_STEREO_PATCH - 1) / IRIS_STEREO_PATCH;
    for (int32_t k = 0; k < across * down; k++) {
        int32_t i = k % across, j = k / across;
        int32_t x = leaf->w * i / across, y = leaf->h * j / down;
        l->patches[l->count] = (iris_stereo_patch){.x = (uint16_t)(leaf->x + x),
                                                   .y = (uint16_t)(leaf->y + y),
                                                   .w = (uint16_t)(leaf->w * (i + 1) / across - x),
                                                   .h = (uint16_t)(leaf->h * (j + 1) / down - y),
                                                   .mean = leaf->mean.g};
        own_tiles(l, l->count++);
    }
}

iris_status iris_stereo_level_divide(iris_stereo_level *level, iris_quadtree_leaf *leaves, int32_t tolerance)
{
    iris_quadtree tree = {.leaves = leaves, .capacity = level->columns * level->rows};
    iris_status status = iris_quadtree_segment(&tree, level->left, &(iris_quadtree_config){tolerance, TILE});
    level->count = 0;
    for (int32_t i = 0; i < tree.count && status == IRIS_OK; i++) {
        cut(level, &tree.leaves[i]);
    }
    return status;
}

void iris_stereo_patch_draw(const iris_image *map, const iris_stereo_patch *patch, const iris_rect *where,
                            int32_t shift, int32_t most)
{
    const int32_t half = 1 << (7 - shift), end = 256 * most;
    for (int32_t y = where->y; y < where->y + where->h; y++) {
        uint16_t *row = iris_image_row(map, y);
        int64_t dx = 2 * where->x - 2 * patch->x - patch->w + 1, dy = 2 * y - 2 * patch->y - patch->h + 1;
        int64_t d = patch->d + (patch->a * dx + patch->b * dy) / 2 + half;
        for (int32_t x = where->x; x < where->x + where->w; x++, d += patch->a) {
            int64_t value = d >> (8 - shift);
            row[x] = (uint16_t)(value < 1 ? 1 : value > end ? end : value);
        }
    }
}
