#include "iris/xt/equalize.h"

#include "../../foundation/views.h"
#include "iris/xt/histogram.h"
#include "iris/xt/tone.h"

iris_status iris_equalize(const iris_image *dst, const iris_image *src, iris_scratch *scratch)
{
    iris_status status = scratch ? iris_views_check_levels(dst, src, IRIS_BORDER_NONE) : IRIS_ERR_ARG;
    if (status != IRIS_OK) {
        return status;
    }
    size_t mark = iris_scratch_mark(scratch);
    uint32_t *histogram = (uint32_t *)iris_scratch_take(scratch, IRIS_EQUALIZE_SCRATCH_BYTES);
    if (!histogram) {
        return IRIS_ERR_SCRATCH;
    }
    iris_tone tone;
    (void)iris_tone_identity(&tone);
    (void)iris_histogram(histogram, src, src->format == IRIS_GRAY8 ? 0 : IRIS_CHANNEL_LIGHTNESS, NULL);
    (void)iris_tone_equalize(&tone, histogram);
    iris_scratch_release(scratch, mark);
    return iris_tone_apply_lightness(dst, src, &tone);
}
