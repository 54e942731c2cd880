#include "smooth_rows.h"

#include <string.h>

#include "iris/xt/blur.h"

iris_status iris_smooth_rows_begin(iris_smooth_rows *smooth, const iris_image *src, iris_q16 sigma_q16,
                                   iris_border border, iris_scratch *scratch)
{
    const size_t bytes = IRIS_BORDER_ROWS_BYTES(src->w, 1, 1, 1);
    *smooth = (iris_smooth_rows){.src = src, .sigma_q16 = sigma_q16, .border = border, .step = bytes / 4};
    smooth->rows = (uint8_t *)iris_scratch_take(scratch, bytes);
    if (!smooth->rows) {
        return IRIS_ERR_SCRATCH;
    }
    memset(smooth->rows, border.value, smooth->step);
    smooth->rows += IRIS_SCRATCH_ALIGN;
    return sigma_q16 > 0 ? iris_blur_rows_begin(&smooth->blur, src, sigma_q16, border, scratch) : IRIS_OK;
}

uint8_t *iris_smooth_row(const iris_smooth_rows *smooth, int32_t y)
{
    int32_t index = iris_border_index(y, smooth->src->h, smooth->border.rule);
    return smooth->rows + (index < 0 ? 0 : (size_t)(index % 3 + 1)) * smooth->step;
}

void iris_smooth_rows_next(iris_smooth_rows *smooth, int32_t y)
{
    uint8_t *row = iris_smooth_row(smooth, y);
    const int32_t w = smooth->src->w;
    if (smooth->sigma_q16 > 0) {
        iris_blur_rows_next(&smooth->blur, row);
    } else {
        memcpy(row, iris_image_row(smooth->src, y), (size_t)w);
    }
    int32_t left = iris_border_index(-1, w, smooth->border.rule);
    int32_t right = iris_border_index(w, w, smooth->border.rule);
    row[-1] = left < 0 ? smooth->border.value : row[left];
    row[w] = right < 0 ? smooth->border.value : row[right];
}
