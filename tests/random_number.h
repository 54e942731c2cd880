/* Random numbers, the same on every run. */
#ifndef IRIS_TEST_RANDOM_NUMBER_H
#define IRIS_TEST_RANDOM_NUMBER_H

#include <stdint.h>

/* All 64 bits. Marsaglia's xorshift. */
static inline uint64_t random_u64(void)
{
    static uint64_t x = 88172645463325252u;
    x ^= x << 13;
    x ^= x >> 7;
    return x ^= x << 17;
}

#endif
