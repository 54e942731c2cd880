#include "iris/xt/signature.h"

#include "../../foundation/views.h"
#include "signature_cells.h"

#define PIECE IRIS_SIGNATURE_PIECE

static iris_status check_which(const iris_signatures *signatures, int32_t which)
{
    if (!signatures) {
        return IRIS_ERR_ARG;
    }
    return which < 0 || which >= IRIS_SIGNATURES ? IRIS_ERR_RANGE : IRIS_OK;
}

iris_status iris_signature_clear(iris_signatures *signatures, int32_t which)
{
    iris_status status = check_which(signatures, which);
    if (status == IRIS_OK) {
        for (int32_t i = 0; i < IRIS_SIGNATURE_CELLS; i++) {
            signatures->cells[i] &= (uint8_t) ~(1u << which);
        }
    }
    return status;
}

/* Is at least half of the cell in the range? Of eight points, those that are colors: all when none is. */
static int cell_is_in(int32_t cell, const iris_hsl_range_test *test)
{
    int32_t colors = 0, in = 0, all_in = 0;
    for (int32_t i = 0; i < 8; i++) {
        int is_color;
        const iris_signature_yuv along = {i & 1 ? 3 : 1, i & 2 ? 3 : 1, i & 4 ? 3 : 1};
        int has = iris_hsl_range_has(test, iris_signature_color_of(cell, along, &is_color));
        colors += is_color;
        in += is_color & has;
        all_in += has;
    }
    return colors > 0 ? 2 * in >= colors : all_in >= 4;
}

iris_status iris_signature_from_range(iris_signatures *signatures, int32_t which, const iris_hsl_range *range)
{
    iris_hsl_range_test test;
    iris_status status = check_which(signatures, which);
    if (status != IRIS_OK || iris_hsl_range_prepare(&test, range) != IRIS_OK) {
        return status != IRIS_OK ? status : IRIS_ERR_ARG;
    }
    for (int32_t cell = 0; cell < IRIS_SIGNATURE_CELLS; cell++) {
        uint32_t bit = (uint32_t)cell_is_in(cell, &test) << which;
        signatures->cells[cell] = (uint8_t)((signatures->cells[cell] & ~(1u << which)) | bit);
    }
    return IRIS_OK;
}

/* --- pixels --- */

static void classify_row(uint8_t *dst, const void *src, iris_format format, int32_t n,
                         const iris_signatures *signatures)
{
    for (int32_t x = 0; x < n; x += PIECE) {
        uint16_t cells[PIECE];
        int32_t count = n - x < PIECE ? n - x : PIECE;
        iris_signature_cells_row(cells, src, format, x, count);
        for (int32_t i = 0; i < count; i++) {
            dst[x + i] = signatures->cells[cells[i]];
        }
    }
}

static void mask_row(uint32_t *mask, const void *src, iris_format format, int32_t n,
                     const iris_signatures *signatures, uint32_t selected)
{
    for (int32_t x = 0; x < n; x += PIECE) {
        uint16_t cells[PIECE];
        int32_t count = n - x < PIECE ? n - x : PIECE;
        iris_signature_cells_row(cells, src, format, x, count);
        for (int32_t first = 0; first < count; first += 32) {
            uint32_t bits = 0, left = (uint32_t)(count - first), *word = mask + (x + first) / 32;
            uint32_t keep = left < 32 ? ~0u << left : 0;
            for (uint32_t i = 0; i < 32 && i < left; i++) {
                bits |= (uint32_t)((signatures->cells[cells[(uint32_t)first + i]] & selected) != 0) << i;
            }
            *word = (*word & keep) | bits;
        }
    }
}

static iris_status check_views(const iris_image *dst, iris_format to, const iris_image *src,
                               const iris_signatures *signatures)
{
    iris_status status = iris_views_check(dst, src, IRIS_BORDER_NONE);
    if (status == IRIS_ERR_ARG || !signatures) {
        return IRIS_ERR_ARG;
    }
    return dst->format != to || !iris_color_takes(src->format) ? IRIS_ERR_FORMAT : status;
}

iris_status iris_signature_classify(const iris_image *dst, const iris_image *src,
                                    const iris_signatures *signatures)
{
    iris_status status = check_views(dst, IRIS_GRAY8, src, signatures);
    for (int32_t y = 0; status == IRIS_OK && y < src->h; y++) {
        classify_row((uint8_t *)iris_image_row(dst, y), iris_image_row(src, y), src->format, src->w,
                     signatures);
    }
    return status;
}

iris_status iris_signature_mask(const iris_image *mask, const iris_image *src,
                                const iris_signatures *signatures, uint32_t selected)
{
    iris_status status = check_views(mask, IRIS_MASK1, src, signatures);
    if (status == IRIS_OK && selected > 255) {
        status = IRIS_ERR_RANGE;
    }
    for (int32_t y = 0; status == IRIS_OK && y < src->h; y++) {
        mask_row((uint32_t *)iris_image_row(mask, y), iris_image_row(src, y), src->format, src->w, signatures,
                 selected);
    }
    return status;
}

iris_status iris_signature_row(uint8_t *dst, const void *src, iris_format src_format, int32_t n,
                               const iris_signatures *signatures)
{
    if (!dst || !src || !signatures) {
        return IRIS_ERR_ARG;
    }
    if (!iris_color_takes(src_format)) {
        return IRIS_ERR_FORMAT;
    }
    size_t bytes = n < 1 || n > IRIS_SIDE_MAX ? 0 : iris_format_row_bytes(src_format, n);
    if (bytes == 0) {
        return IRIS_ERR_RANGE;
    }
    int is_565 = src_format == IRIS_RGB565 || src_format == IRIS_RGB565_SWAP;
    if (is_565 && (uintptr_t)src % 2 != 0) {
        return IRIS_ERR_ALIGN;
    }
    uintptr_t to = (uintptr_t)dst, from = (uintptr_t)src;
    if (to < from + bytes && from < to + (size_t)n && !(to == from && src_format == IRIS_GRAY8)) {
        return IRIS_ERR_ALIAS;
    }
    classify_row(dst, src, src_format, n, signatures);
    return IRIS_OK;
}
