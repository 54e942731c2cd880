/* HSL24 of RGB888, sixteen pixels at a time. Quotients are made bit by bit: that is exact, and no table is asked for each
 * pixel. */
#include "bits.h"

/* Writes bit k of all quotients, from the top, and maybe those below it. On AArch64 that is one instruction with masks
 * in registers; ARMv7 has too few registers for them, and shifts. */
INLINE uint8x16_t put_bit(uint8x16_t bits, uint8x16_t bit, int k)
{
#ifdef __aarch64__
    return vbslq_u8(vdupq_n_u8((uint8_t)(255 >> k)), bit, bits);
#else
    return k == 0 ? bit : vsliq_n_u8(bit, bits, 1);
#endif
}

/* 256 a / d, rounded down, and in a what is left; 255 where a = d. a <= d. */
INLINE uint8x16_t divide(uint8x16_t *a, uint8x16_t d)
{
    uint8x16_t rest = *a, bits = vdupq_n_u8(0);
#pragma GCC unroll 8
    for (int k = 0; k < 8; k++) {
        uint8x16_t fits = vcgeq_u8(rest, vsubq_u8(d, rest)); /* 2 rest >= d, without a ninth bit */
        rest = vmlaq_u8(vaddq_u8(rest, rest), fits, d);      /* all ones are -1 */
        bits = put_bit(bits, fits, k);
    }
    *a = rest;
    return bits;
}

/* Which of r >= g, g >= b, and b >= r hold (4, 2, and 1) tells the sixth of the turn, s. It begins with base = 256 s / 6,
 * rounded down, and H = base + (256 q + k) / 6, where q is the part of the sixth, 0 to 1, and k = 3 for rounding
 * + 256 s % 6. Of grays all hold, and q is 1: their base is such that H is 256, which is 0. */
INLINE uint8x16_t hue_of(uint8x16_t r, uint8x16_t g, uint8x16_t b, uint8x16_t max, uint8x16_t min)
{
    static const uint8_t bases[8] = {0, 128, 42, 85, 213, 170, 0, 213};
    static const uint8_t k_and_2[8] = {0, 5, 9, 7, 7, 9, 5, 7};
    uint8x16_t middle = vmaxq_u8(vminq_u8(r, g), vminq_u8(vmaxq_u8(r, g), b));
    uint8x16_t rg = vcgeq_u8(r, g), gb = vcgeq_u8(g, b), br = vcgeq_u8(b, r);
    uint8x16_t falls = veorq_u8(veorq_u8(rg, gb), br); /* the middle one, along the sixth */
    uint8x16_t order = vandq_u8(vsliq_n_u8(br, vsliq_n_u8(gb, rg, 1), 1), vdupq_n_u8(7));
    uint8x16_t part = vbslq_u8(falls, vsubq_u8(max, middle), vsubq_u8(middle, min));
    uint8x16_t q = divide(&part, vsubq_u8(max, min));
    uint8x16_t half = vhaddq_u8(q, look_up(vld1_u8(k_and_2), order)); /* (256 q + k) / 2 + 1 */
    uint16x8_t low = vmull_u8(vget_low_u8(half), vdup_n_u8(85));      /* (n + 1) * 85 / 256 is n / 3 */
    uint16x8_t high = vmull_u8(vget_high_u8(half), vdup_n_u8(85));
    uint8x16_t steps = vcombine_u8(vshrn_n_u16(low, 8), vshrn_n_u16(high, 8));
    return vaddq_u8(steps, look_up(vld1_u8(bases), order));
}

/* 255 chroma / limit, rounded half up: the quotient of 256 chroma, and one more or less by what is left - chroma +
 * limit / 2. Of black and white all is 0, and 255 and one more are 0. */
INLINE uint8x16_t saturation_of(uint8x16_t chroma, uint8x16_t limit)
{
    uint8x16_t rest = chroma, half = vshrq_n_u8(limit, 1);
    uint8x16_t q = divide(&rest, limit);
    uint8x16_t is_more = vcgeq_u8(vqsubq_u8(rest, chroma), vsubq_u8(limit, half));
    uint8x16_t is_less = vcltq_u8(rest, vqsubq_u8(chroma, half));
    return vaddq_u8(vsubq_u8(q, is_more), is_less);
}

INLINE void hsl24_16(uint8_t *dst, const uint8_t *src, int red)
{
    const uint8x16x3_t p = vld3q_u8(src);
    uint8x16_t r = p.val[red], g = p.val[1], b = p.val[2 - red];
    uint8x16_t max = vmaxq_u8(vmaxq_u8(r, g), b), min = vminq_u8(vminq_u8(r, g), b);
    uint8x16_t limit = vminq_u8(vqaddq_u8(max, min), vqaddq_u8(vmvnq_u8(max), vmvnq_u8(min)));
    uint8x16x3_t hsl = {
        {hue_of(r, g, b, max, min), saturation_of(vsubq_u8(max, min), limit), vrhaddq_u8(max, min)}};
    vst3q_u8(dst, hsl);
}

/* Whole vectors. */
static void rgb_row_of(uint8_t *dst, const uint8_t *src, int32_t n)
{
    for (; n >= 16; n -= 16, src += 48, dst += 48) {
        hsl24_16(dst, src, 0);
    }
}

static void bgr_row_of(uint8_t *dst, const uint8_t *src, int32_t n)
{
    for (; n >= 16; n -= 16, src += 48, dst += 48) {
        hsl24_16(dst, src, 2);
    }
}

void iris_row_hsl24_888_neon(uint8_t *dst, const uint8_t *src, int32_t red, int32_t n)
{
    int32_t whole = n / 16 * 16;
    if (red == 0) {
        rgb_row_of(dst, src, n);
    } else {
        bgr_row_of(dst, src, n);
    }
    iris_row_hsl24_888_c(dst + 3 * whole, src + 3 * whole, red, n - whole);
}
