/* Three rows of a smoothed picture, continued by a pixel at both ends: what a 3x3 operator needs around a row.
 *
 *     status = iris_smooth_rows_begin(&smooth, src, sigma_q16, border, scratch);
 *     for (int32_t y = 0; status == IRIS_OK && y < src->h; y++) {
 *         iris_smooth_rows_next(&smooth, y);      rows y - 2 to y are there, and what lies beyond the picture
 *         ... iris_smooth_row(&smooth, y - 1) ...
 *     }
 */
#ifndef IRIS_XT_SMOOTH_ROWS_H
#define IRIS_XT_SMOOTH_ROWS_H

#include "blur_rows.h"

typedef struct {
    const iris_image *src;
    iris_q16 sigma_q16;
    iris_border border;
    iris_blur_rows blur;
    uint8_t *rows; /* pixel 0 of a row of border.value; behind it a ring of three rows */
    size_t step;
} iris_smooth_rows;

#define IRIS_SMOOTH_ROWS_BYTES(w, sigma_q16)                                                                 \
    (((sigma_q16) > 0 ? IRIS_BLUR_GAUSSIAN_SCRATCH_BYTES(w, 1, sigma_q16) : 0u) +                            \
     IRIS_BORDER_ROWS_BYTES(w, 1, 1, 1))

/* src, IRIS_GRAY8, a checked view that outlives smooth; sigma_q16 0 (as it is) or as in blur.h. Takes
 * IRIS_SMOOTH_ROWS_BYTES; IRIS_ERR_SCRATCH: the caller releases. */
iris_status iris_smooth_rows_begin(iris_smooth_rows *smooth, const iris_image *src, iris_q16 sigma_q16,
                                   iris_border border, iris_scratch *scratch);

/* Makes row y; once for each row of src, in order. By IRIS_BORDER_SKIP, pixels that the blur leaves out are undefined. */
void iris_smooth_rows_next(iris_smooth_rows *smooth, int32_t y);

/* Pixel 0 of row y, -1 up to src->h, of those that are there; readable from -1 to w. */
uint8_t *iris_smooth_row(const iris_smooth_rows *smooth, int32_t y);

#endif
