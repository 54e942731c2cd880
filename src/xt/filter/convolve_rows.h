/* Weighted sums of one row: the inner part of iris_convolve. */
#ifndef IRIS_XT_CONVOLVE_ROWS_H
#define IRIS_XT_CONVOLVE_ROWS_H

#include "../../foundation/kernel.h"
#include "../../foundation/rows.h"
#include "iris/xt/convolve.h"

typedef struct {
    const iris_image *dst;
    iris_rows rows;
    const int32_t *weights; /* as they lie on the window */
    int32_t h, w;           /* of the window */
    int separable;
    int32_t down[IRIS_KERNEL_SIDE_MAX], across[IRIS_KERNEL_SIDE_MAX];
    int32_t *middle; /* pixel 0 of a row of sums; of a separable matrix, of those from top to bottom */
    iris_row_quotient quotient;
} iris_convolution;

/* Makes the samples from `first` to below `end` of row work->rows.y of dst. */
void iris_convolve_row(const iris_convolution *work, int32_t first, int32_t end);

#endif
