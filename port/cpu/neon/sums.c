/* Sums across a row, on top of those above. */
#include <arm_neon.h>

#include "kernel.h"

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
