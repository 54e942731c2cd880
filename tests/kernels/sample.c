/* Kernels that take samples from other places. */
#include "kernels.h"

static void run_halve2(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_halve2_u8)(rows[0], rows[1], rows[2], n);
}

/* ---- between ---- */

/* Sources of this many bytes; their places begin anywhere and are up to so far apart. */
enum { SOURCE = 1024 };
static int32_t first_at, farthest, places_step;
static uint32_t places_down;

static void choose_places(void)
{
    static const uint32_t extremes[] = {0, 1, IRIS_ROW_WHOLE / 2, IRIS_ROW_WHOLE - 1, IRIS_ROW_WHOLE};
    uint32_t which = random_below(8);
    farthest = (int32_t)random_below(6);
    first_at = (int32_t)random_below(20);
    places_step = random_below(2) ? 1 : 3;
    places_down = which < 5 ? extremes[which] : random_below(IRIS_ROW_WHOLE + 1);
}

/* The sources end with the last sample that is read. */
static void run_between(int plain, uint8_t **rows, int32_t n)
{
    int32_t at[KERNEL_ROOM / 16], place = first_at;
    uint16_t weight[KERNEL_ROOM / 16];
    int32_t last = 0;
    for (int32_t i = 0; i < n; i++) {
        at[i] = place + i % places_step;
        weight[i] = (uint16_t)((uint32_t)(i * 611) % (IRIS_ROW_WHOLE + 1));
        last = at[i] > last ? at[i] : last;
        int32_t room = SOURCE - 6 - place, far = i * 7 % (farthest + 1);
        place += i % places_step < places_step - 1 ? 0 : far < room ? far : room;
    }
    int32_t unused = SOURCE - 1 - places_step - last;
    const uint8_t *const two[2] = {rows[1] + unused, rows[2] + unused};
    const iris_row_places places = {at, weight, places_step};
    BODY(plain, iris_row_between_u8)(rows[0], two, &places, places_down, n);
}

/* ---- columns ---- */

static int32_t beyond; /* bytes between two rows of dst */

static void choose_beyond(void)
{
    beyond = (int32_t)random_below(9);
}

/* Of 24 bytes for each row. */
static void run_columns(int plain, uint8_t **rows, int32_t n)
{
    const uint8_t *from[16];
    for (int k = 0; k < 16; k++) {
        from[k] = rows[1] + k * n;
    }
    BODY(plain, iris_row_columns16_u8)(rows[0], 16 + beyond, from, n);
}

/* From the last row on. */
static void run_columns_up(int plain, uint8_t **rows, int32_t n)
{
    const uint8_t *from[16];
    for (int k = 0; k < 16; k++) {
        from[k] = rows[1] + (15 - k) * n;
    }
    BODY(plain, iris_row_columns16_u8)(rows[0] + (n > 0 ? n - 1 : 0) * 17, -17, from, n);
}

/* ---- reversed, and one of three ---- */

static void run_reverse(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_reverse_u8)(rows[0], rows[1], n);
}

static void run_reverse_in_place(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_reverse_u8)(rows[0], rows[0], n);
}

/* Nothing is read behind the last sample, whichever of the three it is. */
static int32_t third;

static void choose_third(void)
{
    third = (int32_t)random_below(3);
}

static void run_every_third(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_every_third_u8)(rows[0], rows[1] + third, n);
}

/* ---- along ---- */

/* A picture whose last byte is the last one that may be read, or with its rows from the last one up. */
enum { WAY_W = 61, WAY_H = 40, WAY_STRIDE = 64, WAY_BYTES = WAY_STRIDE * (WAY_H - 1) + WAY_W };
static int32_t way_ends[2][2], way_is_up;

static void choose_way(void)
{
    way_is_up = (int32_t)random_below(2);
    for (int end = 0; end < 2; end++) {
        for (int axis = 0; axis < 2; axis++) {
            uint32_t side = axis ? WAY_H : WAY_W, last = (side - 1) * 65536u - 1, which = random_below(8);
            way_ends[end][axis] = (int32_t)(which == 0 ? 0 : which == 1 ? last : random_below(last + 1));
        }
    }
}

static void run_along(int plain, uint8_t **rows, int32_t n)
{
    int32_t steps = n > 1 ? n - 1 : 1;
    iris_row_way way = {rows[1], WAY_STRIDE, way_ends[0][0], way_ends[0][1], 0, 0};
    way.dx = (way_ends[1][0] - way_ends[0][0]) / steps;
    way.dy = (way_ends[1][1] - way_ends[0][1]) / steps;
    if (way_is_up) {
        way.src += WAY_STRIDE * (WAY_H - 1);
        way.stride = -WAY_STRIDE;
    }
    BODY(plain, iris_row_along_u8)(rows[0], &way, n);
}

/* ---- along a way with bends ---- */

/* A wide picture, for vectors of 16 bytes; places that hardly move from one to the next, or go anywhere. */
static int32_t bend_bits, bend_far;
static uint32_t bend_seed;

static void choose_bends(void)
{
    static const int32_t far[] = {0, 3000, 70000, 600000, 10000000};
    choose_way();
    bend_bits = (int32_t)random_below(5);
    bend_far = far[random_below(5)];
    bend_seed = random_below(UINT32_MAX);
}

static int32_t beside(int32_t place, int32_t side, uint32_t *seed)
{
    int32_t last =
        (side - 1) * 65536 - 128; /* steps are rounded: a place may be that far beyond the next one */
    *seed = *seed * 1664525u + 1013904223u;
    int64_t next = place + ((int64_t)*seed * (2 * bend_far + 1) >> 32) - bend_far;
    return (int32_t)(next < 128 ? 128 : next > last ? last : next) / 16 * 16;
}

/* To the right by a pixel each, with bends, and back to the left end when the right one is reached. */
static void run_bends(int plain, uint8_t **rows, int32_t n)
{
    static int32_t places[2 * 1026];
    iris_row_bends way = {rows[1], WAY_STRIDE, WAY_W, bend_bits, places};
    uint32_t seed = bend_seed;
    int32_t x = beside(way_ends[0][0], WAY_W, &seed), y = beside(way_ends[0][1], WAY_H, &seed);
    for (int32_t k = 0; k == 0 || (k - 1) << bend_bits < n; k++) {
        places[2 * k] = x;
        places[2 * k + 1] = y;
        x += 65536 << bend_bits;
        x = beside(x < (WAY_W - 1) * 65536 ? x : 0, WAY_W, &seed);
        y = beside(y, WAY_H, &seed);
    }
    if (way_is_up) {
        way.src += WAY_STRIDE * (WAY_H - 1);
        way.stride = -WAY_STRIDE;
    }
    BODY(plain, iris_row_bends_u8)(rows[0], &way, n);
}

static const kernel_case cases[] = {
    {KERNEL(iris_row_halve2_u8), run_halve2, NULL, {ROW_U8, ROW(1, 2, 1, fill_u8), ROW(1, 2, 1, fill_u8)}},
    {KERNEL(iris_row_between_u8),
     run_between,
     choose_places,
     {ROW_U8, TABLE(SOURCE, 1, fill_u8), TABLE(SOURCE, 1, fill_u8)}},
    {KERNEL(iris_row_columns16_u8),
     run_columns,
     choose_beyond,
     {ROW(1, 24, 1, fill_u8), ROW(1, 16, 1, fill_u8)}},
    {KERNEL(iris_row_columns16_u8), run_columns_up, NULL, {ROW(1, 17, 1, fill_u8), ROW(1, 16, 1, fill_u8)}},
    {KERNEL(iris_row_reverse_u8), run_reverse, NULL, {ROW_U8, ROW_U8}},
    {KERNEL(iris_row_reverse_u8), run_reverse_in_place, NULL, {ROW_U8}},
    {KERNEL(iris_row_every_third_u8), run_every_third, choose_third, {ROW_U8, ROW_888}},
    {KERNEL(iris_row_along_u8), run_along, choose_way, {ROW_U8, TABLE(WAY_BYTES, 1, fill_u8)}},
    {KERNEL(iris_row_bends_u8), run_bends, choose_bends, {ROW_U8, TABLE(WAY_BYTES, 1, fill_u8)}},
};

/* ---- truths ---- */

static void truth_of_halve2(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        uint8_t dst[N], upper[2 * N], lower[2 * N], *rows[] = {dst, upper, lower};
        for (int i = 0; i < N; i++) {
            upper[2 * i] = (uint8_t)i;
            upper[2 * i + 1] = (uint8_t)(i + i % 4); /* a quarter, a half, and three quarters too much */
            lower[2 * i] = lower[2 * i + 1] = (uint8_t)i;
        }
        run_halve2(plain, rows, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(dst[i], i + (i % 4 >= 2));
        }
        memset(upper, 255, sizeof upper);
        memset(lower, 255, sizeof lower);
        run_halve2(plain, rows, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(dst[i], 255);
        }
    }
}

/* Ramps: what lies between is between their numbers. */
static void truth_of_between(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        for (int step = 1; step <= 3; step += 2) {
            int32_t at[N];
            uint16_t weight[N];
            uint8_t dst[N], upper[3 * N], lower[3 * N];
            const uint8_t *const rows[2] = {upper, lower};
            const iris_row_places places = {at, weight, step};
            for (int i = 0; i < 3 * N; i++) {
                upper[i] = (uint8_t)i;
                lower[i] = (uint8_t)(i + 40);
            }
            for (int i = 0; i < N; i++) {
                at[i] = 2 * i;
                weight[i] = (uint16_t)(i % 3 * 1024);
            }
            BODY(plain, iris_row_between_u8)(dst, rows, &places, 512, N);
            for (int i = 0; i < N; i++) {
                assert_int_equal(dst[i], (2 * (2 * i + 10) + i % 3 * step + 1) / 2);
            }
        }
    }
}

static void truth_of_columns(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        static uint8_t dst[N * 20], src[16 * N];
        uint8_t *rows[] = {dst, src};
        for (int i = 0; i < 16 * N; i++) {
            src[i] = (uint8_t)(i / N * 16 + i % N % 13);
        }
        memset(dst, 255, sizeof dst);
        beyond = 4;
        run_columns(plain, rows, N);
        for (int i = 0; i < N * 20; i++) {
            assert_int_equal(dst[i], i % 20 < 16 ? i % 20 * 16 + i / 20 % 13 : 255);
        }
    }
}

/* A plane, which rises by 3 to the right and by 2 down, along a diagonal in quarters and halves of a pixel. */
static void truth_of_along(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        static uint8_t src[16 * 30];
        uint8_t dst[N];
        const iris_row_way way = {src, 16, 0, 0, 65536 / 4, 65536 / 2};
        for (int i = 0; i < 16 * 30; i++) {
            src[i] = (uint8_t)(3 * (i % 16) + 2 * (i / 16));
        }
        BODY(plain, iris_row_along_u8)(dst, &way, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(dst[i], (3 * i + 4 * i + 2) / 4);
        }
    }
}

/* The same plane; down first, and back up. */
static void truth_of_bends(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        static uint8_t src[32 * 30];
        static const int32_t places[16] = {0, 0,        4 << 16, 2 << 16,  8 << 16, 0, 12 << 16, 0, 16 << 16,
                                           0, 20 << 16, 0,       20 << 16, 8 << 16, 0, 8 << 16};
        uint8_t dst[N];
        const iris_row_bends way = {src, 32, 32, 3, places};
        for (int i = 0; i < 32 * 30; i++) {
            src[i] = (uint8_t)(3 * (i % 32) + 2 * (i / 32));
        }
        BODY(plain, iris_row_bends_u8)(dst, &way, N);
        for (int i = 0; i < N; i++) {
            int from = i / 8, part = i % 8, at[2];
            for (int k = 0; k < 2; k++) {
                at[k] = (places[2 * from + k] * (8 - part) + places[2 * from + 2 + k] * part) >>
                        17; /* quarters */
            }
            assert_int_equal(dst[i], (3 * at[0] + 2 * at[1] + 2) / 4);
        }
    }
}

static void truth_of_order(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        for (int n = 1; n <= N; n++) {
            uint8_t src[3 * N], dst[N], *rows[2] = {dst, src};
            for (int i = 0; i < 3 * N; i++) {
                src[i] = (uint8_t)(i + 5);
            }
            run_reverse(plain, rows, n);
            for (int i = 0; i < n; i++) {
                assert_int_equal(dst[i], n - 1 - i + 5);
            }
            third = n % 3;
            run_every_third(plain, rows, n);
            for (int i = 0; i < n; i++) {
                assert_int_equal(dst[i], 3 * i + third + 5);
            }
        }
    }
}

static int truths(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(truth_of_halve2),  cmocka_unit_test(truth_of_between),
        cmocka_unit_test(truth_of_columns), cmocka_unit_test(truth_of_order),
        cmocka_unit_test(truth_of_along),   cmocka_unit_test(truth_of_bends),
    };
    return cmocka_run_group_tests_name("kernels of samples", tests, NULL, NULL);
}

const kernel_family kernels_sample = {cases, sizeof cases / sizeof cases[0], truths};
