#include "blur_rows.h"

#include <string.h>

#include "../foundation/kernel.h"
#include "gauss.h"
#include "iris/xt/blur.h"

#define TILE 64 /* samples that are summed at a time */

/* How exact the weights are: as many bits as keep the center below 2^15 and the sums within int32_t. */
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
    if (!middle || !blur->weights) {
        return IRIS_ERR_SCRATCH;
    }
    blur->middle = middle + beyond;
    blur->radius = radius;
    blur->bits = bits_of(radius);
    set_weights(blur->weights, radius, blur->bits, sigma_q16);
    return IRIS_OK;
}

/* Samples from `from` on, n of them, of the row that is the sum from top to bottom. At most 255 * 2^bits before and
 * 255 * 64 after the shift. */
static void sum_down(const iris_blur_rows *blur, int32_t from, int32_t n)
{
    int32_t sums[TILE], count = 0;
    iris_row_tap taps[IRIS_ROW_TAPS];
    for (int32_t i = 0; i < n; i++) {
        sums[i] = 1 << (blur->bits - 7);
    }
    for (int32_t k = -blur->radius; k <= blur->radius; k++) {
        taps[count++] = (iris_row_tap){iris_rows_at(&blur->rows, k) + from, blur->weights[k < 0 ? -k : k]};
        if (count == IRIS_ROW_TAPS || k == blur->radius) {
            iris_row_taps_u8(sums, taps, count, n);
            count = 0;
        }
    }
    for (int32_t i = 0; i < n; i++) {
        blur->middle[from + i] = (int16_t)(sums[i] >> (blur->bits - 6));
    }
}

/* The same from left to right, times 2^bits, with `half` for rounding. At most 255 * 2^23 + 2^22 < 2^31. */
static void sum_across(int32_t *sums, const iris_blur_rows *blur, int32_t half, int32_t from, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        sums[i] = half;
    }
    iris_row_pairs_s16(sums, blur->middle + from, blur->weights, blur->radius, blur->rows.channels, n);
}

static int32_t tile(int32_t from, int32_t end)
{
    return end - from < TILE ? end - from : TILE;
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
    if (radius > IRIS_BELL_RADIUS) {
        for (int32_t i = *first - beyond; i < *end + beyond; i += TILE) {
            sum_down(blur, i, tile(i, *end + beyond));
        }
    } else if (radius > 0) {
        const uint8_t *around[2 * IRIS_BELL_RADIUS + 1];
        for (int32_t k = 0; k <= 2 * radius; k++) {
            around[k] = iris_rows_at(&blur->rows, k - radius) + *first - beyond;
        }
        iris_row_bell_down(blur->middle + *first - beyond, around, blur->weights, radius,
                           *end - *first + 2 * beyond);
    }
    return 1;
}

void iris_blur_rows_next(iris_blur_rows *blur, uint8_t *dst)
{
    int32_t first, end, sums[TILE];
    int32_t some = make_middle(blur, &first, &end);
    if (some && blur->radius == 0) {
        memcpy(dst + first, iris_rows_at(&blur->rows, 0) + first, (size_t)(end - first));
    } else if (some && blur->radius <= IRIS_BELL_RADIUS) {
        iris_row_bell_across_u8(dst + first, blur->middle + first, blur->weights, blur->radius,
                                blur->rows.channels, end - first);
    } else {
        for (int32_t start = first; some && start < end; start += TILE) {
            int32_t n = tile(start, end);
            sum_across(sums, blur, 1 << (blur->bits + 5), start, n);
            for (int32_t i = 0; i < n; i++) {
                dst[start + i] = (uint8_t)(sums[i] >> (blur->bits + 6));
            }
        }
    }
    iris_rows_next(&blur->rows);
}

void iris_blur_rows_next_q6(iris_blur_rows *blur, int16_t *dst)
{
    int32_t first, end, sums[TILE];
    int32_t some = make_middle(blur, &first, &end);
    for (int32_t i = first; some && blur->radius == 0 && i < end; i++) {
        dst[i] = (int16_t)(64 * iris_rows_at(&blur->rows, 0)[i]);
    }
    if (some && blur->radius > 0 && blur->radius <= IRIS_BELL_RADIUS) {
        iris_row_bell_across(dst + first, blur->middle + first, blur->weights, blur->radius,
                             blur->rows.channels, end - first);
    }
    for (int32_t start = first; some && blur->radius > IRIS_BELL_RADIUS && start < end; start += TILE) {
        int32_t n = tile(start, end);
        sum_across(sums, blur, 1 << (blur->bits - 1), start, n);
        for (int32_t i = 0; i < n; i++) {
            dst[start + i] = (int16_t)(sums[i] >> blur->bits);
        }
    }
    iris_rows_next(&blur->rows);
}
