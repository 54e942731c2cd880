/* Kernels that make masks of gray rows, and what they count for it. */
#include "kernels.h"

static uint8_t limit;
static iris_row_window window;

static void choose_limit(void)
{
    static const uint8_t limits[] = {0, 1, 127, 128, 254, 255};
    limit = random_below(2) ? limits[random_below(6)] : (uint8_t)random_below(256);
}

static void choose_window(void)
{
    static const int32_t sides[] = {1, 3, 5, 15, 25, 101, 1023, 2047};
    static const int32_t levels[] = {-255, -1, 0, 1, 20, 255};
    window.side = sides[random_below(8)];
    window.c = random_below(2) ? levels[random_below(6)] : (int32_t)random_below(511) - 255;
}

static void fill_near_limit(uint8_t *row, size_t bytes)
{
    fill_u8_near(row, bytes, limit);
}

/* Sums of columns of the window's side. */
static void fill_columns(uint8_t *row, size_t bytes)
{
    uint32_t kind = random_below(4), level = random_below(256), most = 255u * (uint32_t)window.side;
    for (size_t i = 0; i < bytes / 4; i++) {
        uint32_t sum = kind == 0   ? 0
                       : kind == 1 ? most
                       : kind == 2 ? most / 255 * level /* the mean is this level exactly */
                                   : random_below(most + 1);
        memcpy(row + 4 * i, &sum, 4);
    }
}

static int32_t more_columns(void)
{
    return window.side - 1;
}

static void run_above(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_above_u8)(words(rows[0]), rows[1], limit, n);
}

static void run_scan8(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_scan8_u8)((iris_block8 *)(void *)rows[0], rows[1], n);
}

static void run_slide(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_slide_u32)(words(rows[0]), rows[1], rows[2], n);
}

static void run_slide_u16(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_slide_u16)((uint16_t *)(void *)rows[0], rows[1], rows[2], n);
}

static void run_above_mean(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_above_mean_u8)(words(rows[0]), rows[1], words(rows[2]), window, n);
}

static const kernel_case cases[] = {
    {KERNEL(iris_row_above_u8), run_above, choose_limit, {ROW_MASK, ROW(1, 1, 1, fill_near_limit)}},
    {KERNEL(iris_row_scan8_u8), run_scan8, NULL, {ROW(8, 4, 2, fill_u8), ROW_U8}},
    {KERNEL(iris_row_slide_u32), run_slide, NULL, {ROW_U32, ROW_U8, ROW_U8}},
    {KERNEL(iris_row_slide_u16), run_slide_u16, NULL, {ROW_U16, ROW_U8, ROW_U8}},
    {KERNEL(iris_row_above_mean_u8),
     run_above_mean,
     choose_window,
     {ROW_MASK, ROW_U8, ROW_MORE(1, 4, 4, fill_columns, more_columns)}},
};

/* ---- truths ---- */

static void truth_of_above(void **state)
{
    (void)state;
    static const uint8_t pattern[4] = {99, 100, 101, 255};
    static const struct {
        uint8_t limit, bits; /* one for each of the pattern */
    } expected[] = {{100, 12}, {0, 15}, {98, 15}, {254, 8}, {255, 0}};
    uint8_t src[N];
    for (int i = 0; i < N; i++) {
        src[i] = pattern[i % 4];
    }
    BOTH_BODIES(plain)
    {
        for (size_t e = 0; e < sizeof expected / sizeof expected[0]; e++) {
            uint32_t mask[MASK_WORDS] = {0x12345678u, 0xffffffffu};
            uint8_t *rows[] = {(uint8_t *)mask, src};
            limit = expected[e].limit;
            run_above(plain, rows, N);
            for (int i = 0; i < N; i++) {
                assert_int_equal(bit(mask, i), expected[e].bits >> i % 4 & 1);
            }
            assert_int_equal(mask[1] >> (N - 32), 0xffffffffu >> (N - 32));
        }
    }
}

static void truth_of_scan8(void **state)
{
    (void)state;
    uint8_t src[N];
    for (int i = 0; i < N; i++) {
        src[i] = (uint8_t)(i % 8 * 36); /* 0, 36, ... 252 */
    }
    static const uint8_t limits[7] = {0, 1, 36, 37, 252, 253, 100}, below[7] = {0, 1, 1, 3, 127, 255, 7};
    BOTH_BODIES(plain)
    {
        iris_block8 blocks[7];
        for (int b = 0; b < 7; b++) {
            blocks[b] = (iris_block8){0xffff, limits[b], 0xaa};
        }
        uint8_t *rows[] = {(uint8_t *)blocks, src};
        run_scan8(plain, rows, N);
        for (int b = 0; b < 7; b++) {
            assert_int_equal(blocks[b].sum, b < 6 ? 28 * 36 : 10 * 36); /* the last has 5 pixels */
            assert_int_equal(blocks[b].below, below[b]);
            assert_int_equal(blocks[b].limit, limits[b]);
        }
    }
}

static void truth_of_slide(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        uint32_t sums[N];
        uint16_t halves_too[N];
        uint8_t enter[N], leave[N], *rows[] = {(uint8_t *)sums, enter, leave};
        uint8_t *rows_u16[] = {(uint8_t *)halves_too, enter, leave};
        for (int i = 0; i < N; i++) {
            sums[i] = i % 3 == 0 ? 1000u : i % 3 == 1 ? 0u : 0xffffffffu;
            halves_too[i] = (uint16_t)sums[i];
            enter[i] = i % 3 == 1 ? 0 : 255;
            leave[i] = i % 3 == 2 ? 254 : 255;
        }
        run_slide(plain, rows, N);
        run_slide_u16(plain, rows_u16, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(halves_too[i], (uint16_t)sums[i]);
            assert_int_equal(sums[i], i % 3 == 0 ? 1000u : i % 3 == 1 ? 0xffffff01u : 0u);
        }
    }
}

/* Columns that rise by 9 * k: over 3 of them and 3 rows the mean at pixel i is 3 (i + 1). */
static void truth_of_above_mean(void **state)
{
    (void)state;
    uint32_t sums[N + 2];
    uint8_t src[N];
    for (uint32_t i = 0; i < N + 2; i++) {
        sums[i] = 9 * i;
    }
    for (int i = 0; i < N; i++) {
        src[i] = (uint8_t)(3 * (i + 1) + i % 3 - 1); /* one below, at, and above the mean */
    }
    BOTH_BODIES(plain)
    {
        for (int c = -2; c <= 2; c++) {
            uint32_t mask[MASK_WORDS] = {0, 0};
            uint8_t *rows[] = {(uint8_t *)mask, src, (uint8_t *)sums};
            window = (iris_row_window){3, c};
            run_above_mean(plain, rows, N);
            for (int i = 0; i < N; i++) {
                assert_int_equal(bit(mask, i), i % 3 - 1 > -c);
            }
            assert_int_equal(mask[1] >> (N - 32), 0);
        }
    }
}

static int truths(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(truth_of_above),
        cmocka_unit_test(truth_of_scan8),
        cmocka_unit_test(truth_of_slide),
        cmocka_unit_test(truth_of_above_mean),
    };
    return cmocka_run_group_tests_name("kernels of threshold", tests, NULL, NULL);
}

const kernel_family kernels_threshold = {cases, sizeof cases / sizeof cases[0], truths};
