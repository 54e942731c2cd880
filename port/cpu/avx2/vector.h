/* Moving 32 bytes between memory of any alignment and a register. A shuffle of bytes, a pack or an unpack works in each
 * half of a register by itself. */
#ifndef IRIS_AVX2_VECTOR_H
#define IRIS_AVX2_VECTOR_H

#include <immintrin.h>
#include <stdint.h>
#include <string.h>

#include "kernel.h"

static inline __m256i load32(const void *from)
{
    return _mm256_loadu_si256((const __m256i *)from);
}

static inline void store32(void *to, __m256i vector)
{
    _mm256_storeu_si256((__m256i *)to, vector);
}

/* Two halves from two places. */
static inline __m256i load16_twice(const void *low, const void *high)
{
    return _mm256_loadu2_m128i((const __m128i *)high, (const __m128i *)low);
}

#endif
