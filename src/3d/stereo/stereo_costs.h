/* How little the places of a row of the left picture are like those of the right one, for every disparity: row by row,
 * top first, each cost summed over a square window.
 */
#ifndef IRIS_3D_STEREO_COSTS_H
#define IRIS_3D_STEREO_COSTS_H

#include "iris/3d/stereo.h"

typedef struct {
    const iris_image *left, *right;
    int32_t w, steps; /* steps: how many disparities, from 0 */
    iris_stereo_cost cost;
    int32_t reach;         /* of the window to each side */
    uint32_t *census_left; /* of one row */
    uint32_t
        *census_right;   /* from right to left, and so many more of the leftmost as there are disparities */
    uint8_t *gray_right; /* the same of the gray levels */
    uint8_t *costs;      /* of one row: w times steps */
    uint16_t *columns, *sums; /* of the windows' columns, and of the windows */
} iris_stereo_costs;

/* Checks what all methods take, in the order argument, invalid view, format, size, aliasing. */
iris_status iris_stereo_check(const iris_image *disparity, const iris_image *left, const iris_image *right,
                              const iris_stereo_config *config);

/* side: of the windows, odd; 0: pixels alone. Takes IRIS_STEREO_COSTS_SCRATCH_BYTES, and with windows two rows of
 * sums more. */
iris_status iris_stereo_costs_begin(iris_stereo_costs *c, const iris_image *left, const iris_image *right,
                                    const iris_stereo_config *config, int32_t side, iris_scratch *scratch);

/* The costs of the pixels of row y, each by itself: w times steps. */
const uint8_t *iris_stereo_costs_pixels(const iris_stereo_costs *c, int32_t y);

/* Row y, behind row y - 1: w times steps sums, of which those of disparity d at x < d mean nothing. */
const uint16_t *iris_stereo_costs_row(iris_stereo_costs *c, int32_t y);

#endif
