/* Tables of levels. */
#include "kernels.h"

static void run_tone(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_tone_u8)(rows[0], rows[1], rows[2], n);
}

static void run_tone_in_place(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_tone_u8)(rows[0], rows[0], rows[1], n);
}

/* Rows that are long enough for more than a look-up. */
enum { LONG = 40 };

static void run_long(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_tone_u8)(rows[0], rows[1], rows[2], LONG * n);
}

/* A straight line from black to white: rounded half up. */
static void fill_line(uint8_t *level, int32_t low, int32_t high)
{
    int32_t range = high - low;
    for (int32_t p = 0; p < 256; p++) {
        int32_t above = p - low;
        level[p] = (uint8_t)(above <= 0 ? 0 : above >= range ? 255 : (510 * above + range) / (2 * range));
    }
}

/* Sometimes off at one level. */
static void fill_levels(uint8_t *level, size_t bytes)
{
    (void)bytes;
    int32_t low = (int32_t)random_below(255);
    fill_line(level, low, low + 1 + (int32_t)random_below(255 - (uint32_t)low));
    level[random_below(256)] ^= (uint8_t)random_below(2);
}

static void run_extremes(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_extremes_u8)(rows[0], rows[1], n);
}

static const kernel_case cases[] = {
    {KERNEL(iris_row_tone_u8), run_tone, NULL, {ROW_U8, ROW_U8, TABLE(256, 1, fill_u8)}},
    {KERNEL(iris_row_tone_u8), run_tone_in_place, NULL, {ROW_U8, TABLE(256, 1, fill_levels)}},
    {KERNEL(iris_row_tone_u8),
     run_long,
     NULL,
     {ROW(1, LONG, 1, fill_u8), ROW(1, LONG, 1, fill_u8), TABLE(256, 1, fill_levels)}},
    {KERNEL(iris_row_extremes_u8), run_extremes, NULL, {TABLE(2, 1, fill_u8), ROW_U8}},
};

/* ---- truths ---- */

/* Both at each place in turn; and no sample is farther than what is given. */
static void truth_of_extremes(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        for (int i = 0; i < N; i++) {
            uint8_t src[N], extremes[2] = {255, 0}, far[2] = {1, 250}, *rows[2] = {extremes, src};
            memset(src, 100, sizeof src);
            src[i] = 7;
            src[(i + 11) % N] = 201;
            run_extremes(plain, rows, N);
            assert_int_equal(extremes[0], 7);
            assert_int_equal(extremes[1], 201);
            rows[0] = far;
            run_extremes(plain, rows, N);
            assert_int_equal(far[0], 1);
            assert_int_equal(far[1], 250);
        }
    }
}

static void check_all_levels(const uint8_t *level)
{
    static uint8_t src[LONG * 64], dst[LONG * 64];
    for (int i = 0; i < LONG * 64; i++) {
        src[i] = (uint8_t)(i * 7);
    }
    BOTH_BODIES(plain)
    {
        BODY(plain, iris_row_tone_u8)(dst, src, level, LONG * 64);
        for (int i = 0; i < LONG * 64; i++) {
            assert_int_equal(dst[i], level[src[i]]);
        }
    }
}

/* Of every range, from the first level on and to the last. */
static void every_line_is_its_table(void **state)
{
    (void)state;
    uint8_t level[256];
    for (int32_t range = 1; range < 256; range++) {
        fill_line(level, 0, range);
        check_all_levels(level);
        fill_line(level, 255 - range, 255);
        check_all_levels(level);
    }
}

static void a_table_is_what_it_says(void **state)
{
    (void)state;
    uint8_t level[256];
    for (int i = 0; i < 256; i++) {
        level[i] = (uint8_t)(i * 167 + 13);
    }
    check_all_levels(level);
    memset(level, 0, sizeof level);
    check_all_levels(level);
    memset(level, 255, sizeof level);
    check_all_levels(level);
}

static int truths(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_line_is_its_table),
        cmocka_unit_test(a_table_is_what_it_says),
        cmocka_unit_test(truth_of_extremes),
    };
    return cmocka_run_group_tests_name("kernels of tone", tests, NULL, NULL);
}

const kernel_family kernels_tone = {cases, sizeof cases / sizeof cases[0], truths};
