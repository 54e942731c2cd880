/* Symmetric weighted sums: bells for small Gaussians, and wide ones. */
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

void iris_row_wide_down_c(int16_t *dst, const uint8_t *src, const int32_t *at, const int16_t *weights,
                          int32_t radius, int32_t n)
{
    for (int32_t i = 0; i < n; i++, src++) {
        int32_t sum = (1 << 10) + src[at[radius]] * weights[0];
        for (int32_t k = 1; k <= radius; k++) {
            sum += (src[at[radius - k]] + src[at[radius + k]]) * weights[k];
        }
        dst[i] = (int16_t)(sum >> 11);
    }
}

/* At most 255 * 2^23. */
static inline int32_t wide_at(const int16_t *src, const int16_t *weights, int32_t radius, int32_t step)
{
    int32_t sum = src[0] * weights[0];
    for (int32_t k = 1; k <= radius; k++) {
        sum += (src[-k * step] + src[k * step]) * weights[k];
    }
    return sum;
}

void iris_row_wide_across_c(int16_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                            int32_t step, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        dst[i] = (int16_t)((wide_at(src + i, weights, radius, step) + (1 << 16)) >> 17);
    }
}

void iris_row_wide_across_u8_c(uint8_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                               int32_t step, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        dst[i] = (uint8_t)((wide_at(src + i, weights, radius, step) + (1 << 22)) >> 23);
    }
}
