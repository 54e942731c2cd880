#include "blur_rows.h"

#include <string.h>

#include "../../foundation/kernel.h"
#include "gauss.h"
#include "iris/xt/blur.h"

/* How exact the weights are: as many bits as keep the center below 2^15 and the sums within int32_t. What kernels go
 * by. */
static int bits_of(int32_t radius)
{
    return radius <= IRIS_BELL_RADIUS ? 15 : 17;
}

/* The weights of the distances 0 to radius. Their sum, each side counted, is 2^bits: the center takes what
 * rounding leaves. */
static void set_weights(int16_t *weights, int32_t radius, int bits, iris_q16 sigma_q16)
{
    uint64_t sum = iris_gauss_q31(0, sigma_q16);
    for (int32_t k = 1; k <= radius; k++) {
        sum += 2 * (uint64_t)iris_gauss_q31(k * k, sigma_q16);
    }
    int32_t center = 1 << bits;
    for (int32_t k = 1; k <= radius; k++) {
        uint64_t scaled = (uint64_t)iris_gauss_q31(k * k, sigma_q16) << bits;
        weights[k] = (int16_t)((scaled + sum / 2) / sum);
        center -= 2 * weights[k];
    }
    if (center >
        INT16_MAX) { /* the whole of a sigma so small that its neighbors weigh less than half a unit */
        weights[radius] = 1;
        center -= 2;
    }
    weights[0] = (int16_t)center;
}

iris_status iris_blur_rows_begin(iris_blur_rows *blur, const iris_image *src, iris_q16 sigma_q16,
                                 iris_border border, iris_scratch *scratch)
{
    int32_t radius = IRIS_BLUR_RADIUS(sigma_q16);
    iris_rows_window window = {radius, radius, radius, radius};
    iris_status status = iris_rows_begin(&blur->rows, src, window, border, scratch);
    if (status != IRIS_OK) {
        return status;
    }
    int32_t beyond = radius * blur->rows.channels;
    size_t samples = (size_t)src->w * (size_t)blur->rows.channels + 2 * (size_t)beyond;
    int16_t *middle = (int16_t *)iris_scratch_take(scratch, sizeof(int16_t) * samples);
    blur->weights = (int16_t *)iris_scratch_take(scratch, sizeof(int16_t) * ((size_t)radius + 1));
    size_t rows_at = radius > IRIS_BELL_RADIUS ? 2 * (size_t)radius + 1 : 0;
    blur->at = (int32_t *)iris_scratch_take(scratch, sizeof(int32_t) * rows_at);
    if (!middle || !blur->weights || !blur->at) {
        return IRIS_ERR_SCRATCH;
    }
    blur->middle = middle + beyond;
    blur->radius = radius;
    set_weights(blur->weights, radius, bits_of(radius), sigma_q16);
    return IRIS_OK;
}

/* The sums of rows into n samples from `first` on: of many rows, where they are goes by way of scratch. */
static void sum_down(const iris_blur_rows *blur, int32_t first, int32_t n)
{
    int32_t radius = blur->radius;
    if (radius <= IRIS_BELL_RADIUS) {
        const uint8_t *around[2 * IRIS_BELL_RADIUS + 1];
        for (int32_t k = 0; k <= 2 * radius; k++) {
            around[k] = iris_rows_at(&blur->rows, k - radius) + first;
        }
        iris_row_bell_down(blur->middle + first, around, blur->weights, radius, n);
        return;
    }
    const uint8_t *center = iris_rows_at(&blur->rows, 0);
    for (int32_t k = 0; k <= 2 * radius; k++) {
        blur->at[k] = (int32_t)(iris_rows_at(&blur->rows, k - radius) - center);
    }
    iris_row_wide_down(blur->middle + first, center + first, blur->at, blur->weights, radius, n);
}

/* The samples of the row that are evaluated, summed from top to bottom; 0 when there are none. */
static int make_middle(const iris_blur_rows *blur, int32_t *first, int32_t *end)
{
    int32_t channels = blur->rows.channels, radius = blur->radius, beyond = radius * channels;
    if (!iris_rows_span(first, end, &blur->rows)) {
        return 0;
    }
    *first *= channels;
    *end *= channels;
    if (radius > 0) {
        sum_down(blur, *first - beyond, *end - *first + 2 * beyond);
    }
    return 1;
}

void iris_blur_rows_next(iris_blur_rows *blur, uint8_t *dst)
{
    int32_t first, end, radius = blur->radius, channels = blur->rows.channels;
    if (make_middle(blur, &first, &end)) {
        const int16_t *middle = blur->middle + first;
        if (radius == 0) {
            memcpy(dst + first, iris_rows_at(&blur->rows, 0) + first, (size_t)(end - first));
        } else if (radius <= IRIS_BELL_RADIUS) {
            iris_row_bell_across_u8(dst + first, middle, blur->weights, radius, channels, end - first);
        } else {
            iris_row_wide_across_u8(dst + first, middle, blur->weights, radius, channels, end - first);
        }
    }
    iris_rows_next(&blur->rows);
}

void iris_blur_rows_next_q6(iris_blur_rows *blur, int16_t *dst)
{
    int32_t first, end, radius = blur->radius, channels = blur->rows.channels;
    if (make_middle(blur, &first, &end)) {
        const int16_t *middle = blur->middle + first;
        for (int32_t i = first; radius == 0 && i < end; i++) {
            dst[i] = (int16_t)(64 * iris_rows_at(&blur->rows, 0)[i]);
        }
        if (radius > IRIS_BELL_RADIUS) {
            iris_row_wide_across(dst + first, middle, blur->weights, radius, channels, end - first);
        } else if (radius > 0) {
            iris_row_bell_across(dst + first, middle, blur->weights, radius, channels, end - first);
        }
    }
    iris_rows_next(&blur->rows);
}
