/* Gaussian blur, row by row: for operations that work on a blurred picture without ever having all of it.
 *
 *     size_t mark = iris_scratch_mark(scratch);
 *     iris_status status = iris_blur_rows_begin(&blur, src, sigma_q16, border, scratch);
 *     for (int32_t y = 0; status == IRIS_OK && y < src->h; y++) {
 *         iris_blur_rows_next(&blur, row);         row y of the blurred picture
 *     }
 *     iris_scratch_release(scratch, mark);
 *
 * Takes IRIS_BLUR_GAUSSIAN_SCRATCH_BYTES(w, channels, sigma_q16), which stays taken until the last row. src is read
 * up to row y + IRIS_BLUR_RADIUS(sigma_q16) when row y is made, and never again above that: what is written there
 * does not matter.
 */
#ifndef IRIS_XT_BLUR_ROWS_H
#define IRIS_XT_BLUR_ROWS_H

#include "../../foundation/rows.h"
#include "iris/fixed.h"

typedef struct {
    iris_rows rows;
    int32_t radius;
    int16_t *weights; /* of the distances 0 to radius */
    int32_t *at;      /* of a wide one: the bytes from the middle row to each row around */
    int16_t *middle;  /* pixel 0 of a row summed from top to bottom, with 6 fraction bits */
} iris_blur_rows;

/* Ready for row 0. src: a checked view of any format of iris_rows_begin (the lightness of IRIS_HSL24); it must outlive
 * blur. sigma within IRIS_BLUR_SIGMA_MIN and IRIS_BLUR_SIGMA_MAX. IRIS_ERR_SCRATCH (the caller releases).
 * O(radius * w). */
iris_status iris_blur_rows_begin(iris_blur_rows *blur, const iris_image *src, iris_q16 sigma_q16,
                                 iris_border border, iris_scratch *scratch);

/* Writes the next row, w * channels bytes; the pixels that IRIS_BORDER_SKIP leaves out are not written. Called once
 * for each row of src. O(radius * w * channels). */
void iris_blur_rows_next(iris_blur_rows *blur, uint8_t *dst);

/* The same with 6 fraction bits, 0 to 255 * 64: for what amplifies small differences. */
void iris_blur_rows_next_q6(iris_blur_rows *blur, int16_t *dst);

#endif
