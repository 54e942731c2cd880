#include "iris/xt/histogram.h"

#include <string.h>

#include "../../foundation/kernel.h"
#include "../../foundation/views.h"
#include "histogram_gray.h"
#include "iris/color.h"

/* Pixels as bytes at a distance from each other. */
typedef struct {
    const uint8_t *first;
    int32_t step;
    int lightness; /* of the three bytes from each on */
} samples;

static inline uint32_t sample_at(samples of, int32_t i)
{
    const uint8_t *p = of.first + (ptrdiff_t)i * of.step;
    if (!of.lightness) {
        return *p;
    }
    uint32_t max = p[0] > p[1] ? p[0] : p[1], min = p[0] > p[1] ? p[1] : p[0];
    max = p[2] > max ? p[2] : max;
    min = p[2] < min ? p[2] : min;
    return (max + min + 1) / 2;
}

static void count_samples(uint32_t histogram[256], samples of, int32_t n)
{
    if (of.lightness) {
        for (int32_t x = 0; x < n; x++) {
            histogram[sample_at(of, x)]++;
        }
        return;
    }
    for (const uint8_t *p = of.first; n > 0; n--, p += of.step) {
        histogram[*p]++;
    }
}

static uint32_t bits_below(int32_t count)
{
    return count >= 32 ? ~0u : ((uint32_t)1 << count) - 1;
}

static void count_selected(uint32_t histogram[256], samples of, int32_t n, const uint32_t *mask)
{
    for (int32_t x = 0; x < n; x += 32) {
        uint32_t bits = mask[x / 32] & bits_below(n - x);
        for (int32_t i = x; bits != 0; i++, bits >>= 1) {
            if (bits & 1) {
                histogram[sample_at(of, i)]++;
            }
        }
    }
}

static uint32_t ones_of(uint32_t bits)
{
    bits -= bits >> 1 & 0x55555555u;
    bits = (bits & 0x33333333u) + (bits >> 2 & 0x33333333u);
    return ((bits + (bits >> 4)) & 0x0F0F0F0Fu) * 0x01010101u >> 24;
}

static void count_bits(uint32_t histogram[256], const uint32_t *row, int32_t n, const uint32_t *mask)
{
    for (int32_t x = 0; x < n; x += 32) {
        uint32_t selected = (mask ? mask[x / 32] : ~0u) & bits_below(n - x);
        histogram[0] += ones_of(selected & ~row[x / 32]);
        histogram[1] += ones_of(selected & row[x / 32]);
    }
}

static iris_status check_channel(iris_format format, int32_t channel)
{
    int has_lightness = format == IRIS_RGB888 || format == IRIS_BGR888;
    if (format == IRIS_GRAY8 || format == IRIS_MASK1) {
        return channel == 0 ? IRIS_OK : IRIS_ERR_ARG;
    }
    if (!has_lightness && format != IRIS_HSL24) {
        return IRIS_ERR_FORMAT;
    }
    return channel >= (has_lightness ? IRIS_CHANNEL_LIGHTNESS : 0) && channel <= 2 ? IRIS_OK : IRIS_ERR_ARG;
}

/* Of a call that has been checked. */
static void count_row(uint32_t histogram[256], const void *row, iris_format format, int32_t channel,
                      int32_t n, const uint32_t *mask)
{
    int lightness = channel == IRIS_CHANNEL_LIGHTNESS;
    samples of = {(const uint8_t *)row + (lightness ? 0 : channel), format == IRIS_GRAY8 ? 1 : 3, lightness};
    if (format == IRIS_MASK1) {
        count_bits(histogram, (const uint32_t *)row, n, mask);
    } else if (mask) {
        count_selected(histogram, of, n, mask);
    } else {
        count_samples(histogram, of, n);
    }
}

iris_status iris_histogram_row(uint32_t histogram[256], const void *row, iris_format format, int32_t channel,
                               int32_t n, const uint32_t *mask)
{
    if (!histogram || !row) {
        return IRIS_ERR_ARG;
    }
    iris_status status = check_channel(format, channel);
    if (status != IRIS_OK) {
        return status;
    }
    if (n < 1 || n > IRIS_SIDE_MAX) {
        return IRIS_ERR_RANGE;
    }
    if ((uintptr_t)mask % 4 != 0 || (format == IRIS_MASK1 && (uintptr_t)row % 4 != 0)) {
        return IRIS_ERR_ALIGN;
    }
    count_row(histogram, row, format, channel, n, mask);
    return IRIS_OK;
}

static iris_status check_mask(const iris_image *mask, const iris_image *src)
{
    iris_status status = iris_image_check(mask);
    if (status != IRIS_OK) {
        return status;
    }
    if (mask->format != IRIS_MASK1) {
        return IRIS_ERR_FORMAT;
    }
    return mask->w == src->w && mask->h == src->h ? IRIS_OK : IRIS_ERR_RANGE;
}

iris_status iris_histogram(uint32_t histogram[256], const iris_image *src, int32_t channel,
                           const iris_image *mask)
{
    if (!histogram || !src) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_image_check(src);
    if (status == IRIS_OK) {
        status = check_channel(src->format, channel);
    }
    if (status == IRIS_OK && mask) {
        status = check_mask(mask, src);
    }
    if (status != IRIS_OK) {
        return status;
    }
    memset(histogram, 0, 256 * sizeof histogram[0]);
    if (src->format == IRIS_GRAY8 && !mask) {
        iris_histogram_count_gray(histogram, src);
        return IRIS_OK;
    }
    for (int32_t y = 0; y < src->h; y++) {
        const uint32_t *selected = mask ? (const uint32_t *)iris_image_row(mask, y) : NULL;
        count_row(histogram, iris_image_row(src, y), src->format, channel, src->w, selected);
    }
    return IRIS_OK;
}

iris_status iris_histogram_extremes(uint8_t *darkest, uint8_t *brightest, const iris_image *src)
{
    if (!darkest || !brightest) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_views_check_one(src, IRIS_GRAY8);
    if (status != IRIS_OK) {
        return status;
    }
    uint8_t extremes[2] = {255, 0};
    int32_t n = src->w, rows = src->h;
    if (src->stride == n && n <= INT32_MAX / rows) { /* all are one row */
        n *= rows;
        rows = 1;
    }
    for (int32_t y = 0; y < rows; y++) {
        iris_row_extremes_u8(extremes, (const uint8_t *)iris_image_row(src, y), n);
    }
    *darkest = extremes[0];
    *brightest = extremes[1];
    return IRIS_OK;
}
