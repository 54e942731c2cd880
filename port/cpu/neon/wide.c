/* Wide symmetric weighted sums. The last samples of a row come again, where it is no multiple of the vectors. */
#include <arm_neon.h>

#include "kernel.h"

/* Eight sums. */
typedef struct {
    int32x4_t low, high;
} sums_8;

static inline sums_8 all_alike(int32_t start)
{
    return (sums_8){vdupq_n_s32(start), vdupq_n_s32(start)};
}

static inline sums_8 add_pair(sums_8 sums, int16x8_t pair, int16_t weight)
{
    return (sums_8){vmlal_n_s16(sums.low, vget_low_s16(pair), weight),
                    vmlal_n_s16(sums.high, vget_high_s16(pair), weight)};
}

static inline int16x8_t add_bytes(uint8x8_t a, uint8x8_t b)
{
    return vreinterpretq_s16_u16(vaddl_u8(a, b));
}

void iris_row_wide_down_neon(int16_t *dst, const uint8_t *src, const int32_t *at, const int16_t *weights,
                             int32_t radius, int32_t n)
{
    if (n < 16) {
        iris_row_wide_down_c(dst, src, at, weights, radius, n);
        return;
    }
    for (int32_t i = 0; i < n; i += 16) {
        int32_t from = i < n - 16 ? i : n - 16;
        const uint8_t *here = src + from;
        uint8x16_t a = vld1q_u8(here + at[radius]), b = vdupq_n_u8(0);
        sums_8 low = all_alike(1 << 10), high = low;
        for (int32_t k = 0; k <= radius; k++) {
            if (k > 0) {
                a = vld1q_u8(here + at[radius - k]);
                b = vld1q_u8(here + at[radius + k]);
            }
            low = add_pair(low, add_bytes(vget_low_u8(a), vget_low_u8(b)), weights[k]);
            high = add_pair(high, add_bytes(vget_high_u8(a), vget_high_u8(b)), weights[k]);
        }
        vst1q_s16(dst + from, vcombine_s16(vshrn_n_s32(low.low, 11), vshrn_n_s32(low.high, 11)));
        vst1q_s16(dst + from + 8, vcombine_s16(vshrn_n_s32(high.low, 11), vshrn_n_s32(high.high, 11)));
    }
}

/* Sixteen sums, from src on. */
static inline void across_16(sums_8 sums[2], const int16_t *src, const int16_t *weights, int32_t radius,
                             int32_t step)
{
    const int16_t *left = src, *right = src;
    sums_8 first = add_pair(sums[0], vld1q_s16(src), weights[0]);
    sums_8 second = add_pair(sums[1], vld1q_s16(src + 8), weights[0]);
    for (int32_t k = 1; k <= radius; k++) {
        left -= step;
        right += step;
        first = add_pair(first, vaddq_s16(vld1q_s16(left), vld1q_s16(right)), weights[k]);
        second = add_pair(second, vaddq_s16(vld1q_s16(left + 8), vld1q_s16(right + 8)), weights[k]);
    }
    sums[0] = first;
    sums[1] = second;
}

static inline int16x8_t upper_halves(sums_8 sums, int32_t right)
{
    const int32x4_t shift = vdupq_n_s32(-right);
    return vcombine_s16(vmovn_s32(vshlq_s32(sums.low, shift)), vmovn_s32(vshlq_s32(sums.high, shift)));
}

void iris_row_wide_across_neon(int16_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                               int32_t step, int32_t n)
{
    if (n < 16) {
        iris_row_wide_across_c(dst, src, weights, radius, step, n);
        return;
    }
    for (int32_t i = 0; i < n; i += 16) {
        int32_t from = i < n - 16 ? i : n - 16;
        sums_8 sums[2] = {all_alike(1 << 16), all_alike(1 << 16)};
        across_16(sums, src + from, weights, radius, step);
        vst1q_s16(dst + from, upper_halves(sums[0], 17));
        vst1q_s16(dst + from + 8, upper_halves(sums[1], 17));
    }
}

void iris_row_wide_across_u8_neon(uint8_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                                  int32_t step, int32_t n)
{
    if (n < 16) {
        iris_row_wide_across_u8_c(dst, src, weights, radius, step, n);
        return;
    }
    for (int32_t i = 0; i < n; i += 16) {
        int32_t from = i < n - 16 ? i : n - 16;
        sums_8 sums[2] = {all_alike(1 << 22), all_alike(1 << 22)};
        across_16(sums, src + from, weights, radius, step);
        uint8x8_t low = vqmovun_s16(upper_halves(sums[0], 23)), high = vqmovun_s16(upper_halves(sums[1], 23));
        vst1q_u8(dst + from, vcombine_u8(low, high));
    }
}
