/* The Laplacian of a Gaussian, row by row. */
#ifndef IRIS_XT_LOG_ROWS_H
#define IRIS_XT_LOG_ROWS_H

#include "blur_rows.h"

typedef struct {
    iris_blur_rows blur;
    int32_t w, h;
    int32_t y, loaded; /* the next row; rows blurred */
    int32_t margin;    /* pixels at each edge that are not evaluated */
    iris_border border;
    int16_t *
        rows; /* pixel 0 of a row of border.value; behind it a ring of three blurred rows, with 6 fraction bits */
    size_t row_step;
} iris_log_rows;

/* Ready for row 0. Takes IRIS_BLUR_GAUSSIAN_SCRATCH_BYTES(w, 1, sigma_q16) and four rows of int16_t, w + 2 each.
 * src: a checked IRIS_GRAY8. IRIS_ERR_SCRATCH (the caller releases). */
iris_status iris_log_rows_begin(iris_log_rows *log, const iris_image *src, iris_q16 sigma_q16,
                                iris_border border, iris_scratch *scratch);

/* The pixels *first to *end - 1 of the next row: 32 times the Laplacian of the blurred picture, rounded. 0 when none
 * are evaluated. Called at most once for each row of src. */
int iris_log_rows_next(iris_log_rows *log, int16_t *dst, int32_t *first, int32_t *end);

#endif
