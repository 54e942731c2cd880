#include "hsl.h"
#include "kernel.h"

static int ordered(int32_t low, int32_t high, int32_t most)
{
    return low >= 0 && low <= high && high <= most;
}

iris_status iris_hsl_range_prepare(iris_hsl_range_test *test, const iris_hsl_range *range)
{
    if (!test || !range || !ordered(range->s0, range->s1, 100) || !ordered(range->l0, range->l1, 100) ||
        !ordered(0, range->h0, 360) || !ordered(0, range->h1, 360)) {
        return IRIS_ERR_ARG;
    }
    iris_hsl_range_test result;
    int whole = range->h0 == 0 && range->h1 == 360;
    result.h0 = range->h0 % 360;
    result.h1 = whole ? 360 : range->h1 % 360;
    result.hue_wraps = result.h0 > result.h1;
    result.hue_has_gray = result.h0 == 0 || result.hue_wraps;
    result.s0 = range->s0;
    result.s1 = range->s1;
    result.chroma_min = range->s0 > 0;
    result.l0 = (range->l0 * 510 + 99) / 100;
    result.l1 = range->l1 * 510 / 100;
    *test = result;
    return IRIS_OK;
}

/* Red at 0 degrees and blue at 240 change places, green at 120 stays: hue h becomes 240 - h. */
iris_hsl_range_test iris_hsl_range_of_bgr(const iris_hsl_range_test *test)
{
    iris_hsl_range_test turned = *test;
    if (test->h1 != 360) { /* the whole circle stays as it is */
        turned.h0 = (600 - test->h1) % 360;
        turned.h1 = (600 - test->h0) % 360;
        turned.hue_wraps = turned.h0 > turned.h1;
    }
    return turned;
}

int iris_hsl_range_has(const iris_hsl_range_test *test, iris_color color)
{
    uint8_t rgb[3] = {color.r, color.g, color.b};
    uint32_t mask = 0;
    iris_row_hsl_range(&mask, rgb, test, 1);
    return (int)mask;
}

iris_status iris_hsl_range_row(uint32_t *mask, const uint8_t *rgb, int32_t n, const iris_hsl_range_test *test)
{
    if (!mask || !rgb || !test) {
        return IRIS_ERR_ARG;
    }
    if (n < 1 || n > IRIS_SIDE_MAX) {
        return IRIS_ERR_RANGE;
    }
    if ((uintptr_t)mask % 4 != 0) {
        return IRIS_ERR_ALIGN;
    }
    uintptr_t to = (uintptr_t)mask, from = (uintptr_t)rgb;
    if (to < from + iris_format_row_bytes(IRIS_RGB888, n) &&
        from < to + iris_format_row_bytes(IRIS_MASK1, n)) {
        return IRIS_ERR_ALIAS;
    }
    iris_row_hsl_range(mask, rgb, test, n);
    return IRIS_OK;
}

/* Pixels that are converted to RGB at a time: whole words of the mask. */
#define PIECE 64

static iris_status row_by_pieces(uint32_t *bits, const uint8_t *from, const iris_image *src,
                                 const iris_hsl_range_test *test)
{
    size_t piece_bytes = iris_format_row_bytes(src->format, PIECE);
    for (int32_t x = 0; x < src->w; x += PIECE, bits += PIECE / 32, from += piece_bytes) {
        uint8_t rgb[3 * PIECE];
        int32_t n = src->w - x < PIECE ? src->w - x : PIECE;
        iris_status status = iris_color_rgb_row(rgb, from, src->format, n);
        if (status != IRIS_OK) {
            return status;
        }
        iris_row_hsl_range(bits, rgb, test, n);
    }
    return IRIS_OK;
}

iris_status iris_hsl_range_mask(const iris_image *mask, const iris_image *src, const iris_hsl_range *range)
{
    iris_hsl_range_test test;
    if (iris_image_check(mask) != IRIS_OK || iris_image_check(src) != IRIS_OK ||
        iris_hsl_range_prepare(&test, range) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    if (mask->format != IRIS_MASK1) {
        return IRIS_ERR_FORMAT;
    }
    if (mask->w != src->w || mask->h != src->h) {
        return IRIS_ERR_RANGE;
    }
    if (iris_image_overlaps(mask, src)) {
        return IRIS_ERR_ALIAS;
    }
    if (src->format == IRIS_BGR888) {
        test = iris_hsl_range_of_bgr(&test);
    }
    iris_status status = IRIS_OK;
    for (int32_t y = 0; y < src->h && status == IRIS_OK; y++) {
        uint32_t *bits = (uint32_t *)iris_image_row(mask, y);
        const uint8_t *from = (const uint8_t *)iris_image_row(src, y);
        if (src->format == IRIS_RGB888 || src->format == IRIS_BGR888) {
            iris_row_hsl_range(bits, from, &test, src->w);
        } else {
            status = row_by_pieces(bits, from, src, &test);
        }
    }
    return status;
}
