/* Fixed-point arithmetic and trigonometry, held against double precision over the whole range. */
#include "iris/fixed.h"

#include <math.h>

#include "random_number.h"
#include "test.h"

static const double TURN = 6.283185307179586476925;

static const int32_t extremes[] = {0,
                                   1,
                                   -1,
                                   2,
                                   -2,
                                   3,
                                   -3,
                                   32767,
                                   -32768,
                                   65535,
                                   -65535,
                                   65536,
                                   -65536,
                                   65537,
                                   98304,
                                   -98304,
                                   46340,
                                   46341,
                                   7919,
                                   -7919,
                                   1 << 30,
                                   -(1 << 30),
                                   INT32_MAX,
                                   INT32_MIN,
                                   INT32_MAX - 1,
                                   INT32_MIN + 1};
#define EXTREMES ((int)(sizeof extremes / sizeof extremes[0]))

static uint32_t random_u32(void)
{
    return (uint32_t)(random_u64() >> 16);
}

/* An operand for the n-th trial: extremes first, then random numbers of every magnitude. */
static int32_t operand(int n)
{
    return n < EXTREMES ? extremes[n] : (int32_t)random_u32() >> (random_u32() % 32);
}

/* n / d rounded half up, by quotient and remainder (no shifts). d > 0. */
static int64_t rounded(int64_t n, int64_t d)
{
    int64_t q = n / d, rest = n % d;
    if (rest < 0) {
        rest += d;
        q--;
    }
    return rest >= d - rest ? q + 1 : q;
}

/* The low 32 bits as two's complement. */
static int32_t low_bits(int64_t value)
{
    uint32_t low = (uint32_t)((uint64_t)value & UINT32_MAX);
    return low > INT32_MAX ? -(int32_t)(UINT32_MAX - low) - 1 : (int32_t)low;
}

static int32_t limited(int64_t value)
{
    return value > INT32_MAX ? INT32_MAX : value < INT32_MIN ? INT32_MIN : (int32_t)value;
}

/* What the library requires of the compiler. */
static void compiler_shifts_and_narrows_as_required(void **state)
{
    (void)state;
    volatile int32_t five = -5, low = INT32_MIN, big = 40000;
    volatile int64_t wide = -5, far = 0x1FFFFFFFF;
    assert_int_equal(five >> 1, -3);
    assert_int_equal(low >> 31, -1);
    assert_true(wide >> 1 == -3);
    assert_true((INT64_MIN - wide) >> 62 == -2);
    assert_int_equal((int16_t)big, 40000 - 65536);
    assert_int_equal((int32_t)far, -1);
}

static void rounding_is_half_up(void **state)
{
    (void)state;
    const int64_t by_hand[][3] = {{5, 1, 3},          {-5, 1, -2},         {-6, 2, -1},
                                  {-7, 2, -2},        {6, 2, 2},           {5, 2, 1},
                                  {-1, 1, 0},         {-3, 2, -1},         {0, 30, 0},
                                  {INT64_MAX, 63, 1}, {INT64_MIN, 63, -1}, {INT64_MAX, 1, (int64_t)1 << 62}};
    for (size_t i = 0; i < sizeof by_hand / sizeof by_hand[0]; i++) {
        assert_true(iris_round_shift(by_hand[i][0], (int)by_hand[i][1]) == by_hand[i][2]);
    }
    for (int value = -70000; value <= 70000; value++) {
        assert_true(iris_round_shift(value, 7) == (int64_t)floor(value / 128.0 + 0.5));
        assert_int_equal(iris_round_shift_s32(value, 7), iris_round_shift(value, 7));
    }
    for (int bits = 1; bits < 32; bits++) {
        assert_int_equal(iris_round_shift_s32(INT32_MAX, bits), iris_round_shift(INT32_MAX, bits));
        assert_int_equal(iris_round_shift_s32(INT32_MIN, bits), iris_round_shift(INT32_MIN, bits));
    }
}

static void products_agree_with_exact_arithmetic(void **state)
{
    (void)state;
    for (int i = 0; i < EXTREMES * EXTREMES + 200000; i++) {
        int32_t a = i < EXTREMES * EXTREMES ? extremes[i / EXTREMES] : operand(EXTREMES);
        int32_t b = i < EXTREMES * EXTREMES ? extremes[i % EXTREMES] : operand(EXTREMES);
        int64_t q16 = rounded((int64_t)a * b, 65536);
        int64_t q30 = rounded((int64_t)a * b, 1073741824);
        assert_int_equal(iris_q16_mul(a, b), low_bits(q16));
        assert_int_equal(iris_q16_mul_sat(a, b), limited(q16));
        assert_int_equal(iris_q30_mul(a, b), low_bits(q30));
        assert_int_equal(iris_q30_mul_sat(a, b), limited(q30));
        assert_int_equal(iris_add_sat(a, b), limited((int64_t)a + b));
        assert_int_equal(iris_sub_sat(a, b), limited((int64_t)a - b));
    }
}

static void quotients_agree_with_exact_arithmetic(void **state)
{
    (void)state;
    for (int i = 0; i < EXTREMES * EXTREMES + 200000; i++) {
        int32_t a = i < EXTREMES * EXTREMES ? extremes[i / EXTREMES] : operand(EXTREMES);
        int32_t b = i < EXTREMES * EXTREMES ? extremes[i % EXTREMES] : operand(EXTREMES);
        if (b == 0) {
            int32_t limit = a > 0 ? INT32_MAX : a < 0 ? INT32_MIN : 0;
            assert_int_equal(iris_q16_div(a, b), limit);
            assert_int_equal(iris_q30_div_sat(a, b), limit);
            continue;
        }
        int64_t q16 = rounded((b < 0 ? -(int64_t)a : a) * 65536, b < 0 ? -(int64_t)b : b);
        int64_t q30 = rounded((b < 0 ? -(int64_t)a : a) * 1073741824, b < 0 ? -(int64_t)b : b);
        assert_int_equal(iris_q16_div(a, b), low_bits(q16));
        assert_int_equal(iris_q16_div_sat(a, b), limited(q16));
        assert_int_equal(iris_q30_div(a, b), low_bits(q30));
        assert_int_equal(iris_q30_div_sat(a, b), limited(q30));
    }
    assert_int_equal(iris_q16_div(1, 3), 21845);
    assert_int_equal(iris_q16_div(-1, 2 * 65536), 0); /* -0.5 goes up */
    assert_int_equal(iris_q16_div(1, -2 * 65536), 0);
    assert_int_equal(iris_q16_div(-1, -2 * 65536), 1);
}

static void kinds_convert(void **state)
{
    (void)state;
    for (int i = 0; i < EXTREMES + 100000; i++) {
        int32_t a = operand(i);
        assert_int_equal(iris_q16_from_int(a), low_bits(a * 65536LL));
        assert_int_equal(iris_q16_from_int_sat(a), limited(a * 65536LL));
        assert_int_equal(iris_q16_to_int(a), (int32_t)floor(a / 65536.0 + 0.5));
        assert_int_equal(iris_q16_floor(a), (int32_t)floor(a / 65536.0));
        assert_int_equal(iris_q16_from_q30(a), (int32_t)floor(a / 16384.0 + 0.5));
        assert_int_equal(iris_q30_from_q16(a), low_bits(a * 16384LL));
        assert_int_equal(iris_q30_from_q16_sat(a), limited(a * 16384LL));
    }
}

static void square_roots_are_exact(void **state)
{
    (void)state;
    assert_int_equal(iris_sqrt_u32(0), 0);
    assert_int_equal(iris_sqrt_u64(0), 0);
    for (uint32_t root = 1; root <= 65535; root++) {
        uint32_t square = root * root;
        assert_int_equal(iris_sqrt_u32(square - 1), root - 1);
        assert_int_equal(iris_sqrt_u32(square), root);
        assert_int_equal(iris_sqrt_u32(square + 1), root);
        assert_int_equal(iris_sqrt_u64(square - 1), root - 1);
        assert_int_equal(iris_sqrt_u64(square), root);
    }
    assert_int_equal(iris_sqrt_u32(UINT32_MAX), 65535);
    for (int i = 0; i < 200000; i++) {
        uint64_t root = i < 32 ? UINT32_MAX - (uint64_t)i : (uint64_t)random_u32() >> (random_u32() % 31);
        root += root == 0;
        assert_true(iris_sqrt_u64(root * root - 1) == root - 1);
        assert_true(iris_sqrt_u64(root * root) == root);
        assert_true(iris_sqrt_u64(root * root + 1) == root);
    }
    assert_true(iris_sqrt_u64(UINT64_MAX) == UINT32_MAX);
    assert_int_equal(iris_hypot(3, -4), 5);
    assert_int_equal(iris_hypot(0, 0), 0);
    assert_true(iris_hypot(INT32_MIN, 0) == 2147483648u);
    assert_true(iris_hypot(INT32_MIN, INT32_MIN) == 3037000499u); /* 2^31.5 = 3037000499.97 */
    assert_true(iris_hypot(1, 1) == 1);
}

static void sine_and_cosine_of_every_angle(void **state)
{
    (void)state;
    double worst = 0;
    for (int32_t a = -32768; a <= 32767; a++) {
        iris_q30 sine = iris_sin_q30((iris_angle)a), cosine = iris_cos_q30((iris_angle)a);
        worst = fmax(worst, fabs(sine / 1073741824.0 - sin(a * TURN / 65536)));
        worst = fmax(worst, fabs(cosine / 1073741824.0 - cos(a * TURN / 65536)));
        assert_true(sine >= -IRIS_Q30_ONE && sine <= IRIS_Q30_ONE);
        if (a > -32768) {
            assert_int_equal(iris_sin_q30((iris_angle)-a), -sine);
            assert_int_equal(iris_cos_q30((iris_angle)-a), cosine);
        }
    }
    print_message("# sine, cosine: largest error %.3g\n", worst);
    assert_true(worst <= 5.3e-9);
    assert_int_equal(iris_sin_q30(0), 0);
    assert_int_equal(iris_sin_q30(16384), IRIS_Q30_ONE);
    assert_int_equal(iris_sin_q30(-32768), 0);
    assert_int_equal(iris_sin_q30(-16384), -IRIS_Q30_ONE);
    assert_int_equal(iris_cos_q30(0), IRIS_Q30_ONE);
    assert_int_equal(iris_cos_q30(-32768), -IRIS_Q30_ONE);
}

/* Difference of an angle from the truth, in units, across the wrap. */
static double arc_error(int32_t y, int32_t x)
{
    double error = iris_atan2_angle(y, x) - atan2(y, x) / TURN * 65536;
    return fabs(error - 65536 * floor(error / 65536 + 0.5));
}

static void arc_tangent_of_the_whole_plane(void **state)
{
    (void)state;
    double worst = 0;
    for (int y = -300; y <= 300; y++) { /* every short vector */
        for (int x = -300; x <= 300; x++) {
            worst = x || y ? fmax(worst, arc_error(y, x)) : worst;
        }
    }
    for (int i = 0; i < 400000; i++) { /* every direction in fine steps, at every length */
        double length = ldexp(1.0 + i % 97 / 97.0, 1 + i % 30), turn = i * TURN / 400000;
        worst = fmax(worst, arc_error((int32_t)(length * sin(turn)), (int32_t)(length * cos(turn))));
    }
    for (int i = 0; i < EXTREMES; i++) {
        for (int k = 0; k < EXTREMES; k++) {
            worst = extremes[i] || extremes[k] ? fmax(worst, arc_error(extremes[i], extremes[k])) : worst;
        }
    }
    for (int i = 0; i < 300000; i++) {
        int32_t y = operand(EXTREMES), x = operand(EXTREMES);
        worst = x || y ? fmax(worst, arc_error(y, x)) : worst;
    }
    print_message("# arc tangent: largest error %.3f units\n", worst);
    assert_true(worst <= 0.55);
}

static void arc_tangent_is_exact_on_axes_and_diagonals(void **state)
{
    (void)state;
    assert_int_equal(iris_atan2_angle(0, 0), 0);
    for (int i = 0; i < EXTREMES; i++) {
        int32_t a = extremes[i];
        if (a > 0) {
            assert_int_equal(iris_atan2_angle(0, a), 0);
            assert_int_equal(iris_atan2_angle(a, 0), 16384);
            assert_int_equal(iris_atan2_angle(0, -a), -32768);
            assert_int_equal(iris_atan2_angle(-a, 0), -16384);
            assert_int_equal(iris_atan2_angle(a, a), 8192);
            assert_int_equal(iris_atan2_angle(a, -a), 24576);
            assert_int_equal(iris_atan2_angle(-a, -a), -24576);
        }
    }
    assert_int_equal(iris_atan2_angle(INT32_MIN, INT32_MIN), -24576);
    assert_int_equal(iris_atan2_angle(0, INT32_MIN), -32768);
    assert_int_equal(iris_atan2_angle(INT32_MIN, 0), -16384);
    assert_int_equal(iris_atan2_angle(-1, INT32_MIN), -32768);
    assert_int_equal(iris_atan2_angle(1, INT32_MIN), -32768);
}

static void degrees_convert(void **state)
{
    (void)state;
    for (int32_t a = -32768; a <= 32767; a++) {
        assert_int_equal(iris_angle_to_degrees((iris_angle)a), (int32_t)floor(a * 360.0 / 65536 + 0.5));
        assert_int_equal(iris_angle_to_centidegrees((iris_angle)a),
                         (int32_t)floor(a * 36000.0 / 65536 + 0.5));
    }
    for (int32_t c = -72000; c <= 72000; c++) {
        double units = floor(c * 65536.0 / 36000 + 0.5);
        iris_angle angle = iris_angle_from_centidegrees(c);
        assert_int_equal(angle, (int32_t)(units - 65536 * floor((units + 32768) / 65536)));
        if (c >= -18000 && c < 18000) {
            assert_int_equal(iris_angle_to_centidegrees(angle), c);
        }
        if (c % 100 == 0) {
            assert_int_equal(iris_angle_from_degrees(c / 100), angle);
        }
    }
    for (int i = 0; i < EXTREMES; i++) {
        int32_t c = extremes[i];
        assert_int_equal(iris_angle_from_centidegrees(c), iris_angle_from_centidegrees(c % 36000));
        assert_int_equal(iris_angle_from_degrees(c), iris_angle_from_degrees(c % 360));
    }
    assert_int_equal(iris_angle_from_degrees(180), -32768);
    assert_int_equal(iris_angle_from_degrees(-90), -16384);
    assert_int_equal(iris_angle_wrap(32768), -32768);
    assert_int_equal(iris_angle_wrap(-32769), 32767);
    assert_int_equal(iris_angle_wrap(INT32_MIN), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(compiler_shifts_and_narrows_as_required),
        cmocka_unit_test(rounding_is_half_up),
        cmocka_unit_test(products_agree_with_exact_arithmetic),
        cmocka_unit_test(quotients_agree_with_exact_arithmetic),
        cmocka_unit_test(kinds_convert),
        cmocka_unit_test(square_roots_are_exact),
        cmocka_unit_test(sine_and_cosine_of_every_angle),
        cmocka_unit_test(arc_tangent_of_the_whole_plane),
        cmocka_unit_test(arc_tangent_is_exact_on_axes_and_diagonals),
        cmocka_unit_test(degrees_convert),
    };
    return cmocka_run_group_tests_name("fixed", tests, NULL, NULL);
}
