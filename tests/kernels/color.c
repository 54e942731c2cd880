/* Kernels on pixels of three channels. */
#include "kernels.h"

static iris_hsl_range_test range;

static void choose_range(void)
{
    static const int32_t hues[] = {0, 1, 59, 60, 61, 120, 180, 239, 240, 299, 300, 359, 360};
    iris_hsl_range chosen = {hues[random_below(13)], hues[random_below(13)], 0, 100, 0, 100};
    if (random_below(2)) {
        chosen.s0 = (int32_t)random_below(60);
        chosen.s1 = 100 - (int32_t)random_below(40);
        chosen.l0 = (int32_t)random_below(40);
        chosen.l1 = 100 - (int32_t)random_below(60);
    }
    assert_int_equal(iris_hsl_range_prepare(&range, &chosen), IRIS_OK);
}

static void run_luma_rgb888(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_luma_rgb888)(rows[0], rows[1], n);
}

static void run_luma_bgr888(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_luma_bgr888)(rows[0], rows[1], n);
}

static void run_luma_rgba8888(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_luma_rgba8888)(rows[0], rows[1], n);
}

static void run_swap(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_swap_888)(rows[0], rows[1], n);
}

static void run_swap_in_place(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_swap_888)(rows[0], rows[0], n);
}

static void run_888_gray(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_888_gray)(rows[0], rows[1], n);
}

static void run_hsl_range(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_hsl_range)(words(rows[0]), rows[1], &range, n);
}

static int32_t red;

static void choose_red(void)
{
    red = 2 * (int32_t)random_below(2);
}

static void run_hsl24(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_hsl24_888)(rows[0], rows[1], red, n);
}

static void run_hsl24_in_place(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_hsl24_888)(rows[0], rows[0], red, n);
}

static const kernel_case cases[] = {
    {KERNEL(iris_row_luma_rgb888), run_luma_rgb888, NULL, {ROW_U8, ROW_888}},
    {KERNEL(iris_row_luma_bgr888), run_luma_bgr888, NULL, {ROW_U8, ROW_888}},
    {KERNEL(iris_row_luma_rgba8888), run_luma_rgba8888, NULL, {ROW_U8, ROW(1, 4, 1, fill_u8)}},
    {KERNEL(iris_row_swap_888), run_swap, NULL, {ROW_888, ROW_888}},
    {KERNEL(iris_row_swap_888), run_swap_in_place, NULL, {ROW_888}},
    {KERNEL(iris_row_888_gray), run_888_gray, NULL, {ROW_888, ROW_U8}},
    {KERNEL(iris_row_hsl_range), run_hsl_range, choose_range, {ROW_MASK, ROW_888}},
    {KERNEL(iris_row_hsl24_888), run_hsl24, choose_red, {ROW_888, ROW_888}},
    {KERNEL(iris_row_hsl24_888), run_hsl24_in_place, choose_red, {ROW_888}},
};

/* ---- truths ---- */

static void hsl_range_of_many_colors(void **state)
{
    (void)state;
    static const iris_hsl_range ranges[] = {{0, 360, 0, 100, 0, 100},  {350, 10, 30, 100, 20, 80},
                                            {40, 70, 40, 100, 25, 75}, {60, 60, 0, 100, 0, 100},
                                            {120, 240, 1, 99, 1, 99},  {300, 299, 0, 50, 40, 60},
                                            {90, 330, 33, 67, 0, 50},  {200, 180, 10, 90, 50, 100}};
    for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
        iris_hsl_range_test test;
        assert_int_equal(iris_hsl_range_prepare(&test, &ranges[i]), IRIS_OK);
        for (int r = 0; r < 256; r += 5) {
            for (int g = 0; g < 256; g += 3) {
                uint8_t rgb[3 * 256];
                uint32_t plain[8], port[8];
                for (int b = 0; b < 256; b++) {
                    rgb[3 * b] = (uint8_t)r;
                    rgb[3 * b + 1] = (uint8_t)g;
                    rgb[3 * b + 2] = (uint8_t)b;
                }
                iris_row_hsl_range_c(plain, rgb, &test, 256);
                iris_row_hsl_range(port, rgb, &test, 256);
                assert_memory_equal(plain, port, sizeof plain);
            }
        }
    }
}

/* Every color, where there is anything to compare. */
static void hsl24_of_all_colors(void **state)
{
    (void)state;
    const any_function ours = (any_function)iris_row_hsl24_888, c = (any_function)iris_row_hsl24_888_c;
    if (ours == c) {
        return;
    }
    for (int color = 0; color < 1 << 24; color += 256) {
        uint8_t rgb[3 * 256], plain[3 * 256], port[3 * 256];
        for (int b = 0; b < 256; b++) {
            rgb[3 * b] = (uint8_t)(color >> 16);
            rgb[3 * b + 1] = (uint8_t)(color >> 8);
            rgb[3 * b + 2] = (uint8_t)b;
        }
        iris_row_hsl24_888_c(plain, rgb, 0, 256);
        iris_row_hsl24_888(port, rgb, 0, 256);
        assert_memory_equal(plain, port, sizeof plain);
    }
}

static void truth_of_luma(void **state)
{
    (void)state;
    static const uint8_t colors[6][3] = {{255, 255, 255}, {0, 0, 0},   {255, 0, 0},
                                         {0, 255, 0},     {0, 0, 255}, {1, 2, 3}};
    static const uint8_t as_rgb[6] = {255, 0, 77, 149, 29, 2}, as_bgr[6] = {255, 0, 29, 149, 77, 2};
    uint8_t src[3 * N], with_alpha[4 * N], dst[N];
    for (int i = 0; i < N; i++) {
        memcpy(src + 3 * i, colors[i % 6], 3);
        memcpy(with_alpha + 4 * i, colors[i % 6], 3);
        with_alpha[4 * i + 3] = (uint8_t)(i % 2 * 255);
    }
    uint8_t *rows[] = {dst, src}, *rows_with_alpha[] = {dst, with_alpha};
    BOTH_BODIES(plain)
    {
        run_luma_rgb888(plain, rows, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(dst[i], as_rgb[i % 6]);
        }
        run_luma_bgr888(plain, rows, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(dst[i], as_bgr[i % 6]);
        }
        run_luma_rgba8888(plain, rows_with_alpha, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(dst[i], as_rgb[i % 6]);
        }
    }
}

static void truth_of_swap(void **state)
{
    (void)state;
    uint8_t src[3 * N], dst[3 * N], *rows[] = {dst, src};
    for (int i = 0; i < 3 * N; i++) {
        src[i] = (uint8_t)i;
    }
    BOTH_BODIES(plain)
    {
        run_swap(plain, rows, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(dst[3 * i], 3 * i + 2);
            assert_int_equal(dst[3 * i + 1], 3 * i + 1);
            assert_int_equal(dst[3 * i + 2], 3 * i);
        }
        run_swap_in_place(plain, rows, N);
        assert_memory_equal(dst, src, sizeof src);
    }
}

static void truth_of_888_gray(void **state)
{
    (void)state;
    uint8_t src[N], dst[3 * N], *rows[] = {dst, src};
    for (int i = 0; i < N; i++) {
        src[i] = (uint8_t)(255 - 3 * i);
    }
    BOTH_BODIES(plain)
    {
        memset(dst, 0, sizeof dst);
        run_888_gray(plain, rows, N);
        for (int i = 0; i < 3 * N; i++) {
            assert_int_equal(dst[i], 255 - 3 * (i / 3));
        }
    }
}

static void truth_of_hsl_range(void **state)
{
    (void)state;
    static const struct {
        uint8_t rgb[3];
        int in; /* bit 0: red 350-10, S 50-100, L 20-80; bit 1: 60-240, S 0-100, L 0-100 */
    } colors[] = {{{255, 0, 0}, 1},     {{255, 0, 42}, 1},  {{255, 0, 43}, 0},    {{255, 42, 0}, 1},
                  {{255, 43, 0}, 0},    {{255, 255, 0}, 2}, {{255, 254, 0}, 0},   {{0, 255, 0}, 2},
                  {{0, 0, 255}, 2},     {{1, 0, 255}, 0},   {{0, 255, 255}, 2},   {{255, 0, 255}, 0},
                  {{128, 128, 128}, 0}, {{0, 0, 0}, 0},     {{102, 0, 0}, 1},     {{101, 0, 0}, 0},
                  {{150, 50, 50}, 1},   {{150, 51, 51}, 0}, {{255, 153, 153}, 1}, {{255, 154, 154}, 0}};
    enum { COLORS = sizeof colors / sizeof colors[0] };
    static const iris_hsl_range ranges[2] = {{350, 10, 50, 100, 20, 80}, {60, 240, 0, 100, 0, 100}};
    uint8_t src[3 * N];
    for (int i = 0; i < N; i++) {
        memcpy(src + 3 * i, colors[i % COLORS].rgb, 3);
    }
    BOTH_BODIES(plain)
    {
        for (int k = 0; k < 2; k++) {
            uint32_t mask[MASK_WORDS] = {0, 0xffffffffu};
            uint8_t *rows[] = {(uint8_t *)mask, src};
            assert_int_equal(iris_hsl_range_prepare(&range, &ranges[k]), IRIS_OK);
            run_hsl_range(plain, rows, N);
            for (int i = 0; i < N; i++) {
                assert_int_equal(bit(mask, i), colors[i % COLORS].in >> k & 1);
            }
            assert_int_equal(mask[1] >> (N - 32), 0xffffffffu >> (N - 32));
        }
    }
}

/* Sixths of a turn are 42.67 steps. */
static void truth_of_hsl24(void **state)
{
    (void)state;
    static const uint8_t colors[11][2][3] = {
        {{0, 0, 0}, {0, 0, 0}},          {{255, 255, 255}, {0, 0, 255}},   {{255, 0, 0}, {0, 255, 128}},
        {{255, 255, 0}, {43, 255, 128}}, {{0, 255, 0}, {85, 255, 128}},    {{0, 255, 255}, {128, 255, 128}},
        {{0, 0, 255}, {171, 255, 128}},  {{255, 0, 255}, {213, 255, 128}}, {{255, 0, 1}, {0, 255, 128}},
        {{255, 0, 6}, {255, 255, 128}},  {{100, 50, 50}, {0, 85, 75}}};
    uint8_t src[3 * N], dst[3 * N], *rows[2] = {dst, src};
    BOTH_BODIES(plain)
    {
        for (red = 0; red < 3; red += 2) {
            for (int i = 0; i < 3 * N; i++) {
                src[i] = colors[i / 3 % 11][0][red ? 2 - i % 3 : i % 3];
            }
            run_hsl24(plain, rows, N);
            for (int i = 0; i < 3 * N; i++) {
                assert_int_equal(dst[i], colors[i / 3 % 11][1][i % 3]);
            }
        }
    }
}

static int truths(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hsl_range_of_many_colors),
        cmocka_unit_test(truth_of_luma),
        cmocka_unit_test(truth_of_swap),
        cmocka_unit_test(truth_of_888_gray),
        cmocka_unit_test(truth_of_hsl_range),
        cmocka_unit_test(hsl24_of_all_colors),
        cmocka_unit_test(truth_of_hsl24),
    };
    return cmocka_run_group_tests_name("kernels of color", tests, NULL, NULL);
}

const kernel_family kernels_color = {cases, sizeof cases / sizeof cases[0], truths};
