/* Kernels of weighted sums. */
#include "kernels.h"

enum { TAPS = 9, BESIDE = 3 }; /* rows; taps share them. Pixels on both sides that taps reach */

static int32_t count, step, run; /* taps of a run lie side by side */
static int32_t weights[IRIS_ROW_TAPS];
static iris_row_quotient quotient;

/* Whatever the library gives: 255 times the sum of |weights|, and the start, are below 2^31. */
static void choose_quotient(void)
{
    static const int32_t divisors[] = {1,   2,   3,   9,   16,   100,   127,     128,
                                       129, 250, 256, 257, 1000, 65535, 4194303, 4194304};
    int32_t divisor = divisors[random_below(16)], shift = 31;
    for (; divisor >> (shift - 30) != 0; shift++) {
    }
    uint32_t factor = (uint32_t)((((uint64_t)1 << shift) + (uint32_t)divisor - 1) / (uint32_t)divisor);
    int32_t bias = (int32_t)random_below(3) - 1;
    quotient =
        (iris_row_quotient){divisor / 2 + bias * divisor, divisor, factor, shift, (int)random_below(2)};
}

/* Weights of a byte, of 16 bits, and larger; sometimes all as large as they may be. */
static void choose(void)
{
    static const int32_t limits[] = {3, 20, 64, 127, 128, 2000, 32767, 8000000};
    int32_t limit = limits[random_below(8)], rest = 8300000;
    int32_t same = (int32_t)random_below(4);
    choose_quotient();
    step = random_below(2) ? 1 : 3;
    run = 1 + (int32_t)random_below(2 * BESIDE + 1);
    count = random_below(4) ? 1 + (int32_t)random_below(IRIS_ROW_TAPS) : run * run;
    for (int32_t k = 0; k < count; k++) {
        int32_t most = limit < rest ? limit : rest;
        int32_t size = same == 0 ? most : (int32_t)random_below((uint32_t)most + 1);
        rest -= size;
        weights[k] = same > 1 && random_below(2) ? -size : size;
    }
}

/* Sums from which any weights may be added: at most 255 * 2^15 from zero, and some at the edges of the divisor. */
static void fill_sums(uint8_t *row, size_t bytes)
{
    uint32_t kind = random_below(3);
    for (size_t i = 0; i + 4 <= bytes; i += 4) {
        int32_t sum = (int32_t)random_below(16000000) - 8000000;
        sum = kind == 0 ? sum / 20000 : sum;
        memcpy(row + i, &sum, 4);
    }
}

static void fill_quotients(uint8_t *row, size_t bytes)
{
    static const int32_t extremes[] = {INT32_MAX, -INT32_MAX + 4194304, 0, -1};
    for (size_t i = 0; i + 4 <= bytes; i += 4) {
        int64_t multiple =
            ((int64_t)random_below(300) - 20) * quotient.divisor + (int64_t)random_below(3) - 1;
        int32_t sum = random_below(4) == 0 ? extremes[random_below(4)] : (int32_t)multiple;
        memcpy(row + i, &sum, 4);
    }
}

/* Sources of 32 bits: few enough that 255 * weights and these do not overflow. */
static void fill_small(uint8_t *row, size_t bytes)
{
    for (size_t i = 0; i + 4 <= bytes; i += 4) {
        int32_t value = (int32_t)random_below(511) - 255;
        memcpy(row + i, &value, 4);
    }
}

static int32_t more_taps(void)
{
    return (count - 1) * step;
}

static void set_taps(iris_row_tap taps[IRIS_ROW_TAPS], uint8_t **rows)
{
    for (int32_t k = 0; k < count; k++) {
        taps[k] = (iris_row_tap){rows[1 + k / run % TAPS] + k % run - run / 2, weights[k]};
    }
}

static void run_taps(int plain, uint8_t **rows, int32_t n)
{
    iris_row_tap taps[IRIS_ROW_TAPS];
    set_taps(taps, rows);
    BODY(plain, iris_row_taps_u8)((int32_t *)(void *)rows[0], taps, count, n);
}

static void run_filter(int plain, uint8_t **rows, int32_t n)
{
    iris_row_tap taps[IRIS_ROW_TAPS];
    set_taps(taps, rows);
    BODY(plain, iris_row_filter_u8)(rows[0], taps, count, &quotient, n);
}

static void run_settle(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_settle_u8)(rows[0], (int32_t *)(void *)rows[1], &quotient, n);
}

static void run_taps_s32(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_taps_s32)
    ((int32_t *)(void *)rows[0], (int32_t *)(void *)rows[1], weights, count, step, n);
}

static void run_filter_s32(int plain, uint8_t **rows, int32_t n)
{
    iris_row_line line = {weights, count, step};
    BODY(plain, iris_row_filter_s32)(rows[0], (int32_t *)(void *)rows[1], &line, &quotient, n);
}

#define ROW_T ROW_U8_AROUND(BESIDE, BESIDE)
#define NINE  ROW_T, ROW_T, ROW_T, ROW_T, ROW_T, ROW_T, ROW_T, ROW_T, ROW_T

static const kernel_case cases[] = {
    {KERNEL(iris_row_taps_u8), run_taps, choose, {ROW(1, 4, 4, fill_sums), NINE}},
    {KERNEL(iris_row_filter_u8), run_filter, choose, {ROW_U8, NINE}},
    {KERNEL(iris_row_settle_u8), run_settle, choose_quotient, {ROW_U8, ROW(1, 4, 4, fill_quotients)}},
    {KERNEL(iris_row_taps_s32),
     run_taps_s32,
     choose,
     {ROW(1, 4, 4, fill_sums), ROW_MORE(1, 4, 4, fill_small, more_taps)}},
    {KERNEL(iris_row_filter_s32), run_filter_s32, choose, {ROW_U8, ROW_MORE(1, 4, 4, fill_small, more_taps)}},
};

/* ---- truths ---- */

/* 1 * 10 - 2 * 20 + 300 * 30 and 5 before. */
static void truth_of_taps(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        int32_t sums[N], wide[N], from[N + 2];
        uint8_t row[3][N], *rows[1 + TAPS] = {(uint8_t *)sums, row[0], row[1], row[2]};
        uint8_t *in_s32[2] = {(uint8_t *)wide, (uint8_t *)from};
        for (int i = 0; i < N + 2; i++) {
            from[i] = 1000 * i;
            if (i < N) {
                sums[i] = wide[i] = 5;
                row[0][i] = 10;
                row[1][i] = 20;
                row[2][i] = 30;
            }
        }
        count = 3;
        run = step = 1;
        weights[0] = 1;
        weights[1] = -2;
        weights[2] = 300;
        run_taps(plain, rows, N);
        run_taps_s32(plain, in_s32, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(sums[i], 8975);
            assert_int_equal(wide[i], 5 + 1000 * i - 2000 * (i + 1) + 300000 * (i + 2));
        }
    }
}

/* (p + 3 q) / 4, rounded, and its absolute value with -3 q: 10 and 21 are 18.25 and -13.25. */
static void truth_of_filter(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        uint8_t out[N], row[2][N], *rows[1 + TAPS] = {out, row[0], row[1]};
        memset(row[0], 10, N);
        memset(row[1], 21, N);
        count = 2;
        run = 1;
        weights[0] = 1;
        for (int absolute = 0; absolute < 2; absolute++) {
            quotient = (iris_row_quotient){2, 4, (uint32_t)1 << 31, 33, absolute};
            for (int sign = -1; sign <= 1; sign += 2) {
                weights[1] = 3 * sign;
                run_filter(plain, rows, N);
                for (int i = 0; i < N; i++) {
                    assert_int_equal(out[i], sign > 0 ? 18 : absolute ? 13 : 0);
                }
            }
        }
    }
}

/* Windows of 3x3, 5x5, and 7x7 on a slope of 2 to the right: weights that rise by 1 along a row, 3 in the middle, look a
 * little to the right. And 200 times as much, in more bits. */
static void truth_of_windows(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        uint8_t out[N], slope[N + 2 * BESIDE], *rows[1 + TAPS] = {out};
        for (int i = 0; i < N + 2 * BESIDE; i++) {
            slope[i] = (uint8_t)(40 + 2 * i);
        }
        for (int r = 0; r < TAPS; r++) {
            rows[1 + r] = slope + BESIDE;
        }
        for (run = 3; run <= 7; run += 2) {
            for (int scale = 1; scale <= 200; scale += 199) {
                int reach = run / 2, sum = 3 * run * run * scale, moments = 0, shift = 31;
                count = run * run;
                for (int k = 0; k < count; k++) {
                    weights[k] = scale * (3 + k % run - reach);
                    moments += weights[k] * 2 * (k % run - reach);
                }
                for (; sum >> (shift - 30) != 0; shift++) {
                }
                quotient = (iris_row_quotient){
                    sum / 2, sum, (uint32_t)((((uint64_t)1 << shift) + (uint32_t)sum - 1) / (uint32_t)sum),
                    shift, 0};
                run_filter(plain, rows, N);
                for (int i = 0; i < N; i++) {
                    assert_int_equal(out[i], (slope[i + BESIDE] * sum + moments + sum / 2) / sum);
                }
            }
        }
    }
}

/* The greatest sums that leave d - 1 when they are divided by d: a factor that is not exact rounds them up. */
static void truth_of_divisors(void **state)
{
    (void)state;
    count = 3;
    run = 1;
    weights[0] = weights[1] = 127;
    weights[2] = 1;
    BOTH_BODIES(plain)
    {
        for (int d = 1; d < 255; d++) {
            uint8_t out[N], row[3][N], *rows[1 + TAPS] = {out, row[0], row[1], row[2]};
            int sums[N], shift = 31;
            for (; d >> (shift - 30) != 0; shift++) {
            }
            uint32_t factor = (uint32_t)((((uint64_t)1 << shift) + (uint32_t)d - 1) / (uint32_t)d);
            for (int i = 0; i < N; i++) {
                row[0][i] = (uint8_t)(255 - 2 * i);
                row[1][i] = (uint8_t)(255 - i);
                sums[i] = d / 2 + 127 * (510 - 3 * i);
                row[2][i] = (uint8_t)(d - 1 - sums[i] % d);
                sums[i] += row[2][i];
            }
            quotient = (iris_row_quotient){d / 2, d, factor, shift, 0};
            run_filter(plain, rows, N);
            for (int i = 0; i < N; i++) {
                assert_int_equal(out[i], sums[i] / d < 255 ? sums[i] / d : 255);
            }
        }
    }
}

/* The same across a row of 10, 10, 10, 21, 21, 21, three samples apart. */
static void truth_of_filter_s32(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        uint8_t out[N], *rows[2] = {out, NULL};
        int32_t from[N + 3];
        rows[1] = (uint8_t *)from;
        for (int i = 0; i < N + 3; i++) {
            from[i] = i % 6 < 3 ? 10 : 21;
        }
        count = 2;
        step = 3;
        weights[0] = 1;
        for (int absolute = 0; absolute < 2; absolute++) {
            quotient = (iris_row_quotient){2, 4, (uint32_t)1 << 31, 33, absolute};
            for (int sign = -1; sign <= 1; sign += 2) {
                weights[1] = 3 * sign;
                run_filter_s32(plain, rows, N);
                for (int i = 0; i < N; i++) { /* 10 and 21; 21 and 10: 12.75 and -2.25 */
                    int first = sign > 0 ? 18 : absolute ? 13 : 0, second = sign > 0 ? 13 : absolute ? 2 : 0;
                    assert_int_equal(out[i], i % 6 < 3 ? first : second);
                }
            }
        }
    }
}

static void truth_of_settle(void **state)
{
    (void)state;
    static const int32_t sums[8] = {0, 6, 7, 1784, 1785, INT32_MAX, -1, -8}; /* sevenths */
    static const uint8_t positive[8] = {0, 0, 1, 254, 255, 255, 0, 0},
                         absolute[8] = {0, 0, 1, 254, 255, 255, 1, 2};
    BOTH_BODIES(plain)
    {
        int32_t all[N];
        uint8_t out[N], *rows[2] = {out, (uint8_t *)all};
        for (int i = 0; i < N; i++) {
            all[i] = sums[i % 8];
        }
        for (int sign = 0; sign < 2; sign++) {
            quotient = (iris_row_quotient){3, 7, (uint32_t)((((uint64_t)1 << 33) + 6) / 7), 33, sign};
            run_settle(plain, rows, N);
            for (int i = 0; i < N; i++) {
                assert_int_equal(out[i], sign ? absolute[i % 8] : positive[i % 8]);
            }
        }
    }
}

static int truths(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(truth_of_taps),       cmocka_unit_test(truth_of_filter),
        cmocka_unit_test(truth_of_divisors),   cmocka_unit_test(truth_of_windows),
        cmocka_unit_test(truth_of_filter_s32), cmocka_unit_test(truth_of_settle),
    };
    return cmocka_run_group_tests_name("kernels of taps", tests, NULL, NULL);
}

const kernel_family kernels_taps = {cases, sizeof cases / sizeof cases[0], truths};
