#include "iris/fixed.h"

#include "octant.h"

/* a / b with `bits` fraction bits, rounded half up. bits: 0 to 30. */
static int64_t quotient(int32_t a, int32_t b, int bits)
{
    if (b == 0) {
        return a > 0 ? INT32_MAX : a < 0 ? INT32_MIN : 0;
    }
    int64_t scaled = (int64_t)a * ((int64_t)2 << bits);
    int64_t twice = scaled / b;
    int64_t rest = scaled - twice * b;
    if (rest != 0 && (rest < 0) != (b < 0)) {
        twice--;
    }
    return iris_round_shift(twice, 1);
}

iris_q16 iris_q16_div(int32_t a, int32_t b)
{
    return (iris_q16)quotient(a, b, 16);
}

iris_q16 iris_q16_div_sat(int32_t a, int32_t b)
{
    return iris_sat_s32(quotient(a, b, 16));
}

iris_q30 iris_q30_div(int32_t a, int32_t b)
{
    return (iris_q30)quotient(a, b, 30);
}

iris_q30 iris_q30_div_sat(int32_t a, int32_t b)
{
    return iris_sat_s32(quotient(a, b, 30));
}

uint32_t iris_sqrt_u32(uint32_t value)
{
    uint32_t root = 0;
    for (uint32_t bit = (uint32_t)1 << 30; bit != 0; bit >>= 2) {
        uint32_t trial = root + bit;
        root >>= 1;
        if (value >= trial) {
            value -= trial;
            root += bit;
        }
    }
    return root;
}

uint32_t iris_sqrt_u64(uint64_t value)
{
    uint64_t root = 0;
    for (uint64_t bit = (uint64_t)1 << 62; bit != 0; bit >>= 2) {
        uint64_t trial = root + bit;
        root >>= 1;
        if (value >= trial) {
            value -= trial;
            root += bit;
        }
    }
    return (uint32_t)root;
}

uint32_t iris_hypot(int32_t x, int32_t y)
{
    return iris_sqrt_u64((uint64_t)((int64_t)x * x) + (uint64_t)((int64_t)y * y));
}

/* sin(pi / 2 * t) for t in 0..1: the odd polynomial of degree 9 with the smallest largest error (3.7e-9)
 * among those that are 1 at t = 1, highest power first. */
static iris_q30 sine_of_quarter(iris_q30 t)
{
    static const iris_q30 coefficient[] = {161734, -5016346, 85564576, -693597809, 1686629669};
    iris_q30 square = iris_q30_mul(t, t);
    iris_q30 sum = coefficient[0];
    for (int i = 1; i < 5; i++) {
        sum = coefficient[i] + iris_q30_mul(sum, square);
    }
    return iris_q30_mul(sum, t);
}

static iris_q30 sine(uint32_t angle)
{
    uint32_t phase = angle & 0x3FFFu;
    if (angle & 0x4000u) {
        phase = 0x4000u - phase;
    }
    iris_q30 value = sine_of_quarter((iris_q30)(phase << 16));
    return angle & 0x8000u ? -value : value;
}

iris_q30 iris_sin_q30(iris_angle angle)
{
    return sine((uint16_t)angle);
}

iris_q30 iris_cos_q30(iris_angle angle)
{
    return sine((uint16_t)angle + 0x4000u);
}

static uint32_t magnitude(int32_t value)
{
    return value < 0 ? 0u - (uint32_t)value : (uint32_t)value;
}

/* atan(y / x) for x >= y >= 0, x > 0: 0 to 8192. */
static int32_t angle_of_octant(uint32_t y, uint32_t x)
{
    while (x >= (uint32_t)1 << 29) {
        x >>= 1;
        y >>= 1;
    }
    while (x < (uint32_t)1 << 28) {
        x <<= 1;
        y <<= 1;
    }
    octant_vector v = {(int32_t)x, (int32_t)y, 0};
    for (int i = 0; i < OCTANT_STEPS; i++) {
        v = octant_turned(v, i);
    }
    return iris_round_shift_s32(v.angle, 16);
}

iris_angle iris_atan2_angle(int32_t y, int32_t x)
{
    uint32_t up = magnitude(y), right = magnitude(x);
    if (up == 0 && right == 0) {
        return 0;
    }
    int32_t angle = up > right ? 16384 - angle_of_octant(right, up) : angle_of_octant(up, right);
    if (x < 0) {
        angle = 32768 - angle;
    }
    return iris_angle_wrap(y < 0 ? -angle : angle);
}

iris_angle iris_angle_from_centidegrees(int32_t centidegrees)
{
    int32_t rest = centidegrees % 36000;
    if (rest < 0) {
        rest += 36000;
    }
    return iris_angle_wrap((int32_t)iris_round_shift((uint32_t)rest * 4096u / 1125u, 1));
}

iris_angle iris_angle_from_degrees(int32_t degrees)
{
    return iris_angle_from_centidegrees(degrees % 360 * 100);
}
