/* Kernels from cameras' pixels to colors. */
#include "kernels.h"

static int32_t own, green;

static void choose_place(void)
{
    own = random_below(2) ? 2 : 0;
    green = (int32_t)random_below(2);
}

static void run_nv12(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_rgb888_nv12)(rows[0], rows[1], rows[2], n);
}

static void run_bayer(int plain, uint8_t **rows, int32_t n)
{
    const uint8_t *const around[3] = {rows[1], rows[2], rows[3]};
    BODY(plain, iris_row_888_bayer)(rows[0], around, own, green, n);
}

static int32_t which;

static void choose_which(void)
{
    which = (int32_t)random_below(2);
}

static void run_every_second(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_every_second_u8)(rows[0], rows[1], which, n);
}

#define ROW_PAIRS ROW(2, 2, 1, fill_u8)
#define ROW_NEXT  ROW_U8_AROUND(1, 1)

static const kernel_case cases[] = {
    {KERNEL(iris_row_rgb888_nv12), run_nv12, NULL, {ROW_888, ROW_U8, ROW_PAIRS}},
    {KERNEL(iris_row_every_second_u8), run_every_second, choose_which, {ROW_U8, ROW(1, 2, 1, fill_u8)}},
    {KERNEL(iris_row_888_bayer), run_bayer, choose_place, {ROW_888, ROW_NEXT, ROW_NEXT, ROW_NEXT}},
};

/* ---- truths ---- */

/* Colors of BT.601 whose bytes are known: black, white, gray, the corners beyond, and the strongest red. */
static void truth_of_nv12(void **state)
{
    (void)state;
    static const struct {
        uint8_t y, u, v, r, g, b;
    } known[] = {{16, 128, 128, 0, 0, 0},    {235, 128, 128, 255, 255, 255}, {126, 128, 128, 128, 128, 128},
                 {0, 128, 128, 0, 0, 0},     {255, 128, 128, 255, 255, 255}, {81, 90, 240, 255, 0, 0},
                 {16, 255, 255, 203, 0, 255}};
    BOTH_BODIES(plain)
    {
        for (size_t k = 0; k < sizeof known / sizeof known[0]; k++) {
            uint8_t rgb[3 * N] = {0}, luma[N], chroma[N + 1], *rows[] = {rgb, luma, chroma};
            for (int i = 0; i <= N; i++) {
                luma[i < N ? i : 0] = known[k].y;
                chroma[i] = i % 2 ? known[k].v : known[k].u;
            }
            run_nv12(plain, rows, N);
            for (int i = 0; i < N; i++) {
                assert_true(rgb[3 * i] == known[k].r && rgb[3 * i + 1] == known[k].g &&
                            rgb[3 * i + 2] == known[k].b);
            }
        }
    }
}

static void truth_of_every_second(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        for (which = 0; which < 2; which++) {
            uint8_t src[2 * N], dst[N], *rows[] = {dst, src};
            for (int i = 0; i < 2 * N; i++) {
                src[i] = (uint8_t)(255 - i);
            }
            run_every_second(plain, rows, N);
            for (int i = 0; i < N; i++) {
                assert_int_equal(dst[i], 255 - 2 * i - which);
            }
        }
    }
}

/* Rows that rise: each mean is the value between. Above is 10 less, below 10 more. */
static void truth_of_bayer(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        for (int k = 0; k < 4; k++) {
            uint8_t rgb[3 * N] = {0}, row[3][N + 2], *rows[] = {rgb, row[0] + 1, row[1] + 1, row[2] + 1};
            own = k / 2 * 2;
            green = k % 2;
            for (int i = 0; i < 3 * (N + 2); i++) {
                row[i % 3][i / 3] = (uint8_t)(2 * (i / 3) + i % 3 * 10 + 40);
            }
            run_bayer(plain, rows, N);
            for (int i = 0; i < 3 * N; i++) {
                assert_int_equal(rgb[i], 2 * (i / 3 + 1) + 50);
            }
        }
    }
}

static int truths(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(truth_of_nv12),
        cmocka_unit_test(truth_of_every_second),
        cmocka_unit_test(truth_of_bayer),
    };
    return cmocka_run_group_tests_name("kernels of cameras", tests, NULL, NULL);
}

const kernel_family kernels_camera = {cases, sizeof cases / sizeof cases[0], truths};
