#include "iris/nv12.h"

#include <string.h>

#include "kernel.h"
#include "views.h"

/* Arguments checked. */
static void convert_row(uint8_t *dst, iris_format format, const uint8_t *luma, const uint8_t *chroma,
                        int32_t n)
{
    if (format != IRIS_GRAY8) {
        iris_row_rgb888_nv12(dst, luma, chroma, n);
        if (format == IRIS_BGR888) {
            iris_row_swap_888(dst, dst, n);
        }
    } else if (dst != luma) {
        memcpy(dst, luma, (size_t)n);
    }
}

static int rows_overlap(const uint8_t *a, size_t a_bytes, const uint8_t *b, size_t b_bytes)
{
    return (uintptr_t)a < (uintptr_t)b + b_bytes && (uintptr_t)b < (uintptr_t)a + a_bytes;
}

static iris_status check_frame(const iris_image *luma, const iris_image *chroma)
{
    if (iris_image_check(luma) != IRIS_OK || iris_image_check(chroma) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    if (luma->format != IRIS_GRAY8 || chroma->format != IRIS_UV88) {
        return IRIS_ERR_FORMAT;
    }
    return chroma->w == (luma->w + 1) / 2 && chroma->h == (luma->h + 1) / 2 ? IRIS_OK : IRIS_ERR_RANGE;
}

iris_status iris_nv12_row(uint8_t *dst, iris_format dst_format, const uint8_t *luma, const uint8_t *chroma,
                          int32_t n)
{
    if (!dst || !luma || !chroma) {
        return IRIS_ERR_ARG;
    }
    if (!iris_format_is_levels(dst_format)) {
        return IRIS_ERR_FORMAT;
    }
    size_t dst_bytes = iris_format_row_bytes(dst_format, n);
    if (dst_bytes == 0) {
        return IRIS_ERR_RANGE;
    }
    int same = dst_format == IRIS_GRAY8 && dst == luma;
    if ((!same && rows_overlap(dst, dst_bytes, luma, (size_t)n)) ||
        rows_overlap(dst, dst_bytes, chroma, ((size_t)n + 1) / 2 * 2)) {
        return IRIS_ERR_ALIAS;
    }
    convert_row(dst, dst_format, luma, chroma, n);
    return IRIS_OK;
}

iris_status iris_nv12_convert(const iris_image *dst, const iris_image *luma, const iris_image *chroma)
{
    if (iris_image_check(dst) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    iris_status status = check_frame(luma, chroma);
    if (status != IRIS_OK) {
        return status;
    }
    if (!iris_format_is_levels(dst->format)) {
        return IRIS_ERR_FORMAT;
    }
    if (dst->w != luma->w || dst->h != luma->h) {
        return IRIS_ERR_RANGE;
    }
    int same = dst->format == IRIS_GRAY8 && iris_views_same_place(dst, luma);
    if ((!same && iris_image_overlaps(dst, luma)) || iris_image_overlaps(dst, chroma)) {
        return IRIS_ERR_ALIAS;
    }
    for (int32_t y = 0; y < dst->h; y++) {
        convert_row(iris_image_row(dst, y), dst->format, iris_image_row(luma, y),
                    iris_image_row(chroma, y / 2), dst->w);
    }
    return IRIS_OK;
}

iris_status iris_nv12_crop(iris_image *luma_view, iris_image *chroma_view, const iris_image *luma,
                           const iris_image *chroma, iris_rect rect)
{
    if (!luma_view || !chroma_view) {
        return IRIS_ERR_ARG;
    }
    iris_status status = check_frame(luma, chroma);
    if (status != IRIS_OK) {
        return status;
    }
    iris_image luma_part, chroma_part;
    status = iris_image_crop(&luma_part, luma, rect);
    if (status != IRIS_OK) {
        return status;
    }
    if (rect.x % 2 != 0 || rect.y % 2 != 0) {
        return IRIS_ERR_ALIGN;
    }
    iris_rect half = {rect.x / 2, rect.y / 2, (rect.w + 1) / 2, (rect.h + 1) / 2};
    status = iris_image_crop(&chroma_part, chroma, half);
    if (status == IRIS_OK) {
        *luma_view = luma_part;
        *chroma_view = chroma_part;
    }
    return status;
}
