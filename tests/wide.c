/* Wide numbers against longer ones, reckoned by hand in limbs of 32 bits: not every compiler has 128 bits. Where it has
 * them, they say whether the hand errs. */
#include "iris/wide.h"

#include "random_number.h"
#include "test.h"

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

/* 192 bits, two's complement, the least significant first: no sum or double of products of 64 bits overflows. */
enum { LIMBS = 6 };
typedef struct {
    uint32_t limb[LIMBS];
} exact;

static exact from_words(uint64_t low, uint64_t middle, uint64_t high)
{
    return (exact){{(uint32_t)low, (uint32_t)(low >> 32), (uint32_t)middle, (uint32_t)(middle >> 32),
                    (uint32_t)high, (uint32_t)(high >> 32)}};
}

static exact of(int64_t a)
{
    uint64_t sign = a < 0 ? UINT64_MAX : 0;
    return from_words((uint64_t)a, sign, sign);
}

static uint64_t word(exact a, int k)
{
    return (uint64_t)a.limb[2 * k + 1] << 32 | a.limb[2 * k];
}

/* The low 128 bits. */
static iris_wide wide_of(exact a)
{
    return (iris_wide){(int64_t)word(a, 1), word(a, 0)};
}

static int is_negative(exact a)
{
    return a.limb[LIMBS - 1] >> 31 != 0;
}

static exact plus(exact a, exact b)
{
    uint64_t carry = 0;
    for (int i = 0; i < LIMBS; i++) {
        carry += (uint64_t)a.limb[i] + b.limb[i];
        a.limb[i] = (uint32_t)carry;
        carry >>= 32;
    }
    return a;
}

static exact negative(exact a)
{
    for (int i = 0; i < LIMBS; i++) {
        a.limb[i] = ~a.limb[i];
    }
    return plus(a, of(1));
}

static exact minus(exact a, exact b)
{
    return plus(a, negative(b));
}

static exact times(exact a, exact b)
{
    exact product = {{0}};
    for (int i = 0; i < LIMBS; i++) {
        uint64_t carry = 0;
        for (int k = 0; i + k < LIMBS; k++) {
            carry += (uint64_t)a.limb[i] * b.limb[k] + product.limb[i + k];
            product.limb[i + k] = (uint32_t)carry;
            carry >>= 32;
        }
    }
    return product;
}

/* a / 2^bits, rounded down. */
static exact shifted(exact a, int bits)
{
    uint32_t sign = is_negative(a) ? UINT32_MAX : 0;
    exact result;
    for (int i = 0; i < LIMBS; i++) {
        int from = i + bits / 32;
        uint64_t low = from < LIMBS ? a.limb[from] : sign, high = from + 1 < LIMBS ? a.limb[from + 1] : sign;
        result.limb[i] = (uint32_t)((high << 32 | low) >> bits % 32);
    }
    return result;
}

static int at_most(exact a, exact b)
{
    return !is_negative(minus(b, a));
}

static int same(exact a, exact b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

static int64_t sat(exact a)
{
    return !at_most(a, of(INT64_MAX))   ? INT64_MAX
           : !at_most(of(INT64_MIN), a) ? INT64_MIN
                                        : (int64_t)word(a, 0);
}

#ifdef __SIZEOF_INT128__
__extension__ typedef __int128 compilers;
__extension__ typedef unsigned __int128 compilers_bits;

static int is(exact a, compilers b)
{
    return word(a, 0) == (uint64_t)b && word(a, 1) == (uint64_t)(b >> 64) && is_negative(a) == (b < 0);
}

static void the_hand_reckons_as_the_compiler(void **state)
{
    (void)state;
    for (int i = 0; i < 30000; i++) {
        int64_t a = any(i), b = any(i + 1), c = any(i + 2);
        exact product = times(of(a), of(b));
        compilers truth = (compilers)a * b;
        int bits = (int)(random_u64() % 128);
        assert_true(is(product, truth));
        assert_true(is(plus(product, of(c)), truth + c));
        assert_true(is(minus(product, of(c)), truth - c));
        assert_true(is(shifted(product, bits), truth >> bits));
        assert_int_equal(at_most(product, of(c)), truth <= c);
        assert_true(sat(product) == (truth > INT64_MAX   ? INT64_MAX
                                     : truth < INT64_MIN ? INT64_MIN
                                                         : (int64_t)truth));
    }
}
#endif

static int is_wide(iris_wide a, exact b)
{
    iris_wide low = wide_of(b);
    return a.high == low.high && a.low == low.low;
}

static void products_and_sums_are_exact(void **state)
{
    (void)state;
    for (int i = 0; i < 300000; i++) {
        int64_t a = any(i), b = any(i + 1), c = any(i / 3);
        exact product = times(of(a), of(b));
        assert_true(is_wide(iris_wide_mul(a, b), product));
        assert_true(is_wide(iris_wide_from(a), of(a)));
        assert_true(is_wide(iris_wide_negate(iris_wide_from(c)), negative(of(c))));
        assert_true(is_wide(iris_wide_add(wide_of(product), iris_wide_from(c)), plus(product, of(c))));
        assert_true(is_wide(iris_wide_sub(wide_of(product), iris_wide_from(c)), minus(product, of(c))));
    }
}

static exact any_long(int i)
{
    return plus(times(of(any(i)), of(any(i + 1))), of(any(i + 2)));
}

static int length_of(exact a)
{
    exact m = is_negative(a) ? negative(a) : a;
    int length = 32 * LIMBS;
    while (length > 0 && !(m.limb[(length - 1) / 32] >> (length - 1) % 32 & 1)) {
        length--;
    }
    return length;
}

static void shifts_round_half_up_and_saturate(void **state)
{
    (void)state;
    for (int i = 0; i < 300000; i++) {
        exact a = any_long(i);
        int bits = (int)(random_u64() % 128);
        exact expected = bits == 0 ? a : shifted(plus(shifted(a, bits - 1), of(1)), 1);
        assert_true(iris_wide_round_shift_sat(wide_of(a), bits) == sat(expected));
        assert_int_equal(iris_wide_bits(wide_of(a)), length_of(a));
    }
    assert_int_equal(iris_wide_bits((iris_wide){INT64_MIN, 0}), 128);
}

/* Is q the whole number nearest to a / b, halves away from 0, or the end of its range that is nearest? */
static int is_nearest(int64_t q, exact a, int64_t b)
{
    exact by = of(b);
    if (b < 0) {
        a = negative(a);
        by = negative(by);
    }
    exact rest = minus(a, times(of(q), by)), twice = plus(rest, rest);
    int not_above = same(twice, negative(by)) ? !is_negative(a) : at_most(negative(by), twice);
    int not_below = same(twice, by) ? is_negative(a) : at_most(twice, by);
    return (not_above || q == INT64_MIN) && (not_below || q == INT64_MAX);
}

static void quotients_are_the_nearest(void **state)
{
    (void)state;
    for (int i = 0; i < 300000; i++) {
        exact a = any_long(i);
        int64_t b = any(i / 2), q = iris_wide_div_sat(wide_of(a), b);
        if (b == 0) {
            assert_true(q == (same(a, of(0)) ? 0 : is_negative(a) ? INT64_MIN : INT64_MAX));
        } else {
            assert_true(is_nearest(q, a, b));
        }
    }
    for (int64_t b = -4; b <= 4; b++) {
        for (int64_t a = -20; a <= 20 && b != 0; a++) {
            int64_t nearest = (2 * llabs(a) + llabs(b)) / (2 * llabs(b));
            assert_true(iris_wide_div_sat(iris_wide_from(a), b) == ((a < 0) != (b < 0) ? -nearest : nearest));
        }
    }
    assert_true(iris_wide_div_sat((iris_wide){INT64_MIN, 0}, 1) == INT64_MIN);
    assert_true(iris_wide_div_sat((iris_wide){INT64_MIN, 0}, -1) == INT64_MAX);
    assert_true(iris_q32_div_sat(1, 3) == 1431655765);
    assert_true(iris_q32_mul_sat(IRIS_Q32_ONE / 2, -3) == -1); /* half up */
    assert_true(iris_q32_mul_sat(INT64_MIN, INT64_MIN) == INT64_MAX);
}

static void roots_are_the_largest(void **state)
{
    (void)state;
    for (int i = 0; i < 300000; i++) {
        int64_t low = (int64_t)(random_u64() >> (2 + random_u64() % 62)),
                high = i % 4 ? (int64_t)(random_u64() >> (4 + random_u64() % 60)) : 0;
        iris_wide a = {high, (uint64_t)low << i % 3};
        int64_t root = iris_wide_sqrt(a);
        assert_true(root >= 0);
        assert_true(iris_wide_sub(a, iris_wide_mul(root, root)).high >= 0);
        assert_true(iris_wide_sub(a, iris_wide_mul(root + 1, root + 1)).high < 0);
    }
    for (int64_t root = 0; root < 70000; root++) {
        assert_true(iris_wide_sqrt(iris_wide_mul(root, root)) == root);
        assert_true(iris_wide_sqrt(iris_wide_sub(iris_wide_mul(root + 1, root + 1), iris_wide_from(1))) ==
                    root);
    }
    assert_true(iris_wide_sqrt((iris_wide){((int64_t)1 << 60) - 1, UINT64_MAX}) == ((int64_t)1 << 62) - 1);
    assert_true(iris_wide_sqrt((iris_wide){-1, 5}) == 0);
    assert_true(iris_q32_sqrt(2 * IRIS_Q32_ONE) == 6074000999); /* 1.41421356 */
    assert_true(iris_q32_sqrt(-1) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
#ifdef __SIZEOF_INT128__
        cmocka_unit_test(the_hand_reckons_as_the_compiler),
#endif
        cmocka_unit_test(products_and_sums_are_exact),
        cmocka_unit_test(shifts_round_half_up_and_saturate),
        cmocka_unit_test(quotients_are_the_nearest),
        cmocka_unit_test(roots_are_the_largest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
