/* A grid of odds, and as a picture. */
#include "iris/3d/grid.h"

#include <string.h>

#include "../../foundation/views.h"
#include "map_parts.h"

#define CERTAIN 64 /* odds of what a picture says */

int iris_grid_is_laid_out(iris_size cells, int32_t cell_mm, int32_t left_mm, int32_t bottom_mm)
{
    return cells.w >= 1 && cells.w <= IRIS_GRID_SIDE_MAX && cells.h >= 1 && cells.h <= IRIS_GRID_SIDE_MAX &&
           cell_mm >= 1 && cell_mm <= IRIS_GRID_CELL_MAX_MM && iris_place_fits(left_mm) &&
           iris_place_fits(bottom_mm);
}

iris_status iris_grid_check(const iris_grid *grid)
{
    return grid && grid->odds &&
                   iris_grid_is_laid_out((iris_size){grid->w, grid->h}, grid->cell_mm, grid->left_mm,
                                         grid->bottom_mm)
               ? IRIS_OK
               : IRIS_ERR_ARG;
}

iris_status iris_grid_init(iris_grid *grid, int8_t *odds, size_t bytes, iris_size cells, int32_t cell_mm,
                           const int32_t corner_mm[2])
{
    if (!grid || !odds || !corner_mm) {
        return IRIS_ERR_ARG;
    }
    if (!iris_grid_is_laid_out(cells, cell_mm, corner_mm[0], corner_mm[1]) ||
        bytes < (size_t)cells.w * (size_t)cells.h) {
        return IRIS_ERR_RANGE;
    }
    memset(odds, 0, (size_t)cells.w * (size_t)cells.h);
    *grid = (iris_grid){odds, cells.w, cells.h, cell_mm, corner_mm[0], corner_mm[1]};
    return IRIS_OK;
}

int32_t iris_grid_at(const iris_grid *grid, int32_t x_mm, int32_t y_mm)
{
    if (!iris_place_fits(x_mm) || !iris_place_fits(y_mm)) {
        return 0;
    }
    const int32_t x = iris_ray_floor(x_mm - grid->left_mm, grid->cell_mm);
    const int32_t y = iris_ray_floor(y_mm - grid->bottom_mm, grid->cell_mm);
    const int inside = x >= 0 && x < grid->w && y >= 0 && y < grid->h;
    return inside ? grid->odds[(size_t)y * (size_t)grid->w + (size_t)x] : 0;
}

/* --- as pictures --- */

static iris_status check_picture(const iris_image *image, const iris_grid *grid)
{
    iris_status status = image ? iris_grid_check(grid) : IRIS_ERR_ARG;
    status = status == IRIS_OK ? iris_views_check_one(image, IRIS_GRAY8) : status;
    return status == IRIS_OK && (image->w != grid->w || image->h != grid->h) ? IRIS_ERR_RANGE : status;
}

iris_status iris_grid_to_picture(const iris_image *image, const iris_grid *grid)
{
    const iris_status status = check_picture(image, grid);
    if (status != IRIS_OK) {
        return status;
    }
    for (int32_t y = 0; y < grid->h; y++) {
        const int8_t *from = grid->odds + (size_t)(grid->h - 1 - y) * (size_t)grid->w;
        uint8_t *to = iris_image_row(image, y);
        for (int32_t x = 0; x < grid->w; x++) {
            to[x] = from[x] >= IRIS_ODDS_OCCUPIED ? IRIS_GRID_GRAY_OCCUPIED
                    : from[x] <= IRIS_ODDS_FREE   ? IRIS_GRID_GRAY_FREE
                                                  : IRIS_GRID_GRAY_UNKNOWN;
        }
    }
    return IRIS_OK;
}

void iris_grid_shades_defaults(iris_grid_shades *shades)
{
    if (shades) {
        *shades = (iris_grid_shades){42598, 12845, 0};
    }
}

iris_status iris_grid_from_picture(const iris_grid *grid, const iris_image *image,
                                   const iris_grid_shades *shades)
{
    iris_grid_shades by;
    int8_t odds[256];
    iris_grid_shades_defaults(&by);
    by = shades ? *shades : by;
    iris_status status = check_picture(image, grid);
    if (status == IRIS_OK &&
        (by.free_q16 < 0 || by.occupied_q16 > IRIS_Q16_ONE || by.free_q16 > by.occupied_q16)) {
        status = IRIS_ERR_ARG;
    }
    if (status != IRIS_OK) {
        return status;
    }
    for (int gray = 0; gray < 256; gray++) {
        const int64_t p = (int64_t)(by.negate ? gray : 255 - gray) * IRIS_Q16_ONE; /* of 255 */
        odds[gray] = (int8_t)(p > (int64_t)255 * by.occupied_q16 ? CERTAIN
                              : p < (int64_t)255 * by.free_q16   ? -CERTAIN
                                                                 : 0);
    }
    for (int32_t y = 0; y < grid->h; y++) {
        int8_t *to = grid->odds + (size_t)(grid->h - 1 - y) * (size_t)grid->w;
        const uint8_t *from = iris_image_row(image, y);
        for (int32_t x = 0; x < grid->w; x++) {
            to[x] = odds[from[x]];
        }
    }
    return IRIS_OK;
}
