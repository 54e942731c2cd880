#include "iris/color.h"

#include <string.h>

#include "color_rows.h"
#include "kernel.h"
#include "views.h"

/* Pixels that go through RGB on the stack at a time; even, for YUV in pairs. */
#define PIECE 64

/* ---- rows, arguments checked ---- */

static void copy_row(uint8_t *dst, const uint8_t *src, size_t bytes)
{
    if (dst != src) {
        memcpy(dst, src, bytes);
    }
}

/* high: which of a pixel's two bytes is the high one. */
static void rgb_from_565(uint8_t *dst, const uint8_t *src, int32_t n, int high)
{
    for (int32_t i = 0; i < n; i++, src += 2, dst += 3) {
        uint32_t value = (uint32_t)src[high] << 8 | src[1 - high];
        uint32_t r = value >> 11, g = value >> 5 & 63u, b = value & 31u;
        dst[0] = (uint8_t)(r << 3 | r >> 2);
        dst[1] = (uint8_t)(g << 2 | g >> 4);
        dst[2] = (uint8_t)(b << 3 | b >> 2);
    }
}

static void rgb_from_rgba(uint8_t *dst, const uint8_t *src, int32_t n)
{
    for (int32_t i = 0; i < n; i++, src += 4, dst += 3) {
        dst[0] = src[0];
        dst[1] = src[1];
        dst[2] = src[2];
    }
}

/* As rows of NV12. y: which of the first two bytes is Y. */
static void rgb_from_yuv(uint8_t *dst, const uint8_t *src, int32_t n, int y)
{
    for (int32_t x = 0; x < n; x += PIECE) {
        uint8_t luma[PIECE], chroma[PIECE];
        int32_t count = n - x < PIECE ? n - x : PIECE;
        iris_row_every_second_u8(luma, src + 2 * x, y, count);
        iris_row_every_second_u8(chroma, src + 2 * x, 1 - y, count);
        iris_row_rgb888_nv12(dst + 3 * x, luma, chroma, count);
    }
}

int iris_color_takes(iris_format format)
{
    switch (format) {
    case IRIS_GRAY8:
    case IRIS_RGB888:
    case IRIS_BGR888:
    case IRIS_RGBA8888:
    case IRIS_RGB565:
    case IRIS_RGB565_SWAP:
    case IRIS_YUYV:
    case IRIS_UYVY:
        return 1;
    default:
        return 0;
    }
}

void iris_color_rgb_fill(uint8_t *dst, const uint8_t *src, iris_format format, int32_t n)
{
    switch (format) {
    case IRIS_GRAY8:
        iris_row_888_gray(dst, src, n);
        break;
    case IRIS_BGR888:
        iris_row_swap_888(dst, src, n);
        break;
    case IRIS_RGBA8888:
        rgb_from_rgba(dst, src, n);
        break;
    case IRIS_RGB565:
        rgb_from_565(dst, src, n, 1);
        break;
    case IRIS_RGB565_SWAP:
        rgb_from_565(dst, src, n, 0);
        break;
    case IRIS_YUYV:
        rgb_from_yuv(dst, src, n, 0);
        break;
    case IRIS_UYVY:
        rgb_from_yuv(dst, src, n, 1);
        break;
    default: /* IRIS_RGB888 */
        copy_row(dst, src, 3 * (size_t)n);
        break;
    }
}

/* From RGB888, or BGR888 with `bgr`. */
static void gray_from_888(uint8_t *dst, const uint8_t *src, int32_t n, iris_gray_method method, int bgr)
{
    if (method == IRIS_GRAY_GREEN) {
        for (int32_t i = 0; i < n; i++) {
            dst[i] = src[3 * i + 1];
        }
    } else if (method == IRIS_GRAY_AVERAGE) {
        for (int32_t i = 0; i < n; i++, src += 3) {
            /* 21846 / 65536 for a third: exact up to 766 */
            dst[i] = (uint8_t)(((uint32_t)src[0] + src[1] + src[2] + 1u) * 21846u >> 16);
        }
    } else if (bgr) {
        iris_row_luma_bgr888(dst, src, n);
    } else {
        iris_row_luma_rgb888(dst, src, n);
    }
}

void iris_color_gray_fill(uint8_t *dst, const uint8_t *src, iris_format format, int32_t n,
                          iris_gray_method method)
{
    if (format == IRIS_GRAY8) {
        copy_row(dst, src, (size_t)n);
    } else if (format == IRIS_RGB888 || format == IRIS_BGR888) {
        gray_from_888(dst, src, n, method, format == IRIS_BGR888);
    } else if (method == IRIS_GRAY_LUMA && (format == IRIS_YUYV || format == IRIS_UYVY)) {
        iris_row_every_second_u8(dst, src, format == IRIS_UYVY, n);
    } else if (method == IRIS_GRAY_LUMA && format == IRIS_RGBA8888) {
        iris_row_luma_rgba8888(dst, src, n);
    } else { /* two or four bytes per pixel */
        for (int32_t x = 0; x < n; x += PIECE) {
            uint8_t rgb[3 * PIECE];
            int32_t count = n - x < PIECE ? n - x : PIECE;
            iris_color_rgb_fill(rgb, src + iris_format_row_bytes(format, 2) / 2 * (size_t)x, format, count);
            gray_from_888(dst + x, rgb, count, method, 0);
        }
    }
}

/* ---- checks ---- */

static int same_pixel_bytes(iris_format a, iris_format b)
{
    return iris_format_row_bytes(a, 2) == iris_format_row_bytes(b, 2);
}

static int misaligned(const void *row, iris_format format)
{
    size_t alignment = format == IRIS_MASK1 ? 4 : format == IRIS_HSL48 ? 2 : 1;
    return (uintptr_t)row % alignment != 0;
}

iris_status iris_color_rows_check(const void *dst, iris_format dst_format, const void *src,
                                  iris_format src_format, int32_t n)
{
    size_t dst_bytes = iris_format_row_bytes(dst_format, n);
    size_t src_bytes = iris_format_row_bytes(src_format, n);
    if (dst_bytes == 0 || src_bytes == 0) {
        return IRIS_ERR_RANGE;
    }
    if (misaligned(dst, dst_format) || misaligned(src, src_format)) {
        return IRIS_ERR_ALIGN;
    }
    uintptr_t to = (uintptr_t)dst, from = (uintptr_t)src;
    if (to == from && same_pixel_bytes(dst_format, src_format)) {
        return IRIS_OK;
    }
    return to < from + src_bytes && from < to + dst_bytes ? IRIS_ERR_ALIAS : IRIS_OK;
}

iris_status iris_color_views_check(const iris_image *dst, const iris_image *src)
{
    if (iris_image_check(dst) != IRIS_OK || iris_image_check(src) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    if (dst->w != src->w || dst->h != src->h) {
        return IRIS_ERR_RANGE;
    }
    int same = iris_views_same_place(dst, src) && same_pixel_bytes(dst->format, src->format);
    return !same && iris_image_overlaps(dst, src) ? IRIS_ERR_ALIAS : IRIS_OK;
}

static int is_method(iris_gray_method method)
{
    return method == IRIS_GRAY_LUMA || method == IRIS_GRAY_AVERAGE || method == IRIS_GRAY_GREEN;
}

/* ---- the public functions ---- */

iris_status iris_color_rgb_row(uint8_t *dst, const void *src, iris_format src_format, int32_t n)
{
    if (!dst || !src) {
        return IRIS_ERR_ARG;
    }
    if (!iris_color_takes(src_format)) {
        return IRIS_ERR_FORMAT;
    }
    iris_status status = iris_color_rows_check(dst, IRIS_RGB888, src, src_format, n);
    if (status == IRIS_OK) {
        iris_color_rgb_fill(dst, (const uint8_t *)src, src_format, n);
    }
    return status;
}

iris_status iris_color_gray_row(uint8_t *dst, const void *src, iris_format src_format,
                                iris_gray_method method, int32_t n)
{
    if (!dst || !src || !is_method(method)) {
        return IRIS_ERR_ARG;
    }
    if (!iris_color_takes(src_format)) {
        return IRIS_ERR_FORMAT;
    }
    iris_status status = iris_color_rows_check(dst, IRIS_GRAY8, src, src_format, n);
    if (status == IRIS_OK) {
        iris_color_gray_fill(dst, (const uint8_t *)src, src_format, n, method);
    }
    return status;
}

iris_status iris_color_gray(const iris_image *dst, const iris_image *src, iris_gray_method method)
{
    iris_status status = iris_color_views_check(dst, src);
    if (status == IRIS_OK && dst->format != IRIS_GRAY8) {
        status = IRIS_ERR_FORMAT;
    }
    for (int32_t y = 0; status == IRIS_OK && y < dst->h; y++) {
        status = iris_color_gray_row((uint8_t *)iris_image_row(dst, y), iris_image_row(src, y), src->format,
                                     method, src->w);
    }
    return status;
}
