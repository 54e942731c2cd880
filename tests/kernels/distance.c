/* Kernels of distances. */
#include "kernels.h"

static iris_row_steps steps;

static void choose_steps(void)
{
    static const uint16_t costs[] = {1, 2, 3, 4, 254, 255};
    steps.straight = costs[random_below(6)];
    steps.diagonal = random_below(4) ? costs[random_below(6)] : 65535;
}

/* Short and long ways: few pixels are zero. */
static void fill_distances(uint8_t *row, size_t bytes)
{
    uint32_t kind = random_below(3), rare = 2 + random_below(60);
    if (kind == 0) {
        fill_u16(row, bytes);
        return;
    }
    for (size_t i = 0; i + 2 <= bytes; i += 2) {
        uint16_t value =
            (uint16_t)(random_below(rare) == 0 ? random_below(9) : 65535 - random_below(kind * 100));
        memcpy(row + i, &value, 2);
    }
}

static uint16_t *distances(uint8_t *row)
{
    return (uint16_t *)(void *)row;
}

static void run_select(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_select_u16)(distances(rows[0]), words(rows[1]), n);
}

static void run_reach(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_reach_u16)(distances(rows[0]), distances(rows[1]), steps, n);
}

static void run_right(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_spread_right_u16)(distances(rows[0]), steps.straight, n);
}

static void run_left(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_spread_left_u16)(distances(rows[0]), steps.straight, n);
}

#define ROW_FAR ROW(1, 2, 2, fill_distances)

static const kernel_case cases[] = {
    {KERNEL(iris_row_select_u16), run_select, NULL, {ROW_U16, ROW_MASK}},
    {KERNEL(iris_row_reach_u16), run_reach, choose_steps, {ROW_FAR, ROW_FAR}},
    {KERNEL(iris_row_spread_right_u16), run_right, choose_steps, {ROW_FAR}},
    {KERNEL(iris_row_spread_left_u16), run_left, choose_steps, {ROW_FAR}},
};

/* ---- truths: one near pixel, AT ---- */

enum { AT = 20 };

static void truth_of_select(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        uint16_t row[N];
        uint32_t mask[MASK_WORDS] = {(uint32_t)1 << AT, (uint32_t)1 << (N - 1 - 32)};
        run_select(plain, (uint8_t *[]){(uint8_t *)row, (uint8_t *)mask}, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(row[i], i == AT || i == N - 1 ? 65535 : 0);
        }
    }
}

static void truth_of_reach(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        for (int far = 0; far < 2; far++) {
            uint16_t row[N], other[N];
            steps = (iris_row_steps){3, far ? 65535 : 4};
            for (int i = 0; i < N; i++) {
                row[i] = 40000;
                other[i] = (uint16_t)(i == AT ? 100 : 65534);
            }
            run_reach(plain, (uint8_t *[]){(uint8_t *)row, (uint8_t *)other}, N);
            for (int i = 0; i < N; i++) {
                assert_int_equal(row[i], i == AT ? 103 : abs(i - AT) == 1 && !far ? 104 : 40000);
            }
        }
    }
}

static void truth_of_spreading(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        for (int left = 0; left < 2; left++) {
            uint16_t row[N];
            steps.straight = 3;
            for (int i = 0; i < N; i++) {
                row[i] = (uint16_t)(i == AT ? 5 : 65535);
            }
            (left ? run_left : run_right)(plain, (uint8_t *[]){(uint8_t *)row}, N);
            for (int i = 0; i < N; i++) {
                int away = left ? AT - i : i - AT;
                assert_int_equal(row[i], away >= 0 ? 5 + 3 * away : 65535);
            }
        }
    }
}

static int truths(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(truth_of_select),
        cmocka_unit_test(truth_of_reach),
        cmocka_unit_test(truth_of_spreading),
    };
    return cmocka_run_group_tests_name("kernels of distances", tests, NULL, NULL);
}

const kernel_family kernels_distance = {cases, sizeof cases / sizeof cases[0], truths};
