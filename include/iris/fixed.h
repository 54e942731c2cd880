/* IRIS - fixed-point numbers, square roots, and trigonometry, in integers only.
 *
 * The number in a type's name counts its fraction bits. Rounding is half up (towards plus infinity), and
 * iris_round_shift is the only place where it is done (iris_round_shift_s32 for 32 bits). The compiler must shift negative numbers
 * arithmetically and convert to a narrower signed type modulo 2^n, as gcc and clang do; tests/fixed.c checks
 * both.
 *
 * Every function here takes every input. An unsuffixed function whose true result does not fit its type
 * returns the low bits of it (it wraps); the _sat form returns the nearest value that fits. O(1) each.
 */
#ifndef IRIS_FIXED_H
#define IRIS_FIXED_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef int32_t iris_q16;   /* 16 fraction bits: 65536 = 1.0 */
typedef int32_t iris_q30;   /* 30 fraction bits: sines, unit vectors */
typedef int16_t iris_angle; /* 65536 = one turn: -180 degrees up to below 180; wraps */

#define IRIS_Q16_ONE ((iris_q16)65536)
#define IRIS_Q30_ONE ((iris_q30)1073741824)

/* value / 2^bits, rounded half up. bits: 1 to 63. Never overflows. */
static inline int64_t iris_round_shift(int64_t value, int bits)
{
    return (value >> bits) + ((value >> (bits - 1)) & 1);
}

/* The same of 32 bits, for processors that have no more. bits: 1 to 31. */
static inline int32_t iris_round_shift_s32(int32_t value, int bits)
{
    return (value >> bits) + ((value >> (bits - 1)) & 1);
}

/* value limited to INT32_MIN..INT32_MAX. */
static inline int32_t iris_sat_s32(int64_t value)
{
    return value > INT32_MAX ? INT32_MAX : value < INT32_MIN ? INT32_MIN : (int32_t)value;
}

/* Sum and difference, saturated, of numbers of the same kind. */
static inline int32_t iris_add_sat(int32_t a, int32_t b)
{
    return iris_sat_s32((int64_t)a + b);
}

static inline int32_t iris_sub_sat(int32_t a, int32_t b)
{
    return iris_sat_s32((int64_t)a - b);
}

/* a * b, rounded. Wraps when |a b| >= 32768. */
static inline iris_q16 iris_q16_mul(iris_q16 a, iris_q16 b)
{
    return (iris_q16)iris_round_shift((int64_t)a * b, 16);
}

static inline iris_q16 iris_q16_mul_sat(iris_q16 a, iris_q16 b)
{
    return iris_sat_s32(iris_round_shift((int64_t)a * b, 16));
}

/* a * b, rounded, in the kind of a: scales an integer, an iris_q16 or an iris_q30 by a sine. Cannot wrap
 * while |b| <= IRIS_Q30_ONE, but for the lowest a times -1. */
static inline int32_t iris_q30_mul(int32_t a, iris_q30 b)
{
    return (int32_t)iris_round_shift((int64_t)a * b, 30);
}

static inline int32_t iris_q30_mul_sat(int32_t a, iris_q30 b)
{
    return iris_sat_s32(iris_round_shift((int64_t)a * b, 30));
}

/* a / b, rounded, for a and b of the same kind (integers too). Wraps when the quotient is outside -32768 up
 * to below 32768. With b = 0: the largest or smallest value by the sign of a, and 0 for 0 / 0. One 64-bit
 * division. */
iris_q16 iris_q16_div(int32_t a, int32_t b);
iris_q16 iris_q16_div_sat(int32_t a, int32_t b);

/* The same with 30 fraction bits. Wraps when the quotient is outside -2 up to below 2. */
iris_q30 iris_q30_div(int32_t a, int32_t b);
iris_q30 iris_q30_div_sat(int32_t a, int32_t b);

/* Integer to iris_q16. Wraps outside -32768..32767. */
static inline iris_q16 iris_q16_from_int(int32_t n)
{
    return (iris_q16)((uint32_t)n << 16);
}

static inline iris_q16 iris_q16_from_int_sat(int32_t n)
{
    return iris_sat_s32((int64_t)n * 65536);
}

/* iris_q16 to integer, rounded; and the largest integer not above. */
static inline int32_t iris_q16_to_int(iris_q16 a)
{
    return (int32_t)iris_round_shift(a, 16);
}

static inline int32_t iris_q16_floor(iris_q16 a)
{
    return a >> 16;
}

static inline iris_q16 iris_q16_from_q30(iris_q30 a)
{
    return (iris_q16)iris_round_shift(a, 14);
}

/* Wraps outside -2 up to below 2. */
static inline iris_q30 iris_q30_from_q16(iris_q16 a)
{
    return (iris_q30)((uint32_t)a << 14);
}

static inline iris_q30 iris_q30_from_q16_sat(iris_q16 a)
{
    return iris_sat_s32((int64_t)a * 16384);
}

/* The largest integer whose square is not above value. Shifts and subtractions only: 16 and 32 steps. */
uint32_t iris_sqrt_u32(uint32_t value);
uint32_t iris_sqrt_u64(uint64_t value);

/* sqrt(x^2 + y^2), rounded down. */
uint32_t iris_hypot(int32_t x, int32_t y);

/* Sine and cosine. The largest error over all 65536 angles is 5.3e-9 (5.7 units); the value is within -1..1,
 * exact at every quarter turn, and exactly odd and even. A polynomial of degree 9: six multiplications, 20
 * bytes of constants. */
iris_q30 iris_sin_q30(iris_angle angle);
iris_q30 iris_cos_q30(iris_angle angle);

/* The angle of the vector (x, y): 0 along +x, a quarter turn (16384) along +y. 0 for (0, 0). The largest
 * error is 0.55 of a unit (0.003 degrees), so it is within one unit; exact on the axes and diagonals.
 * atan2(-y, x) = -atan2(y, x). CORDIC, 18 steps of shifts and additions, after J. E. Volder 1959. */
iris_angle iris_atan2_angle(int32_t y, int32_t x);

/* Any sum or difference of angles, brought back to -180 degrees up to below 180. */
static inline iris_angle iris_angle_wrap(int32_t angle)
{
    return (iris_angle)(uint16_t)((uint32_t)angle & 0xFFFFu);
}

/* Degrees and hundredths of a degree, rounded: -180..180 and -18000..17999. */
static inline int32_t iris_angle_to_degrees(iris_angle angle)
{
    return (int32_t)iris_round_shift((int32_t)angle * 45, 13);
}

static inline int32_t iris_angle_to_centidegrees(iris_angle angle)
{
    return iris_round_shift_s32((int32_t)angle * 1125, 11);
}

/* The nearest angle; any number of turns. An angle unit is 0.0055 degrees: hundredths to angle and back is
 * identity. */
iris_angle iris_angle_from_degrees(int32_t degrees);
iris_angle iris_angle_from_centidegrees(int32_t centidegrees);

#ifdef __cplusplus
}
#endif

#endif
