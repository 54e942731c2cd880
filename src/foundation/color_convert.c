/* From every format to every other, by rows and views. */
#include "color_rows.h"
#include "hsl.h"
#include "kernel.h"

#include <string.h>

static void bgr_row(uint8_t *dst, const uint8_t *src, iris_format format, int32_t n)
{
    if (format == IRIS_BGR888) {
        if (dst != src) {
            memcpy(dst, src, 3 * (size_t)n);
        }
    } else if (format == IRIS_RGB888) {
        iris_row_swap_888(dst, src, n);
    } else {
        iris_color_rgb_fill(dst, src, format, n);
        iris_row_swap_888(dst, dst, n);
    }
}

static void gray_from_mask(uint8_t *dst, const uint32_t *mask, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        dst[i] = mask[i / 32] >> (i % 32) & 1u ? 255 : 0;
    }
}

static int is_pair(iris_format dst, iris_format src)
{
    switch (dst) {
    case IRIS_GRAY8:
        return iris_color_takes(src) || src == IRIS_MASK1;
    case IRIS_RGB888:
    case IRIS_BGR888:
        return iris_color_takes(src) || src == IRIS_HSL24 || src == IRIS_HSL48;
    case IRIS_HSL24:
    case IRIS_HSL48:
        return src == IRIS_RGB888 || src == IRIS_BGR888;
    default:
        return 0;
    }
}

/* To RGB888 (red = 0) or BGR888 (red = 2). */
static void row_to_888(uint8_t *dst, const void *src, iris_format src_format, int32_t n, int red)
{
    if (src_format == IRIS_HSL24) {
        iris_hsl24_row_to_888(dst, (const uint8_t *)src, n, red);
    } else if (src_format == IRIS_HSL48) {
        iris_hsl48_row_to_888(dst, (const uint16_t *)src, n, red);
    } else if (red == 0) {
        iris_color_rgb_fill(dst, (const uint8_t *)src, src_format, n);
    } else {
        bgr_row(dst, (const uint8_t *)src, src_format, n);
    }
}

iris_status iris_color_row(void *dst, iris_format dst_format, const void *src, iris_format src_format,
                           int32_t n)
{
    if (!dst || !src) {
        return IRIS_ERR_ARG;
    }
    if (!is_pair(dst_format, src_format)) {
        return IRIS_ERR_FORMAT;
    }
    iris_status status = iris_color_rows_check(dst, dst_format, src, src_format, n);
    if (status != IRIS_OK) {
        return status;
    }
    int src_red = src_format == IRIS_BGR888 ? 2 : 0;
    if (dst_format == IRIS_HSL24) {
        iris_row_hsl24_888((uint8_t *)dst, (const uint8_t *)src, src_red, n);
    } else if (dst_format == IRIS_HSL48) {
        iris_hsl48_row_from_888((uint16_t *)dst, (const uint8_t *)src, n, src_red);
    } else if (dst_format != IRIS_GRAY8) {
        row_to_888((uint8_t *)dst, src, src_format, n, dst_format == IRIS_BGR888 ? 2 : 0);
    } else if (src_format == IRIS_MASK1) {
        gray_from_mask((uint8_t *)dst, (const uint32_t *)src, n);
    } else {
        iris_color_gray_fill((uint8_t *)dst, (const uint8_t *)src, src_format, n, IRIS_GRAY_LUMA);
    }
    return IRIS_OK;
}

iris_status iris_color_convert(const iris_image *dst, const iris_image *src)
{
    iris_status status = iris_color_views_check(dst, src);
    for (int32_t y = 0; status == IRIS_OK && y < dst->h; y++) {
        status =
            iris_color_row(iris_image_row(dst, y), dst->format, iris_image_row(src, y), src->format, src->w);
    }
    return status;
}
