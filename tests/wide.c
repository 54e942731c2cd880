/* Wide numbers against the compiler's own 128 bits: tests may use them, the library does not. */
#include "iris/wide.h"

#include "test.h"

__extension__ typedef __int128 exact;
__extension__ typedef unsigned __int128 exact_bits;

static uint64_t random_u64(void)
{
    static uint64_t x = 88172645463325252u;
    x ^= x << 13;
    x ^= x >> 7;
    return x ^= x << 17;
}

/* Every length of number, and the extremes. */
static int64_t any(int i)
{
    static const int64_t extremes[] = {
        0,         1,         -1,           2,          -2,          INT64_MAX,
        INT64_MIN, INT32_MAX, INT32_MIN,    65536,      -65536,      INT64_MAX - 1,
        3,         -3,        IRIS_Q32_ONE, UINT32_MAX, -UINT32_MAX, INT64_MIN + 1};
    const int n = (int)(sizeof extremes / sizeof extremes[0]);
    uint64_t value = random_u64();
    return i % 3 == 0 ? extremes[value % (uint64_t)n] : (int64_t)value >> (value % 64);
}

static exact value_of(iris_wide a)
{
    return (exact)((exact_bits)(uint64_t)a.high << 64 | a.low);
}

static iris_wide wide_of(exact a)
{
    return (iris_wide){(int64_t)(a >> 64), (uint64_t)a};
}

static int64_t sat(exact a)
{
    return a > INT64_MAX ? INT64_MAX : a < INT64_MIN ? INT64_MIN : (int64_t)a;
}

static void products_and_sums_are_exact(void **state)
{
    (void)state;
    for (int i = 0; i < 300000; i++) {
        int64_t a = any(i), b = any(i + 1), c = any(i / 3);
        exact product = (exact)a * b;
        assert_true(value_of(iris_wide_mul(a, b)) == product);
        assert_true(value_of(iris_wide_from(a)) == a);
        assert_true(value_of(iris_wide_negate(iris_wide_from(c))) == -(exact)c);
        assert_true(value_of(iris_wide_add(wide_of(product), iris_wide_from(c))) ==
                    (exact)((exact_bits)product + (exact_bits)(exact)c));
        assert_true(value_of(iris_wide_sub(wide_of(product), iris_wide_from(c))) ==
                    (exact)((exact_bits)product - (exact_bits)(exact)c));
    }
}

static void shifts_round_half_up_and_saturate(void **state)
{
    (void)state;
    for (int i = 0; i < 300000; i++) {
        exact a = (exact)any(i) * any(i + 1) + any(i + 2);
        int bits = (int)(random_u64() % 128);
        exact expected = bits == 0 ? a : (a >> bits) + (a >> (bits - 1) & 1);
        assert_true(iris_wide_round_shift_sat(wide_of(a), bits) == sat(expected));
        int length = 0;
        for (exact_bits m = a < 0 ? 0 - (exact_bits)a : (exact_bits)a; m; m >>= 1) {
            length++;
        }
        assert_int_equal(iris_wide_bits(wide_of(a)), length);
    }
    assert_int_equal(iris_wide_bits((iris_wide){INT64_MIN, 0}), 128);
}

static void quotients_are_the_nearest(void **state)
{
    (void)state;
    for (int i = 0; i < 300000; i++) {
        exact a = (exact)any(i) * any(i + 1) + any(i + 2);
        int64_t b = any(i / 2);
        exact expected;
        if (b == 0) {
            expected = a > 0 ? INT64_MAX : a < 0 ? INT64_MIN : 0;
        } else {
            exact m = a < 0 ? -a : a, by = b < 0 ? -(exact)b : b;
            exact nearest = m / by + (m % by >= by - m % by);
            expected = (a < 0) != (b < 0) ? -nearest : nearest;
        }
        assert_true(iris_wide_div_sat(wide_of(a), b) == sat(expected));
    }
    assert_true(iris_wide_div_sat((iris_wide){INT64_MIN, 0}, 1) == INT64_MIN);
    assert_true(iris_wide_div_sat((iris_wide){INT64_MIN, 0}, -1) == INT64_MAX);
    assert_true(iris_q32_div_sat(1, 3) == 1431655765);
    assert_true(iris_q32_mul_sat(IRIS_Q32_ONE / 2, -3) == -1); /* half up */
    assert_true(iris_q32_mul_sat(INT64_MIN, INT64_MIN) == INT64_MAX);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(products_and_sums_are_exact),
        cmocka_unit_test(shifts_round_half_up_and_saturate),
        cmocka_unit_test(quotients_are_the_nearest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
