/* Gray from three channels, and their exchange. */
#include "bits.h"

static inline uint8x8_t luma_of_8(uint8x8_t red, uint8x8_t green, uint8x8_t blue)
{
    uint16x8_t sum = vmull_u8(green, vdup_n_u8(150));
    sum = vmlal_u8(sum, red, vdup_n_u8(77));
    sum = vmlal_u8(sum, blue, vdup_n_u8(29));
    return vrshrn_n_u16(sum, 8);
}

INLINE void luma_8(uint8_t *dst, const uint8_t *src, int red)
{
    uint8x8x3_t pixels = vld3_u8(src);
    vst1_u8(dst, luma_of_8(pixels.val[red], pixels.val[1], pixels.val[2 - red]));
}

/* n >= 8. The last 8 pixels may overlap those before them: dst and src are disjoint. */
INLINE void luma_row(uint8_t *dst, const uint8_t *src, int32_t n, int red)
{
    for (; n >= 32; n -= 32) {
#pragma GCC unroll 4
        for (int k = 0; k < 4; k++) {
            luma_8(dst, src, red);
            dst += 8;
            src += 24;
            HERE(dst);
            HERE(src);
        }
    }
    for (int32_t i = 0; i < n; i += 8) {
        int32_t at = i < n - 8 ? i : n - 8;
        luma_8(dst + at, src + 3 * at, red);
    }
}

void iris_row_luma_rgb888_neon(uint8_t *dst, const uint8_t *src, int32_t n)
{
    if (n < 8) {
        iris_row_luma_rgb888_c(dst, src, n);
        return;
    }
    luma_row(dst, src, n, 0);
}

void iris_row_luma_bgr888_neon(uint8_t *dst, const uint8_t *src, int32_t n)
{
    if (n < 8) {
        iris_row_luma_bgr888_c(dst, src, n);
        return;
    }
    luma_row(dst, src, n, 2);
}

void iris_row_luma_rgba8888_neon(uint8_t *dst, const uint8_t *src, int32_t n)
{
    for (; n >= 8; n -= 8, dst += 8, src += 32) {
        uint8x8x4_t pixels = vld4_u8(src);
        vst1_u8(dst, luma_of_8(pixels.val[0], pixels.val[1], pixels.val[2]));
    }
    iris_row_luma_rgba8888_c(dst, src, n);
}

void iris_row_swap_888_neon(uint8_t *dst, const uint8_t *src, int32_t n)
{
    for (; n >= 16; n -= 16, src += 48, dst += 48) {
        uint8x16x3_t pixels = vld3q_u8(src);
        uint8x16_t first = pixels.val[0];
        pixels.val[0] = pixels.val[2];
        pixels.val[2] = first;
        vst3q_u8(dst, pixels);
    }
    iris_row_swap_888_c(dst, src, n);
}
