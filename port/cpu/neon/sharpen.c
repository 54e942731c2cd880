/* Unsharp mask of a row. */
#include <arm_neon.h>

#include "kernel.h"

static inline int16x4_t change_of(int16x4_t difference, int32_t amount)
{
    return vrshrn_n_s32(vmulq_n_s32(vmovl_s16(difference), amount), 16);
}

void iris_row_sharpen_u8_neon(uint8_t *dst, const uint8_t *src, const uint8_t *blurred,
                              iris_row_sharpening by, int32_t n)
{
    const int16x8_t threshold = vdupq_n_s16((int16_t)by.threshold);
    for (; n >= 8; n -= 8, dst += 8, src += 8, blurred += 8) {
        uint8x8_t s = vld1_u8(src);
        int16x8_t difference = vreinterpretq_s16_u16(vsubl_u8(s, vld1_u8(blurred)));
        int16x8_t change = vcombine_s16(change_of(vget_low_s16(difference), by.amount_q16),
                                        change_of(vget_high_s16(difference), by.amount_q16));
        uint16x8_t counts = vcgtq_s16(vabsq_s16(difference), threshold);
        change = vandq_s16(change, vreinterpretq_s16_u16(counts));
        vst1_u8(dst, vqmovun_s16(vaddq_s16(vreinterpretq_s16_u16(vmovl_u8(s)), change)));
    }
    iris_row_sharpen_u8_c(dst, src, blurred, by, n);
}
