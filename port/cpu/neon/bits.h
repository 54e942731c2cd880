/* From lanes to bits, and from a table to lanes. */
#ifndef IRIS_NEON_BITS_H
#define IRIS_NEON_BITS_H

#include <arm_neon.h>
#include <stdint.h>

#include "kernel.h"

/* Parameters that are constants where a function is called are so within it, too. */
#define INLINE static inline __attribute__((always_inline))

/* A pointer is to hold its value here: it then moves on as part of a load or a store, which costs nothing. */
#define HERE(pointer) __asm__("" : "+r"(pointer))

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

/* table[index]; index 0 to 7. */
static inline uint8x16_t look_up(uint8x8_t table, uint8x16_t index)
{
#ifdef __aarch64__
    return vqtbl1q_u8(vcombine_u8(table, table), index);
#else
    return vcombine_u8(vtbl1_u8(table, vget_low_u8(index)), vtbl1_u8(table, vget_high_u8(index)));
#endif
}

#endif
