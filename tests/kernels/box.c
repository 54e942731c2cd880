/* Kernels of box blurs. */
#include "kernels.h"

static int32_t side, step;

static void choose_side(void)
{
    static const int32_t sides[] = {1, 2, 3, 5, 6, 9, 15, 16, 17, 18, 51, 254, 255};
    side = random_below(4) ? sides[random_below(13)] : 1 + (int32_t)random_below(255);
    step = random_below(2) ? 1 : 3;
}

/* Sums of columns of that side. */
static void fill_columns(uint8_t *row, size_t bytes)
{
    uint32_t kind = random_below(4), most = 255u * (uint32_t)side;
    for (size_t i = 0; i + 2 <= bytes; i += 2) {
        uint16_t sum = (uint16_t)(kind == 0   ? most
                                  : kind == 1 ? most * random_below(2)
                                  : kind == 2 ? most / 2 + random_below(2)
                                              : random_below(most + 1));
        memcpy(row + i, &sum, 2);
    }
}

static int32_t more_columns(void)
{
    return (side - 1) * step;
}

static void run(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_box_mean_u8)(rows[0], (const uint16_t *)(void *)rows[1], side, step, n);
}

static int32_t more_sums(void)
{
    return 2 * step;
}

static void run_box9(int plain, uint8_t **rows, int32_t n)
{
    const uint8_t *const three[3] = {rows[2], rows[3], rows[4]};
    BODY(plain, iris_row_box9_u8)(rows[0], (uint16_t *)(void *)rows[1], three, step, n);
}

static const kernel_case cases[] = {
    {KERNEL(iris_row_box_mean_u8), run, choose_side, {ROW_U8, ROW_MORE(1, 2, 2, fill_columns, more_columns)}},
    {KERNEL(iris_row_box9_u8),
     run_box9,
     choose_side,
     {ROW_U8, ROW_MORE(1, 2, 2, fill_u16, more_sums), ROW_U8_AROUND(3, 3), ROW_U8_AROUND(3, 3),
      ROW_U8_AROUND(3, 3)}},
};

/* ---- truths ---- */

/* Windows that hold every sum that there is, below, at, and above each half, in the one column that is not 0. A column
 * may hold more than 255 * side here as long as the whole window does not. */
static void truth_of_division(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        for (side = 1; side <= 16; side++) {
            static uint16_t columns[32 * 16 + 16];
            static uint8_t out[32 * 16];
            uint8_t *rows[2] = {out, (uint8_t *)columns};
            uint32_t area = (uint32_t)(side * side), sum = 0;
            step = 1;
            while (sum <= 255 * area) {
                memset(columns, 0, sizeof columns);
                for (int32_t i = 0; i < 32; i++) { /* the first column of windows 0, side, 2 side... */
                    columns[i * side] =
                        (uint16_t)(sum + (uint32_t)i < 255 * area ? sum + (uint32_t)i : 255 * area);
                }
                run(plain, rows, 32 * side);
                for (int32_t i = 0; i < 32; i++) {
                    assert_int_equal(out[i * side], (columns[i * side] + area / 2) / area);
                }
                sum += 32;
            }
        }
    }
}

/* Columns alike, of which each n-th is greater: two channels that stay what they are, and one that does not. */
static void truth_of_channels(void **state)
{
    (void)state;
    static const int32_t sides[] = {3, 6, 16, 17, 200};
    BOTH_BODIES(plain)
    {
        for (int k = 0; k < 5; k++) {
            uint16_t columns[N + 3 * 199];
            uint8_t out[N], *rows[2] = {out, (uint8_t *)columns};
            side = sides[k];
            step = 3;
            for (int32_t i = 0; i < N + 3 * (side - 1); i++) {
                columns[i] = (uint16_t)(side * (i % 3 == 0 ? 255 : i % 3 == 1 ? 7 : i % 6 == 2 ? 100 : 101));
            }
            run(plain, rows, N);
            for (int i = 0; i < N; i++) {
                int32_t hundreds = i % 6 == 2 ? (side + 1) / 2 : side / 2; /* of the window's columns */
                int32_t mean = 2 * (side - hundreds) >= side ? 101 : 100;
                assert_int_equal(out[i], i % 3 == 0 ? 255 : i % 3 == 1 ? 7 : mean);
            }
        }
    }
}

/* Every sum of nine samples, in the one that is not 0 and in those above it; and which samples these are. */
static void truth_of_box9(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        uint16_t columns[N + 6];
        uint8_t dst[N], row[3][N + 6],
            *rows[5] = {dst, (uint8_t *)columns, row[0] + 3, row[1] + 3, row[2] + 3};
        for (step = 1; step <= 3; step += 2) {
            for (int sum = 0; sum <= 9 * 255; sum++) {
                for (int i = 0; i < 3 * (N + 6); i++) {
                    int left = sum - i / (N + 6) * 765 - (i + 2 * step) / step % 3 * 255;
                    row[i / (N + 6)][i % (N + 6)] = (uint8_t)(left < 0 ? 0 : left > 255 ? 255 : left);
                }
                run_box9(plain, rows, N);
                for (int i = 0; i < N; i++) {
                    assert_int_equal(dst[i], (2 * sum + 9) / 18);
                }
            }
            memset(row, 0, sizeof row);
            row[1][3 + 20] = 90;
            run_box9(plain, rows, N);
            for (int i = 0; i < N; i++) {
                assert_int_equal(dst[i], abs(i - 20) == step || i == 20 ? 10 : 0);
            }
        }
    }
}

static int truths(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(truth_of_division),
        cmocka_unit_test(truth_of_channels),
        cmocka_unit_test(truth_of_box9),
    };
    return cmocka_run_group_tests_name("kernels of box", tests, NULL, NULL);
}

const kernel_family kernels_box = {cases, sizeof cases / sizeof cases[0], truths};
