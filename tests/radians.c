/* Sines, cosines, and arc tangents against the C library's in double precision. */
#include "iris/radians.h"

#include <math.h>
#include <stdio.h>

#include "random_number.h"
#include "test.h"

static const double one = 4294967296.0;

static double worst_sine(int64_t limit, int count)
{
    double worst = 0;
    for (int i = 0; i < count; i++) {
        iris_q32 sine, cosine, angle = (iris_q32)(random_u64() >> 1) % limit * (i % 2 ? 1 : -1);
        iris_q32_sin_cos(&sine, &cosine, angle);
        double off_sine = fabs((double)sine - sin((double)angle / one) * one);
        double off_cosine = fabs((double)cosine - cos((double)angle / one) * one);
        worst = fmax(worst, fmax(off_sine, off_cosine));
    }
    return worst;
}

static void sines(void **state)
{
    (void)state;
    double turn = worst_sine(2 * IRIS_PI_Q32, 100000), turns = worst_sine(2000 * IRIS_PI_Q32, 30000);
    /* Angles that a double holds exactly: 52 bits and their sign. */
    double many = worst_sine((int64_t)1 << 52, 30000);
    printf("#: sine and cosine: worst error %.4f units in a turn, %.4f in a thousand, %.4f at a million "
           "radians\n",
           turn, turns, many);
    assert_true(turn <= 0.51 && turns <= 0.51 && many <= 0.6);
}

static void exact_sines(void **state)
{
    (void)state;
    static const struct {
        iris_q32 angle, sine, cosine;
    } known[] = {
        {0, 0, IRIS_Q32_ONE},
        {IRIS_PI_Q32 / 6, 2147483647, 3719550787}, /* a unit below a sixth of pi */
        {IRIS_PI_Q32, 0, -IRIS_Q32_ONE},           /* half a unit from pi */
        {-IRIS_PI_Q32 / 2, -IRIS_Q32_ONE, 0},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        iris_q32 sine, cosine;
        iris_q32_sin_cos(&sine, &cosine, known[i].angle);
        assert_true(llabs(sine - known[i].sine) <= 1);
        assert_true(llabs(cosine - known[i].cosine) <= 1);
    }
    iris_q32 sine, cosine;
    iris_q32_sin_cos(&sine, &cosine, INT64_MIN); /* only has to be a point of the circle */
    assert_true(fabs(hypot((double)sine, (double)cosine) - one) < 2);
    iris_q32_sin_cos(&sine, &cosine, INT64_MAX);
    assert_true(fabs(hypot((double)sine, (double)cosine) - one) < 2);
}

static void arc_tangents(void **state)
{
    (void)state;
    double worst = 0;
    for (int i = 0; i < 50000; i++) {
        int64_t y = (int64_t)random_u64() >> (11 + random_u64() % 50),
                x = (int64_t)random_u64() >> (11 + random_u64() % 50);
        double off = fabs((double)iris_q32_atan2(y, x) - atan2((double)y, (double)x) * one);
        worst = fmax(worst,
                     off > 4 * one ? 2 * 3.14159265358979323846 * one - off : off); /* -pi and pi are one */
    }
    printf("#: arc tangent: worst error %.4f units\n", worst);
    assert_true(worst <= 0.51);
}

static void arc_tangents_at_the_ends(void **state)
{
    (void)state;
    assert_int_equal(iris_q32_atan2(0, 0), 0);
    assert_int_equal(iris_q32_atan2(0, 1), 0);
    assert_int_equal(iris_q32_atan2(0, INT64_MAX), 0);
    assert_int_equal(iris_q32_atan2(1, 0), 6746518852);
    assert_int_equal(iris_q32_atan2(INT64_MIN, 0), -6746518852);
    assert_int_equal(iris_q32_atan2(INT64_MAX, INT64_MAX), 3373259426);
    assert_int_equal(iris_q32_atan2(INT64_MIN, INT64_MIN), -10119778278);
    assert_int_equal(llabs(iris_q32_atan2(0, INT64_MIN)), IRIS_PI_Q32);
    assert_int_equal(llabs(iris_q32_atan2(1, INT64_MIN)), IRIS_PI_Q32); /* less than a unit beside either */
    assert_int_equal(llabs(iris_q32_atan2(-1, INT64_MIN)), IRIS_PI_Q32);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sines),
        cmocka_unit_test(exact_sines),
        cmocka_unit_test(arc_tangents),
        cmocka_unit_test(arc_tangents_at_the_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
