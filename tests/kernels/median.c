/* Kernels that find medians. */
#include "kernels.h"

static int32_t step;

static void choose_step(void)
{
    step = random_below(2) ? 1 : 3;
}

static void run_median9(int plain, uint8_t **rows, int32_t n)
{
    const uint8_t *const around[3] = {rows[1], rows[2], rows[3]};
    BODY(plain, iris_row_median9_u8)(rows[0], around, step, n);
}

static void run_sort5(int plain, uint8_t **rows, int32_t n)
{
    const uint8_t *const around[5] = {rows[5], rows[6], rows[7], rows[8], rows[9]};
    BODY(plain, iris_row_sort5_u8)(rows, around, n);
}

static void run_median25(int plain, uint8_t **rows, int32_t n)
{
    const uint8_t *const sorted[5] = {rows[1], rows[2], rows[3], rows[4], rows[5]};
    BODY(plain, iris_row_median25_u8)(rows[0], sorted, step, n);
}

#define ROW3 ROW_U8_AROUND(3, 3)
#define ROW6 ROW_U8_AROUND(6, 6)

static const kernel_case cases[] = {
    {KERNEL(iris_row_median9_u8), run_median9, choose_step, {ROW_U8, ROW3, ROW3, ROW3}},
    {KERNEL(iris_row_sort5_u8),
     run_sort5,
     NULL,
     {ROW_U8, ROW_U8, ROW_U8, ROW_U8, ROW_U8, ROW_U8, ROW_U8, ROW_U8, ROW_U8, ROW_U8}},
    {KERNEL(iris_row_median25_u8), run_median25, choose_step, {ROW_U8, ROW6, ROW6, ROW6, ROW6, ROW6}},
};

/* ---- truths ---- */

static void truth_of_median9(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        for (step = 1; step <= 3; step += 2) {
            uint8_t row[4][N + 6], *rows[] = {row[0] + 3, row[1] + 3, row[2] + 3, row[3] + 3};
            for (int i = 0; i < N + 6; i++) {
                row[1][i] = (uint8_t)(2 * i); /* rising, with a wall above and a hole below */
                row[2][i] = 255;
                row[3][i] = 0;
            }
            run_median9(plain, rows, N);
            for (int i = 0; i < N; i++) {
                assert_int_equal(rows[0][i], 2 * (i + 3));
            }
        }
    }
}

static void truth_of_sort5(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        uint8_t row[10][N], *rows[10];
        for (int r = 0; r < 10; r++) {
            rows[r] = row[r];
            for (int i = 0; i < N; i++) {
                row[r][i] = (uint8_t)(50 * ((r * 3 + i) % 5) + i % 7); /* each order of a turn */
            }
        }
        run_sort5(plain, rows, N);
        for (int i = 0; i < 5 * N; i++) {
            assert_int_equal(row[i % 5][i / 5], 50 * (i % 5) + i / 5 % 7);
        }
    }
}

/* The ranks do not meet: the median is that of the five middle ones, which rise along the row. */
static void truth_of_median25(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        for (step = 1; step <= 3; step += 2) {
            uint8_t row[6][N + 12], *rows[6];
            for (int r = 0; r < 6; r++) {
                rows[r] = row[r] + 6;
                for (int i = 0; i < N + 12; i++) {
                    static const int level[6] = {0, 0, 10, 0, 240, 255};
                    row[r][i] = (uint8_t)(r == 3 ? 30 + 3 * i : level[r]);
                }
            }
            run_median25(plain, rows, N);
            for (int i = 0; i < N; i++) {
                assert_int_equal(rows[0][i], 30 + 3 * (i + 6));
            }
        }
    }
}

static int truths(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(truth_of_median9),
        cmocka_unit_test(truth_of_sort5),
        cmocka_unit_test(truth_of_median25),
    };
    return cmocka_run_group_tests_name("kernels of median", tests, NULL, NULL);
}

const kernel_family kernels_median = {cases, sizeof cases / sizeof cases[0], truths};
