/* Samples at other places: halved, between others, turned, reversed, and picked. */
#include <string.h>

#include "kernel.h"

/* The two samples beside each other are read as one number: which of them comes first does not matter. */
void iris_row_halve2_u8_c(uint8_t *dst, const uint8_t *upper, const uint8_t *lower, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        uint16_t above, below;
        memcpy(&above, upper + 2 * i, 2);
        memcpy(&below, lower + 2 * i, 2);
        uint32_t sum = (above & 255u) + (above >> 8) + (below & 255u) + (below >> 8);
        dst[i] = (uint8_t)((sum + 2u) >> 2);
    }
}

static inline uint32_t blend(uint32_t first, uint32_t second, uint32_t weight)
{
    return first * (IRIS_ROW_WHOLE - weight) + second * weight;
}

void iris_row_between_u8_c(uint8_t *dst, const uint8_t *const rows[2], const iris_row_places *places,
                           uint32_t down, int32_t n)
{
    const int32_t step = places->step;
    for (int32_t i = 0; i < n; i++) {
        const uint8_t *upper = rows[0] + places->at[i], *lower = rows[1] + places->at[i];
        uint32_t weight = places->weight[i];
        uint32_t above = blend(upper[0], upper[step], weight), below = blend(lower[0], lower[step], weight);
        dst[i] = (uint8_t)((blend(above, below, down) + IRIS_ROW_WHOLE * IRIS_ROW_WHOLE / 2) /
                           (IRIS_ROW_WHOLE * IRIS_ROW_WHOLE));
    }
}

void iris_row_columns16_u8_c(uint8_t *dst, ptrdiff_t stride, const uint8_t *const rows[16], int32_t n)
{
    for (int32_t i = 0; i < n; i++, dst += stride) {
        for (int32_t k = 0; k < 16; k++) {
            dst[k] = rows[k][i];
        }
    }
}

/* Above and below at once, 16 bits each: what wraps around on the way comes back. So does a place behind the last one. */
void iris_row_along_u8_c(uint8_t *dst, const iris_row_way *way, int32_t n)
{
    const uint8_t *src = way->src;
    const ptrdiff_t stride = way->stride;
    const uint32_t dx = (uint32_t)way->dx, dy = (uint32_t)way->dy;
    uint32_t x = (uint32_t)way->x, y = (uint32_t)way->y;
    for (int32_t i = 0; i < n; i++, x += dx, y += dy) {
        const uint8_t *above = src + (ptrdiff_t)(y >> 16) * stride + (x >> 16), *below = above + stride;
        uint32_t right = x >> 8 & 255, down = y >> 8 & 255;
        uint32_t left = above[0] | (uint32_t)below[0] << 16, other = above[1] | (uint32_t)below[1] << 16;
        uint32_t both = left * 256 + (other - left) * right, top = both & 0xFFFF, bottom = both >> 16;
        dst[i] = (uint8_t)((top * 256 + (bottom - top) * down + 32768) >> 16);
    }
}

void iris_row_bends_u8_c(uint8_t *dst, const iris_row_bends *way, int32_t n)
{
    const int bits = way->bits;
    const int32_t *at = way->places;
    for (int32_t i = 0; i < n; i += 1 << bits, at += 2) {
        const iris_row_way straight = {way->src,
                                       way->stride,
                                       at[0],
                                       at[1],
                                       iris_row_bends_step(at[0], at[2], bits),
                                       iris_row_bends_step(at[1], at[3], bits)};
        iris_row_along_u8_c(dst + i, &straight, n - i < 1 << bits ? n - i : 1 << bits);
    }
}

static inline uint64_t reversed_bytes(uint64_t word)
{
    word = (word >> 8 & 0x00FF00FF00FF00FFu) | (word & 0x00FF00FF00FF00FFu) << 8;
    word = (word >> 16 & 0x0000FFFF0000FFFFu) | (word & 0x0000FFFF0000FFFFu) << 16;
    return word >> 32 | word << 32;
}

/* Eight at a time from both ends, until they would meet. */
void iris_row_reverse_u8_c(uint8_t *dst, const uint8_t *src, int32_t n)
{
    for (; n >= 16; n -= 16, src += 8, dst += 8) {
        uint64_t left, right;
        memcpy(&left, src, 8);
        memcpy(&right, src + n - 8, 8);
        left = reversed_bytes(left);
        right = reversed_bytes(right);
        memcpy(dst, &right, 8);
        memcpy(dst + n - 8, &left, 8);
    }
    for (int32_t i = 0; 2 * i < n; i++) {
        uint8_t left = src[i], right = src[n - 1 - i];
        dst[i] = right;
        dst[n - 1 - i] = left;
    }
}

void iris_row_every_third_u8_c(uint8_t *dst, const uint8_t *src, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        dst[i] = src[3 * i];
    }
}
