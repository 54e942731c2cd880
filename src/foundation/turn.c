#include "iris/turn.h"

#include <string.h>

#include "iris/copy.h"
#include "kernel.h"
#include "views.h"

/* What a turning is made of: transposed first, then mirrored. */
enum { MIRRORED_X = 1, MIRRORED_Y = 2, TRANSPOSED = 4 };

/* Pixels are transposed in squares of this side, so that both pictures stay in the cache. */
#define TILE 64

/* The same pixels, last row first. */
static iris_image upside_down(const iris_image *image)
{
    iris_image result = *image;
    result.data = iris_image_row(image, image->h - 1);
    result.stride = image->h > 1 ? -image->stride : image->stride;
    return result;
}

/* ---- pixels of whole bytes; `bytes` is a constant wherever these are called ---- */

static inline void reverse_pixels(uint8_t *row, int32_t n, size_t bytes)
{
    uint8_t *left = row, *right = row + bytes * (size_t)(n - 1), pixel[6];
    for (; left < right; left += bytes, right -= bytes) {
        memcpy(pixel, left, bytes);
        memcpy(left, right, bytes);
        memcpy(right, pixel, bytes);
    }
}

static void reverse_row(uint8_t *row, int32_t n, size_t bytes)
{
    switch (bytes) {
    case 1:
        iris_row_reverse_u8(row, row, n);
        break;
    case 2:
        reverse_pixels(row, n, 2);
        break;
    case 3:
        reverse_pixels(row, n, 3);
        break;
    case 4:
        reverse_pixels(row, n, 4);
        break;
    default:
        reverse_pixels(row, n, 6);
        break;
    }
}

/* The tile of dst whose first pixel is (x, y). */
static inline void transpose_pixels(const iris_image *dst, const iris_image *src, int32_t x, int32_t y,
                                    size_t bytes)
{
    int32_t w = dst->w - x < TILE ? dst->w - x : TILE;
    int32_t h = dst->h - y < TILE ? dst->h - y : TILE;
    for (int32_t v = y; v < y + h; v++) {
        uint8_t *to = (uint8_t *)iris_image_row(dst, v) + bytes * (size_t)x;
        const uint8_t *from = (const uint8_t *)iris_image_row(src, x) + bytes * (size_t)v;
        for (int32_t u = 0; u < w; u++, to += bytes) {
            memcpy(to, from + (ptrdiff_t)u * src->stride, bytes);
        }
    }
}

/* The same of bytes, sixteen columns at a time. */
static void transpose_bytes(const iris_image *dst, const iris_image *src, int32_t x, int32_t y)
{
    const int32_t end = dst->w - x < TILE ? dst->w : x + TILE, h = dst->h - y < TILE ? dst->h - y : TILE;
    for (; x + 16 <= end; x += 16) {
        const uint8_t *rows[16];
        for (int32_t k = 0; k < 16; k++) {
            rows[k] = (const uint8_t *)iris_image_row(src, x + k) + y;
        }
        iris_row_columns16_u8((uint8_t *)iris_image_row(dst, y) + x, dst->stride, rows, h);
    }
    for (int32_t u = x; u < end; u++) {
        const uint8_t *from = (const uint8_t *)iris_image_row(src, u) + y;
        uint8_t *to = (uint8_t *)iris_image_row(dst, y) + u;
        for (int32_t v = 0; v < h; v++) {
            to[v * dst->stride] = from[v];
        }
    }
}

static void transpose_tile(const iris_image *dst, const iris_image *src, int32_t x, int32_t y, size_t bytes)
{
    switch (bytes) {
    case 1:
        transpose_bytes(dst, src, x, y);
        break;
    case 2:
        transpose_pixels(dst, src, x, y, 2);
        break;
    case 3:
        transpose_pixels(dst, src, x, y, 3);
        break;
    case 4:
        transpose_pixels(dst, src, x, y, 4);
        break;
    default:
        transpose_pixels(dst, src, x, y, 6);
        break;
    }
}

/* ---- masks ---- */

/* The bits of a row's last word that are pixels. */
static uint32_t last_bits(int32_t n)
{
    return ~0u >> (n % 32 == 0 ? 0 : 32 - n % 32);
}

static uint32_t reversed(uint32_t word)
{
    word = (word >> 1 & 0x55555555u) | (word & 0x55555555u) << 1;
    word = (word >> 2 & 0x33333333u) | (word & 0x33333333u) << 2;
    word = (word >> 4 & 0x0F0F0F0Fu) | (word & 0x0F0F0F0Fu) << 4;
    word = (word >> 8 & 0x00FF00FFu) | (word & 0x00FF00FFu) << 8;
    return word >> 16 | word << 16;
}

/* Reversed as whole words, and moved down by what is missing in the last one. */
static void reverse_mask_row(uint32_t *row, int32_t n)
{
    int32_t last = (n - 1) / 32, missing = 31 - (n - 1) % 32;
    uint32_t kept = row[last] & ~last_bits(n);
    for (int32_t i = 0; i <= last - i; i++) {
        uint32_t word = reversed(row[i]);
        row[i] = reversed(row[last - i]);
        row[last - i] = word;
    }
    if (missing > 0) {
        for (int32_t i = 0; i < last; i++) {
            row[i] = row[i] >> missing | row[i + 1] << (32 - missing);
        }
        row[last] = row[last] >> missing | kept;
    }
}

/* A square of 32 by 32 bits: halves of halves change places across the diagonal. */
static void transpose_bits(uint32_t square[32])
{
    uint32_t low = 0x0000FFFFu;
    for (int half = 16; half > 0; half /= 2, low ^= low << half) {
        for (int i = 0; i < 32; i = ((i | half) + 1) & ~half) {
            uint32_t moved = (square[i] >> half ^ square[i | half]) & low;
            square[i] ^= moved << half;
            square[i | half] ^= moved;
        }
    }
}

/* The word of dst that begins with pixel (x, y), and those below it. x and y are multiples of 32. */
static void transpose_square(const iris_image *dst, const iris_image *src, int32_t x, int32_t y)
{
    uint32_t square[32] = {0};
    int32_t w = dst->w - x < 32 ? dst->w - x : 32;
    int32_t h = dst->h - y < 32 ? dst->h - y : 32;
    for (int32_t u = 0; u < w; u++) {
        square[u] = ((const uint32_t *)iris_image_row(src, x + u))[y / 32];
    }
    transpose_bits(square);
    for (int32_t v = 0; v < h; v++) {
        uint32_t *word = (uint32_t *)iris_image_row(dst, y + v) + x / 32;
        *word = (*word & ~last_bits(w)) | (square[v] & last_bits(w));
    }
}

/* ---- whole pictures ---- */

static void transpose(const iris_image *dst, const iris_image *src)
{
    size_t bytes = iris_format_row_bytes(dst->format, 1);
    const int32_t side = dst->format == IRIS_MASK1 ? 32 : TILE;
    for (int32_t y = 0; y < dst->h; y += side) {
        for (int32_t x = 0; x < dst->w; x += side) {
            if (dst->format == IRIS_MASK1) {
                transpose_square(dst, src, x, y);
            } else {
                transpose_tile(dst, src, x, y, bytes);
            }
        }
    }
}

/* In place. */
static void mirror_x(const iris_image *image)
{
    for (int32_t y = 0; y < image->h; y++) {
        if (image->format == IRIS_MASK1) {
            reverse_mask_row(iris_image_row(image, y), image->w);
        } else {
            reverse_row(iris_image_row(image, y), image->w, iris_format_row_bytes(image->format, 1));
        }
    }
}

static void exchange(uint8_t *a, uint8_t *b, size_t bytes)
{
    uint8_t part[64];
    for (size_t done = 0, count; done < bytes; done += count) {
        count = bytes - done < sizeof part ? bytes - done : sizeof part;
        memcpy(part, a + done, count);
        memcpy(a + done, b + done, count);
        memcpy(b + done, part, count);
    }
}

/* In place: rows change places, and so do the bits past w of a mask's, which then change back. */
static void mirror_y(const iris_image *image)
{
    size_t bytes = iris_format_row_bytes(image->format, image->w);
    for (int32_t y = 0; y < image->h / 2; y++) {
        uint8_t *upper = iris_image_row(image, y), *lower = iris_image_row(image, image->h - 1 - y);
        exchange(upper, lower, bytes);
        if (image->format == IRIS_MASK1) {
            uint32_t *a = (uint32_t *)(void *)(upper + bytes) - 1,
                     *b = (uint32_t *)(void *)(lower + bytes) - 1;
            uint32_t other = (*a ^ *b) & ~last_bits(image->w);
            *a ^= other;
            *b ^= other;
        }
    }
}

/* The filter of the new first pixel: at an even side the mirrored pattern is out of step. Bit 0 of the order
 * exchanges columns, bit 1 rows. */
iris_format iris_turn_format(iris_format format, iris_size size, iris_turning turning)
{
    if (!iris_format_is_bayer(format)) {
        return format;
    }
    int order = (int)format - IRIS_BAYER8_RGGB, how = (int)turning;
    int w = size.w, h = size.h;
    if (how & TRANSPOSED) {
        order = order >> 1 | (order & 1) << 1;
        w = size.h;
        h = size.w;
    }
    order ^= (how & MIRRORED_X && w % 2 == 0) | (how & MIRRORED_Y && h % 2 == 0) << 1;
    return (iris_format)(IRIS_BAYER8_RGGB + order);
}

static iris_status check(const iris_image *dst, const iris_image *src, iris_turning turning)
{
    if (iris_image_check(dst) != IRIS_OK || iris_image_check(src) != IRIS_OK ||
        (unsigned)turning > IRIS_TRANSVERSE) {
        return IRIS_ERR_ARG;
    }
    int in_pairs = src->format == IRIS_YUYV || src->format == IRIS_UYVY;
    if (dst->format != iris_turn_format(src->format, (iris_size){src->w, src->h}, turning) ||
        (in_pairs && ((int)turning & ~MIRRORED_Y) != 0)) {
        return IRIS_ERR_FORMAT;
    }
    int across = ((int)turning & TRANSPOSED) != 0;
    if (dst->w != (across ? src->h : src->w) || dst->h != (across ? src->w : src->h)) {
        return IRIS_ERR_RANGE;
    }
    int in_place = !across && iris_views_same_place(dst, src);
    return !in_place && iris_image_overlaps(dst, src) ? IRIS_ERR_ALIAS : IRIS_OK;
}

iris_status iris_turn(const iris_image *dst, const iris_image *src, iris_turning turning)
{
    iris_status status = check(dst, src, turning);
    if (status != IRIS_OK) {
        return status;
    }
    int how = (int)turning;
    if (how & TRANSPOSED) { /* mirrored before or after: the rows of one of the two from the last on */
        iris_image to = how & MIRRORED_Y ? upside_down(dst) : *dst;
        iris_image from = how & MIRRORED_X ? upside_down(src) : *src;
        transpose(&to, &from);
        return IRIS_OK;
    }
    if ((how & MIRRORED_X) && dst->data != src->data && iris_format_row_bytes(dst->format, 1) == 1) {
        iris_image from = how & MIRRORED_Y ? upside_down(src) : *src;
        for (int32_t y = 0; y < dst->h; y++) {
            iris_row_reverse_u8(iris_image_row(dst, y), iris_image_row(&from, y), dst->w);
        }
        return IRIS_OK;
    }
    if (dst->data == src->data) {
        if (how & MIRRORED_Y) {
            mirror_y(dst);
        }
    } else {
        iris_image from = how & MIRRORED_Y ? upside_down(src) : *src;
        from.format = dst->format; /* Bayer */
        status = iris_copy(dst, &from);
    }
    if (how & MIRRORED_X) {
        mirror_x(dst);
    }
    return status;
}
