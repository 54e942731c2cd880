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

void iris_row_scan8_u8_c(uint8_t *below, uint16_t *sum, const uint8_t *src, const uint8_t *limit, int32_t n)
{
    for (; n >= 8; n -= 8, src += 8) {
        uint32_t total = 0, bits = 0, edge = *limit++;
        for (uint32_t i = 0; i < 8; i++) {
            uint32_t p = src[i];
            total += p;
            bits |= (p - edge) >> 31 << i;
        }
        *sum++ = (uint16_t)total;
        *below++ = (uint8_t)bits;
    }
    if (n > 0) {
        uint32_t total = 0, bits = 0;
        for (int32_t i = 0; i < n; i++) {
            total += src[i];
            bits |= (uint32_t)(src[i] < *limit) << i;
        }
        *sum = (uint16_t)total;
        *below = (uint8_t)bits;
    }
}

void iris_row_slide_u32_c(uint32_t *sums, const uint8_t *enter, const uint8_t *leave, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        sums[i] += (uint32_t)enter[i] - leave[i];
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
