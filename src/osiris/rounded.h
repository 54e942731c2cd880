/* Quotients that are rounded half up, as everything is.
 */
#ifndef OSIRIS_ROUNDED_H
#define OSIRIS_ROUNDED_H

#include <stdint.h>

/* a / b; b > 0, and a + b / 2 is no overflow. */
static inline int64_t osiris_quotient(int64_t a, int64_t b)
{
    const int64_t sum = a + b / 2, whole = sum / b;
    return whole - (sum % b < 0);
}

static inline int32_t osiris_within(int32_t value, int32_t low, int32_t high)
{
    return value < low ? low : value > high ? high : value;
}

static inline int32_t osiris_size_of(int32_t value)
{
    return value < 0 ? (value == INT32_MIN ? INT32_MAX : -value) : value;
}

#endif
