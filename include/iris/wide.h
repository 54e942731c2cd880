/* IRIS - wide numbers: 64 bits with 32 fraction bits, and the 128-bit products that they need.
 *
 * In plain C99: no 128-bit type of a compiler. A wide number is two's complement, high:low. Functions named _sat return
 * the nearest value that fits; the others wrap. Rounding is half up, as in fixed.h. O(1) each.
 */
#ifndef IRIS_WIDE_H
#define IRIS_WIDE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef int64_t iris_q32; /* 32 fraction bits: 4294967296 = 1.0 */

#define IRIS_Q32_ONE ((iris_q32)4294967296)

typedef struct {
    int64_t high;
    uint64_t low;
} iris_wide;

static inline iris_wide iris_wide_from(int64_t value)
{
    iris_wide wide = {value < 0 ? -1 : 0, (uint64_t)value};
    return wide;
}

/* a * b, exact. */
iris_wide iris_wide_mul(int64_t a, int64_t b);

static inline iris_wide iris_wide_add(iris_wide a, iris_wide b)
{
    uint64_t low = a.low + b.low;
    uint64_t high = (uint64_t)a.high + (uint64_t)b.high + (low < a.low);
    iris_wide sum = {(int64_t)high, low};
    return sum;
}

static inline iris_wide iris_wide_negate(iris_wide a)
{
    uint64_t high = ~(uint64_t)a.high + (a.low == 0);
    iris_wide negated = {(int64_t)high, 0u - a.low};
    return negated;
}

static inline iris_wide iris_wide_sub(iris_wide a, iris_wide b)
{
    return iris_wide_add(a, iris_wide_negate(b));
}

/* Bits of the magnitude: 0 for 0, 1 for 1 and -1, 128 at most. */
int iris_wide_bits(iris_wide a);

/* a / 2^bits, rounded and saturated. bits: 0 to 127. */
int64_t iris_wide_round_shift_sat(iris_wide a, int bits);

/* a / b, rounded to nearest (halves away from 0) and saturated. With b = 0: the largest or smallest value by the sign
 * of a, 0 for 0 / 0. At most 64 steps of a shift and a subtraction. */
int64_t iris_wide_div_sat(iris_wide a, int64_t b);

/* The largest integer whose square is not above a; 0 for negative ones. a is below 2^124. iris_sqrt_u64 and one
 * division. */
int64_t iris_wide_sqrt(iris_wide a);

/* Square root, rounded down; 0 for negative numbers. */
static inline iris_q32 iris_q32_sqrt(iris_q32 a)
{
    return iris_wide_sqrt(iris_wide_mul(a, IRIS_Q32_ONE));
}

/* Numbers of the same kind, or an integer and an iris_q32. */
static inline iris_q32 iris_q32_mul_sat(iris_q32 a, iris_q32 b)
{
    return iris_wide_round_shift_sat(iris_wide_mul(a, b), 32);
}

/* a / b for a and b of the same kind. */
static inline iris_q32 iris_q32_div_sat(int64_t a, int64_t b)
{
    return iris_wide_div_sat(iris_wide_mul(a, IRIS_Q32_ONE), b);
}

#ifdef __cplusplus
}
#endif

#endif
