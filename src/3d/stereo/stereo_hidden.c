#include "stereo_hidden.h"

#define TILE  IRIS_STEREO_TILE
#define ALIKE 384 /* 256ths of a pixel: matches that differ by at most so much are one */

iris_status iris_stereo_claims_begin(iris_stereo_claims *claims, const iris_stereo_level *level,
                                     iris_scratch *scratch)
{
    size_t w = (size_t)level->left->w;
    claims->cost = iris_scratch_take(scratch, 2 * w);
    claims->disparity = iris_scratch_take(scratch, 2 * w);
    claims->hidden = iris_scratch_take(scratch, (size_t)level->columns);
    return claims->cost && claims->disparity && claims->hidden ? IRIS_OK : IRIS_ERR_SCRATCH;
}

static const iris_stereo_patch *patch_at(const iris_stereo_level *l, int32_t column, int32_t row)
{
    return &l->patches[l->owner[row * l->columns + column]];
}

static int32_t disparity_at(const iris_stereo_level *l, int32_t column, int32_t row)
{
    return iris_stereo_tile_at(l, patch_at(l, column, row), column, row) >> (IRIS_STEREO_FRACTION - 8);
}

/* Each place of the other picture goes to the tile that matches it best. */
static void claim(const iris_stereo_level *l, const iris_stereo_claims *c, int32_t row)
{
    for (int32_t x = 0; x < l->left->w; x++) {
        c->cost[x] = UINT16_MAX;
        c->disparity[x] = 0;
    }
    for (int32_t column = 0; column < l->columns; column++) {
        int32_t d = disparity_at(l, column, row), x = column * TILE - ((d + 128) >> 8);
        uint16_t cost = patch_at(l, column, row)->cost;
        for (int32_t k = x; k < x + TILE; k++) {
            if (k >= 0 && k < l->left->w && cost < c->cost[k]) {
                c->cost[k] = cost;
                c->disparity[k] = (uint16_t)d;
            }
        }
    }
}

/* A tile is hidden if most of its places are outside of the other picture, or another's. */
static void find_hidden(const iris_stereo_level *l, const iris_stereo_claims *c, int32_t row)
{
    for (int32_t column = 0; column < l->columns; column++) {
        int32_t d = disparity_at(l, column, row), x = column * TILE - ((d + 128) >> 8), lost = 0;
        for (int32_t k = x; k < x + TILE; k++) {
            int32_t apart = k >= 0 && k < l->left->w ? c->disparity[k] - d : 2 * ALIKE;
            lost += apart > ALIKE || -apart > ALIKE;
        }
        c->hidden[column] = lost > TILE / 2;
    }
}

/* What would lie outside of the other picture if it belonged to the patch that is seen right of it, and matches much
 * worse than that, is not seen either: what it has is only the best of what there is inside. */
static void distrust_edge(const iris_stereo_level *l, const iris_stereo_claims *c, int32_t row)
{
    const iris_stereo_patch *right = NULL;
    for (int32_t column = l->columns - 1; column >= 0; column--) {
        const iris_stereo_patch *own = patch_at(l, column, row);
        if (c->hidden[column] || !right) {
            right = c->hidden[column] ? right : own;
            continue;
        }
        int32_t d = iris_stereo_tile_at(l, right, column, row) >> (IRIS_STEREO_FRACTION - 8);
        int outside = d > 256 * (column * TILE + TILE / 2) && d - disparity_at(l, column, row) > ALIKE;
        if (outside && 2 * own->cost > 3 * right->cost) {
            c->hidden[column] = 1;
        } else {
            right = own;
        }
    }
}

/* Of the patches at the ends of a run of hidden tiles, left and right (null: none), the one that is farther away at a
 * tile of it; the tile's own where both are none. */
static const iris_stereo_patch *farther(const iris_stereo_level *l, const iris_stereo_patch *left,
                                        const iris_stereo_patch *right, int32_t column, int32_t row)
{
    if (!left || !right) {
        return left ? left : right ? right : patch_at(l, column, row);
    }
    int nearer = iris_stereo_tile_at(l, left, column, row) > iris_stereo_tile_at(l, right, column, row);
    return nearer ? right : left;
}

static void fill_row(const iris_image *map, const iris_stereo_level *l, const iris_stereo_claims *c,
                     int32_t row, const int32_t scale[2])
{
    const iris_stereo_patch *left = NULL;
    for (int32_t column = 0; column < l->columns; column++) {
        int32_t end = column;
        while (end < l->columns && c->hidden[end]) {
            end++;
        }
        const iris_stereo_patch *right = end < l->columns ? patch_at(l, end, row) : NULL;
        for (; column < end; column++) {
            int32_t x = column * TILE, y = row * TILE;
            iris_rect where = {x, y, map->w - x < TILE ? map->w - x : TILE,
                               map->h - y < TILE ? map->h - y : TILE};
            iris_stereo_patch_draw(map, farther(l, left, right, column, row), &where, scale[0], scale[1]);
        }
        left = right;
    }
}

void iris_stereo_fill_hidden(const iris_image *map, const iris_stereo_level *level,
                             const iris_stereo_claims *claims, int32_t shift, int32_t most)
{
    for (int32_t row = 0; row < level->rows; row++) {
        claim(level, claims, row);
        find_hidden(level, claims, row);
        distrust_edge(level, claims, row);
        fill_row(map, level, claims, row, (const int32_t[]){shift, most});
    }
}
