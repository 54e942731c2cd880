#include "iris/bayer.h"

#include "iris/border.h"
#include "kernel.h"
#include "views.h"

/* Pixels of gray that go through RGB on the stack at a time. */
#define PIECE 240

/* A row between its neighbors. */
typedef struct {
    const uint8_t *const *rows;
    int32_t n;
    int32_t green; /* pixels of this parity are green */
    int32_t own;   /* the byte of a pixel that gets the row's color other than green */
} mosaic;

/* The first or the last pixel. */
static void edge_pixel(uint8_t *dst, const mosaic *m, int32_t x)
{
    uint8_t around[3][3];
    const uint8_t *const middle[3] = {&around[0][1], &around[1][1], &around[2][1]};
    for (int32_t i = 0; i < 3; i++) {
        for (int32_t k = 0; k < 3; k++) {
            around[i][k] = m->rows[i][iris_border_index(x + k - 1, m->n, IRIS_BORDER_REFLECT101)];
        }
    }
    iris_row_888_bayer(dst, middle, m->own, m->green ^ (x & 1), 1);
}

/* Pixels x to below end, the first of them to dst. */
static void color_pixels(uint8_t *dst, const mosaic *m, int32_t x, int32_t end)
{
    if (x == 0) {
        edge_pixel(dst, m, x++);
        dst += 3;
    }
    int32_t last = m->n - 1, count = (end < last ? end : last) - x;
    if (count > 0) {
        const uint8_t *const from[3] = {m->rows[0] + x, m->rows[1] + x, m->rows[2] + x};
        iris_row_888_bayer(dst, from, m->own, m->green ^ (x & 1), count);
        dst += 3 * count;
    }
    if (end == m->n && m->n > 1) {
        edge_pixel(dst, m, last);
    }
}

/* Arguments checked. */
static void convert_row(uint8_t *dst, iris_format dst_format, const uint8_t *const rows[3], iris_format order,
                        int32_t n)
{
    int place = (int)order - IRIS_BAYER8_RGGB; /* bit 0: columns exchanged, bit 1: rows exchanged */
    int blue_row = place >> 1;
    int own = (dst_format == IRIS_BGR888) == blue_row ? 0 : 2;
    mosaic m = {rows, n, (place ^ blue_row ^ 1) & 1, own};
    if (dst_format != IRIS_GRAY8) {
        color_pixels(dst, &m, 0, n);
        return;
    }
    for (int32_t x = 0; x < n; x += PIECE) {
        uint8_t rgb[3 * PIECE];
        int32_t count = n - x < PIECE ? n - x : PIECE;
        color_pixels(rgb, &m, x, x + count);
        iris_row_luma_rgb888(dst + x, rgb, count);
    }
}

iris_status iris_bayer_row(uint8_t *dst, iris_format dst_format, const uint8_t *const rows[3],
                           iris_format order, int32_t n)
{
    if (!dst || !rows || !rows[0] || !rows[1] || !rows[2]) {
        return IRIS_ERR_ARG;
    }
    if (!iris_format_is_levels(dst_format) || !iris_format_is_bayer(order)) {
        return IRIS_ERR_FORMAT;
    }
    size_t bytes = iris_format_row_bytes(dst_format, n);
    if (bytes == 0) {
        return IRIS_ERR_RANGE;
    }
    for (int i = 0; i < 3; i++) {
        uintptr_t to = (uintptr_t)dst, from = (uintptr_t)rows[i];
        if (to < from + (size_t)n && from < to + bytes) {
            return IRIS_ERR_ALIAS;
        }
    }
    convert_row(dst, dst_format, rows, order, n);
    return IRIS_OK;
}

iris_status iris_bayer_convert(const iris_image *dst, const iris_image *src)
{
    if (iris_image_check(dst) != IRIS_OK || iris_image_check(src) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    if (!iris_format_is_levels(dst->format) || !iris_format_is_bayer(src->format)) {
        return IRIS_ERR_FORMAT;
    }
    if (dst->w != src->w || dst->h != src->h) {
        return IRIS_ERR_RANGE;
    }
    if (iris_image_overlaps(dst, src)) {
        return IRIS_ERR_ALIAS;
    }
    for (int32_t y = 0; y < dst->h; y++) {
        const uint8_t *rows[3];
        for (int32_t i = 0; i < 3; i++) {
            rows[i] = iris_image_row(src, iris_border_index(y + i - 1, src->h, IRIS_BORDER_REFLECT101));
        }
        iris_format order =
            y % 2 ? (iris_format)(IRIS_BAYER8_RGGB + (((int)src->format - IRIS_BAYER8_RGGB) ^ 2))
                  : src->format;
        convert_row(iris_image_row(dst, y), dst->format, rows, order, dst->w);
    }
    return IRIS_OK;
}
