/* Sums and comparisons in blocks of 8 pixels. */
#include "bits.h"

/* Lanes that are all ones where a pixel is below the limit of its block; two blocks. */
static inline uint8x16_t below_16(uint8x16_t pixels, uint8x8_t blocks)
{
    return vcltq_u8(pixels, vcombine_u8(vdup_lane_u8(blocks, 2), vdup_lane_u8(blocks, 6)));
}

/* Sums of four pixels. */
static inline uint16x4_t sums_of_4(uint8x16_t pixels)
{
    uint16x8_t pairs = vpaddlq_u8(pixels);
    return vpadd_u16(vget_low_u16(pairs), vget_high_u16(pairs));
}

/* 32 pixels, 4 blocks, at a time. A block in 32 bits: sum in the low half, limit, and below in the highest byte. */
void iris_row_scan8_u8_neon(iris_block8 *block, const uint8_t *src, int32_t n)
{
    for (; n >= 32; n -= 32, src += 32, block += 4) {
        uint8x16_t blocks = vld1q_u8((const uint8_t *)block), a = vld1q_u8(src), b = vld1q_u8(src + 16);
        uint8x8_t bits = bits_of_32(below_16(a, vget_low_u8(blocks)), below_16(b, vget_high_u8(blocks)));
        uint32x4_t below = vshlq_n_u32(vmovl_u16(vget_low_u16(vmovl_u8(bits))), 24);
        uint32x4_t sums = vmovl_u16(vpadd_u16(sums_of_4(a), sums_of_4(b)));
        uint32x4_t limits = vandq_u32(vreinterpretq_u32_u8(blocks), vdupq_n_u32(0xff0000));
        vst1q_u8((uint8_t *)block, vreinterpretq_u8_u32(vorrq_u32(vorrq_u32(limits, below), sums)));
    }
    iris_row_scan8_u8_c(block, src, n);
}
