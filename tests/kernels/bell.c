/* Kernels of Gaussians. */
#include "kernels.h"

static int32_t radius, step;
static int16_t weights[IRIS_BELL_RADIUS + 1];

/* Any weights that sum to 2^15, each side counted; all in one place too. */
static void choose_weights(void)
{
    int32_t rest = 1 << 14, kind = (int32_t)random_below(3);
    radius = 1 + (int32_t)random_below(IRIS_BELL_RADIUS);
    step = random_below(2) ? 1 : 3;
    for (int32_t k = radius; k > 0; k--) {
        weights[k] = (int16_t)(kind == 0 ? 0 : random_below((uint32_t)rest));
        rest -= weights[k];
    }
    if (2 * rest > INT16_MAX) { /* the center would not fit */
        weights[1] = 1;
        rest--;
    }
    weights[0] = (int16_t)(2 * rest);
}

/* Sums with 6 fraction bits, up to the greatest that there are. */
static void fill_sums(uint8_t *row, size_t bytes)
{
    uint32_t kind = random_below(3);
    for (size_t i = 0; i + 2 <= bytes; i += 2) {
        int16_t sum = (int16_t)(kind == 0   ? 255 * 64 + 3
                                : kind == 1 ? random_below(2) * 255 * 64
                                            : random_below(255 * 64 + 4));
        memcpy(row + i, &sum, 2);
    }
}

static void run_down(int plain, uint8_t **rows, int32_t n)
{
    const uint8_t *around[2 * IRIS_BELL_RADIUS + 1];
    for (int r = 0; r <= 2 * IRIS_BELL_RADIUS; r++) {
        around[r] = rows[r + 1];
    }
    BODY(plain, iris_row_bell_down)(halves(rows[0]), around, weights, radius, n);
}

static void run_across(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_bell_across)(halves(rows[0]), halves(rows[1]), weights, radius, step, n);
}

static void run_across_u8(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_bell_across_u8)(rows[0], halves(rows[1]), weights, radius, step, n);
}

/* Wide ones, as many distances as the harness has room for; weights of 2^17 in all. */
static int32_t wide_radius, wide_at[81];
static int16_t wide_weights[41];

static void choose_wide(void)
{
    int32_t rest = 1 << 17;
    wide_radius = 1 + (int32_t)random_below(40);
    step = random_below(2) ? 1 : 3;
    for (int32_t k = 0; k <= wide_radius; k++) {
        int32_t most = rest / 2 < INT16_MAX ? rest / 2 : INT16_MAX;
        wide_weights[k] = (int16_t)(random_below(4) ? random_below((uint32_t)most + 1) : (uint32_t)most);
        rest -= 2 * wide_weights[k];
    }
    for (int32_t k = 0; k <= 2 * wide_radius; k++) {
        wide_at[k] = (int32_t)random_below(241) - 120;
    }
}

static void fill_plain_sums(uint8_t *row, size_t bytes)
{
    for (size_t i = 0; i + 2 <= bytes; i += 2) {
        int16_t sum = (int16_t)(random_below(3) ? random_below(255 * 64 + 1) : 255 * 64);
        memcpy(row + i, &sum, 2);
    }
}

static void run_wide_down(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_wide_down)(halves(rows[0]), rows[1], wide_at, wide_weights, wide_radius, n);
}

static void run_wide_across(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_wide_across)(halves(rows[0]), halves(rows[1]), wide_weights, wide_radius, step, n);
}

static void run_wide_across_u8(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_wide_across_u8)(rows[0], halves(rows[1]), wide_weights, wide_radius, step, n);
}

#define WIDE_SUMS ROW_AROUND(1, 2, 2, fill_plain_sums, 120, 120)
#define SUMS      ROW_AROUND(1, 2, 2, fill_sums, 3 * IRIS_BELL_RADIUS, 3 * IRIS_BELL_RADIUS)

static const kernel_case cases[] = {
    {KERNEL(iris_row_bell_down),
     run_down,
     choose_weights,
     {ROW_S16, ROW_U8, ROW_U8, ROW_U8, ROW_U8, ROW_U8, ROW_U8, ROW_U8, ROW_U8, ROW_U8, ROW_U8, ROW_U8}},
    {KERNEL(iris_row_bell_across), run_across, choose_weights, {ROW_S16, SUMS}},
    {KERNEL(iris_row_wide_down), run_wide_down, choose_wide, {ROW_S16, ROW_U8_AROUND(120, 120)}},
    {KERNEL(iris_row_wide_across), run_wide_across, choose_wide, {ROW_S16, WIDE_SUMS}},
    {KERNEL(iris_row_wide_across_u8), run_wide_across_u8, choose_wide, {ROW_U8, WIDE_SUMS}},
    {KERNEL(iris_row_bell_across_u8), run_across_u8, choose_weights, {ROW_U8, SUMS}},
};

/* ---- truths ---- */

/* 1 2 1 of 0, 255, and 1: 127.75, and its rounding; one of the sides weighs less than half a unit and is lost. */
static void truth_of_down(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        int16_t out[N];
        uint8_t row[3][N], *rows[12] = {(uint8_t *)out, row[0], row[1], row[2]};
        memset(row[0], 0, N);
        memset(row[1], 255, N);
        memset(row[2], 1, N);
        radius = 1;
        weights[0] = 16384;
        weights[1] = 8192;
        run_down(plain, rows, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(out[i], 127 * 64 + 48);
        }
        weights[0] = 32766;
        weights[1] = 1;
        run_down(plain, rows, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(out[i], 255 * 64 - 1); /* 16319.004 and 0.002 */
        }
    }
}

static void truth_of_across(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        int16_t sums[N + 30], out[N];
        uint8_t bytes[N], *rows[2] = {(uint8_t *)out, (uint8_t *)(sums + 15)},
                          *to_bytes[2] = {bytes, rows[1]};
        for (int i = 0; i < N + 30; i++) {
            sums[i] = (int16_t)(i % 2 ? 64 * 200 : 0);
        }
        radius = 2;
        step = 1;
        weights[0] = 16384;
        weights[1] = 4096;
        weights[2] = 4096; /* 3/4 of the same, 1/4 of the other */
        run_across(plain, rows, N);
        run_across_u8(plain, to_bytes, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(out[i], i % 2 ? 64 * 50 : 64 * 150);
            assert_int_equal(bytes[i], i % 2 ? 50 : 150);
        }
    }
}

/* 900, 800, 700... where one row of many, or one sample, is not 0, by how far away that is. */
static void truth_of_wide(void **state)
{
    (void)state;
    for (int32_t k = 0; k < 9; k++) {
        wide_weights[k] = (int16_t)(1600 * (9 - k));
    }
    BOTH_BODIES(plain)
    {
        for (wide_radius = 1; wide_radius <= 8; wide_radius++) {
            for (int32_t which = -wide_radius; which <= wide_radius; which++) {
                uint8_t pixels[2 * N], *down[2] = {NULL, pixels}, *across[2];
                int16_t out[N], src[N + 48];
                memset(pixels, 0, N);
                memset(pixels + N, 128, N);
                memset(src, 0, sizeof src);
                for (int32_t k = 0; k <= 2 * wide_radius; k++) {
                    wide_at[k] = k == wide_radius + which ? N : 0;
                }
                down[0] = across[0] = (uint8_t *)out;
                across[1] = (uint8_t *)(src + 24);
                run_wide_down(plain, down, N);
                for (int32_t i = 0; i < N; i++) {
                    assert_int_equal(out[i], 100 * (9 - abs(which)));
                }
                step = which % 2 ? 1 : 3;
                src[24 + 25 + which * step] = 8192;
                run_wide_across(plain, across, N);
                assert_int_equal(out[25], 100 * (9 - abs(which)));
            }
        }
    }
}

/* The last that is rounded down, and the first that is rounded up; and the greatest that there is. */
static void truth_of_wide_rounding(void **state)
{
    (void)state;
    static const int16_t center[3] = {1023, 1024, 16384}, sample[4] = {3, 4, 255, 256};
    BOTH_BODIES(plain)
    {
        uint8_t bytes[N], pixels[N], *rows[2], *to_bytes[2];
        int16_t out[N], src[N + 16];
        rows[0] = (uint8_t *)out;
        to_bytes[0] = bytes;
        to_bytes[1] = (uint8_t *)(src + 8);
        memset(wide_at, 0, sizeof wide_at);
        memset(wide_weights, 0, sizeof wide_weights);
        memset(pixels, 1, N);
        wide_radius = 8;
        step = 1;
        for (int k = 0; k < 4; k++) {
            wide_weights[0] = center[k < 2 ? k : 2];
            for (int i = 0; i < N + 16; i++) {
                src[i] = sample[k];
            }
            rows[1] = pixels;
            run_wide_down(plain, rows, N);
            assert_int_equal(out[7], k == 0 ? 0 : k == 1 ? 1 : 8);
            wide_weights[0] = 16384;
            rows[1] = to_bytes[1];
            run_wide_across(plain, rows, N);
            run_wide_across_u8(plain, to_bytes, N);
            assert_int_equal(out[7], k == 0 ? 0 : k == 1 ? 1 : 32);
            assert_int_equal(bytes[7], k == 3);
        }
        for (int i = 0; i < N + 16; i++) {
            src[i] = 255 * 64;
        }
        for (int k = 0; k <= 8; k++) {
            wide_weights[k] = k < 8 ? 8192 : 4096; /* 2^17 in all */
        }
        memset(pixels, 255, N);
        rows[1] = pixels;
        run_wide_down(plain, rows, N);
        assert_int_equal(out[52], 255 * 64);
        rows[1] = to_bytes[1];
        run_wide_across(plain, rows, N);
        run_wide_across_u8(plain, to_bytes, N);
        assert_int_equal(out[52], 255 * 64);
        assert_int_equal(bytes[52], 255);
    }
}

static int truths(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(truth_of_down),
        cmocka_unit_test(truth_of_across),
        cmocka_unit_test(truth_of_wide),
        cmocka_unit_test(truth_of_wide_rounding),
    };
    return cmocka_run_group_tests_name("kernels of bell", tests, NULL, NULL);
}

const kernel_family kernels_bell = {cases, sizeof cases / sizeof cases[0], truths};
