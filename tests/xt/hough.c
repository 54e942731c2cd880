/* Hough transform: votes worked out by formula, working memory, back to the image, wrong calls. */
#include "line_mask.h"

/* A few points give exactly the votes of the formula, computed in double precision. */
static void votes_are_the_formula(void **state)
{
    (void)state;
    iris_hough_config config = config_of(36, 2, 1);
    config.angle_min = -8192;
    config.angle_max = 12288; /* steps of 3.125 degrees */
    config.rho_min = -20;
    config.rho_max = 31;
    const int32_t points[][2] = {{0, 0}, {99, 40}, {58, 80}, {120, 3}, {120, 80}, {61, 40}};
    iris_scratch scratch = arena(sizeof memory);
    iris_hough hough;
    iris_image view;
    assert_int_equal(iris_hough_begin(&hough, (iris_size){61, 41}, &config, &scratch), IRIS_OK);
    assert_int_equal(iris_hough_accumulator(&view, &hough), IRIS_OK);
    assert_int_equal(iris_image_check(&view), IRIS_OK);
    assert_int_equal(view.format, IRIS_GRAY_U16);
    assert_int_equal(view.w, 26);
    assert_int_equal(view.h, 36);
    static int expected[36][26];
    memset(expected, 0, sizeof expected);
    for (size_t i = 0; i < sizeof points / sizeof points[0]; i++) {
        assert_int_equal(iris_hough_vote(&hough, points[i][0], points[i][1]), IRIS_OK);
        for (int t = 0; t < 36; t++) {
            double angle = floor(-8192 + t * 20480 / 36.0 + 0.5) / 32768 * PI;
            double rho = (points[i][0] / 2.0 - 30) * cos(angle) + (points[i][1] / 2.0 - 20) * sin(angle);
            double bin = (rho + 20) / 2;
            assert_true(fabs(bin - floor(bin + 0.5)) > 1e-3 ||
                        bin == floor(bin)); /* no doubt about the bin */
            if (bin >= 0 && bin < 26) {
                expected[t][(int)floor(bin)]++;
            }
        }
    }
    for (int t = 0; t < 36; t++) {
        const uint16_t *row = iris_image_row(&view, t);
        for (int r = 0; r < 26; r++) {
            assert_int_equal(row[r], expected[t][r]);
        }
    }
}

/* Six upright lines of different lengths, in an order of their own. */
static void the_best_are_kept_when_full(void **state)
{
    (void)state;
    const int32_t length[] = {50, 90, 70, 100, 60, 80}, ranked[] = {3, 1, 5, 2, 4, 0};
    iris_image mask = blank(201, 100);
    for (int32_t i = 0; i < 6; i++) {
        for (int32_t y = 0; y < length[i]; y++) {
            set(&mask, 10 + 36 * i, y);
        }
    }
    iris_hough_config config = config_of(60, 1, 50);
    config.angle_min = -1820;
    config.angle_max = 1820;
    for (int32_t capacity = 0; capacity <= 7; capacity++) {
        iris_hough_line lines[8];
        memset(lines, 0x55, sizeof lines);
        int32_t count = -1;
        iris_scratch scratch = arena(sizeof memory);
        iris_status status =
            iris_hough_lines(capacity ? lines : NULL, capacity, &count, &mask, &config, &scratch);
        assert_int_equal(status, capacity < 6 ? IRIS_ERR_FULL : IRIS_OK);
        assert_int_equal(count, 6);
        assert_int_equal(scratch.used, 0);
        for (int32_t k = 0; k < 8; k++) {
            if (k < capacity && k < 6) {
                assert_int_equal(lines[k].votes, length[ranked[k]]);
                assert_true(fabs(lines[k].rho_q16 / 65536.0 - (10 + 36 * ranked[k] - 100)) <= 1);
            } else {
                assert_int_equal(lines[k].votes, 0x55555555);
            }
        }
    }
}

static void votes_saturate(void **state)
{
    (void)state;
    iris_hough_config config = config_of(8, 1, 65535);
    iris_scratch scratch = arena(sizeof memory);
    iris_hough hough;
    iris_hough_line lines[10];
    int32_t count;
    assert_int_equal(iris_hough_begin(&hough, (iris_size){9, 9}, &config, &scratch), IRIS_OK);
    for (int32_t i = 0; i < 65534; i++) {
        iris_hough_vote(&hough, 8, 8);
    }
    assert_int_equal(iris_hough_peaks(lines, 10, &count, &hough), IRIS_OK);
    assert_int_equal(count, 0);
    for (int32_t i = 0; i < 3; i++) {
        iris_hough_vote(&hough, 8, 8);
    }
    assert_int_equal(iris_hough_peaks(lines, 10, &count, &hough), IRIS_OK);
    assert_true(count >= 1);
    assert_int_equal(lines[0].votes, 65535);
}

/* Row by row, point by point, and as a mask: the same votes, whatever the size, the stride, the bits past w. */
static void three_ways_to_vote_are_one(void **state)
{
    (void)state;
    for (int32_t w = 1; w <= 70; w += w < 31 ? 5 : 1) {
        iris_image whole = blank(w + 32, 9), mask;
        for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
            words[i] = 0xA5C3F096u * (uint32_t)(i + 7);
        }
        if (w % 2) {
            iris_image_wrap(&whole, words, sizeof words, (iris_size){w + 32, 9}, -20, IRIS_MASK1);
        }
        assert_int_equal(iris_image_crop(&mask, &whole, (iris_rect){32, 1, w, 7}), IRIS_OK);
        iris_hough_config config = config_of(12, 1, 1);
        iris_scratch scratch = arena(sizeof memory);
        iris_hough rows, points;
        assert_int_equal(iris_hough_begin(&rows, (iris_size){w, 7}, &config, &scratch), IRIS_OK);
        assert_int_equal(iris_hough_begin(&points, (iris_size){w, 7}, &config, &scratch), IRIS_OK);
        for (int32_t y = 0; y < 7; y++) {
            const uint32_t *row = iris_image_row(&mask, y);
            assert_int_equal(iris_hough_vote_row(&rows, row, y), IRIS_OK);
            for (int32_t x = 0; x < w; x++) {
                if (row[x / 32] >> x % 32 & 1) {
                    assert_int_equal(iris_hough_vote(&points, 2 * x, 2 * y), IRIS_OK);
                }
            }
        }
        iris_image a, b;
        iris_hough_accumulator(&a, &rows);
        iris_hough_accumulator(&b, &points);
        assert_int_equal(a.stride, b.stride);
        assert_memory_equal(a.data, b.data, (size_t)a.stride * (size_t)a.h);
        iris_hough_line by_rows[40], by_mask[40];
        int32_t row_count, mask_count;
        iris_status status = iris_hough_peaks(by_rows, 40, &row_count, &rows);
        assert_int_equal(iris_hough_lines(by_mask, 40, &mask_count, &mask, &config, &scratch), status);
        assert_int_equal(row_count, mask_count);
        for (int32_t i = 0; i < row_count && i < 40; i++) {
            assert_int_equal(by_rows[i].angle, by_mask[i].angle);
            assert_int_equal(by_rows[i].rho_q16, by_mask[i].rho_q16);
            assert_int_equal(by_rows[i].votes, by_mask[i].votes);
        }
    }
}

/* The largest sides and the corners, for the sanitizers; no vote falls out. */
static void the_largest_image(void **state)
{
    (void)state;
    const int32_t far = 2 * (IRIS_SIDE_MAX - 1);
    iris_hough_config config = config_of(16, 64, 1);
    iris_scratch scratch = arena(sizeof memory);
    iris_size size = {IRIS_SIDE_MAX, IRIS_SIDE_MAX};
    iris_hough hough;
    iris_image view;
    assert_int_equal(iris_hough_begin(&hough, size, &config, &scratch), IRIS_OK);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(iris_hough_vote(&hough, i % 2 ? far : 0, i / 2 ? far : 0), IRIS_OK);
    }
    assert_int_equal(iris_hough_accumulator(&view, &hough), IRIS_OK);
    for (int32_t t = 0; t < view.h; t++) {
        const uint16_t *row = iris_image_row(&view, t);
        int sum = 0;
        for (int32_t r = 0; r < view.w; r++) {
            sum += row[r];
        }
        assert_int_equal(sum, 4); /* no vote fell out */
    }
    iris_hough_line lines[1];
    int32_t count;
    assert_int_equal(iris_hough_peaks(lines, 1, &count, &hough), IRIS_ERR_FULL);
    assert_int_equal(lines[0].votes, 2);
    config.rho_step = 1;
    assert_int_equal(iris_hough_begin(&hough, size, &config, &scratch),
                     IRIS_ERR_RANGE); /* 46422 bins of rho */
    config.rho_min = 23000;
    assert_int_equal(iris_hough_begin(&hough, size, &config, &scratch), IRIS_OK);
    config.rho_min = 23212;
    assert_int_equal(iris_hough_begin(&hough, size, &config, &scratch), IRIS_ERR_RANGE);
}

/* Reach against the true distance of the farthest pixel, for every kind of size. */
static void reach_holds_every_pixel(void **state)
{
    (void)state;
    for (int32_t w = 1; w < IRIS_SIDE_MAX; w += 1 + w / 9) {
        for (int32_t h = 1; h < IRIS_SIDE_MAX; h += 1 + h / 7) {
            double truth = hypot(w - 1, h - 1) / 2, reach = (double)IRIS_HOUGH_REACH(w, h);
            assert_true(reach > truth && reach <= hypot(w, h) / 2 * 1.084 + 1);
        }
    }
}

static void scratch_is_exact(void **state)
{
    (void)state;
    const size_t bytes = IRIS_HOUGH_SCRATCH_BYTES(37, 23, 45);
    /* (12 * 37 + 5 * 23) / 24 + 1 = 24, so 48 bins of rho; 45 * 4 = 180 and 48 * 45 * 2 = 4320 in blocks of 16 */
    assert_int_equal(bytes, 192 + 4320);
    iris_image mask = blank(37, 23);
    draw(&mask, 10, 2);
    iris_hough_config config = config_of(45, 1, 10);
    iris_hough_line lines[4], before[4];
    int32_t count = 77;
    memset(lines, 0x33, sizeof lines);
    memcpy(before, lines, sizeof lines);
    iris_scratch scratch = arena(bytes - 1);
    assert_int_equal(iris_hough_lines(lines, 4, &count, &mask, &config, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(count, 77);
    assert_memory_equal(lines, before, sizeof lines);
    assert_int_equal(scratch.used, 0);
    scratch = arena(bytes);
    assert_int_equal(iris_hough_lines(lines, 4, &count, &mask, &config, &scratch), IRIS_OK);
    assert_int_equal(scratch.peak, bytes);
    /* -10 up to 15 by 4: 7 bins */
    config.rho_min = -10;
    config.rho_max = 15;
    config.rho_step = 4;
    scratch = arena(IRIS_HOUGH_BINS_SCRATCH_BYTES(7, 45));
    assert_int_equal(iris_hough_lines(lines, 4, &count, &mask, &config, &scratch), IRIS_OK);
    assert_int_equal(scratch.peak, IRIS_HOUGH_BINS_SCRATCH_BYTES(7, 45));
    scratch = arena(IRIS_HOUGH_BINS_SCRATCH_BYTES(7, 45) - 1);
    assert_int_equal(iris_hough_lines(lines, 4, &count, &mask, &config, &scratch), IRIS_ERR_SCRATCH);
}

static void assert_config_refused(iris_hough_config config)
{
    iris_scratch scratch = arena(sizeof memory);
    iris_hough hough;
    memset(&hough, 0x11, sizeof hough);
    iris_hough before = hough;
    assert_int_equal(iris_hough_begin(&hough, (iris_size){20, 20}, &config, &scratch), IRIS_ERR_ARG);
    assert_memory_equal(&hough, &before, sizeof hough);
    assert_int_equal(scratch.used, 0);
}

static void bad_configs_are_refused(void **state)
{
    (void)state;
    const int32_t bad[][2] = {{0, 0},     {0, 4097},   {1, 0},     {1, 3},   {1, 128}, {1, -1},
                              {2, 0},     {2, 65536},  {3, -1},    {3, 256}, {4, -1},  {4, 256},
                              {5, 16385}, {5, -16385}, {6, 16385}, {7, 0}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        iris_hough_config config;
        iris_hough_defaults(&config);
        switch (bad[i][0]) {
        case 0:
            config.theta_bins = bad[i][1];
            break;
        case 1:
            config.rho_step = bad[i][1];
            break;
        case 2:
            config.min_votes = bad[i][1];
            break;
        case 3:
            config.theta_separation = bad[i][1];
            break;
        case 4:
            config.rho_separation = bad[i][1];
            break;
        case 5:
            config.angle_min = (iris_angle)bad[i][1];
            break;
        case 6:
            config.angle_max = (iris_angle)bad[i][1];
            break;
        default:
            config.rho_min = config.rho_max = bad[i][1];
            break;
        }
        assert_config_refused(config);
    }
    iris_hough_defaults(NULL);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    iris_scratch scratch = arena(sizeof memory);
    iris_hough hough;
    iris_hough_line line;
    iris_hough_ends ends;
    int32_t count = 5;
    iris_image mask = blank(40, 30), gray;
    assert_int_equal(iris_image_wrap(&gray, words, 1200, (iris_size){40, 30}, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_hough_begin(NULL, (iris_size){40, 30}, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_begin(&hough, (iris_size){40, 30}, NULL, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_begin(&hough, (iris_size){0, 30}, NULL, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_hough_begin(&hough, (iris_size){40, 32768}, NULL, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_hough_begin(&hough, (iris_size){40, 30}, NULL, &scratch), IRIS_OK);
    const int32_t out[][2] = {
        {-1, 0}, {79, 0}, {0, -1}, {0, 59}, {INT32_MIN, INT32_MAX}, {INT32_MAX, INT32_MIN}};
    for (size_t i = 0; i < sizeof out / sizeof out[0]; i++) {
        assert_int_equal(iris_hough_vote(&hough, out[i][0], out[i][1]), IRIS_ERR_RANGE);
    }
    assert_int_equal(iris_hough_vote(NULL, 0, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_vote_row(&hough, words, -1), IRIS_ERR_RANGE);
    assert_int_equal(iris_hough_vote_row(&hough, words, 30), IRIS_ERR_RANGE);
    assert_int_equal(iris_hough_vote_row(&hough, NULL, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_vote_row(NULL, words, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_peaks(&line, -1, &count, &hough), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_peaks(NULL, 1, &count, &hough), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_peaks(&line, 1, NULL, &hough), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_peaks(&line, 1, &count, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_accumulator(NULL, &hough), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_accumulator(&gray, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_lines(&line, 1, &count, &gray, NULL, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_hough_lines(&line, 1, &count, NULL, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_lines(&line, 1, &count, &mask, NULL, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_lines(&line, 1, NULL, &mask, NULL, &scratch), IRIS_ERR_ARG);
    mask.w = 0;
    assert_int_equal(iris_hough_lines(&line, 1, &count, &mask, NULL, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(count, 5);
    line = (iris_hough_line){0, 0, 0};
    assert_int_equal(iris_hough_clip(NULL, &line, (iris_size){4, 4}), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_clip(&ends, NULL, (iris_size){4, 4}), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_clip(&ends, &line, (iris_size){4, 0}), IRIS_ERR_RANGE);
}

static void assert_ends(double degrees, double rho, iris_size size, iris_hough_ends expected)
{
    iris_hough_line line = {(iris_angle)lround(degrees * DEGREE), (iris_q16)lround(rho * 65536), 1};
    iris_hough_ends ends;
    assert_int_equal(iris_hough_clip(&ends, &line, size), IRIS_OK);
    assert_int_equal(ends.x0, expected.x0);
    assert_int_equal(ends.y0, expected.y0);
    assert_int_equal(ends.x1, expected.x1);
    assert_int_equal(ends.y1, expected.y1);
}

static void clip_by_hand(void **state)
{
    (void)state;
    const iris_size size = {101, 81}; /* middle (50, 40) */
    assert_ends(0, 0, size, (iris_hough_ends){50, 80, 50, 0});
    assert_ends(0, -50, size, (iris_hough_ends){0, 80, 0, 0});
    assert_ends(-90, 0, size, (iris_hough_ends){0, 40, 100, 40});
    assert_ends(-90, 40, size, (iris_hough_ends){0, 0, 100, 0});
    assert_ends(90, -1, size, (iris_hough_ends){0, 39, 100, 39});
    assert_ends(45, 0, size, (iris_hough_ends){10, 80, 90, 0});
    assert_ends(-45, 0, size, (iris_hough_ends){90, 80, 10, 0});
    assert_ends(45, 40 * sqrt(2), size, (iris_hough_ends){90, 80, 100, 70}); /* x + y = 170 */
    assert_ends(60, 0, (iris_size){1, 1}, (iris_hough_ends){0, 0, 0, 0});
    iris_hough_ends ends = {1, 2, 3, 4};
    iris_hough_line outside_line = {0, 51 * 65536, 1};
    assert_int_equal(iris_hough_clip(&ends, &outside_line, size), IRIS_ERR_RANGE);
    assert_int_equal(ends.x0, 1);
}

/* Both ends are inside and within half a pixel of the line, and no point of the line inside the image is beyond
 * them. Any line may be asked for. */
static void clip_against_doubles(void **state)
{
    (void)state;
    uint32_t seed = 5;
    const iris_size sizes[] = {{101, 81}, {1, 50}, {640, 3}, {32767, 200}, {33, 32767}};
    for (int i = 0; i < 500; i++) {
        iris_size size = sizes[i % 5];
        double half = hypot(size.w, size.h) / 2;
        iris_hough_line line = {(iris_angle)(next_random(&seed) - 32768),
                                (iris_q16)((next_random(&seed) % 2001 / 1000.0 - 1) * half * 65536), 1};
        double c = cos(line.angle * PI / 32768), s = sin(line.angle * PI / 32768),
               rho = line.rho_q16 / 65536.0;
        iris_hough_ends ends;
        if (iris_hough_clip(&ends, &line, size) == IRIS_OK) {
            assert_true(ends.x0 >= 0 && ends.x0 < size.w && ends.x1 >= 0 && ends.x1 < size.w);
            assert_true(ends.y0 >= ends.y1 && ends.y1 >= 0 && ends.y0 < size.h);
            double from = (ends.x0 - (size.w - 1) / 2.0) * c + (ends.y0 - (size.h - 1) / 2.0) * s - rho;
            double to = (ends.x1 - (size.w - 1) / 2.0) * c + (ends.y1 - (size.h - 1) / 2.0) * s - rho;
            assert_true(fabs(from) < 0.51 && fabs(to) < 0.51);
        } else {
            ends = (iris_hough_ends){-5, -5, -5, -5};
        }
        /* walk the line in double precision: what is well inside is between the ends */
        for (double t = -half; t <= half; t += half / 300) {
            double x = (size.w - 1) / 2.0 + rho * c + t * s, y = (size.h - 1) / 2.0 + rho * s - t * c;
            if (x >= 0 && x <= size.w - 1 && y >= 0 && y <= size.h - 1) {
                assert_true(ends.x0 >= 0);
                assert_true(y <= ends.y0 + 1 && y >= ends.y1 - 1);
                assert_true(x <= fmax(ends.x0, ends.x1) + 1 && x >= fmin(ends.x0, ends.x1) - 1);
            }
        }
    }
    iris_hough_ends ends;
    for (int i = 0; i < 8; i++) { /* the extremes of both numbers, for the sanitizers */
        iris_hough_line line = {(iris_angle)(i / 2 * 8192 - 32768), i % 2 ? INT32_MIN : INT32_MAX, 0};
        assert_int_equal(iris_hough_clip(&ends, &line, (iris_size){9, IRIS_SIDE_MAX}), IRIS_ERR_RANGE);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(votes_are_the_formula),   cmocka_unit_test(the_best_are_kept_when_full),
        cmocka_unit_test(votes_saturate),          cmocka_unit_test(three_ways_to_vote_are_one),
        cmocka_unit_test(the_largest_image),       cmocka_unit_test(reach_holds_every_pixel),
        cmocka_unit_test(scratch_is_exact),        cmocka_unit_test(bad_configs_are_refused),
        cmocka_unit_test(wrong_calls_are_refused), cmocka_unit_test(clip_by_hand),
        cmocka_unit_test(clip_against_doubles),
    };
    return cmocka_run_group_tests_name("hough", tests, NULL, NULL);
}
