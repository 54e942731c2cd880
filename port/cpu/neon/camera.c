/* Rows of cameras to colors. */
#include <arm_neon.h>

#include "kernel.h"

/* ---- YUV ---- */

/* Eight pixels of a channel: their luma, four and four, and the tint of each two. */
static inline uint8x8_t tinted(int32x4_t luma0, int32x4_t luma1, int32x4_t tint)
{
    int32x4x2_t twice = vzipq_s32(tint, tint);
    int16x4_t low = vshrn_n_s32(vaddq_s32(luma0, twice.val[0]), 8);
    int16x4_t high = vshrn_n_s32(vaddq_s32(luma1, twice.val[1]), 8);
    return vqmovun_s16(vcombine_s16(low, high));
}

/* Eight pixels, and their four of U and V. */
static inline void colors_of_8(uint8x8_t rgb[3], uint8x8_t pixels, int16x4_t u, int16x4_t v)
{
    int16x8_t y = vreinterpretq_s16_u16(vsubl_u8(pixels, vdup_n_u8(16)));
    int32x4_t luma0 = vmlal_n_s16(vdupq_n_s32(128), vget_low_s16(y), 298);
    int32x4_t luma1 = vmlal_n_s16(vdupq_n_s32(128), vget_high_s16(y), 298);
    rgb[0] = tinted(luma0, luma1, vmull_n_s16(v, 409));
    rgb[1] = tinted(luma0, luma1, vmlal_n_s16(vmull_n_s16(u, -100), v, -208));
    rgb[2] = tinted(luma0, luma1, vmull_n_s16(u, 516));
}

void iris_row_rgb888_nv12_neon(uint8_t *dst, const uint8_t *luma, const uint8_t *chroma, int32_t n)
{
    for (; n >= 16; n -= 16, dst += 48, luma += 16, chroma += 16) {
        uint8x16_t y = vld1q_u8(luma);
        uint8x8x2_t uv = vld2_u8(chroma);
        int16x8_t u = vreinterpretq_s16_u16(vsubl_u8(uv.val[0], vdup_n_u8(128)));
        int16x8_t v = vreinterpretq_s16_u16(vsubl_u8(uv.val[1], vdup_n_u8(128)));
        uint8x8_t low[3], high[3];
        colors_of_8(low, vget_low_u8(y), vget_low_s16(u), vget_low_s16(v));
        colors_of_8(high, vget_high_u8(y), vget_high_s16(u), vget_high_s16(v));
        uint8x16x3_t pixels = {
            {vcombine_u8(low[0], high[0]), vcombine_u8(low[1], high[1]), vcombine_u8(low[2], high[2])}};
        vst3q_u8(dst, pixels);
    }
    iris_row_rgb888_nv12_c(dst, luma, chroma, n);
}

/* ---- Bayer ---- */

static inline uint16x8_t odd_bytes(uint8x16_t bytes)
{
    return vshrq_n_u16(vreinterpretq_u16_u8(bytes), 8);
}

/* The means of four in the odd bytes; the even ones are 0. */
static inline uint8x16_t odd_means(uint8x16_t a, uint8x16_t b, uint8x16_t c, uint8x16_t d)
{
    uint16x8_t sum = vaddq_u16(vaddq_u16(odd_bytes(a), odd_bytes(b)), vaddq_u16(odd_bytes(c), odd_bytes(d)));
    return vreinterpretq_u8_u16(vshlq_n_u16(vrshrq_n_u16(sum, 2), 8));
}

/* Sixteen pixels, the even ones green. */
static inline void demosaic_16(uint8_t *dst, const uint8_t *const rows[3], int32_t own)
{
    const uint8x16_t even = vreinterpretq_u8_u16(vdupq_n_u16(0xFF));
    uint8x16_t row = vld1q_u8(rows[1]), left = vld1q_u8(rows[1] - 1), right = vld1q_u8(rows[1] + 1);
    uint8x16_t above = vld1q_u8(rows[0]), below = vld1q_u8(rows[2]);
    uint8x16_t of_row = vbslq_u8(even, vrhaddq_u8(left, right), row);
    uint8x16_t green = vbslq_u8(even, row, odd_means(left, right, above, below));
    uint8x16_t corners =
        odd_means(vld1q_u8(rows[0] - 1), vld1q_u8(rows[0] + 1), vld1q_u8(rows[2] - 1), vld1q_u8(rows[2] + 1));
    uint8x16_t far = vbslq_u8(even, vrhaddq_u8(above, below), corners);
    uint8x16x3_t pixels = {{own == 0 ? of_row : far, green, own == 0 ? far : of_row}};
    vst3q_u8(dst, pixels);
}

void iris_row_888_bayer_neon(uint8_t *dst, const uint8_t *const rows[3], int32_t own, int32_t green,
                             int32_t n)
{
    int32_t x = green != 0 && n > 0; /* a pixel that is not green */
    iris_row_888_bayer_c(dst, rows, own, green, x);
    for (; x + 16 <= n; x += 16) {
        const uint8_t *const here[3] = {rows[0] + x, rows[1] + x, rows[2] + x};
        demosaic_16(dst + 3 * x, here, own);
    }
    const uint8_t *const rest[3] = {rows[0] + x, rows[1] + x, rows[2] + x};
    iris_row_888_bayer_c(dst + 3 * x, rest, own, 0, n - x);
}
