/* Kernels that sum rows, down and across. */
#include "kernels.h"

static uint16_t *sums_at(uint8_t *row)
{
    return (uint16_t *)(void *)row;
}

static void run_binomial5(int plain, uint8_t **rows, int32_t n)
{
    const uint8_t *const five[5] = {rows[1], rows[2], rows[3], rows[4], rows[5]};
    BODY(plain, iris_row_binomial5_u8)(sums_at(rows[0]), five, n);
}

static void run_halve(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_halve_u16)(rows[0], sums_at(rows[1]), n);
}

static void run_integral(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_integral_u8)(words(rows[0]), words(rows[1]), rows[2], n);
}

/* Sixteen times 255 at most. */
static void fill_sums(uint8_t *row, size_t bytes)
{
    fill_u16(row, bytes);
    for (size_t i = 0; i < bytes / 2; i++) {
        sums_at(row)[i] = sums_at(row)[i] > 4080 ? (uint16_t)(4080 - sums_at(row)[i] % 5) : sums_at(row)[i];
    }
}

/* Two sums for each pixel. */
#define ROW_SUMS ROW_AROUND(1, 4, 2, fill_sums, 1, 1)

static const kernel_case cases[] = {
    {KERNEL(iris_row_binomial5_u8), run_binomial5, NULL, {ROW_U16, ROW_U8, ROW_U8, ROW_U8, ROW_U8, ROW_U8}},
    {KERNEL(iris_row_halve_u16), run_halve, NULL, {ROW_U8, ROW_SUMS}},
    {KERNEL(iris_row_integral_u8), run_integral, NULL, {ROW_U32, ROW_U32, ROW_U8}},
};

/* ---- truths ---- */

/* One row at a time: its weight. */
static void truth_of_binomial5(void **state)
{
    (void)state;
    static const int weights[5] = {1, 4, 6, 4, 1};
    BOTH_BODIES(plain)
    {
        for (int r = 0; r < 6; r++) {
            uint16_t sums[N];
            uint8_t row[5][N], *rows[6] = {(uint8_t *)sums};
            for (int i = 0; i < 5 * N; i++) {
                rows[1 + i / N] = row[i / N];
                row[i / N][i % N] = (uint8_t)(r == 5 ? 255 : i / N == r ? 200 + i % N : 0);
            }
            run_binomial5(plain, rows, N);
            for (int i = 0; i < N; i++) {
                assert_int_equal(sums[i], r == 5 ? 4080 : weights[r] * (200 + i));
            }
        }
    }
}

/* One sum of 160 in a row of zeros: its weights 1, 4, 6 of 256 wherever it lies; and the largest. */
static void truth_of_halve(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        uint16_t sums[2 * N + 4];
        uint8_t dst[N], *rows[] = {dst, (uint8_t *)(sums + 2)};
        for (int place = -2; place <= 2 * N; place++) {
            memset(sums, 0, sizeof sums);
            sums[place + 2] = 160;
            run_halve(plain, rows, N);
            for (int i = 0; i < N; i++) {
                int apart = abs(2 * i - place);
                assert_int_equal(dst[i], apart > 2 ? 0 : apart == 2 ? 1 : apart == 1 ? 3 : 4);
            }
        }
        for (int i = 0; i < 2 * N + 4; i++) {
            sums[i] = 4080;
        }
        run_halve(plain, rows, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(dst[i], 255);
        }
    }
}

static void truth_of_integral(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        uint32_t dst[N], above[N];
        uint8_t src[N], *rows[] = {(uint8_t *)dst, (uint8_t *)above, src};
        for (int i = 0; i < N; i++) {
            src[i] = (uint8_t)(2 * i + 1); /* odd numbers sum to squares */
            above[i] = UINT32_MAX - 999;   /* wraps around at a thousand */
        }
        run_integral(plain, rows, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(dst[i], (uint32_t)((i + 1) * (i + 1) - 1000));
        }
    }
}

static int truths(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(truth_of_binomial5),
        cmocka_unit_test(truth_of_halve),
        cmocka_unit_test(truth_of_integral),
    };
    return cmocka_run_group_tests_name("kernels of sums", tests, NULL, NULL);
}

const kernel_family kernels_sums = {cases, sizeof cases / sizeof cases[0], truths};
