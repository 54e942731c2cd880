#include "iris/bayer.h"

#include "iris/border.h"
#include "kernel.h"

/* Pixels of gray that go through RGB on the stack at a time. */
#define PIECE 64

/* A row and its neighbors. */
typedef struct {
    const uint8_t *above, *row, *below;
    int32_t n;
    int green;    /* pixels of this parity are green */
    int own, far; /* which byte of dst is the row's color other than green, and which is the other rows' */
} mosaic;

static inline uint8_t mean2(uint32_t a, uint32_t b)
{
    return (uint8_t)((a + b + 1u) >> 1);
}

static inline uint8_t mean4(uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    return (uint8_t)((a + b + c + d + 2u) >> 2);
}

static inline void at_green(uint8_t *dst, const mosaic *m, int32_t left, int32_t x, int32_t right)
{
    dst[m->own] = mean2(m->row[left], m->row[right]);
    dst[1] = m->row[x];
    dst[m->far] = mean2(m->above[x], m->below[x]);
}

static inline void at_color(uint8_t *dst, const mosaic *m, int32_t left, int32_t x, int32_t right)
{
    dst[m->own] = m->row[x];
    dst[1] = mean4(m->row[left], m->row[right], m->above[x], m->below[x]);
    dst[m->far] = mean4(m->above[left], m->above[right], m->below[left], m->below[right]);
}

static void at_any(uint8_t *dst, const mosaic *m, int32_t x)
{
    int32_t left = iris_border_index(x - 1, m->n, IRIS_BORDER_REFLECT101);
    int32_t right = iris_border_index(x + 1, m->n, IRIS_BORDER_REFLECT101);
    if (x % 2 == m->green) {
        at_green(dst, m, left, x, right);
    } else {
        at_color(dst, m, left, x, right);
    }
}

/* Pixels x to below end, the first of them to dst. */
static void color_pixels(uint8_t *dst, const mosaic *m, int32_t x, int32_t end)
{
    for (; x < end && (x == 0 || x % 2 != m->green); x++, dst += 3) {
        at_any(dst, m, x);
    }
    for (; x + 2 < m->n && x + 1 < end; x += 2, dst += 6) {
        at_green(dst, m, x - 1, x, x + 1);
        at_color(dst + 3, m, x, x + 1, x + 2);
    }
    for (; x < end; x++, dst += 3) {
        at_any(dst, m, x);
    }
}

static int is_bayer(iris_format format)
{
    return format >= IRIS_BAYER8_RGGB && format <= IRIS_BAYER8_BGGR;
}

static int is_target(iris_format format)
{
    return format == IRIS_RGB888 || format == IRIS_BGR888 || format == IRIS_GRAY8;
}

/* Arguments checked. shift: 1 when the row is the second of the order. */
static void convert_row(uint8_t *dst, iris_format dst_format, const uint8_t *const rows[3], iris_format order,
                        int32_t n)
{
    int place = (int)order - IRIS_BAYER8_RGGB; /* bit 0: columns exchanged, bit 1: rows exchanged */
    int blue_row = place >> 1;
    int own = (dst_format == IRIS_BGR888) == blue_row ? 0 : 2;
    mosaic m = {rows[0], rows[1], rows[2], n, (place ^ blue_row ^ 1) & 1, own, 2 - own};
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
    if (!is_target(dst_format) || !is_bayer(order)) {
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
    if (!is_target(dst->format) || !is_bayer(src->format)) {
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
