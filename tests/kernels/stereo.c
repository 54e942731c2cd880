/* Kernels of stereo pairs. */
#include "kernels.h"

/* Pixels have at most so many steps; those that have fewer leave the beginning of the row's memory alone. */
enum { STEPS = 32 };
static int32_t steps, apart;

/* Whole vectors, less, and more. */
static void choose_steps(void)
{
    static const int32_t whole[] = {8, 16, 24, 32, 32, 32};
    uint32_t which = random_below(8);
    steps = which < 6 ? whole[which] : 2 + (int32_t)random_below(STEPS - 1);
    apart = steps + (int32_t)random_below((uint32_t)(STEPS + 1 - steps));
}

static int32_t more_steps(void)
{
    return steps - 1;
}

static uint16_t *cells(uint8_t *row, int32_t n)
{
    return (uint16_t *)(void *)row + (STEPS - steps) * n;
}

/* ---- what places differ by ---- */

static void run_census(int plain, uint8_t **rows, int32_t n)
{
    const uint8_t *const around[5] = {rows[3], rows[4], rows[5], rows[6], rows[7]};
    BODY(plain, iris_row_census_u8)(rows, around, n);
}

/* Both, the census alone, gray levels alone. */
static uint32_t planes;

static void choose_pair(void)
{
    choose_steps();
    planes = random_below(3);
}

/* Of four rows each, the right ones longer. */
static iris_row_pair pair_of(uint8_t *const *left, uint8_t *const *right, int32_t n)
{
    iris_row_pair pair = {.steps = steps};
    for (int k = planes == 2 ? 3 : 0; k < (planes == 1 ? 3 : 4); k++) {
        pair.left[k] = left[k];
        pair.right[k] = right[k] + (n > 0 ? n - 1 : 0);
    }
    return pair;
}

static void run_costs(int plain, uint8_t **rows, int32_t n)
{
    const iris_row_pair pair = pair_of(rows + 1, rows + 5, n);
    BODY(plain, iris_row_costs_u8)(rows[0] + (STEPS - steps) * n, &pair, n);
}

/* What leaves is of the same rows, in another order. */
static void run_slide_costs(int plain, uint8_t **rows, int32_t n)
{
    uint8_t *const others[4] = {rows[6], rows[7], rows[8], rows[5]};
    const iris_row_pair enter = pair_of(rows + 1, rows + 5, n), leave = pair_of(others, others, n);
    BODY(plain, iris_row_slide_costs_u16)(cells(rows[0], n), &enter, &leave, n);
}

static void run_add_costs(int plain, uint8_t **rows, int32_t n)
{
    const iris_row_pair enter = pair_of(rows + 1, rows + 5, n);
    BODY(plain, iris_row_slide_costs_u16)(cells(rows[0], n), &enter, NULL, n);
}

static void run_roll(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_roll_u16)
    (cells(rows[0], n), cells(rows[1], n), cells(rows[2], n), steps, n);
}

static void run_tiles(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_tiles_u16)(cells(rows[0], n), rows[1] + (STEPS - steps) * n, steps, n);
}

static uint16_t weight;

static void choose_weight(void)
{
    weight = (uint16_t)random_below(65536);
}

static void run_weigh(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_weigh_u16)((uint16_t *)(void *)rows[0], (uint16_t *)(void *)rows[1], weight, n);
}

/* ---- which of them are alike ---- */

static void run_least(int plain, uint8_t **rows, int32_t n)
{
    uint16_t *const to = (uint16_t *)(void *)rows[0];
    const iris_row_least least = {to, (uint16_t *)(void *)rows[1], (uint16_t *)(void *)rows[2],
                                  (uint16_t *)(void *)rows[3]};
    int32_t unused = n > 0 ? STEPS * n - (n - 1) * apart - steps : 0;
    BODY(plain, iris_row_least_u16)(&least, (uint16_t *)(void *)rows[4] + unused, steps, apart, n);
}

static void run_parabola(int plain, uint8_t **rows, int32_t n)
{
    const iris_row_least least = {(uint16_t *)(void *)rows[1], (uint16_t *)(void *)rows[2],
                                  (uint16_t *)(void *)rows[3], (uint16_t *)(void *)rows[4]};
    BODY(plain, iris_row_parabola_u16)((uint16_t *)(void *)rows[0], &least, n);
}

static void run_facing(int plain, uint8_t **rows, int32_t n)
{
    int32_t last = n > 0 ? n - 1 : 0;
    BODY(plain, iris_row_facing_u16)
    ((uint16_t *)(void *)rows[0] + last, (uint16_t *)(void *)rows[1] + last, cells(rows[2], n), steps, n);
}

/* ---- paths ---- */

static uint16_t one_step, has_sums, in_place;

static void choose_paths(void)
{
    choose_steps();
    one_step = (uint16_t)random_below(random_below(2) ? 60 : 10001);
    has_sums = (uint16_t)random_below(2);
    in_place = (uint16_t)random_below(2);
}

static iris_row_ground ground_of(const uint8_t *costs, const uint8_t *leaps, int32_t n)
{
    return (iris_row_ground){costs + (STEPS - steps) * n, (const uint16_t *)(void *)leaps, steps, one_step};
}

static void run_paths(int plain, uint8_t **rows, int32_t n)
{
    const iris_row_ground ground = ground_of(rows[2], rows[3], n);
    BODY(plain, iris_row_paths_u16)
    (cells(rows[0], n), cells(rows[in_place ? 0 : 4], n), has_sums ? cells(rows[1], n) : NULL, &ground, n);
}

static void run_paths_along(int plain, uint8_t **rows, int32_t n)
{
    static uint16_t room[2 * STEPS];
    const iris_row_ground ground = ground_of(rows[1], rows[2], n);
    BODY(plain, iris_row_paths_along_u16)(cells(rows[0], n), room, &ground, n);
}

/* ---- medians ---- */

static void run_median25(int plain, uint8_t **rows, int32_t n)
{
    const uint16_t *around[5];
    for (int k = 0; k < 5; k++) {
        around[k] = (const uint16_t *)(void *)rows[1 + k];
    }
    BODY(plain, iris_row_median25_u16)((uint16_t *)(void *)rows[0], around, n);
}

#define AROUND      ROW_U8_AROUND(2, 2)
#define WIDE_AROUND ROW_S16_AROUND(2, 2)
#define LONGER      ROW_MORE(1, 1, 1, fill_u8, more_steps)
#define WIDE_LONGER ROW_MORE(1, 2, 2, fill_u16, more_steps)
#define CELLS_U8    ROW(1, STEPS, 1, fill_u8)
#define CELLS_U16   ROW(1, 2 * STEPS, 2, fill_u16)
#define FOUR(row)   row, row, row, row
#define FIVE(row)   row, row, row, row, row

static const kernel_case cases[] = {
    {KERNEL(iris_row_census_u8), run_census, NULL, {ROW_U8, ROW_U8, ROW_U8, FIVE(AROUND)}},
    {KERNEL(iris_row_costs_u8), run_costs, choose_pair, {CELLS_U8, FOUR(ROW_U8), FOUR(LONGER)}},
    {KERNEL(iris_row_slide_costs_u16), run_slide_costs, choose_pair, {CELLS_U16, FOUR(ROW_U8), FOUR(LONGER)}},
    {KERNEL(iris_row_slide_costs_u16), run_add_costs, choose_pair, {CELLS_U16, FOUR(ROW_U8), FOUR(LONGER)}},
    {KERNEL(iris_row_roll_u16),
     run_roll,
     choose_steps,
     {ROW_AROUND(1, 2 * STEPS, 2, fill_u16, 1, 0), CELLS_U16, CELLS_U16}},
    {KERNEL(iris_row_tiles_u16), run_tiles, choose_steps, {CELLS_U16, CELLS_U8}},
    {KERNEL(iris_row_weigh_u16), run_weigh, choose_weight, {ROW_U16, ROW_U16}},
    {KERNEL(iris_row_least_u16), run_least, choose_steps, {FOUR(ROW_U16), CELLS_U16}},
    {KERNEL(iris_row_parabola_u16), run_parabola, NULL, {ROW_U16, FOUR(ROW_U16)}},
    {KERNEL(iris_row_facing_u16), run_facing, choose_steps, {WIDE_LONGER, WIDE_LONGER, CELLS_U16}},
    {KERNEL(iris_row_median25_u16), run_median25, NULL, {ROW_U16, FIVE(WIDE_AROUND)}},
    {KERNEL(iris_row_paths_u16),
     run_paths,
     choose_paths,
     {CELLS_U16, CELLS_U16, CELLS_U8, ROW_U16, CELLS_U16}},
    {KERNEL(iris_row_paths_along_u16),
     run_paths_along,
     choose_paths,
     {CELLS_U16, CELLS_U8, ROW_AROUND(1, 2, 2, fill_u16, 0, 1)}},
};

/* ---- truths ---- */

/* A ramp to the right: what is left of a pixel is darker, 2 of 5 in each row. A dot is darker than none, and all around it
 * see no darker pixel but those that they had. */
static void truth_of_census(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        uint8_t made[3][N], row[N + 4], *rows[8] = {made[0], made[1], made[2]};
        for (int i = 0; i < N + 4; i++) {
            row[i] = (uint8_t)(3 * i);
        }
        for (int k = 3; k < 8; k++) {
            rows[k] = row + 2;
        }
        run_census(plain, rows, N);
        for (int i = 0; i < N; i++) {
            int bits = 0;
            for (int k = 0; k < 24; k++) {
                bits += made[k / 8][i] >> k % 8 & 1;
            }
            assert_int_equal(bits, 10);
        }
    }
}

/* Step d is the d-th pixel to the left: levels differ by 2 d, up to 32, and the census by as many bits as d mod 4. */
static void truth_of_costs(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        static uint8_t left[4][N], right[4][N + STEPS], costs[N * STEPS];
        static uint16_t sums[N * STEPS];
        steps = STEPS;
        for (int i = 0; i < N + STEPS; i++) {
            int x = N - 1 - i; /* which pixel it is */
            for (int k = 0; k < 3; k++) {
                right[k][i] = (x & 3) > k ? 255 : 0;
                left[k][i < N ? i : 0] = 0;
            }
            right[3][i] = (uint8_t)(100 + 2 * x);
            left[3][i < N ? N - 1 - i : 0] = (uint8_t)(100 + 2 * (i < N ? N - 1 - i : 0));
        }
        uint8_t *rows[9] = {costs,    left[0],  left[1],  left[2], left[3],
                            right[0], right[1], right[2], right[3]};
        for (planes = 0; planes < 3; planes++) {
            rows[0] = costs;
            run_costs(plain, rows, N);
            for (int i = 0; i < N * STEPS; i++) {
                int x = i / STEPS, d = i % STEPS, gray = 2 * d < 32 ? 2 * d : 32, bits = 8 * ((x - d) & 3);
                assert_int_equal(costs[i], (planes != 1 ? gray : 0) + (planes != 2 ? bits : 0));
                sums[i] = (uint16_t)(i + 65000);
            }
            rows[0] = (uint8_t *)(void *)sums;
            run_add_costs(plain, rows, N);
            for (int i = 0; i < N * STEPS; i++) {
                assert_int_equal(sums[i], (uint16_t)(i + 65000 + costs[i]));
            }
            const iris_row_pair pair = pair_of(rows + 1, rows + 5, N);
            BODY(plain, iris_row_slide_costs_u16)(sums, &pair, &pair, N);
            assert_int_equal(sums[5], (uint16_t)(65005 + costs[5]));
            BODY(plain, iris_row_slide_costs_u16)(sums, &pair, NULL, N);
            assert_int_equal(sums[5], (uint16_t)(65005 + 2 * costs[5]));
        }
    }
}

static void truth_of_roll(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        static uint16_t sums[(N + 1) * STEPS], enter[N * STEPS], leave[N * STEPS];
        steps = STEPS;
        for (int i = 0; i < N * STEPS; i++) {
            enter[i] = (uint16_t)(i % STEPS + 7);
            leave[i] = 5;
            sums[i % STEPS] = 1000;
        }
        BODY(plain, iris_row_roll_u16)(sums + STEPS, enter, leave, steps, N);
        for (int i = 0; i < N * STEPS; i++) {
            assert_int_equal(sums[STEPS + i], 1000 + (i / STEPS + 1) * (i % STEPS + 2));
        }
    }
}

/* Ten pixels: two tiles of four, and one of two. */
static void truth_of_tiles(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        static uint16_t sums[4 * STEPS];
        static uint8_t costs[10 * STEPS];
        steps = STEPS;
        for (int i = 0; i < 10 * STEPS; i++) {
            costs[i] = (uint8_t)(i / STEPS + i % STEPS % 50);
        }
        for (int i = 0; i < 4 * STEPS; i++) {
            sums[i] = 65535;
        }
        BODY(plain, iris_row_tiles_u16)(sums, costs, steps, 10);
        for (int i = 0; i < STEPS; i++) {
            assert_int_equal(sums[i], 0 + 1 + 2 + 3 + 4 * (i % 50) - 1);
            assert_int_equal(sums[STEPS + i], 4 + 5 + 6 + 7 + 4 * (i % 50) - 1);
            assert_int_equal(sums[2 * STEPS + i], 8 + 9 + 2 * (i % 50) - 1);
            assert_int_equal(sums[3 * STEPS + i], 65535);
        }
    }
}

static void truth_of_weigh(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        uint16_t sums[N], src[N];
        for (int i = 0; i < N; i++) {
            sums[i] = 100;
            src[i] = (uint16_t)(500 * i);
        }
        BODY(plain, iris_row_weigh_u16)(sums, src, 3, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(sums[i], (uint16_t)(100 + 1500 * i));
        }
    }
}

/* A valley whose ground moves from pixel to pixel; and of two grounds that are as low, the first. */
static void truth_of_least(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        static uint16_t costs[N * STEPS];
        uint16_t found[4][N], dst[N];
        steps = apart = STEPS;
        for (int i = 0; i < N * STEPS; i++) {
            int d = i % STEPS, low = i / STEPS % STEPS, far = d > low ? 2 * (d - low) : 3 * (low - d);
            costs[i] = (uint16_t)(60000 + 10 * far);
        }
        costs[5 * STEPS + 20] = 60000;
        uint8_t *rows[5];
        for (int k = 0; k < 4; k++) {
            rows[k] = (uint8_t *)(void *)found[k];
        }
        rows[4] = (uint8_t *)(void *)costs;
        run_least(plain, rows, N);
        const iris_row_least least = {found[0], found[1], found[2], found[3]};
        BODY(plain, iris_row_parabola_u16)(dst, &least, N);
        for (int x = 0; x < N; x++) {
            int low = x % STEPS, inside = low > 0 && low < STEPS - 1;
            assert_int_equal(found[0][x], low);
            assert_int_equal(found[1][x], inside ? 60030 : 60000);
            assert_int_equal(found[2][x], 60000);
            assert_int_equal(found[3][x], inside ? 60020 : 60000);
            /* (30 - 20) / 2 / (30 + 20) of a step to the right: 25.6 of 256ths */
            assert_int_equal(dst[x], low == 0 ? 1 : low * 256 + (inside ? 26 : 0));
        }
    }
}

/* Of pixel x the cost d is best for the right picture's pixel x - d where d is 3. */
static void truth_of_facing(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        static uint16_t costs[N * STEPS], least[N + STEPS], step[N + STEPS];
        uint8_t *rows[3] = {(uint8_t *)(void *)least, (uint8_t *)(void *)step, (uint8_t *)(void *)costs};
        steps = STEPS;
        memset(least, 255, sizeof least);
        memset(step, 255, sizeof step);
        for (int i = 0; i < N * STEPS; i++) {
            costs[i] = (uint16_t)(i % STEPS == 3 ? 50 + i / STEPS : 40000);
        }
        run_facing(plain, rows, N);
        for (int i = 0; i < N + STEPS - 1; i++) {
            int x = N - 1 - i; /* of the right picture */
            int seen = x + 3 >= 0 && x + 3 < N;
            assert_int_equal(least[i], seen ? 50 + x + 3 : 40000);
            assert_int_equal(step[i], seen ? 3 : x < 0 ? -x : 0);
        }
    }
}

static void truth_of_median25(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        uint16_t dst[N], ramp[N + 4], high[N + 4];
        for (int i = 0; i < N + 4; i++) {
            ramp[i] = (uint16_t)(1000 * i);
            high[i] = 65535;
        }
        uint8_t *rows[6] = {(uint8_t *)(void *)dst};
        for (int k = 1; k < 6; k++) {
            rows[k] = (uint8_t *)(void *)(ramp + 2);
        }
        run_median25(plain, rows, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(dst[i], 1000 * (i + 2));
        }
        rows[2] = (uint8_t *)(void *)(high + 2); /* 5 of 25: the median is the 13th of 20 */
        run_median25(plain, rows, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(dst[i], 1000 * (i + 3));
        }
    }
}

/* Costs of 9 but for one step, 0. One step away costs 5, all others 8. */
static void truth_of_paths(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        static uint16_t paths[N * STEPS], sums[N * STEPS], leaps[N + 1], room[2 * STEPS];
        static uint8_t costs[N * STEPS];
        steps = STEPS;
        memset(paths, 0, sizeof paths);
        for (int i = 0; i < N * STEPS; i++) {
            costs[i] = i % STEPS == 7 ? 0 : 9;
            leaps[i / STEPS] = leaps[N] = 8;
            sums[i] = 100;
        }
        const iris_row_ground ground = {costs, leaps, STEPS, 5};
        BODY(plain, iris_row_paths_u16)(paths, paths, NULL, &ground, N);
        BODY(plain, iris_row_paths_u16)(paths, paths, sums, &ground, N);
        for (int i = 0; i < N * STEPS; i++) {
            int d = i % STEPS, far = d > 7 ? d - 7 : 7 - d;
            assert_int_equal(paths[i], far == 0 ? 0 : far == 1 ? 9 + 5 : 9 + 8);
            assert_int_equal(sums[i], 100 + paths[i]);
        }
        memset(sums, 0, sizeof sums);
        BODY(plain, iris_row_paths_along_u16)(sums, room, &ground, N);
        for (int i = 0; i < N * STEPS; i++) { /* at the ends one of the two begins */
            int x = i / STEPS, end = x == 0 || x == N - 1;
            assert_int_equal(sums[i], end ? costs[i] + paths[i] : 2 * paths[i]);
        }
    }
}

static int truths(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(truth_of_census), cmocka_unit_test(truth_of_costs),
        cmocka_unit_test(truth_of_roll),   cmocka_unit_test(truth_of_least),
        cmocka_unit_test(truth_of_tiles),  cmocka_unit_test(truth_of_weigh),
        cmocka_unit_test(truth_of_facing), cmocka_unit_test(truth_of_median25),
        cmocka_unit_test(truth_of_paths),
    };
    return cmocka_run_group_tests_name("kernels of stereo pairs", tests, NULL, NULL);
}

const kernel_family kernels_stereo = {cases, sizeof cases / sizeof cases[0], truths};
