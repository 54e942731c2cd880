/* Means of levels. */
#ifndef IRIS_FOUNDATION_MEAN_H
#define IRIS_FOUNDATION_MEAN_H

#include <stdint.h>

/* sum / count, rounded half up; sum is that of count levels, and count at least 1. Division of 64 bits is slow on small
 * processors, and seldom needed. */
static inline uint8_t iris_mean_u8(uint64_t sum, uint32_t count)
{
    sum += count / 2;
    return (uint8_t)(sum <= UINT32_MAX ? (uint32_t)sum / count : sum / count);
}

#endif
