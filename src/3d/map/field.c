/* A grid made ready for matching: how near each cell is to a wall, and the best of blocks. */
#include <string.h>

#include "iris/3d/localize.h"
#include "iris/xt/distance.h"
#include "map_parts.h"

#define PAD (IRIS_FIELD_BLOCK - 1)

/* 255 exp(-(d / 3 / 1.5)^2 / 2) for distances of d thirds of a cell. */
static const uint8_t bell[] = {255, 249, 231, 204, 172, 138, 105, 76, 53, 35, 22, 13, 7, 4, 2, 1};

static void select_free(const iris_image *mask, const iris_grid *grid)
{
    for (int32_t y = 0; y < grid->h; y++) {
        const int8_t *from = grid->odds + (size_t)y * (size_t)grid->w;
        uint32_t *to = iris_image_row(mask, y);
        memset(to, 0, ((size_t)grid->w + 31u) / 32u * 4u);
        for (int32_t x = 0; x < grid->w; x++) {
            to[x / 32] |= (uint32_t)(from[x] < IRIS_ODDS_OCCUPIED) << (x % 32);
        }
    }
}

static uint8_t larger(uint8_t a, uint8_t b)
{
    return a > b ? a : b;
}

/* Each number of the row becomes the largest of the 8 from it on. */
static void best_along(uint8_t *row, size_t count)
{
    for (size_t reach = 1; reach < IRIS_FIELD_BLOCK; reach *= 2) {
        for (size_t i = 0; i + reach < count; i++) {
            row[i] = larger(row[i], row[i + reach]);
        }
    }
}

static void fill_blocks(uint8_t *blocks, const uint8_t *near, size_t w, size_t h)
{
    const size_t wide = w + PAD, high = h + PAD;
    memset(blocks, 0, wide * high);
    for (size_t y = 0; y < h; y++) {
        memcpy(blocks + (y + PAD) * wide + PAD, near + y * w, w);
        best_along(blocks + (y + PAD) * wide, wide);
    }
    for (size_t reach = 1; reach < IRIS_FIELD_BLOCK; reach *= 2) {
        for (size_t i = 0; i < (high - reach) * wide; i++) {
            blocks[i] = larger(blocks[i], blocks[i + reach * wide]);
        }
    }
}

iris_status iris_field_init(iris_field *field, uint8_t *memory, size_t bytes, const iris_grid *grid,
                            iris_scratch *scratch)
{
    iris_status status = field && memory && scratch ? iris_grid_check(grid) : IRIS_ERR_ARG;
    if (status != IRIS_OK) {
        return status;
    }
    const size_t w = (size_t)grid->w, h = (size_t)grid->h, distance_bytes = 2 * w * h,
                 mask_bytes = (w + 31u) / 32u * 4u * h;
    if (bytes < IRIS_FIELD_BYTES(w, h)) {
        return IRIS_ERR_RANGE;
    }
    const size_t mark = iris_scratch_mark(scratch);
    iris_image distance, mask;
    void *distances = iris_scratch_take(scratch, distance_bytes),
         *bits = iris_scratch_take(scratch, mask_bytes);
    if (!distances || !bits) {
        iris_scratch_release(scratch, mark);
        return IRIS_ERR_SCRATCH;
    }
    const iris_size size = {grid->w, grid->h};
    (void)iris_image_wrap(&distance, distances, distance_bytes, size, 0, IRIS_GRAY_U16);
    (void)iris_image_wrap(&mask, bits, mask_bytes, size, 0, IRIS_MASK1);
    select_free(&mask, grid);
    (void)iris_distance_transform(&distance, &mask, IRIS_DISTANCE_CHAMFER);
    for (size_t i = 0; i < w * h; i++) {
        const uint16_t thirds = ((const uint16_t *)distances)[i];
        memory[i] = thirds < sizeof bell ? bell[thirds] : 0;
    }
    fill_blocks(memory + w * h, memory, w, h);
    *field =
        (iris_field){memory, memory + w * h, grid->w, grid->h, grid->cell_mm, grid->left_mm, grid->bottom_mm};
    iris_scratch_release(scratch, mark);
    return IRIS_OK;
}
