/* From lanes to bits. */
#ifndef IRIS_NEON_BITS_H
#define IRIS_NEON_BITS_H

#include <arm_neon.h>
#include <stdint.h>

#include "kernel.h"

/* 32 lanes, each all ones or zero, as the bits of the first 4 bytes, lane 0 in the lowest bit of byte 0. */
static inline uint8x8_t bits_of_32(uint8x16_t first, uint8x16_t second)
{
    static const uint8_t weights[16] = {1, 2, 4, 8, 16, 32, 64, 128, 1, 2, 4, 8, 16, 32, 64, 128};
    const uint8x16_t weight = vld1q_u8(weights);
    first = vandq_u8(first, weight);
    second = vandq_u8(second, weight);
    uint8x8_t pairs = vpadd_u8(vget_low_u8(first), vget_high_u8(first));
    uint8x8_t more = vpadd_u8(vget_low_u8(second), vget_high_u8(second));
    uint8x8_t quads = vpadd_u8(pairs, more);
    return vpadd_u8(quads, quads);
}

static inline uint32_t word_of_32(uint8x16_t first, uint8x16_t second)
{
    return vget_lane_u32(vreinterpret_u32_u8(bits_of_32(first, second)), 0);
}

#endif
