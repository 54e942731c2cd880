/* Sums of rows, down and across. */
#include <arm_neon.h>

#include "kernel.h"

static inline uint16x8_t binomial_of_8(const uint8_t *const rows[5], int32_t x)
{
    uint8x8_t middle = vld1_u8(rows[2] + x);
    uint16x8_t outer = vaddl_u8(vld1_u8(rows[0] + x), vld1_u8(rows[4] + x));
    uint16x8_t inner = vaddw_u8(vaddl_u8(vld1_u8(rows[1] + x), vld1_u8(rows[3] + x)), middle);
    return vaddq_u16(vaddq_u16(outer, vshll_n_u8(middle, 1)), vshlq_n_u16(inner, 2));
}

/* n >= 8. The last 8 may overlap those before them: sums and rows are disjoint. */
void iris_row_binomial5_u8_neon(uint16_t *sums, const uint8_t *const rows[5], int32_t n)
{
    if (n < 8) {
        iris_row_binomial5_u8_c(sums, rows, n);
        return;
    }
    for (int32_t x = 0; x < n; x += 8) {
        x = x > n - 8 ? n - 8 : x;
        vst1q_u16(sums + x, binomial_of_8(rows, x));
    }
}

/* Nothing is read past what the eight results need. */
static inline uint8x8_t halved_8(const uint16_t *sums)
{
    uint16x8x2_t left = vld2q_u16(sums - 2), middle = vld2q_u16(sums);
    uint16x8_t right = vextq_u16(middle.val[0], vld1q_dup_u16(sums + 16), 1);
    uint16x8_t inner = vaddq_u16(vaddq_u16(left.val[1], middle.val[1]), middle.val[0]);
    uint16x8_t outer = vaddq_u16(vaddq_u16(left.val[0], right), vshlq_n_u16(middle.val[0], 1));
    return vrshrn_n_u16(vaddq_u16(outer, vshlq_n_u16(inner, 2)), 8);
}

void iris_row_halve_u16_neon(uint8_t *dst, const uint16_t *sums, int32_t n)
{
    if (n < 8) {
        iris_row_halve_u16_c(dst, sums, n);
        return;
    }
    for (int32_t x = 0; x < n; x += 8) {
        x = x > n - 8 ? n - 8 : x;
        vst1_u8(dst + x, halved_8(sums + 2 * x));
    }
}

void iris_row_integral_u8_neon(uint32_t *dst, const uint32_t *above, const uint8_t *src, int32_t n)
{
    const uint16x8_t zero = vdupq_n_u16(0);
    uint32x4_t before = vdupq_n_u32(0); /* the sum so far, four times */
    int32_t x = 0;
    for (; x + 8 <= n; x += 8) {
        uint16x8_t sum = vmovl_u8(vld1_u8(src + x));
        sum = vaddq_u16(sum, vextq_u16(zero, sum, 7));
        sum = vaddq_u16(sum, vextq_u16(zero, sum, 6));
        sum = vaddq_u16(sum, vextq_u16(zero, sum, 4));
        uint32x4_t low = vaddw_u16(before, vget_low_u16(sum)), high = vaddw_u16(before, vget_high_u16(sum));
        before = vdupq_lane_u32(vget_high_u32(high), 1);
        vst1q_u32(dst + x, vaddq_u32(low, vld1q_u32(above + x)));
        vst1q_u32(dst + x + 4, vaddq_u32(high, vld1q_u32(above + x + 4)));
    }
    uint32_t rest = vgetq_lane_u32(before, 0);
    for (; x < n; x++) {
        rest += src[x];
        dst[x] = above[x] + rest;
    }
}
