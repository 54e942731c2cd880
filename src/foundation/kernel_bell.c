/* Symmetric weighted sums: bells for small Gaussians, and wide ones. */
#include "kernel.h"

/* Two distances at a time, so that their weights and pointers stay in registers; past the radius, with weight 0. */

static inline int32_t weighted(int32_t pair, int32_t weight, int shift)
{
    return (pair * weight + (1 << (shift - 1))) >> shift;
}

void iris_row_bell_down_c(int16_t *dst, const uint8_t *const *rows, const int16_t *weights, int32_t radius,
                          int32_t n)
{
    const uint8_t *above = rows[radius - 1], *here = rows[radius], *below = rows[radius + 1];
    int32_t weight = weights[0], outer = weights[1];
    for (int32_t i = 0; i < n; i++) {
        dst[i] = (int16_t)(weighted(here[i], weight, 9) + weighted(above[i] + below[i], outer, 9));
    }
    for (int32_t k = 2; k <= radius; k += 2) {
        int32_t far = k < radius ? k + 1 : k;
        const uint8_t *top = rows[radius - far], *bottom = rows[radius + far];
        above = rows[radius - k];
        below = rows[radius + k];
        weight = weights[k];
        outer = k < radius ? weights[far] : 0;
        for (int32_t i = 0; i < n; i++) {
            int32_t sum = dst[i] + weighted(above[i] + below[i], weight, 9);
            dst[i] = (int16_t)(sum + weighted(top[i] + bottom[i], outer, 9));
        }
    }
}

void iris_row_bell_across_c(int16_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                            int32_t step, int32_t n)
{
    const int16_t *left = src - step, *right = src + step;
    int32_t weight = weights[0], outer = weights[1];
    for (int32_t i = 0; i < n; i++) {
        dst[i] = (int16_t)(weighted(src[i], weight, 15) + weighted(left[i] + right[i], outer, 15));
    }
    for (int32_t k = 2; k <= radius; k += 2) {
        int32_t far = k < radius ? k + 1 : k;
        const int16_t *first = src - far * step, *last = src + far * step;
        left = src - k * step;
        right = src + k * step;
        weight = weights[k];
        outer = k < radius ? weights[far] : 0;
        for (int32_t i = 0; i < n; i++) {
            int32_t sum = dst[i] + weighted(left[i] + right[i], weight, 15);
            dst[i] = (int16_t)(sum + weighted(first[i] + last[i], outer, 15));
        }
    }
}

#define TILE 64

void iris_row_bell_across_u8_c(uint8_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                               int32_t step, int32_t n)
{
    int16_t sums[TILE];
    for (int32_t from = 0; from < n; from += TILE) {
        int32_t some = n - from < TILE ? n - from : TILE;
        iris_row_bell_across_c(sums, src + from, weights, radius, step, some);
        for (int32_t i = 0; i < some; i++) {
            int32_t value = (sums[i] + 32) >> 6;
            dst[from + i] = (uint8_t)(value < 255 ? value : 255);
        }
    }
}

/* Wide sums round once, at their end. */

void iris_row_wide_down_c(int16_t *dst, const uint8_t *src, const int32_t *at, const int16_t *weights,
                          int32_t radius, int32_t n)
{
    int32_t sums[TILE];
    for (int32_t from = 0; from < n; from += TILE, src += TILE) {
        int32_t some = n - from < TILE ? n - from : TILE;
        const uint8_t *here = src + at[radius];
        for (int32_t i = 0; i < some; i++) {
            sums[i] = (1 << 10) + here[i] * weights[0];
        }
        for (int32_t k = 1; k <= radius; k += 2) {
            int32_t far = k < radius ? k + 1 : k, weight = weights[k], outer = k < radius ? weights[far] : 0;
            const uint8_t *above = src + at[radius - k], *below = src + at[radius + k];
            const uint8_t *top = src + at[radius - far], *bottom = src + at[radius + far];
            for (int32_t i = 0; i < some; i++) {
                sums[i] += (above[i] + below[i]) * weight + (top[i] + bottom[i]) * outer;
            }
        }
        for (int32_t i = 0; i < some; i++) {
            dst[from + i] = (int16_t)(sums[i] >> 11);
        }
    }
}

/* At most 255 * 2^23. */
static void wide_sums(int32_t sums[TILE], const int16_t *src, const int16_t *weights, int32_t radius,
                      int32_t step, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        sums[i] = src[i] * weights[0];
    }
    for (int32_t k = 1; k <= radius; k += 2) {
        int32_t far = k < radius ? k + 1 : k, weight = weights[k], outer = k < radius ? weights[far] : 0;
        const int16_t *left = src - k * step, *right = src + k * step;
        const int16_t *first = src - far * step, *last = src + far * step;
        for (int32_t i = 0; i < n; i++) {
            sums[i] += (left[i] + right[i]) * weight + (first[i] + last[i]) * outer;
        }
    }
}

void iris_row_wide_across_c(int16_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                            int32_t step, int32_t n)
{
    int32_t sums[TILE];
    for (int32_t from = 0; from < n; from += TILE) {
        int32_t some = n - from < TILE ? n - from : TILE;
        wide_sums(sums, src + from, weights, radius, step, some);
        for (int32_t i = 0; i < some; i++) {
            dst[from + i] = (int16_t)((sums[i] + (1 << 16)) >> 17);
        }
    }
}

void iris_row_wide_across_u8_c(uint8_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                               int32_t step, int32_t n)
{
    int32_t sums[TILE];
    for (int32_t from = 0; from < n; from += TILE) {
        int32_t some = n - from < TILE ? n - from : TILE;
        wide_sums(sums, src + from, weights, radius, step, some);
        for (int32_t i = 0; i < some; i++) {
            dst[from + i] = (uint8_t)((sums[i] + (1 << 22)) >> 23);
        }
    }
}
