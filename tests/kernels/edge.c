/* Kernels of edges: gradients, their sizes, and where they are greatest. */
#include "kernels.h"

#include "iris/fixed.h"

static int32_t more, low, high;
static uint32_t gain;
static uint8_t limit;

static void choose_more(void)
{
    static const int32_t common[3] = {128, 53, 0};
    more = random_below(4) ? common[random_below(3)] : (int32_t)random_below(129);
}

/* From 0 up to below 16.0, and the values next to where whole numbers begin. */
static void choose_gain(void)
{
    gain = random_below(2) ? random_below(16 * 65536) : random_below(16) * 65536u + random_below(3) - 1u;
    gain = gain >= 16 * 65536 ? 0 : gain >> random_below(16);
}

static void choose_limits(void)
{
    uint32_t most = random_below(2) ? 32768 : 600;
    low = (int32_t)random_below(most);
    high = low + (int32_t)random_below(32768u - (uint32_t)low);
    limit = (uint8_t)random_below(256);
}

/* Values around 0, and of either sign's extremes but one. */
static void fill_value(uint8_t *row, size_t bytes)
{
    uint32_t kind = random_below(3);
    fill_u16(row, bytes);
    for (size_t i = 0; i + 1 < bytes; i += 2) {
        int16_t *value = halves(row + i);
        *value = (int16_t)(kind == 0 ? *value % 3 : kind == 1 ? *value % 300 : *value);
        *value = *value == INT16_MIN ? 0 : *value;
    }
}

/* Sizes are not negative, and differences within what three bytes give. */
static void fill_size(uint8_t *row, size_t bytes)
{
    fill_u16(row, bytes);
    for (size_t i = 1; i < bytes; i += 2) {
        row[i] &= 0x7f;
    }
}

static void fill_difference(uint8_t *row, size_t bytes)
{
    fill_u16(row, bytes);
    for (size_t i = 0; i + 1 < bytes; i += 2) {
        int16_t *value = halves(row + i);
        *value = (int16_t)(random_below(8) ? *value % 1021 : *value % 3);
    }
}

static void run_gradient(int plain, uint8_t **rows, int32_t n)
{
    const iris_row_gradient to = {halves(rows[0]), halves(rows[1]), halves(rows[2])};
    const uint8_t *const around[3] = {rows[3], rows[4], rows[5]};
    BODY(plain, iris_row_gradient_u8)(&to, around, more, n);
}

static int32_t turn;

static void choose_turn(void)
{
    turn = random_below(2) ? 8192 * (int32_t)random_below(2) : (int32_t)random_below(65536);
}

static void run_direction(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_direction_s16)
    ((uint16_t *)halves(rows[0]), halves(rows[1]), halves(rows[2]), turn, n);
}

static void run_laplacian(int plain, uint8_t **rows, int32_t n)
{
    const uint8_t *const around[3] = {rows[1], rows[2], rows[3]};
    BODY(plain, iris_row_laplacian_u8)(halves(rows[0]), around, n);
}

static void run_crossings(int plain, uint8_t **rows, int32_t n)
{
    const int16_t *const around[3] = {halves(rows[1]), halves(rows[2]), halves(rows[3])};
    BODY(plain, iris_row_crossings_s16)(words(rows[0]), around, low, n);
}

static void run_gain(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_gain_s16)(rows[0], halves(rows[1]), gain, n);
}

static void choose_more_and_gain(void)
{
    choose_more();
    choose_gain();
    gain -= gain % 2 && random_below(8); /* odd ones are rare */
}

static void run_gradient_gain(int plain, uint8_t **rows, int32_t n)
{
    const uint8_t *const around[3] = {rows[1], rows[2], rows[3]};
    BODY(plain, iris_row_gradient_gain_u8)(rows[0], around, more, gain, n);
}

static void run_laplacian_gain(int plain, uint8_t **rows, int32_t n)
{
    const uint8_t *const around[3] = {rows[1], rows[2], rows[3]};
    BODY(plain, iris_row_laplacian_gain_u8)(rows[0], around, gain, n);
}

static void run_above(int plain, uint8_t **rows, int32_t n)
{
    BODY(plain, iris_row_above_s16)(words(rows[0]), halves(rows[1]), low, n);
}

static void run_ridges(int plain, uint8_t **rows, int32_t n)
{
    const iris_row_ridges from = {
        {halves(rows[2]), halves(rows[3]), halves(rows[4])}, halves(rows[5]), halves(rows[6]), low, high};
    BODY(plain, iris_row_ridges_s16)(words(rows[0]), words(rows[1]), &from, n);
}

static void run_unlike(int plain, uint8_t **rows, int32_t n)
{
    const uint8_t *const around[3] = {rows[1], rows[2], rows[3]};
    BODY(plain, iris_row_unlike_u8)(words(rows[0]), around, limit, n);
}

#define ROW3       ROW_U8_AROUND(1, 1)
#define ROW_VALUE  ROW(1, 2, 2, fill_value)
#define ROW_VALUE3 ROW_AROUND(1, 2, 2, fill_value, 1, 1)
#define ROW_SIZE3  ROW_AROUND(1, 2, 2, fill_size, 1, 1)
#define ROW_CHANGE ROW(1, 2, 2, fill_difference)

static const kernel_case cases[] = {
    {KERNEL(iris_row_gradient_u8), run_gradient, choose_more, {ROW_S16, ROW_S16, ROW_S16, ROW3, ROW3, ROW3}},
    {KERNEL(iris_row_direction_s16), run_direction, choose_turn, {ROW_U16, ROW_S16, ROW_S16}},
    {KERNEL(iris_row_laplacian_u8), run_laplacian, NULL, {ROW_S16, ROW3, ROW3, ROW3}},
    {KERNEL(iris_row_crossings_s16),
     run_crossings,
     choose_limits,
     {ROW_MASK, ROW_VALUE3, ROW_VALUE3, ROW_VALUE3}},
    {KERNEL(iris_row_gain_s16), run_gain, choose_gain, {ROW_U8, ROW_VALUE}},
    {KERNEL(iris_row_gradient_gain_u8), run_gradient_gain, choose_more_and_gain, {ROW_U8, ROW3, ROW3, ROW3}},
    {KERNEL(iris_row_laplacian_gain_u8),
     run_laplacian_gain,
     choose_more_and_gain,
     {ROW_U8, ROW3, ROW3, ROW3}},
    {KERNEL(iris_row_above_s16), run_above, choose_limits, {ROW_MASK, ROW_S16}},
    {KERNEL(iris_row_ridges_s16),
     run_ridges,
     choose_limits,
     {ROW_MASK, ROW_MASK, ROW_SIZE3, ROW_SIZE3, ROW_SIZE3, ROW_CHANGE, ROW_CHANGE}},
    {KERNEL(iris_row_unlike_u8), run_unlike, choose_limits, {ROW_MASK, ROW3, ROW3, ROW3}},
};

/* ---- truths ---- */

/* Every gradient that bytes give, of signs in turn, and the farthest ones: the angle of the vector alone. */
static void truth_of_direction(void **state)
{
    enum { MOST = 1020, ALL = MOST + 1 };
    static int16_t dx[ALL], dy[ALL];
    static uint16_t out[ALL];
    (void)state;
    BOTH_BODIES(plain)
    {
        for (int32_t down = 0; down <= ALL; down++) {
            for (int32_t i = 0; i < ALL; i++) {
                dx[i] = (int16_t)((down & 1 ? -1 : 1) * (down <= MOST ? i : INT16_MAX - i));
                dy[i] = (int16_t)((i & 1 ? -1 : 1) * (down <= MOST ? down : INT16_MIN + i));
            }
            uint8_t *rows[3] = {(uint8_t *)out, (uint8_t *)dx, (uint8_t *)dy};
            turn = 8192 * (down & 2);
            run_direction(plain, rows, ALL);
            for (int32_t i = 0; i < ALL; i++) {
                int32_t angle = dx[i] == 0 && dy[i] == 0 ? 0 : iris_atan2_angle(dy[i], dx[i]) + turn;
                assert_int_equal(out[i], (uint16_t)angle);
            }
        }
    }
}

/* A slope of 3 to the right and 5 down: 8 neighbors make dx 8 3 and dy 8 5 by Sobel's weights, 6 3 by Prewitt's. */
static void truth_of_gradient(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        int16_t to[3][N];
        uint8_t around[3][N + 2];
        uint8_t *rows[] = {(uint8_t *)to[0], (uint8_t *)to[1], (uint8_t *)to[2],
                           around[0] + 1,    around[1] + 1,    around[2] + 1};
        for (int i = 0; i < 3 * (N + 2); i++) {
            around[i % 3][i / 3] = (uint8_t)(3 * (i / 3) + 5 * (i % 3));
        }
        for (more = 0; more <= 128; more += 64) {
            run_gradient(plain, rows, N);
            for (int i = 0; i < N; i++) {
                int weight = 6 + more / 64; /* twice 3, and twice the share of the middle */
                assert_int_equal(to[0][i], 3 * weight);
                assert_int_equal(to[1][i], 5 * weight);
                assert_int_equal(to[2][i], 8 * weight);
            }
        }
    }
}

static void truth_of_gain(void **state)
{
    (void)state;
    static const int16_t sizes[] = {0, 1, -2, 509, -510, 511, -32767};
    static const struct {
        uint32_t gain;
        uint8_t levels[7];
    } expected[] = {{0, {0}},
                    {32768, {0, 1, 1, 255, 255, 255, 255}},
                    {16384, {0, 0, 1, 127, 128, 128, 255}},
                    {512, {0, 0, 0, 4, 4, 4, 255}},
                    {16 * 65536 - 1, {0, 16, 32, 255, 255, 255, 255}}};
    BOTH_BODIES(plain)
    {
        int16_t row[N];
        uint8_t dst[N], *rows[] = {dst, (uint8_t *)row};
        for (int i = 0; i < N; i++) {
            row[i] = sizes[i % 7];
        }
        for (size_t k = 0; k < sizeof expected / sizeof expected[0]; k++) {
            gain = expected[k].gain;
            run_gain(plain, rows, N);
            for (int i = 0; i < N; i++) {
                assert_int_equal(dst[i], expected[k].levels[i % 7]);
            }
        }
    }
}

/* Pixels two apart that differ by 80: Prewitt's size is 240, Sobel's 320. Lines that are 30 brighter: -60 on them, 30
 * beside them. */
static void truth_of_gains_at_once(void **state)
{
    (void)state;
    static const uint32_t gains[4] = {65536, 21845, 21846, 3 * 65536 / 4};
    static const uint8_t of_gradient[4][2] = {{240, 255}, {80, 107}, {80, 107}, {180, 240}};
    static const uint8_t of_laplacian[4][2] = {{60, 30}, {20, 10}, {20, 10}, {45, 23}};
    BOTH_BODIES(plain)
    {
        uint8_t out[N], slope[N + 2], line[N + 2];
        uint8_t *rows[2][4] = {{out, slope + 1, slope + 1, slope + 1}, {out, line + 1, line + 1, line + 1}};
        for (int i = 0; i < N + 2; i++) {
            slope[i] = (uint8_t)(i / 2 % 2 ? 200 : 120);
            line[i] = (uint8_t)(i % 3 == 1 ? 130 : 100);
        }
        for (int k = 0; k < 4; k++) {
            gain = gains[k];
            for (more = 0; more <= 128; more += 128) {
                run_gradient_gain(plain, rows[0], N);
                for (int i = 0; i < N; i++) {
                    assert_int_equal(out[i], of_gradient[k][more / 128]);
                }
            }
            run_laplacian_gain(plain, rows[1], N);
            for (int i = 0; i < N; i++) {
                assert_int_equal(out[i], of_laplacian[k][i % 3 != 0]);
            }
        }
    }
}

/* A hill of 7 on a slope that the sum of four does not see. */
static void truth_of_laplacian(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        int16_t to[N];
        uint8_t around[3][N + 2], *rows[] = {(uint8_t *)to, around[0] + 1, around[1] + 1, around[2] + 1};
        for (int i = 0; i < 3 * (N + 2); i++) {
            around[i % 3][i / 3] = (uint8_t)(3 * (i / 3) + 5 * (i % 3) + (i == 3 * 21 + 1 ? 7 : 0));
        }
        run_laplacian(plain, rows, N);
        for (int i = 0; i < N; i++) {
            assert_int_equal(to[i], i == 20 ? -28 : i == 19 || i == 21 ? 7 : 0);
        }
    }
}

/* Pairs and triples that cross or do not, along the row and down. */
static void truth_of_crossings(void **state)
{
    (void)state;
    static const struct {
        int16_t before, here, after;
        int from; /* thresholds up to this: a crossing at here; -1: none */
    } kinds[] = {{-50, 50, 60, -1},     {-51, 50, 60, 100},        {60, 50, -50, 99}, {60, 50, -49, -1},
                 {-30, 0, 30, 59},      {30, 0, 30, -1},           {-30, 0, 0, -1},   {0, 20, 0, -1},
                 {-32767, 0, 2, 32767}, {32767, -32766, 1, 32767}, {0, -20, 30, 49},  {-20, -20, 20, 39}};
    enum { KINDS = sizeof kinds / sizeof kinds[0], M = 3 * 19 };
    BOTH_BODIES(plain)
    {
        int16_t values[3][M + 2];
        uint32_t mask[2];
        uint8_t *rows[] = {(uint8_t *)mask, (uint8_t *)(values[0] + 1), (uint8_t *)(values[1] + 1),
                           (uint8_t *)(values[2] + 1)};
        for (int shift = 0; shift < 2 * KINDS; shift++) {
            memset(values, 0, sizeof values);
            for (int i = 1; i < M; i += 3) {
                int k = (i / 3 + shift) % KINDS, down = shift >= KINDS;
                values[1][i + 1] = kinds[k].here;
                values[down ? 0 : 1][down ? i + 1 : i] = kinds[k].before;
                values[down ? 2 : 1][down ? i + 1 : i + 2] = kinds[k].after;
            }
            static const int32_t thresholds[] = {0, 38, 39, 49, 50, 58, 59, 98, 99, 100, 101, 32767};
            for (size_t t = 0; t < sizeof thresholds / sizeof thresholds[0]; t++) {
                low = thresholds[t];
                run_crossings(plain, rows, M);
                for (int i = 1; i < M; i += 3) {
                    int k = (i / 3 + shift) % KINDS;
                    assert_int_equal(bit(mask, i), low <= kinds[k].from);
                }
            }
        }
    }
}

static void truth_of_above(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        int16_t row[N];
        uint32_t mask[MASK_WORDS] = {0};
        uint8_t *rows[] = {(uint8_t *)mask, (uint8_t *)row};
        for (int i = 0; i < N; i++) {
            row[i] = (int16_t)(i % 3 == 0 ? INT16_MIN : 99 + i % 3);
        }
        low = 100;
        run_above(plain, rows, N);
        for (int i = 0; i < 32 * MASK_WORDS; i++) {
            assert_int_equal(bit(mask, i), i < N && i % 3 == 2);
        }
    }
}

/* In turn: a ridge that stands upright, level, and on both diagonals, as high as one neighbor or the other. */
static void truth_of_ridges(void **state)
{
    (void)state;
    static const struct {
        int16_t dx, dy;     /* t is dx * 0.414 */
        int16_t size[3][3]; /* around the pixel */
        int passes;
    } kinds[] = {
        {100, 41, {{0, 0, 0}, {4, 5, 5}, {0, 0, 0}}, 1},   {100, 41, {{0, 9, 0}, {5, 5, 4}, {0, 9, 0}}, 0},
        {100, 42, {{4, 9, 9}, {9, 5, 9}, {9, 9, 4}}, 1},   {-100, -42, {{4, 9, 9}, {9, 5, 9}, {9, 9, 5}}, 0},
        {-100, 240, {{9, 9, 4}, {9, 5, 9}, {4, 9, 9}}, 1}, {100, -241, {{9, 9, 5}, {9, 5, 9}, {4, 9, 9}}, 0},
        {100, 242, {{9, 4, 9}, {9, 5, 9}, {9, 5, 9}}, 1},  {-100, 242, {{9, 5, 9}, {9, 5, 9}, {9, 4, 9}}, 0},
    };
    enum { KINDS = sizeof kinds / sizeof kinds[0], M = 3 * 19 };
    BOTH_BODIES(plain)
    {
        int16_t size[3][M + 2], dx[M], dy[M];
        uint32_t weak[2], strong[2];
        uint8_t *rows[] = {(uint8_t *)weak,
                           (uint8_t *)strong,
                           (uint8_t *)(size[0] + 1),
                           (uint8_t *)(size[1] + 1),
                           (uint8_t *)(size[2] + 1),
                           (uint8_t *)dx,
                           (uint8_t *)dy};
        for (int shift = 0; shift < KINDS; shift++) {
            for (int i = 0; i < M; i++) {
                int k = (i / 3 + shift) % KINDS;
                dx[i] = kinds[k].dx;
                dy[i] = kinds[k].dy;
                for (int y = 0; y < 3; y++) {
                    size[y][i + 1] = (int16_t)(10 * kinds[k].size[y][i % 3]);
                }
            }
            for (int y = 0; y < 3; y++) {
                size[y][0] = size[y][M + 1] = 0;
            }
            for (low = 49; low <= 50; low++) {
                for (high = low; high <= 50; high++) {
                    run_ridges(plain, rows, M);
                    for (int i = 1; i < M; i += 3) {
                        int passes = kinds[(i / 3 + shift) % KINDS].passes;
                        assert_int_equal(bit(weak, i), passes && low < 50);
                        assert_int_equal(bit(strong, i), passes && high < 50);
                    }
                }
            }
        }
    }
}

static void truth_of_unlike(void **state)
{
    (void)state;
    BOTH_BODIES(plain)
    {
        uint8_t around[3][N + 2];
        uint32_t mask[MASK_WORDS] = {0};
        uint8_t *rows[] = {(uint8_t *)mask, around[0] + 1, around[1] + 1, around[2] + 1};
        for (int i = 0; i < N + 2; i++) { /* pixel 10 is bright; above pixel 33, 40 more than below */
            around[0][i] = i == 34 ? 140 : 100;
            around[1][i] = i == 11 ? 255 : 0;
            around[2][i] = 100;
        }
        for (int level = 39; level <= 255; level += level == 39 || level == 254 ? 1 : 214) {
            limit = (uint8_t)level;
            run_unlike(plain, rows, N);
            for (int i = 0; i < 32 * MASK_WORDS; i++) {
                int expected = ((i == 9 || i == 11) && level < 255) || (i == 33 && level < 40);
                assert_int_equal(bit(mask, i), expected);
            }
        }
    }
}

static int truths(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(truth_of_gradient),  cmocka_unit_test(truth_of_gain),
        cmocka_unit_test(truth_of_direction), cmocka_unit_test(truth_of_gains_at_once),
        cmocka_unit_test(truth_of_laplacian), cmocka_unit_test(truth_of_crossings),
        cmocka_unit_test(truth_of_above),     cmocka_unit_test(truth_of_ridges),
        cmocka_unit_test(truth_of_unlike),
    };
    return cmocka_run_group_tests_name("kernels of edges", tests, NULL, NULL);
}

const kernel_family kernels_edge = {cases, sizeof cases / sizeof cases[0], truths};
