#include "iris/radians.h"

#include "iris/fixed.h"

#define TURNS_Q62     ((int64_t)733972625820500307)  /* 1 / (2 pi) */
#define QUARTER_Q61   ((int64_t)3622009729038561421) /* pi / 2 */
#define TURN_Q60      ((int64_t)7244019458077122842) /* 2 pi */
#define ONE_Q61       ((int64_t)1 << 61)
#define HALF_TURN_Q60 (TURN_Q60 / 2)

static int64_t mul_q61(int64_t a, int64_t b)
{
    return iris_wide_round_shift_sat(iris_wide_mul(a, b), 61);
}

/* The series 1 - square / (n (n + 1)) (1 - square / ((n + 2) (n + 3)) (1 - ...)), seven factors of it. */
static int64_t series(int64_t square, int n)
{
    int64_t sum = ONE_Q61;
    for (int k = n + 12; k >= n; k -= 2) {
        sum = ONE_Q61 - mul_q61(square, sum) / (k * (k + 1));
    }
    return sum;
}

/* Sine and cosine with 61 fraction bits; the angle in parts of a turn, 2^64 of them. */
static void sin_cos_q61(int64_t *sine, int64_t *cosine, uint64_t turn)
{
    uint64_t quarter = turn >> 62, part = turn << 2 >> 2; /* part: of a quarter turn, 2^62 of them */
    int beyond_half = part >> 61 != 0;
    int64_t folded = (int64_t)(beyond_half ? ((uint64_t)1 << 62) - part : part);
    int64_t angle = iris_wide_round_shift_sat(iris_wide_mul(folded, QUARTER_Q61), 62);
    int64_t square = mul_q61(angle, angle);
    int64_t s = mul_q61(angle, series(square, 2)), c = series(square, 1);
    if (beyond_half != (int)(quarter & 1)) {
        int64_t swap = s;
        s = c;
        c = swap;
    }
    *sine = quarter >= 2 ? -s : s;
    *cosine = quarter == 1 || quarter == 2 ? -c : c;
}

void iris_q32_sin_cos(iris_q32 *sine, iris_q32 *cosine, iris_q32 radians)
{
    iris_wide turns = iris_wide_mul(radians, TURNS_Q62); /* 94 fraction bits */
    int64_t s, c;
    sin_cos_q61(&s, &c, (uint64_t)turns.high << 34 | turns.low >> 30);
    *sine = iris_round_shift(s, 29);
    *cosine = iris_round_shift(c, 29);
}

/* value / 2^bits for positive bits, else value * 2^-bits, which fits. */
static int64_t shifted(int64_t value, int bits)
{
    return bits > 0 ? value >> bits : value * ((int64_t)1 << -bits);
}

iris_q32 iris_q32_atan2(int64_t y, int64_t x)
{
    int x_bits = iris_wide_bits(iris_wide_from(x)), y_bits = iris_wide_bits(iris_wide_from(y));
    int bits = x_bits > y_bits ? x_bits : y_bits;
    int64_t s, c;
    if (bits == 0) {
        return 0;
    }
    x = shifted(x, bits - 61);
    y = shifted(y, bits - 61);
    iris_angle near = iris_atan2_angle((int32_t)(y >> 31), (int32_t)(x >> 31));
    sin_cos_q61(&s, &c, (uint64_t)near << 48);
    int64_t along = iris_wide_round_shift_sat(iris_wide_add(iris_wide_mul(x, c), iris_wide_mul(y, s)), 61);
    int64_t across = iris_wide_round_shift_sat(iris_wide_sub(iris_wide_mul(y, c), iris_wide_mul(x, s)), 61);
    int64_t tangent = iris_wide_div_sat(iris_wide_mul(across, ONE_Q61), along); /* below 2^-12 */
    int64_t rest = tangent - mul_q61(mul_q61(tangent, tangent), tangent) / 3;
    int64_t angle = iris_wide_round_shift_sat(iris_wide_mul(near, TURN_Q60), 16) + rest / 2;
    angle += angle < -HALF_TURN_Q60 ? TURN_Q60 : 0;
    angle -= angle >= HALF_TURN_Q60 ? TURN_Q60 : 0;
    return iris_round_shift(angle, 28);
}
