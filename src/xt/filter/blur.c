#include "iris/xt/blur.h"

#include "../../foundation/views.h"
#include "blur_rows.h"

iris_status iris_blur_gaussian(const iris_image *dst, const iris_image *src, iris_q16 sigma_q16,
                               iris_border border, iris_scratch *scratch)
{
    iris_status status = iris_views_check_levels(dst, src, border);
    if (status != IRIS_OK || !scratch) {
        return status != IRIS_OK ? status : IRIS_ERR_ARG;
    }
    if (sigma_q16 < IRIS_BLUR_SIGMA_MIN || sigma_q16 > IRIS_BLUR_SIGMA_MAX) {
        return IRIS_ERR_RANGE;
    }
    size_t mark = iris_scratch_mark(scratch);
    iris_blur_rows blur;
    status = iris_blur_rows_begin(&blur, src, sigma_q16, border, scratch);
    for (int32_t y = 0; status == IRIS_OK && y < src->h; y++) {
        iris_blur_rows_next(&blur, (uint8_t *)iris_image_row(dst, y));
    }
    iris_scratch_release(scratch, mark);
    return status;
}
