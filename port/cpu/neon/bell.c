/* Symmetric weighted sums: vqrdmulhq_n_s16 is the rounded product. The last samples of a row come again, where it is no
 * multiple of the vectors. */
#include <arm_neon.h>

#include "kernel.h"

/* (a + b) * 64 * weight. */
static inline int16x8_t weigh_pairs(uint8x8_t a, uint8x8_t b, int16_t weight)
{
    return vqrdmulhq_n_s16(vreinterpretq_s16_u16(vshlq_n_u16(vaddl_u8(a, b), 6)), weight);
}

void iris_row_bell_down_neon(int16_t *dst, const uint8_t *const *rows, const int16_t *weights, int32_t radius,
                             int32_t n)
{
    if (n < 16) {
        iris_row_bell_down_c(dst, rows, weights, radius, n);
        return;
    }
    for (int32_t i = 0; i < n; i += 16) {
        int32_t at = i < n - 16 ? i : n - 16;
        uint8x16_t center = vld1q_u8(rows[radius] + at);
        int16x8_t low = weigh_pairs(vget_low_u8(center), vdup_n_u8(0), weights[0]);
        int16x8_t high = weigh_pairs(vget_high_u8(center), vdup_n_u8(0), weights[0]);
        for (int32_t k = 1; k <= radius; k++) {
            uint8x16_t above = vld1q_u8(rows[radius - k] + at), below = vld1q_u8(rows[radius + k] + at);
            low = vaddq_s16(low, weigh_pairs(vget_low_u8(above), vget_low_u8(below), weights[k]));
            high = vaddq_s16(high, weigh_pairs(vget_high_u8(above), vget_high_u8(below), weights[k]));
        }
        vst1q_s16(dst + at, low);
        vst1q_s16(dst + at + 8, high);
    }
}

static inline int16x8_t across_8(const int16_t *src, const int16_t *weights, int32_t radius, int32_t step)
{
    int16x8_t sum = vqrdmulhq_n_s16(vld1q_s16(src), weights[0]);
    for (int32_t k = 1; k <= radius; k++) {
        int16x8_t pair = vaddq_s16(vld1q_s16(src - k * step), vld1q_s16(src + k * step));
        sum = vaddq_s16(sum, vqrdmulhq_n_s16(pair, weights[k]));
    }
    return sum;
}

void iris_row_bell_across_neon(int16_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                               int32_t step, int32_t n)
{
    for (; n >= 8; n -= 8, dst += 8, src += 8) {
        vst1q_s16(dst, across_8(src, weights, radius, step));
    }
    iris_row_bell_across_c(dst, src, weights, radius, step, n);
}

void iris_row_bell_across_u8_neon(uint8_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                                  int32_t step, int32_t n)
{
    if (n < 8) {
        iris_row_bell_across_u8_c(dst, src, weights, radius, step, n);
        return;
    }
    for (int32_t i = 0; i < n; i += 8) {
        int32_t at = i < n - 8 ? i : n - 8;
        vst1_u8(dst + at, vqrshrun_n_s16(across_8(src + at, weights, radius, step), 6));
    }
}
