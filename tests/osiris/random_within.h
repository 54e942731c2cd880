/* Random whole numbers from low to high. */
#ifndef IRIS_TEST_RANDOM_WITHIN_H
#define IRIS_TEST_RANDOM_WITHIN_H

#include "random_number.h"

static inline int32_t random_within(int32_t low, int32_t high)
{
    const uint64_t count = (uint64_t)((int64_t)high - low) + 1;
    return (int32_t)(low + (int64_t)((random_u64() >> 16) % count));
}

#endif
