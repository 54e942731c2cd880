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

#define INLINE static inline __attribute__((always_inline))

/* The last half of `left` and the first one of `right`. */
INLINE __m256i between(__m256i left, __m256i right)
{
    return _mm256_permute2x128_si256(left, right, 0x21);
}

/* What is `step` bytes, 1 or 3, a constant, before `here` and behind it; middle: what lies between it and the one before or
 * behind. */
INLINE __m256i before(__m256i middle, __m256i here, int32_t step)
{
    return step == 1 ? _mm256_alignr_epi8(here, middle, 15) : _mm256_alignr_epi8(here, middle, 13);
}

INLINE __m256i behind(__m256i here, __m256i middle, int32_t step)
{
    return step == 1 ? _mm256_alignr_epi8(middle, here, 1) : _mm256_alignr_epi8(middle, here, 3);
}

#endif
