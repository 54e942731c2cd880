/* How little the places of a row of the left picture are like those of the right one, for every disparity: row by row,
 * top first, each cost summed over a square window.
 */
#ifndef IRIS_3D_STEREO_COSTS_H
#define IRIS_3D_STEREO_COSTS_H

#include "../../foundation/kernel.h"
#include "iris/3d/stereo.h"

/* A row of both pictures: three planes of the census, and gray levels. The right one goes from right to left, and so many
 * times more of its leftmost pixel as there are disparities. */
typedef struct {
    uint8_t *left[3], *right[4];
} iris_stereo_rows;

typedef struct {
    const iris_image *left, *right;
    int32_t w, steps; /* steps: how many disparities, from 0 */
    iris_stereo_cost cost;
    int32_t reach;                 /* of the window to each side */
    iris_stereo_rows enter, leave; /* the latter with windows alone */
    uint8_t *costs;                /* of one row, without windows: w times steps */

    /* With windows. */
    iris_row_pair entering, leaving; /* the rows that columns are moved on by */
    uint16_t *columns;               /* sums over columns; of the first `moved` those of this row */
    int32_t moved;
    uint16_t *sums; /* over windows: of the pixel before, of a piece of the row */
    uint16_t *last; /* of the piece's last pixel */
} iris_stereo_costs;

/* Checks what all methods take, in the order argument, invalid view, format, size, aliasing. */
iris_status iris_stereo_check(const iris_image *disparity, const iris_image *left, const iris_image *right,
                              const iris_stereo_config *config);

/* side: of the windows, odd; 0: pixels alone. Takes IRIS_STEREO_COSTS_SCRATCH_BYTES, with windows
 * IRIS_STEREO_WINDOWS_SCRATCH_BYTES. */
iris_status iris_stereo_costs_begin(iris_stereo_costs *c, const iris_image *left, const iris_image *right,
                                    const iris_stereo_config *config, int32_t side, iris_scratch *scratch);

/* The costs of the pixels of row y, each by itself: w times steps. Begun without windows. */
const uint8_t *iris_stereo_costs_pixels(const iris_stereo_costs *c, int32_t y);

/* Row y, behind row y - 1; and then its pieces from left to right, each of at most IRIS_STEREO_PIECE pixels: of each
 * `steps` sums, of which those of disparity d at x < d mean nothing. They may be changed. Begun with windows. */
void iris_stereo_costs_begin_row(iris_stereo_costs *c, int32_t y);
uint16_t *iris_stereo_costs_piece(iris_stereo_costs *c, int32_t x, int32_t count);

#endif
