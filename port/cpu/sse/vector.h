/* Moving 16 bytes between memory of any alignment and a register. */
#ifndef IRIS_SSE_VECTOR_H
#define IRIS_SSE_VECTOR_H

#include <smmintrin.h>
#include <stdint.h>
#include <string.h>

#include "kernel.h"

static inline __m128i load16(const void *from)
{
    return _mm_loadu_si128((const __m128i *)from);
}

static inline void store16(void *to, __m128i vector)
{
    _mm_storeu_si128((__m128i *)to, vector);
}

/* The high bits of 32 bytes, the first in the least significant bit. */
static inline uint32_t high_bits(__m128i first, __m128i second)
{
    return (uint32_t)_mm_movemask_epi8(first) | (uint32_t)_mm_movemask_epi8(second) << 16;
}

#endif
