/* Kernels of morphology. */
#include "kernels.h"

static int32_t at[3], step;
static uint32_t all, beside[2];

static void choose_from(int32_t low, int32_t high)
{
    static const int32_t places[] = {-32, -31, -1, 0, 1, 31, 32, 33, 63};
    for (int k = 0; k < 3; k++) {
        do {
            at[k] = places[random_below(9)];
        } while (at[k] < low || at[k] > high);
    }
    all = random_below(2) ? ~0u : 0u;
}

static void choose_places(void)
{
    choose_from(-32, 63);
}

static void choose_places_behind(void)
{
    choose_from(0, 63);
}

static void choose_all(void)
{
    all = random_below(2) ? ~0u : 0u;
    for (int k = 0; k < 2; k++) {
        beside[k] = random_below(2) ? 0x80000001u : random_below(2) ? 0x7ffffffeu : 0;
    }
}

static void choose_step(void)
{
    step = random_below(2) ? 1 : 3;
}

static void run_max9(int plain, uint8_t **rows, int32_t n)
{
    const uint8_t *const around[3] = {rows[1], rows[2], rows[3]};
    BODY(plain, iris_row_max9_u8)(rows[0], around, step, n);
}

static void run_min9(int plain, uint8_t **rows, int32_t n)
{
    const uint8_t *const around[3] = {rows[1], rows[2], rows[3]};
    BODY(plain, iris_row_min9_u8)(rows[0], around, step, n);
}

static void run_max3(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_max3_u8)(rows[0], rows[1], rows[2], rows[3], n);
}

static void run_min3(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_min3_u8)(rows[0], rows[1], rows[2], rows[3], n);
}

static void run_max3_in_place(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_max3_u8)(rows[0], rows[0], rows[0] + 1, rows[0] + 3, n);
}

static void run_min3_in_place(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_min3_u8)(rows[0], rows[0] + 17, rows[0], rows[0] + 1, n);
}

static void run_minus(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_minus_u8)(rows[0], rows[1], rows[2], n);
}

static void run_minus_in_place(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_minus_u8)(rows[0], rows[1], rows[0], n);
}

static void run_join3(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_join3_mask)(words(rows[0]), words(rows[1]), at, all, (n + 31) / 32);
}

static void run_join3_in_place(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_join3_mask)(words(rows[0]), words(rows[0]), at, all, (n + 31) / 32);
}

static void run_join_rows(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_join_rows_mask)
    (words(rows[0]), words(rows[1]), words(rows[2]), words(rows[3]), all, (n + 31) / 32);
}

static void run_join_rows_in_place(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_join_rows_mask)
    (words(rows[0]), words(rows[1]), words(rows[0]), words(rows[2]), all, (n + 31) / 32);
}

static void run_mask_join9(int plain, uint8_t **rows, int32_t n)
{
    const uint32_t *const three[3] = {words(rows[1]), words(rows[2]), words(rows[3])};
    BODY(plain, iris_row_join9_mask)(words(rows[0]), three, beside, all, (n + 31) / 32);
}

static void run_agree(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_agree_mask)(words(rows[0]), words(rows[1]), at[0], all, (n + 31) / 32);
}

#define ROW3 ROW_U8_AROUND(3, 3)

static const kernel_case cases[] = {
    {KERNEL(iris_row_max9_u8), run_max9, choose_step, {ROW_U8, ROW3, ROW3, ROW3}},
    {KERNEL(iris_row_min9_u8), run_min9, choose_step, {ROW_U8, ROW3, ROW3, ROW3}},
    {KERNEL(iris_row_max3_u8), run_max3, NULL, {ROW_U8, ROW_U8, ROW_U8, ROW_U8}},
    {KERNEL(iris_row_max3_u8), run_max3_in_place, NULL, {ROW_U8_AROUND(0, 3)}},
    {KERNEL(iris_row_min3_u8), run_min3, NULL, {ROW_U8, ROW_U8, ROW_U8, ROW_U8}},
    {KERNEL(iris_row_min3_u8), run_min3_in_place, NULL, {ROW_U8_AROUND(0, 17)}},
    {KERNEL(iris_row_minus_u8), run_minus, NULL, {ROW_U8, ROW_U8, ROW_U8}},
    {KERNEL(iris_row_minus_u8), run_minus_in_place, NULL, {ROW_U8, ROW_U8}},
    {KERNEL(iris_row_join3_mask), run_join3, choose_places, {ROW_MASK, ROW_MASK_AROUND(32, 64)}},
    {KERNEL(iris_row_join3_mask), run_join3_in_place, choose_places_behind, {ROW_MASK_AROUND(0, 64)}},
    {KERNEL(iris_row_join_rows_mask), run_join_rows, choose_all, {ROW_MASK, ROW_MASK, ROW_MASK, ROW_MASK}},
    {KERNEL(iris_row_join_rows_mask), run_join_rows_in_place, choose_all, {ROW_MASK, ROW_MASK, ROW_MASK}},
    {KERNEL(iris_row_join9_mask), run_mask_join9, choose_all, {ROW_MASK, ROW_MASK, ROW_MASK, ROW_MASK}},
    {KERNEL(iris_row_agree_mask), run_agree, choose_places, {ROW_MASK, ROW_MASK_AROUND(32, 64)}},
};

/* ---- truths ---- */

static void truth_of_samples(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        uint8_t row[4][N], *rows[] = {row[0], row[1], row[2], row[3]};
        for (int i = 0; i < N; i++) {
            row[1][i] = (uint8_t)(i % 3 == 0 ? 255 : 100 + i);
            row[2][i] = (uint8_t)(i % 3 == 1 ? 255 : 90);
            row[3][i] = (uint8_t)(i % 3 == 2 ? 255 : 0);
        }
        run_max3(plain, rows, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(row[0][i], 255);
        }
        run_min3(plain, rows, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(row[0][i], i % 3 == 2 ? 90 : 0);
        }
        run_minus(plain, rows, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(row[0][i], i % 3 == 0 ? 165 : i % 3 == 1 ? 0 : 10 + i);
        }
    }
}

/* One pixel in the middle row, and one in the row below. */
static void truth_of_nine(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        for (step = 1; step <= 3; step += 2) {
            uint8_t row[4][N + 6], *rows[] = {row[0] + 3, row[1] + 3, row[2] + 3, row[3] + 3};
            memset(row, 100, sizeof row);
            rows[2][20] = 200;
            rows[3][40] = 50;
            run_max9(plain, rows, N);
            for (int i = 0; i < N; i++) {
                assert_int_equal(rows[0][i], i == 20 || i == 20 - step || i == 20 + step ? 200 : 100);
            }
            run_min9(plain, rows, N);
            for (int i = 0; i < N; i++) {
                assert_int_equal(rows[0][i], i == 40 || i == 40 - step || i == 40 + step ? 50 : 100);
            }
        }
    }
}

/* One pixel set, and one clear. */
static void truth_of_join3(void **state)
{
    (void)state;
    enum { WORDS = 6, SET = 77 };
    static const int32_t places[3] = {-1, 0, 33};
    BOTH_BODIES(plain)
    {
        for (int turn = 0; turn < 2; turn++) {
            uint32_t from[WORDS + 3] = {0}, to[WORDS] = {0};
            uint8_t *rows[] = {(uint8_t *)to, (uint8_t *)(from + 1)};
            from[1 + SET / 32] = (uint32_t)1 << SET % 32;
            for (int i = 0; i < WORDS + 3; i++) {
                from[i] ^= turn ? ~0u : 0u;
            }
            memcpy(at, places, sizeof at);
            all = turn ? ~0u : 0u;
            run_join3(plain, rows, 32 * WORDS);
            for (int i = 0; i < 32 * WORDS; i++) {
                assert_int_equal(bit(to, i), (i - 1 == SET || i == SET || i + 33 == SET) != turn);
            }
        }
    }
}

/* One pixel of the middle row is set, or all but it: at the ends of words and of the row, and where nothing is near. */
static void truth_of_mask_rows(void **state)
{
    (void)state;
    enum { WORDS = 9, PIXELS = 32 * WORDS };
    static const int32_t places[] = {0, 31, 32, 127, 128, 200, 255, 256, PIXELS - 1};
    BOTH_BODIES(plain)
    {
        for (int i = 0; i < 2 * (int)(sizeof places / sizeof places[0]); i++) {
            uint32_t row[4][WORDS] = {{0}};
            uint8_t *rows[] = {(uint8_t *)row[0], (uint8_t *)row[1], (uint8_t *)row[2], (uint8_t *)row[3]};
            int32_t place = places[i / 2];
            all = beside[0] = beside[1] = i % 2 ? ~0u : 0u;
            row[2][place / 32] = (uint32_t)1 << place % 32;
            for (int k = 0; k < 3 * WORDS; k++) {
                row[1 + k / WORDS][k % WORDS] ^= all;
            }
            run_join_rows(plain, rows, PIXELS);
            for (int x = 0; x < PIXELS; x++) {
                assert_int_equal(bit(row[0], x), (x == place) != i % 2);
            }
            run_mask_join9(plain, rows, PIXELS);
            for (int x = 0; x < PIXELS; x++) {
                assert_int_equal(bit(row[0], x), (x >= place - 1 && x <= place + 1) != i % 2);
            }
            beside[0] = all ^ 0x80000000u;
            beside[1] = all ^ 1u;
            run_mask_join9(plain, rows, PIXELS);
            assert_int_equal(bit(row[0], 0), !(i % 2));
            assert_int_equal(bit(row[0], PIXELS - 1), !(i % 2));
            assert_int_equal(bit(row[0], PIXELS / 2 - 20), i % 2);
        }
    }
}

/* Of the even pixels stay those whose pixel 33 farther on, then 1 before, is set or clear. */
static void truth_of_agree(void **state)
{
    (void)state;
    enum { WORDS = 6, SET = 77 };
    BOTH_BODIES(plain)
    {
        for (int i = 0; i < 4; i++) {
            uint32_t from[WORDS + 3] = {0}, to[WORDS];
            uint8_t *rows[] = {(uint8_t *)to, (uint8_t *)(from + 1)};
            memset(to, 0x55, sizeof to);
            from[1 + SET / 32] = (uint32_t)1 << SET % 32;
            at[0] = i / 2 ? 33 : -1;
            all = i % 2 ? ~0u : 0u;
            run_agree(plain, rows, 32 * WORDS);
            for (int x = 0; x < 32 * WORDS; x++) {
                assert_int_equal(bit(to, x), x % 2 == 0 && (x + at[0] == SET) != i % 2);
            }
        }
    }
}

static int truths(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(truth_of_samples), cmocka_unit_test(truth_of_nine),
        cmocka_unit_test(truth_of_join3),   cmocka_unit_test(truth_of_mask_rows),
        cmocka_unit_test(truth_of_agree),
    };
    return cmocka_run_group_tests_name("kernels of morphology", tests, NULL, NULL);
}

const kernel_family kernels_morph = {cases, sizeof cases / sizeof cases[0], truths};
