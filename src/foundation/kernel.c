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

void iris_row_swap_888_c(uint8_t *dst, const uint8_t *src, int32_t n)
{
    for (int32_t i = 0; i < n; i++, src += 3, dst += 3) {
        uint8_t first = src[0];
        dst[1] = src[1];
        dst[0] = src[2];
        dst[2] = first;
    }
}

/* Writes the low `count` (1 to 32) bits of `bits` and keeps the rest of the word. */
static void store_bits(uint32_t *word, uint32_t bits, int32_t count)
{
    uint32_t keep = count == 32 ? 0u : ~0u << count;
    *word = (*word & keep) | (bits & ~keep);
}

void iris_row_above_u8_c(uint32_t *mask, const uint8_t *src, uint8_t limit, int32_t n)
{
    for (int32_t start = 0; start < n; start += 32, src += 32) {
        int32_t count = n - start < 32 ? n - start : 32;
        uint32_t bits = 0;
        for (int32_t i = 0; i < count; i++) {
            bits |= (uint32_t)(src[i] > limit) << i;
        }
        store_bits(&mask[start / 32], bits, count);
    }
}
