/* Pixels of three bytes as three vectors of their channels. */
#ifndef IRIS_SSE_PLANES_H
#define IRIS_SSE_PLANES_H

#include "lanes.h"

typedef struct {
    lanes r, g, b;
} planes;

#ifdef __AVX2__
#define PLACES(...) _mm256_broadcastsi128_si256(_mm_setr_epi8(__VA_ARGS__))
#else
#define PLACES(...) _mm_setr_epi8(__VA_ARGS__)
#endif
#define PART(vector, ...) V(shuffle_epi8)(vector, PLACES(__VA_ARGS__))

INLINE lanes join(lanes a, lanes b, lanes c)
{
    return VSI(or)(a, VSI(or)(b, c));
}

/* 16 pixels are three times 16 bytes. */
INLINE planes load_pixels(const uint8_t *from)
{
    lanes a = load_parts(from, 48), b = load_parts(from + 16, 48), c = load_parts(from + 32, 48);
    return (planes){join(PART(a, 0, 3, 6, 9, 12, 15, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1),
                         PART(b, -1, -1, -1, -1, -1, -1, 2, 5, 8, 11, 14, -1, -1, -1, -1, -1),
                         PART(c, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 1, 4, 7, 10, 13)),
                    join(PART(a, 1, 4, 7, 10, 13, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1),
                         PART(b, -1, -1, -1, -1, -1, 0, 3, 6, 9, 12, 15, -1, -1, -1, -1, -1),
                         PART(c, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 2, 5, 8, 11, 14)),
                    join(PART(a, 2, 5, 8, 11, 14, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1),
                         PART(b, -1, -1, -1, -1, -1, 1, 4, 7, 10, 13, -1, -1, -1, -1, -1, -1),
                         PART(c, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 0, 3, 6, 9, 12, 15))};
}

#endif
