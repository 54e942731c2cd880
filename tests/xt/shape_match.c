/* Descriptions and matches: known forms; heights in double precision; and real shapes, turned, scaled, and mirrored. */
#include <math.h>

#include "iris/xt/moments.h"
#include "iris/xt/shape.h"
#include "shape_mask.h"

#define TURN  6.283185307179586
#define REAL  30
#define N     IRIS_SHAPE_POINTS
#define GROUP IRIS_SHAPE_HEIGHTS_PER_POINT

static uint32_t words[(SHAPE_SIDE_MAX / 32 + 4) * SHAPE_SIDE_MAX];
static IRIS_SCRATCH_BUFFER(memory, IRIS_CONTOUR_SCRATCH_BYTES(SHAPE_SIDE_MAX, SHAPE_SIDE_MAX));
static shape drawn, turned;
static iris_shape models[REAL];
static int have_models;

static iris_scratch arena(size_t bytes)
{
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, bytes), IRIS_OK);
    return scratch;
}

static iris_image mask_of(const shape *s)
{
    size_t bytes = iris_format_row_bytes(IRIS_MASK1, s->w) * (size_t)s->h;
    return shape_mask(words, bytes, s, 0, ~0u);
}

/* With just the working memory that is needed. */
static iris_shape describe(const shape *s)
{
    iris_image mask = mask_of(s);
    iris_contour contour;
    iris_shape made;
    int32_t count;
    memset(&made, 0x55, sizeof made);
    iris_scratch scratch = arena(IRIS_SHAPE_DESCRIBE_SCRATCH_BYTES(s->w, s->h));
    iris_status status = iris_contour_find(&contour, 1, &count, &mask, &scratch);
    assert_true(status == IRIS_OK || status == IRIS_ERR_FULL);
    scratch = arena(IRIS_SHAPE_DESCRIBE_SCRATCH_BYTES(s->w, s->h));
    assert_int_equal(iris_shape_describe(&made, &contour, &mask, &scratch), IRIS_OK);
    assert_int_equal(scratch.used, 0);
    assert_int_equal(scratch.peak, IRIS_SHAPE_DESCRIBE_SCRATCH_BYTES(s->w, s->h));
    return made;
}

static iris_shape_found match(const iris_shape *s, const iris_shape *from, int32_t count,
                              const iris_shape_matching *config)
{
    iris_shape_library library = {from, count};
    iris_shape_found found;
    iris_scratch scratch = arena(IRIS_SHAPE_MATCH_SCRATCH_BYTES);
    assert_int_equal(iris_shape_match(&found, s, &library, config, &scratch), IRIS_OK);
    assert_int_equal(scratch.used, 0);
    assert_int_equal(scratch.peak, IRIS_SHAPE_MATCH_SCRATCH_BYTES);
    return found;
}

static void clear(int32_t w, int32_t h)
{
    drawn.w = w;
    drawn.h = h;
    memset(drawn.at, 0, sizeof drawn.at);
}

/* --- descriptions --- */

static void a_square_described(void **state)
{
    (void)state;
    for (int32_t at = 0; at < 40; at += 13) {
        clear(180, 170);
        for (int32_t y = 5; y < 102; y++) {
            memset(&drawn.at[y][10 + at], 1, 97);
        }
        drawn.at[0][0] = 1; /* something smaller */
        iris_shape s = describe(&drawn);
        assert_int_equal(s.class_index, 0);
        assert_int_equal(s.x_q16, (58 + at) << 16);
        assert_int_equal(s.y_q16, 53 << 16);
        assert_true(abs(s.diameter_q16 - (int32_t)(96 * sqrt(2) * 65536)) < 400);
        double side = IRIS_SHAPE_DIAMETER / sqrt(2);
        for (int i = 0; i < N; i++) { /* from the upper left corner clockwise, 16 steps a side */
            double along = i % 16 * side / 16 - side / 2, edge = side / 2;
            const double at_side[4][2] = {{along, -edge}, {edge, along}, {-along, edge}, {-edge, -along}};
            assert_true(fabs(s.x[i] - at_side[i / 16][0]) < 3 && fabs(s.y[i] - at_side[i / 16][1]) < 3);
        }
        for (int i = 0; i < IRIS_SHAPE_RAYS; i++) {
            double c = fabs(cos(TURN * i / 128)), r = 32768 / sqrt(2) / fmax(c, fabs(sin(TURN * i / 128)));
            assert_true(fabs(s.rays[i] - r) < 12);
        }
        assert_true(abs(s.moments_q20[0] - (1 << 20) / 6) < 100 && s.moments_q20[1] < 100);
    }
}

/* A hole is described as the part that would fill it, but for the pixel that its polygon is larger. */
static void a_hole_described(void **state)
{
    (void)state;
    clear(100, 100);
    for (int32_t i = 0; i < 10000; i++) {
        int32_t x = i % 100 - 50, y = i / 100 - 50;
        drawn.at[i / 100][i % 100] = x * x + 2 * y * y > 1200;
    }
    iris_image mask = mask_of(&drawn);
    iris_contour contours[2];
    int32_t count;
    iris_shape hole;
    iris_scratch scratch = arena(IRIS_SHAPE_DESCRIBE_SCRATCH_BYTES(100, 100));
    assert_int_equal(iris_contour_find(contours, 2, &count, &mask, &scratch), IRIS_OK);
    assert_true(count == 2 && contours[1].is_hole);
    assert_int_equal(iris_shape_describe(&hole, &contours[1], &mask, &scratch), IRIS_OK);
    for (int32_t i = 0; i < 10000; i++) {
        drawn.at[i / 100][i % 100] ^= 1;
    }
    iris_shape part = describe(&drawn);
    assert_int_equal(hole.x_q16, part.x_q16);
    assert_memory_equal(hole.rays, part.rays, sizeof part.rays);
    iris_shape_found found = match(&hole, &part, 1, NULL);
    assert_true(found.score_q16 > 40000); /* as it is, or turned by half a turn */
}

/* --- heights in double precision, over doubles from the same points --- */

static double heights[2][N][GROUP];

static void heights_slowly(int which, const iris_shape *s, int mirrored)
{
    double x[N], y[N];
    for (int i = 0; i < N; i++) {
        x[i] = mirrored ? -s->x[(N - i) % N] : s->x[i];
        y[i] = mirrored ? s->y[(N - i) % N] : s->y[i];
    }
    for (int i = 0; i < N; i++) {
        double tx = x[(i + 1) % N] - x[(i + N - 1) % N], ty = y[(i + 1) % N] - y[(i + N - 1) % N];
        double length = hypot(tx, ty);
        for (int k = 1; k < N; k++) {
            double height = tx * (y[(i + k) % N] - y[i]) - ty * (x[(i + k) % N] - x[i]);
            heights[which][i][(k - 1) / 3] +=
                k % 3 == 1 ? height / length / 3 - heights[which][i][(k - 1) / 3] : height / length / 3;
        }
    }
}

static double differ_slowly(int i, int j)
{
    double sum = 0;
    for (int g = 0; g < GROUP; g++) {
        sum += fabs(heights[0][i][g] - heights[1][j % N][g]);
    }
    return sum;
}

static double variety_slowly(int which)
{
    double sum = 0;
    for (int g = 0; g < GROUP; g++) {
        double mean = 0;
        for (int i = 0; i < N; i++) {
            mean += heights[which][i][g] / N;
        }
        for (int i = 0; i < N; i++) {
            sum += fabs(heights[which][i][g] - mean);
        }
    }
    return sum;
}

/* The score without mirroring, from the start with the least sum point by point. */
static double score_slowly(int mirrored, const iris_shape *a, const iris_shape *b)
{
    static double sums[N + 1][N + 1];
    heights_slowly(0, a, 0);
    heights_slowly(1, b, mirrored);
    int best = 0;
    double least = 1e30;
    for (int start = 0; start < N; start++) {
        double sum = 0;
        for (int i = 0; i < N; i++) {
            sum += differ_slowly(i, i + start);
        }
        best = sum < least ? start : best;
        least = sum < least ? sum : least;
    }
    for (int i = 0; i <= N; i++) {
        for (int j = 0; j <= N; j++) {
            sums[i][j] = i == 0 && j == 0 ? 0 : 1e30;
            if (i > 0 && j > 0 && abs(i - j) <= IRIS_SHAPE_GIVE) {
                sums[i][j] = fmin(sums[i - 1][j - 1], fmin(sums[i - 1][j], sums[i][j - 1])) +
                             differ_slowly(i - 1, j - 1 + best);
            }
        }
    }
    return fmax(0, 1 - sums[N][N] / ((variety_slowly(0) + variety_slowly(1)) / 2));
}

/* --- real shapes --- */

static void load_models(void)
{
    for (int i = 0; i < REAL && (i == 0 || have_models); i++) {
        have_models = shape_load(&drawn, shape_name(i));
        if (have_models) {
            models[i] = describe(&drawn);
            models[i].class_index = i / 3;
        }
    }
}

static void as_in_double_precision(void **state)
{
    (void)state;
    if (!have_models) {
        skip();
    }
    iris_shape_matching config;
    iris_shape_matching_defaults(&config, IRIS_SHAPE_HEIGHTS);
    int far = 0; /* rounding may choose another start when two are as good */
    for (int i = 0; i < 300; i++) {
        const iris_shape *a = &models[i % REAL], *b = &models[(i * 7 + i / 30) % REAL];
        config.mirrored = 0;
        double plain = score_slowly(0, a, b), mirrored = score_slowly(1, a, b);
        far += fabs(match(a, b, 1, &config).score_q16 / 65536.0 - plain) > 0.02;
        config.mirrored = 1;
        far += fabs(match(a, b, 1, &config).score_q16 / 65536.0 -
                    (mirrored > plain + 0.03125 ? mirrored : plain)) > 0.02;
    }
    assert_true(far <= 8);
}

static int leave_one_out(iris_shape_method method)
{
    int right = 0;
    iris_shape_matching config;
    iris_shape_matching_defaults(&config, method);
    config.least_q16 = 0;
    for (int i = 0; i < REAL; i++) {
        config.except = i;
        iris_shape_found found = match(&models[i], models, REAL, &config);
        assert_true(found.index != i && found.index >= 0 && found.class_index == found.index / 3);
        right += found.class_index == i / 3;
    }
    return right;
}

static void nearest_of_real_shapes(void **state)
{
    (void)state;
    if (!have_models) {
        skip();
    }
    assert_true(leave_one_out(IRIS_SHAPE_HEIGHTS) >= 28);
    assert_true(leave_one_out(IRIS_SHAPE_RADIAL) >= 24);
    assert_true(leave_one_out(IRIS_SHAPE_MOMENTS) >= 13);
}

/* `turned` is `drawn`, mirrored or not, turned clockwise, scaled. */
static void turn(double degrees, double scale, int mirrored)
{
    double c = cos(degrees / 360 * TURN) / scale, s = sin(degrees / 360 * TURN) / scale;
    int32_t side = (int32_t)(scale * hypot(drawn.w, drawn.h)) + 4;
    side = side > SHAPE_SIDE_MAX ? SHAPE_SIDE_MAX : side;
    memset(turned.at, 0, sizeof turned.at);
    turned.w = turned.h = side;
    for (int32_t i = 0; i < side * side; i++) {
        double x = i % side - side / 2.0, y = i / side - side / 2.0; /* NOLINT: halves of pixels */
        double from_x = c * x + s * y, from_y = c * y - s * x;
        from_x = (mirrored ? -from_x : from_x) + drawn.w / 2.0;
        turned.at[i / side][i % side] =
            (uint8_t)shape_at(&drawn, (int32_t)floor(from_x), (int32_t)floor(from_y + drawn.h / 2.0));
    }
}

static void turned_and_scaled(void **state)
{
    (void)state;
    if (!have_models) {
        skip();
    }
    static const int whole[] = {8, 12, 14, 24, 27}; /* without an axis of symmetry, but for the bone */
    uint32_t seed = 9;
    for (int k = 0; k < 5; k++) {
        int i = whole[k];
        assert_true(shape_load(&drawn, shape_name(i)));
        for (int round = 0; round < 8; round++) {
            int degrees = (int)(next_random(&seed) % 360), mirrored = round % 4 == 3;
            turn(degrees, 0.6 + next_random(&seed) % 90 / 100.0, mirrored);
            iris_shape s = describe(&turned);
            for (int method = 0; method < 3; method++) {
                iris_shape_matching config;
                iris_shape_matching_defaults(&config, (iris_shape_method)method);
                iris_shape_found found = match(&s, models, REAL, &config);
                assert_true(method != IRIS_SHAPE_HEIGHTS || found.class_index == i / 3);
                assert_true((i != 12 && i != 14) || found.index == i);
                if (method != IRIS_SHAPE_MOMENTS && (i == 12 || i == 14)) {
                    double error = remainder(found.angle / 65536.0 * 360 - degrees, 360);
                    assert_int_equal(found.mirrored, mirrored);
                    assert_true(fabs(error) < 3);
                }
            }
        }
    }
}

static void nothing_like_it(void **state)
{
    (void)state;
    if (!have_models) {
        skip();
    }
    uint32_t seed = 4;
    clear(160, 160);
    for (int32_t i = 0; i < 160 * 160; i++) {
        drawn.at[i / 160][i % 160] = next_random(&seed) % 100 < 62;
    }
    iris_shape noise = describe(&drawn);
    iris_shape_found found = match(&noise, models, REAL, NULL);
    assert_int_equal(found.class_index, IRIS_SHAPE_UNKNOWN);
    assert_true(found.index >= 0);
    found = match(&noise, NULL, 0, NULL);
    assert_true(found.class_index == IRIS_SHAPE_UNKNOWN && found.index == -1 && found.score_q16 == 0);
    iris_shape_matching config;
    iris_shape_matching_defaults(&config, IRIS_SHAPE_HEIGHTS);
    config.except = 0;
    assert_int_equal(match(&models[0], models, 1, &config).index, -1);
    config.except = 1;
    found = match(&models[0], models, 1, &config);
    assert_true(found.index == 0 && found.score_q16 == IRIS_Q16_ONE && found.angle == 0 && !found.mirrored);
}

static void smallest_shapes(void **state)
{
    (void)state;
    clear(2, 1);
    memset(drawn.at[0], 1, 2);
    iris_shape two = describe(&drawn);
    assert_int_equal(two.diameter_q16, 65536);
    assert_int_equal(match(&two, &two, 1, NULL).score_q16, IRIS_Q16_ONE);
    clear(SHAPE_SIDE_MAX, 1);
    memset(drawn.at[0], 1, SHAPE_SIDE_MAX);
    iris_shape line = describe(&drawn);
    assert_true(match(&two, &line, 1, NULL).score_q16 > 60000);
}

static void wrong_descriptions_are_refused(void **state)
{
    (void)state;
    static uint8_t bytes[64];
    iris_image gray, mask;
    assert_int_equal(iris_image_wrap(&gray, bytes, sizeof bytes, (iris_size){8, 8}, 0, IRIS_GRAY8), IRIS_OK);
    clear(32, 8);
    drawn.at[1][1] = drawn.at[4][4] = drawn.at[4][5] = 1;
    mask = mask_of(&drawn);
    iris_contour alone = {.x = 1, .y = 1}, pair = {.x = 4, .y = 4}, none = {.x = 8, .y = 3}, off = {.x = 32};
    iris_shape made, kept;
    memset(&made, 0x33, sizeof made);
    kept = made;
    iris_scratch exact = arena(IRIS_SHAPE_DESCRIBE_SCRATCH_BYTES(32, 8));
    iris_scratch less = arena(IRIS_SHAPE_DESCRIBE_SCRATCH_BYTES(32, 8) - 1);
    assert_int_equal(iris_shape_describe(NULL, &pair, &mask, &exact), IRIS_ERR_ARG);
    assert_int_equal(iris_shape_describe(&made, NULL, &mask, &exact), IRIS_ERR_ARG);
    assert_int_equal(iris_shape_describe(&made, &pair, NULL, &exact), IRIS_ERR_ARG);
    assert_int_equal(iris_shape_describe(&made, &pair, &mask, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_shape_describe(&made, &pair, &gray, &exact), IRIS_ERR_FORMAT);
    assert_int_equal(iris_shape_describe(&made, &alone, &mask, &exact), IRIS_ERR_RANGE);
    assert_int_equal(iris_shape_describe(&made, &none, &mask, &exact), IRIS_ERR_RANGE);
    assert_int_equal(iris_shape_describe(&made, &off, &mask, &exact), IRIS_ERR_RANGE);
    assert_int_equal(iris_shape_describe(&made, &pair, &mask, &less), IRIS_ERR_SCRATCH);
    assert_memory_equal(&made, &kept, sizeof made);
    assert_int_equal(iris_shape_describe(&made, &pair, &mask, &exact), IRIS_OK);
}

static void wrong_matches_are_refused(void **state)
{
    (void)state;
    clear(4, 4);
    drawn.at[1][1] = drawn.at[2][2] = drawn.at[1][2] = 1;
    iris_shape made = describe(&drawn);
    iris_shape_library library = {&made, 1}, negative = {&made, -1}, nowhere = {NULL, 1};
    iris_shape_found found = {7, 7, 7, 7, 7};
    iris_shape_matching c;
    iris_scratch exact = arena(IRIS_SHAPE_MATCH_SCRATCH_BYTES);
    iris_scratch less = arena(IRIS_SHAPE_MATCH_SCRATCH_BYTES - 1);
    assert_int_equal(iris_shape_match(NULL, &made, &library, NULL, &exact), IRIS_ERR_ARG);
    assert_int_equal(iris_shape_match(&found, NULL, &library, NULL, &exact), IRIS_ERR_ARG);
    assert_int_equal(iris_shape_match(&found, &made, NULL, NULL, &exact), IRIS_ERR_ARG);
    assert_int_equal(iris_shape_match(&found, &made, &negative, NULL, &exact), IRIS_ERR_ARG);
    assert_int_equal(iris_shape_match(&found, &made, &nowhere, NULL, &exact), IRIS_ERR_ARG);
    assert_int_equal(iris_shape_match(&found, &made, &library, NULL, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_shape_match(&found, &made, &library, NULL, &less), IRIS_ERR_SCRATCH);
    const iris_shape_matching good = {IRIS_SHAPE_RADIAL, 1, 0, -1, {0, 0, 0, 0}};
    for (int i = 0; i < 7; i++) {
        c = good;
        c.method = i == 0 ? (iris_shape_method)3 : c.method;
        c.mirrored = i == 1 ? 2 : 1;
        c.least_q16 = i == 2 ? 65537 : 0;
        c.except = i == 3 ? -2 : -1;
        c.tolerance.tolerance = i == 4 ? 32769 : 0;
        c.tolerance.cumulative_q16 = i == 5 ? -1 : 0;
        c.tolerance.missing_q16 = i == 6 ? 65537 : 0;
        assert_int_equal(iris_shape_match(&found, &made, &library, &c, &exact), IRIS_ERR_ARG);
    }
    for (int i = 0; i < 4; i++) {
        iris_shape bad = made;
        bad.class_index = i == 0 ? -1 : 0;
        bad.x[63] = i == 1 ? -4097 : 0;
        bad.rays[127] = i == 2 ? 32769 : 0;
        bad.moments_q20[3] = i == 3 ? -1 : 0;
        iris_shape_library hostile = {&bad, 1};
        assert_int_equal(iris_shape_match(&found, &made, &hostile, NULL, &exact), IRIS_ERR_RANGE);
        assert_int_equal(iris_shape_match(&found, &bad, &library, NULL, &exact), IRIS_ERR_RANGE);
    }
    assert_true(found.class_index == 7 && found.score_q16 == 7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_square_described),        cmocka_unit_test(a_hole_described),
        cmocka_unit_test(as_in_double_precision),    cmocka_unit_test(nearest_of_real_shapes),
        cmocka_unit_test(turned_and_scaled),         cmocka_unit_test(nothing_like_it),
        cmocka_unit_test(smallest_shapes),           cmocka_unit_test(wrong_descriptions_are_refused),
        cmocka_unit_test(wrong_matches_are_refused),
    };
    load_models();
    return cmocka_run_group_tests_name("shape_match", tests, NULL, NULL);
}
