/* Noise of a seed, the same on every processor.
 */
#ifndef OSIRIS_NOISE_H
#define OSIRIS_NOISE_H

#include <stdint.h>

/* 16 random bits. A linear congruence (Numerical Recipes' constants): its upper half is random enough. */
static inline int32_t osiris_noise_bits(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (int32_t)(*state >> 16);
}

/* Nearly normal, with a standard deviation of 65536: the sum of twelve uniform ones. Within 6 deviations. */
static inline int32_t osiris_noise_normal(uint32_t *state)
{
    int32_t sum = -6 * 65536;
    for (int i = 0; i < 12; i++) {
        sum += osiris_noise_bits(state);
    }
    return sum;
}

#endif
