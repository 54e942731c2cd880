/* Segments of lines: where they end, what supports them, and what is left. */
#include "iris/xt/hough_segments.h"

#include "line_mask.h"

static uint32_t seed = 11;

static int32_t any(int32_t low, int32_t high)
{
    return low + (int32_t)(next_random(&seed) % (uint32_t)(high - low + 1));
}

static iris_hough_line line_of(double degrees, double rho)
{
    return (iris_hough_line){(iris_angle)lround(degrees * DEGREE), (iris_q16)lround(rho * 65536), 123};
}

static iris_hough_segment_config config_for(int32_t gap, int32_t length, double reach)
{
    iris_hough_segment_config config;
    iris_hough_segment_defaults(&config);
    config.max_gap = gap;
    config.min_length = length;
    config.reach_q16 = (iris_q16)lround(reach * 65536);
    return config;
}

static iris_status of_mask(iris_hough_segment *segment, const iris_image *mask, iris_hough_line line,
                           iris_hough_segment_config config)
{
    iris_scratch scratch = arena(IRIS_HOUGH_SEGMENT_SCRATCH_BYTES(mask->w, mask->h));
    iris_status status = iris_hough_segment_of_mask(segment, mask, &line, &config, &scratch);
    assert_int_equal(scratch.used, 0);
    return status;
}

static int selected(const iris_image *mask, int32_t x, int32_t y)
{
    return ((const uint32_t *)iris_image_row(mask, y))[x / 32] >> x % 32 & 1;
}

static int32_t pixels(const iris_image *mask)
{
    int32_t sum = 0;
    for (int32_t i = 0; i < mask->w * mask->h; i++) {
        sum += selected(mask, i % mask->w, i / mask->w);
    }
    return sum;
}

static void assert_ends(const iris_hough_ends *ends, int32_t x0, int32_t y0, int32_t x1, int32_t y1)
{
    assert_int_equal(ends->x0, x0);
    assert_int_equal(ends->y0, y0);
    assert_int_equal(ends->x1, x1);
    assert_int_equal(ends->y1, y1);
}

/* An upright line with gaps: 30 pixels, 5 missing, 20, 6 missing, 44. */
static void gaps_and_lengths_by_hand(void **state)
{
    (void)state;
    for (int transposed = 0; transposed < 2; transposed++) {
        for (int run = 0; run < 4; run++) {
            iris_image mask = blank(121, 121);
            for (int32_t k = 0; k < 105; k++) {
                if (k < 30 || (k >= 35 && k < 55) || k >= 61) {
                    set(&mask, transposed ? 8 + k : 40, transposed ? 40 : 8 + k);
                }
            }
            iris_hough_line line = transposed ? line_of(-90, 20) : line_of(0, -20); /* column or row 40 */
            iris_hough_segment segment;
            int32_t gap = run == 0 ? 4 : run == 1 ? 5 : 6;
            if (run < 2) { /* the third one first, as it is longest or the shorter of two */
                iris_hough_segment_config config = config_for(gap, 20, 1);
                assert_int_equal(of_mask(&segment, &mask, line, config), IRIS_OK);
                assert_int_equal(segment.points, run == 0 ? 44 : 50);
                assert_int_equal(segment.line.votes, 123);
                assert_int_equal(of_mask(&segment, &mask, line, config), IRIS_OK);
                assert_int_equal(segment.points, run == 0 ? 30 : 44);
                assert_int_equal(of_mask(&segment, &mask, line, config), run == 0 ? IRIS_OK : IRIS_ERR_END);
                if (run == 0) {
                    assert_int_equal(segment.points, 20);
                    assert_ends(&segment.ends, transposed ? 43 : 40, transposed ? 40 : 62,
                                transposed ? 62 : 40, transposed ? 40 : 43);
                }
                assert_int_equal(pixels(&mask), 0);
            } else {
                iris_hough_segment_config config = config_for(gap, run == 2 ? 105 : 106, 1);
                assert_int_equal(of_mask(&segment, &mask, line, config), run == 2 ? IRIS_OK : IRIS_ERR_END);
                assert_int_equal(pixels(&mask), run == 2 ? 0 : 94);
                if (run == 2) {
                    assert_int_equal(segment.points, 94);
                    assert_ends(&segment.ends, transposed ? 8 : 40, transposed ? 40 : 112,
                                transposed ? 112 : 40, transposed ? 40 : 8);
                }
            }
        }
    }
}

/* Diagonal steps are 1.41 pixels: 7 missing ones are a gap of 9.9. */
static void gaps_are_measured_along_the_line(void **state)
{
    (void)state;
    for (int32_t gap = 9; gap <= 10; gap++) {
        iris_image mask = blank(101, 101);
        for (int32_t k = 0; k < 101; k++) {
            if (k < 47 || k >= 54) {
                set(&mask, k, 100 - k);
            }
        }
        iris_hough_segment segment;
        assert_int_equal(of_mask(&segment, &mask, line_of(45, 0), config_for(gap, 66, 1)), IRIS_OK);
        assert_int_equal(segment.points, gap == 9 ? 47 : 94);
        assert_int_equal(of_mask(&segment, &mask, line_of(45, 0), config_for(gap, 67, 1)), IRIS_ERR_END);
    }
}

/* A dashed line in every direction, and a transform's error: 0.5 degrees and 0.5 pixels. */
static void rough_lines_are_fitted(void **state)
{
    (void)state;
    for (double degrees = -89.5; degrees < 90; degrees += 4.25) {
        double c = cos(degrees * PI / 180), s = sin(degrees * PI / 180), rho = any(-300, 300) / 10.0;
        for (int i = 0; i < 4; i++) {
            iris_image mask = blank(200, 160), drawn;
            draw(&mask, degrees, rho);
            /* from -60 to 50 pixels along the line, with a hole from 10 to 20 */
            int32_t expected = 0;
            for (int32_t k = 0; k < 200 * 160; k++) {
                double along = -(k % 200 - 99.5) * s + (k / 200 - 79.5) * c;
                uint32_t *word = (uint32_t *)iris_image_row(&mask, k / 200) + k % 200 / 32;
                if (along < -60 || along > 50 || (along > 10 && along < 20)) {
                    *word &= ~((uint32_t)1 << k % 200 % 32);
                }
                expected += (int32_t)(*word >> k % 200 % 32 & 1);
            }
            drawn = mask;
            iris_hough_segment segment;
            iris_hough_line rough = line_of(degrees + (i % 2 ? 0.5 : -0.5), rho + (i / 2 ? 0.5 : -0.5));
            assert_int_equal(of_mask(&segment, &drawn, rough, config_for(12, 60, degrees < 0 ? 2 : 1)),
                             IRIS_OK);
            assert_int_equal(segment.points, expected);
            assert_int_equal(pixels(&mask), 0);
            assert_true(fabs(remainder(segment.line.angle / DEGREE - degrees, 180)) < 0.3);
            const iris_hough_ends *e = &segment.ends;
            double ends[2][2] = {{e->x0 - 99.5, e->y0 - 79.5}, {e->x1 - 99.5, e->y1 - 79.5}};
            assert_true(e->y0 > e->y1 || (e->y0 == e->y1 && e->x0 < e->x1));
            for (int k = 0; k < 2; k++) {
                double along = -ends[k][0] * s + ends[k][1] * c, off = ends[k][0] * c + ends[k][1] * s - rho;
                assert_true(fabs(along + 60) < 1.6 || fabs(along - 50) < 1.6);
                assert_true(fabs(off) < 1.1);
            }
        }
    }
}

/* A cross: its middle goes to the first line, and the second goes on beyond it. */
static void each_pixel_supports_one_line(void **state)
{
    (void)state;
    iris_image mask = blank(100, 100);
    for (int32_t k = 10; k < 90; k++) {
        set(&mask, k, 50);
        set(&mask, 50, k);
    }
    iris_hough_segment segment;
    assert_int_equal(of_mask(&segment, &mask, line_of(0, 0.5), config_for(8, 20, 2)), IRIS_OK);
    assert_int_equal(segment.points, 80 + 4);
    assert_int_equal(pixels(&mask), 159 - 84);
    assert_int_equal(of_mask(&segment, &mask, line_of(-90, -0.5), config_for(8, 20, 2)), IRIS_OK);
    assert_ends(&segment.ends, 10, 50, 89, 50);
    assert_int_equal(segment.points, 75);
}

/* On one upright line: rising edges at the even rows, falling ones at the odd rows, others off or beside it. */
static void directions_must_fit(void **state)
{
    (void)state;
    for (int full = 0; full < 2; full++) {
        iris_edge_point points[200];
        iris_edge_list edges = {points, 0, {100, 100}};
        for (int32_t y = 0; y < 80; y++) {
            iris_edge_point on = {60, (int16_t)(y + 10), (iris_angle)(y % 2 ? 30000 : -2000)};
            points[edges.count++] = on;
            iris_edge_point turned = {61, (int16_t)(y + 10), (iris_angle)(y % 2 ? 6000 : -24000)};
            points[edges.count++] = turned;
        }
        iris_hough_segment_config config = config_for(2, 70, 2);
        config.full_circle = full;
        iris_hough_line line = line_of(0, 10.5);
        iris_scratch scratch = arena(IRIS_HOUGH_SEGMENT_SCRATCH_BYTES(100, 100));
        iris_hough_segment segment;
        assert_int_equal(iris_hough_segment_of_edges(&segment, &edges, &line, &config, &scratch), IRIS_OK);
        assert_int_equal(segment.points, full ? 40 : 80);
        assert_int_equal(edges.count, 80 + (full ? 40 : 0));
        int32_t turned = 0;
        for (int32_t i = 0; i < edges.count; i++) {
            assert_true(points[i].x == 61 || (full && points[i].angle == 30000));
            turned += points[i].x == 61;
            assert_true(i == 0 || points[i].y > points[i - 1].y ||
                        (points[i].y == points[i - 1].y && points[i - 1].x == 60));
        }
        assert_int_equal(turned, 80);
        assert_int_equal(segment.line.angle, 0);
        assert_true(labs((long)segment.line.rho_q16 - 688128) < 700);
        assert_ends(&segment.ends, 60, full ? 88 : 89, 60, 10);
        /* the same the other way round */
        line = (iris_hough_line){INT16_MIN, -688128, 9};
        iris_status status = iris_hough_segment_of_edges(&segment, &edges, &line, &config, &scratch);
        assert_int_equal(status, full ? IRIS_OK : IRIS_ERR_END);
        if (full) {
            assert_int_equal(segment.points, 40);
            assert_int_equal(segment.line.angle, INT16_MIN);
        }
        assert_int_equal(edges.count, 80);
    }
}

/* Whatever is in the mask: what is taken lies at the line, is counted, and nothing else changes. */
static void random_masks(void **state)
{
    (void)state;
    int found = 0;
    for (int round = 0; round < 3000; round++) {
        iris_image whole = blank(any(1, 120) + 32, any(1, 90) + 1), mask;
        static uint32_t before[sizeof words / sizeof words[0]];
        int density = any(1, 30);
        for (int32_t i = 0; i < whole.w * whole.h; i++) {
            if (any(0, density) == 0) {
                set(&whole, i % whole.w, i / whole.w);
            }
        }
        assert_int_equal(iris_image_crop(&mask, &whole, (iris_rect){32, 1, whole.w - 32, whole.h - 1}),
                         IRIS_OK);
        memcpy(before, words, sizeof words);
        iris_hough_segment_config config = config_for(any(0, 9), any(1, 20), any(0, 40) / 10.0);
        iris_hough_line line = {(iris_angle)any(-32768, 32767),
                                any(0, 9) ? any(-60, 60) * 65536 : any(-32767, 32767) * 65536, 1};
        iris_hough_segment segment, untouched;
        memset(&segment, 0x44, sizeof segment);
        untouched = segment;
        int32_t had = pixels(&whole);
        iris_status status = of_mask(&segment, &mask, line, config);
        if (status != IRIS_OK) {
            assert_int_equal(status, IRIS_ERR_END);
            assert_memory_equal(before, words, sizeof words);
            assert_memory_equal(&segment, &untouched, sizeof segment);
            continue;
        }
        found++;
        assert_int_equal(had - pixels(&whole), segment.points);
        double angle = segment.line.angle / 32768.0 * PI, rho = segment.line.rho_q16 / 65536.0;
        for (int32_t i = 0; i < mask.w * mask.h; i++) {
            int32_t x = i % mask.w, y = i / mask.w;
            int was =
                (int)(before[(size_t)(y + 1) * (size_t)(whole.stride / 4) + (size_t)x / 32 + 1] >> x % 32 &
                      1);
            double off = (x - (mask.w - 1) / 2.0) * cos(angle) + (y - (mask.h - 1) / 2.0) * sin(angle) - rho;
            assert_true(was == selected(&mask, x, y) || fabs(off) <= config.reach_q16 / 65536.0 + 0.01);
        }
        const iris_hough_ends *e = &segment.ends;
        assert_true(e->x0 >= 0 && e->x0 < mask.w && e->x1 >= 0 && e->x1 < mask.w);
        assert_true(e->y0 >= 0 && e->y0 < mask.h && e->y1 >= 0 && e->y1 < mask.h);
    }
    assert_true(found > 500);
}

/* A photograph's lines, for what a caller does: from edges to segments until none is left. */
static void a_grid(void **state)
{
    (void)state;
    static iris_edge_point points[20000];
    picture grid = load_pnm(data_path("hough/sudoku_half.pgm"));
    if (!grid.pixels) {
        skip();
    }
    iris_image gray;
    iris_hough hough;
    iris_hough_line lines[60];
    iris_edge_list edges = {points, 0, {grid.w, grid.h}};
    int32_t found, segments = 0, long_ones = 0;
    size_t bytes = (size_t)grid.w * (size_t)grid.h;
    iris_scratch scratch = arena(sizeof memory);
    assert_int_equal(iris_image_wrap(&gray, grid.pixels, bytes, edges.size, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_edge_points(points, 20000, &edges.count, &gray, NULL, &scratch), IRIS_OK);
    iris_hough_config config = config_of(180, 1, 40);
    config.theta_separation = 3;
    config.rho_separation = 4;
    assert_int_equal(iris_hough_begin(&hough, edges.size, &config, &scratch), IRIS_OK);
    assert_int_equal(iris_hough_vote_edges(&hough, points, edges.count), IRIS_OK);
    (void)iris_hough_peaks(lines, 60, &found, &hough);
    int32_t before = edges.count;
    for (int32_t i = 0; i < found && i < 60; i++) {
        iris_hough_segment segment;
        while (iris_hough_segment_of_edges(&segment, &edges, &lines[i], NULL, &scratch) == IRIS_OK) {
            before -= segment.points;
            assert_int_equal(edges.count, before);
            segments++;
            long_ones += hypot(segment.ends.x1 - segment.ends.x0, segment.ends.y1 - segment.ends.y0) > 100;
        }
    }
    free(grid.pixels);
    assert_true(segments >= 10 && long_ones >= 8);
}

static void extremes(void **state)
{
    (void)state;
    iris_image mask = blank(9, 9);
    set(&mask, 4, 4);
    iris_hough_segment segment;
    for (int i = 0; i < 16; i++) {
        iris_hough_line line = {(iris_angle)(i / 2 * 8192 - 32768), i % 2 ? INT32_MIN : INT32_MAX, 0};
        assert_int_equal(of_mask(&segment, &mask, line, config_for(IRIS_SIDE_MAX, 1, 64)), IRIS_ERR_END);
    }
    assert_int_equal(of_mask(&segment, &mask, line_of(30, 0), config_for(0, 1, 0)), IRIS_OK);
    assert_ends(&segment.ends, 4, 4, 4, 4);
    /* corners of the largest picture */
    iris_edge_point corners[] = {{IRIS_SIDE_MAX - 1, 0, 8192}, {0, IRIS_SIDE_MAX - 1, 8192}, {0, 0, 8192}};
    iris_edge_list edges = {corners, 3, {IRIS_SIDE_MAX, IRIS_SIDE_MAX}};
    iris_hough_line line = line_of(45, 0);
    iris_hough_segment_config config = config_for(IRIS_SIDE_MAX, 1, 1);
    iris_scratch scratch = arena(sizeof memory);
    assert_int_equal(iris_hough_segment_of_edges(&segment, &edges, &line, &config, &scratch), IRIS_OK);
    assert_int_equal(segment.points, 1); /* the gap is longer than IRIS_SIDE_MAX */
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    iris_image mask = blank(40, 30), gray, broken;
    iris_edge_point points[2] = {{3, 3, 0}, {3, 29, 0}};
    iris_edge_list edges = {points, 2, {40, 30}}, bad_edges;
    iris_hough_line line = line_of(0, -16.5);
    iris_hough_segment_config config = config_for(30, 10, 1);
    iris_hough_segment segment, before;
    iris_scratch scratch = arena(16), less = arena(15);
    memset(&segment, 0x22, sizeof segment);
    before = segment;
    for (int32_t y = 0; y < 30; y++) {
        set(&mask, 3, y);
    }
    assert_int_equal(IRIS_HOUGH_SEGMENT_SCRATCH_BYTES(40, 30), 16);
    assert_int_equal(iris_image_wrap(&gray, words, 1200, (iris_size){40, 30}, 0, IRIS_GRAY8), IRIS_OK);
    broken = mask;
    broken.h = 0;
    assert_int_equal(iris_hough_segment_of_mask(NULL, &mask, &line, &config, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_segment_of_mask(&segment, NULL, &line, &config, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_segment_of_mask(&segment, &mask, NULL, &config, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_segment_of_mask(&segment, &mask, &line, &config, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_segment_of_mask(&segment, &gray, &line, &config, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_hough_segment_of_mask(&segment, &broken, &line, &config, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_hough_segment_of_mask(&segment, &mask, &line, &config, &less), IRIS_ERR_SCRATCH);
    assert_int_equal(iris_hough_segment_of_edges(NULL, &edges, &line, &config, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_segment_of_edges(&segment, NULL, &line, &config, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_segment_of_edges(&segment, &edges, NULL, &config, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_segment_of_edges(&segment, &edges, &line, &config, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_segment_of_edges(&segment, &edges, &line, &config, &less), IRIS_ERR_SCRATCH);
    bad_edges = (iris_edge_list){NULL, 1, {40, 30}};
    assert_int_equal(iris_hough_segment_of_edges(&segment, &bad_edges, &line, &config, &scratch),
                     IRIS_ERR_ARG);
    bad_edges = (iris_edge_list){points, -1, {40, 30}};
    assert_int_equal(iris_hough_segment_of_edges(&segment, &bad_edges, &line, &config, &scratch),
                     IRIS_ERR_ARG);
    bad_edges = (iris_edge_list){points, 2, {40, 0}};
    assert_int_equal(iris_hough_segment_of_edges(&segment, &bad_edges, &line, &config, &scratch),
                     IRIS_ERR_RANGE);
    bad_edges = (iris_edge_list){points, 2, {40, 29}};
    assert_int_equal(iris_hough_segment_of_edges(&segment, &bad_edges, &line, &config, &scratch),
                     IRIS_ERR_RANGE);
    for (int i = 0; i < 10; i++) {
        iris_hough_segment_config bad = config;
        bad.max_gap = i == 0 ? -1 : i == 1 ? IRIS_SIDE_MAX + 1 : 0;
        bad.min_length = i == 2 ? 0 : i == 3 ? IRIS_SIDE_MAX + 1 : 1;
        bad.reach_q16 = i == 4 ? -1 : i == 5 ? IRIS_HOUGH_REACH_MAX + 1 : 0;
        bad.spread = i == 6 ? -1 : i == 7 ? 16384 : 0;
        bad.full_circle = i == 8 ? -1 : i == 9 ? 2 : 0;
        assert_int_equal(iris_hough_segment_of_mask(&segment, &mask, &line, &bad, &scratch), IRIS_ERR_ARG);
        assert_int_equal(iris_hough_segment_of_edges(&segment, &edges, &line, &bad, &scratch), IRIS_ERR_ARG);
    }
    iris_hough_segment_defaults(NULL);
    assert_memory_equal(&segment, &before, sizeof segment);
    assert_int_equal(pixels(&mask), 30);
    assert_int_equal(edges.count, 2);
    assert_int_equal(iris_hough_segment_of_edges(&segment, &edges, &line, &config, &scratch), IRIS_OK);
    assert_int_equal(iris_hough_segment_of_mask(&segment, &mask, &line, &config, &scratch), IRIS_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gaps_and_lengths_by_hand),
        cmocka_unit_test(gaps_are_measured_along_the_line),
        cmocka_unit_test(rough_lines_are_fitted),
        cmocka_unit_test(each_pixel_supports_one_line),
        cmocka_unit_test(directions_must_fit),
        cmocka_unit_test(random_masks),
        cmocka_unit_test(a_grid),
        cmocka_unit_test(extremes),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("hough segments", tests, NULL, NULL);
}
