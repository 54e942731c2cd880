/* Tones on pictures. */
#include "tone_lightness.h"

#include "../../foundation/kernel.h"
#include "../../foundation/lightness.h"
#include "../../foundation/views.h"
#include "iris/xt/tone.h"

iris_status iris_tone_row(uint8_t *dst, const uint8_t *src, int32_t n, const iris_tone *tone)
{
    if (!dst || !src || !tone) {
        return IRIS_ERR_ARG;
    }
    if (n < 0) {
        return IRIS_ERR_RANGE;
    }
    uintptr_t to = (uintptr_t)dst, from = (uintptr_t)src, bytes = (uintptr_t)n;
    if (to != from && to < from + bytes && from < to + bytes) {
        return IRIS_ERR_ALIAS;
    }
    iris_row_tone_u8(dst, src, tone->level, n);
    return IRIS_OK;
}

iris_status iris_tone_apply(const iris_image *dst, const iris_image *src, const iris_tone *tone)
{
    iris_status status = tone ? iris_views_check_levels(dst, src, IRIS_BORDER_NONE) : IRIS_ERR_ARG;
    if (status != IRIS_OK) {
        return status;
    }
    int32_t bytes = src->format == IRIS_GRAY8 ? src->w : 3 * src->w, rows = src->h;
    if (dst->stride == bytes && src->stride == bytes && bytes <= INT32_MAX / rows) { /* all are one row */
        bytes *= rows;
        rows = 1;
    }
    for (int32_t y = 0; y < rows; y++) {
        iris_row_tone_u8((uint8_t *)iris_image_row(dst, y), (const uint8_t *)iris_image_row(src, y),
                         tone->level, bytes);
    }
    return IRIS_OK;
}

iris_status iris_tone_apply_rgb(const iris_image *dst, const iris_image *src, const iris_tone *red,
                                const iris_tone *green, const iris_tone *blue)
{
    iris_status status =
        red && green && blue ? iris_views_check_levels(dst, src, IRIS_BORDER_NONE) : IRIS_ERR_ARG;
    if (status != IRIS_OK || src->format == IRIS_GRAY8) {
        return status != IRIS_OK ? status : IRIS_ERR_FORMAT;
    }
    const iris_tone *first = src->format == IRIS_RGB888 ? red : blue;
    const iris_tone *third = src->format == IRIS_RGB888 ? blue : red;
    for (int32_t y = 0; y < src->h; y++) {
        uint8_t *to = (uint8_t *)iris_image_row(dst, y);
        const uint8_t *from = (const uint8_t *)iris_image_row(src, y);
        for (int32_t i = 0; i < 3 * src->w; i += 3) {
            to[i] = first->level[from[i]];
            to[i + 1] = green->level[from[i + 1]];
            to[i + 2] = third->level[from[i + 2]];
        }
    }
    return IRIS_OK;
}

iris_status iris_tone_apply_lightness(const iris_image *dst, const iris_image *src, const iris_tone *tone)
{
    iris_status status = tone ? iris_views_check_levels(dst, src, IRIS_BORDER_NONE) : IRIS_ERR_ARG;
    if (status != IRIS_OK) {
        return status;
    }
    if (src->format == IRIS_GRAY8) {
        return iris_tone_apply(dst, src, tone);
    }
    for (int32_t y = 0; y < src->h; y++) {
        uint8_t *to = (uint8_t *)iris_image_row(dst, y);
        const uint8_t *from = (const uint8_t *)iris_image_row(src, y);
        for (int32_t i = 0; i < 3 * src->w; i += 3) {
            iris_hsl_extent extent = iris_hsl_extent_of(from[i], from[i + 1], from[i + 2]);
            int32_t l = iris_tone_twice_at(tone->level, extent.sum);
            iris_lightness_set(to + i, from + i, extent, l << 20);
        }
    }
    return IRIS_OK;
}
