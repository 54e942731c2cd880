/* The plain C bodies of the row kernels, on every port. */
#include "kernel.h"

static void luma_row(uint8_t *dst, const uint8_t *src, int32_t n, int red)
{
    for (int32_t i = 0; i < n; i++, src += 3) {
        dst[i] = (uint8_t)((77u * src[red] + 150u * src[1] + 29u * src[2 - red] + 128u) >> 8);
    }
}

void iris_row_luma_rgb888_c(uint8_t *dst, const uint8_t *src, int32_t n)
{
    luma_row(dst, src, n, 0);
}

void iris_row_luma_bgr888_c(uint8_t *dst, const uint8_t *src, int32_t n)
{
    luma_row(dst, src, n, 2);
}

void iris_row_luma_rgba8888_c(uint8_t *dst, const uint8_t *src, int32_t n)
{
    for (int32_t i = 0; i < n; i++, src += 4) {
        dst[i] = (uint8_t)((77u * src[0] + 150u * src[1] + 29u * src[2] + 128u) >> 8);
    }
}

void iris_row_swap_888_c(uint8_t *dst, const uint8_t *src, int32_t n)
{
    for (int32_t i = 0; i < n; i++, src += 3, dst += 3) {
        uint8_t first = src[0];
        dst[1] = src[1];
        dst[0] = src[2];
        dst[2] = first;
    }
}

void iris_row_888_gray_c(uint8_t *dst, const uint8_t *src, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        dst[3 * i] = dst[3 * i + 1] = dst[3 * i + 2] = src[i]; /* by index: compilers do it with vectors */
    }
}

void iris_row_above_u8_c(uint32_t *mask, const uint8_t *src, uint8_t limit, int32_t n)
{
    for (int32_t start = 0; start < n; start += 32, src += 32) {
        int32_t count = n - start < 32 ? n - start : 32;
        uint32_t bits = 0;
        for (int32_t i = 0; i < count; i++) {
            bits |= (uint32_t)(src[i] > limit) << i;
        }
        iris_row_put_bits(&mask[start / 32], bits, count);
    }
}

/* Four bytes as a word, the first in the low byte; one load where the processor can. */
static inline uint32_t word_at(const uint8_t *p)
{
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

#define EVEN  0x00ff00ffu
#define CARRY 0x01000100u

/* The bytes of a block, two to a word, with a carry in bits 8 and 24 where the pixel is not below the limit. */
static void mark_block(iris_block8 *block, uint32_t even0, uint32_t odd0, uint32_t even1, uint32_t odd1)
{
    uint32_t bits = (even0 & CARRY) >> 8 | (odd0 & CARRY) >> 7 | (even1 & CARRY) >> 4 | (odd1 & CARRY) >> 3;
    block->below = (uint8_t) ~((bits & 0x33u) | (bits >> 14 & 0xccu));
}

static inline void scan_block(iris_block8 *block, uint32_t x0, uint32_t x1)
{
    uint32_t above = CARRY - (block->limit | (uint32_t)block->limit << 16);
    uint32_t even0 = x0 & EVEN, odd0 = x0 >> 8 & EVEN;
    uint32_t even1 = x1 & EVEN, odd1 = x1 >> 8 & EVEN;
    uint32_t pairs = even0 + odd0 + even1 + odd1;
    block->sum = (uint16_t)(pairs + (pairs >> 16));
    even0 += above;
    odd0 += above;
    even1 += above;
    odd1 += above;
    block->below = 0;
    if (__builtin_expect((even0 & odd0 & even1 & odd1 & CARRY) != CARRY, 0)) {
        mark_block(block, even0, odd0, even1, odd1);
    }
}

void iris_row_scan8_u8_c(iris_block8 *block, const uint8_t *src, int32_t n)
{
    if ((uintptr_t)src % 4 == 0) {
        for (; n >= 8; n -= 8, src += 8) {
            const uint8_t *aligned = (const uint8_t *)__builtin_assume_aligned(src, 4);
            scan_block(block++, word_at(aligned), word_at(aligned + 4));
        }
    }
    for (; n >= 8; n -= 8, src += 8) {
        scan_block(block++, word_at(src), word_at(src + 4));
    }
    if (n > 0) {
        uint32_t total = 0, bits = 0;
        for (int32_t i = 0; i < n; i++) {
            total += src[i];
            bits |= (uint32_t)(src[i] < block->limit) << i;
        }
        block->sum = (uint16_t)total;
        block->below = (uint8_t)bits;
    }
}

void iris_row_slide_u32_c(uint32_t *sums, const uint8_t *enter, const uint8_t *leave, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        int32_t change = (int16_t)(enter[i] - leave[i]); /* narrow, so that a vector holds many */
        sums[i] += (uint32_t)change;
    }
}

void iris_row_slide_u16_c(uint16_t *sums, const uint8_t *enter, const uint8_t *leave, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        sums[i] = (uint16_t)(sums[i] + enter[i] - leave[i]);
    }
}

void iris_row_above_mean_u8_c(uint32_t *mask, const uint8_t *src, const uint32_t *sums,
                              iris_row_window window, int32_t n)
{
    int32_t area = window.side * window.side;
    int32_t total = 0; /* at most 255 * area, below 2^31 like (src + c) * area */
    for (int32_t i = 0; i < window.side - 1 && n > 0; i++) {
        total += (int32_t)sums[i];
    }
    for (int32_t start = 0; start < n; start += 32) {
        int32_t count = n - start < 32 ? n - start : 32;
        uint32_t bits = 0;
        for (int32_t i = 0; i < count; i++) {
            total += (int32_t)sums[start + i + window.side - 1];
            bits |= (uint32_t)((src[start + i] + window.c) * area > total) << i;
            total -= (int32_t)sums[start + i];
        }
        iris_row_put_bits(&mask[start / 32], bits, count);
    }
}
