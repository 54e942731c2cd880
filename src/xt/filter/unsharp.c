#include "iris/xt/unsharp.h"

#include "../../foundation/kernel.h"
#include "../../foundation/views.h"
#include "blur_rows.h"

void iris_unsharp_defaults(iris_unsharp_config *config)
{
    if (config) {
        *config = (iris_unsharp_config){IRIS_Q16_ONE, IRIS_Q16_ONE, 0};
    }
}

static iris_status unsharp(const iris_image *dst, const iris_image *src, const iris_unsharp_config *config,
                           iris_border border, iris_scratch *scratch)
{
    iris_blur_rows blur;
    iris_status status = iris_blur_rows_begin(&blur, src, config->sigma_q16, border, scratch);
    if (status != IRIS_OK) {
        return status;
    }
    int32_t channels = blur.rows.channels;
    uint8_t *blurred = (uint8_t *)iris_scratch_take(scratch, (size_t)src->w * (size_t)channels);
    if (!blurred) {
        return IRIS_ERR_SCRATCH;
    }
    for (int32_t y = 0; y < src->h; y++) {
        int32_t first, end;
        int any = iris_rows_span(&first, &end, &blur.rows);
        iris_blur_rows_next(&blur, blurred);
        if (any) {
            int32_t from = first * channels;
            iris_row_sharpen_u8((uint8_t *)iris_image_row(dst, y) + from,
                                (const uint8_t *)iris_image_row(src, y) + from, blurred + from,
                                (iris_row_sharpening){config->amount_q16, config->threshold},
                                (end - first) * channels);
        }
    }
    return IRIS_OK;
}

iris_status iris_unsharp(const iris_image *dst, const iris_image *src, const iris_unsharp_config *config,
                         iris_border border, iris_scratch *scratch)
{
    iris_status status = iris_views_check_levels(dst, src, border);
    if (status != IRIS_OK || !scratch) {
        return status != IRIS_OK ? status : IRIS_ERR_ARG;
    }
    iris_unsharp_config chosen;
    iris_unsharp_defaults(&chosen);
    chosen = config ? *config : chosen;
    if (chosen.sigma_q16 < IRIS_BLUR_SIGMA_MIN || chosen.sigma_q16 > IRIS_BLUR_SIGMA_MAX ||
        chosen.amount_q16 < 0 || chosen.amount_q16 > IRIS_UNSHARP_AMOUNT_MAX || chosen.threshold < 0 ||
        chosen.threshold > 255) {
        return IRIS_ERR_ARG;
    }
    size_t mark = iris_scratch_mark(scratch);
    status = unsharp(dst, src, &chosen, border, scratch);
    iris_scratch_release(scratch, mark);
    return status;
}
