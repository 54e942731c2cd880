/* Vectors as wide as the port's processor has them: the AVX2 port compiles the same kernels with 32 bytes. V(op) and
 * VSI(op) are the instruction of that name on a whole vector. What moves bytes about (unpack, pack, shuffle) does so
 * within each 16 of them. */
#ifndef IRIS_SSE_LANES_H
#define IRIS_SSE_LANES_H

#include "vector.h"

#ifdef __AVX2__
#include <immintrin.h>
typedef __m256i lanes;
#define V(op)   _mm256_##op
#define VSI(op) _mm256_##op##_si256
#else
typedef __m128i lanes;
#define V(op)   _mm_##op
#define VSI(op) _mm_##op##_si128
#endif

#define INLINE static inline __attribute__((always_inline))

enum { LANES = sizeof(lanes) }; /* bytes */

INLINE lanes load_lanes(const void *from)
{
    return VSI(loadu)((const lanes *)from);
}

INLINE void store_lanes(void *to, lanes vector)
{
    VSI(storeu)((lanes *)to, vector);
}

/* 16 bytes each, `apart` bytes from each other where there are 32. */
INLINE lanes load_parts(const uint8_t *from, int32_t apart)
{
#ifdef __AVX2__
    return _mm256_inserti128_si256(_mm256_castsi128_si256(load16(from)), load16(from + apart), 1);
#else
    (void)apart;
    return load16(from);
#endif
}

INLINE void store_parts(uint8_t *to, lanes vector, int32_t apart)
{
#ifdef __AVX2__
    store16(to, _mm256_castsi256_si128(vector));
    store16(to + apart, _mm256_extracti128_si256(vector, 1));
#else
    (void)apart;
    store16(to, vector);
#endif
}

/* LANES values of 16 bits that were made of the low and the high halves of bytes, in their order. */
INLINE void store_halves(int16_t *to, lanes low, lanes high)
{
    store_parts((uint8_t *)to, low, 32);
    store_parts((uint8_t *)(to + 8), high, 32);
}

/* What was packed of two vectors that follow each other, in their order. */
INLINE lanes in_order(lanes packed)
{
#ifdef __AVX2__
    return _mm256_permute4x64_epi64(packed, 0xd8);
#else
    return packed;
#endif
}

#endif
