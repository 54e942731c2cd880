/* The kernel of the unsharp mask. */
#include "kernels.h"

static iris_row_sharpening by;

static void choose(void)
{
    static const int32_t amounts[] = {0,     1,     32767, 32768,          32769,
                                      65535, 65536, 98304, 16 * 65536 - 1, 16 * 65536};
    static const int32_t thresholds[] = {0, 1, 127, 128, 254, 255};
    by.amount_q16 = random_below(2) ? amounts[random_below(10)] : (int32_t)random_below(16 * 65536 + 1);
    by.threshold = random_below(2) ? thresholds[random_below(6)] : (int32_t)random_below(20);
}

static void run_sharpen(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_sharpen_u8)(rows[0], rows[1], rows[2], by, n);
}

static const kernel_case cases[] = {
    {KERNEL(iris_row_sharpen_u8), run_sharpen, choose, {ROW_U8, ROW_U8, ROW_U8}},
};

/* 1.5 times -5 is -7.5, which is rounded up; 3 is not above the threshold. */
static void truth_of_sharpen(void **state)
{
    (void)state;
    static const uint8_t source[6] = {100, 100, 100, 100, 250, 3}, blurred[6] = {105, 95, 103, 97, 240, 20},
                         expected[6] = {93, 108, 100, 100, 255, 0};
    BOTH_BODIES(plain)
    {
        uint8_t out[N], src[N], smooth[N], *rows[3] = {out, src, smooth};
        for (int i = 0; i < N; i++) {
            src[i] = source[i % 6];
            smooth[i] = blurred[i % 6];
        }
        by = (iris_row_sharpening){98304, 3};
        run_sharpen(plain, rows, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(out[i], expected[i % 6]);
        }
        rows[0] = src;
        run_sharpen(plain, rows, N);
        assert_memory_equal(src, out, N);
    }
}

static int truths(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(truth_of_sharpen),
    };
    return cmocka_run_group_tests_name("kernels of sharpen", tests, NULL, NULL);
}

const kernel_family kernels_sharpen = {cases, sizeof cases / sizeof cases[0], truths};
