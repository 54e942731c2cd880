/* Symmetric weighted sums, for small Gaussians. */
#include "kernel.h"

void iris_row_bell_down_c(int16_t *dst, const uint8_t *const *rows, const int16_t *weights, int32_t radius,
                          int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        int32_t sum = (rows[radius][i] * weights[0] + 256) >> 9;
        for (int32_t k = 1; k <= radius; k++) {
            sum += ((rows[radius - k][i] + rows[radius + k][i]) * weights[k] + 256) >> 9;
        }
        dst[i] = (int16_t)sum;
    }
}

static inline int32_t across_at(const int16_t *src, const int16_t *weights, int32_t radius, int32_t step)
{
    int32_t sum = (src[0] * weights[0] + 16384) >> 15;
    for (int32_t k = 1; k <= radius; k++) {
        sum += ((src[-k * step] + src[k * step]) * weights[k] + 16384) >> 15;
    }
    return sum;
}

void iris_row_bell_across_c(int16_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                            int32_t step, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        dst[i] = (int16_t)across_at(src + i, weights, radius, step);
    }
}

void iris_row_bell_across_u8_c(uint8_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                               int32_t step, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        int32_t value = (across_at(src + i, weights, radius, step) + 32) >> 6;
        dst[i] = (uint8_t)(value < 255 ? value : 255);
    }
}

void iris_row_pairs_s16_c(int32_t *sums, const int16_t *src, const int16_t *weights, int32_t radius,
                          int32_t step, int32_t n)
{
    for (int32_t k = 0; k <= radius; k++) {
        const int16_t *left = src - k * step, *right = src + k * step;
        for (int32_t i = 0; i < n; i++) {
            sums[i] += weights[k] * (k == 0 ? src[i] : left[i] + right[i]);
        }
    }
}
