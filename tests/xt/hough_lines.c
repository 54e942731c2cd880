/* Hough transform: which lines are found, drawn in double precision and in two real pictures. */
#include "line_mask.h"

/* The lines in a mask, which must all fit; returns how many. */
static int32_t find(iris_hough_line *lines, int32_t capacity, const iris_image *mask,
                    const iris_hough_config *config)
{
    iris_scratch scratch = arena(sizeof memory);
    int32_t count = -1;
    assert_int_equal(iris_hough_lines(lines, capacity, &count, mask, config, &scratch), IRIS_OK);
    return count;
}

static void strew(const iris_image *mask, int32_t points, uint32_t seed)
{
    for (int32_t i = 0; i < points; i++) {
        int32_t x = (int32_t)(next_random(&seed) % (uint32_t)mask->w);
        set(mask, x, (int32_t)(next_random(&seed) % (uint32_t)mask->h));
    }
}

/* How far a line is from the truth, in degrees and in pixels; the same line may be written in two ways. */
static double angle_off(const iris_hough_line *line, double degrees, double rho, double *rho_off)
{
    double off = line->angle / DEGREE - degrees, sign = 1;
    if (fabs(off) > 90) {
        off += off < 0 ? 180 : -180;
        sign = -1;
    }
    *rho_off = fabs(sign * line->rho_q16 / 65536.0 - rho);
    return fabs(off);
}

static void assert_line(const iris_hough_line *line, double degrees, double rho, double bin_degrees,
                        double step)
{
    double rho_off;
    assert_true(angle_off(line, degrees, rho, &rho_off) <= bin_degrees);
    assert_true(rho_off <= step);
    assert_true(line->angle >= -16384 && line->angle < 16384);
}

static void one_line_at_every_angle_in_noise(void **state)
{
    (void)state;
    const struct {
        int32_t w, h, theta_bins, rho_step;
    } cases[] = {{160, 120, 180, 1}, {97, 131, 60, 2}, {320, 240, 90, 2}};
    const double special[] = {-90, -89.9, -45, 0, 0.1, 44.6, 45, 89.4, 89.9};
    double angle_squares = 0, rho_squares = 0;
    int lines_seen = 0;
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        int32_t w = cases[k].w, h = cases[k].h;
        iris_hough_config config = config_of(cases[k].theta_bins, cases[k].rho_step, h / 3);
        double bin = 180.0 / config.theta_bins;
        for (int i = 0; i < 9 + 60; i++) {
            double degrees = i < 9 ? special[i] : -90 + 2.97 * (i - 9), rho = -25 + 3.7 * (i % 14), rho_off;
            iris_image mask = blank(w, h);
            draw(&mask, degrees, rho);
            strew(&mask, w * h / 60, (uint32_t)i);
            iris_hough_line lines[1];
            assert_int_equal(find(lines, 1, &mask, &config), 1);
            assert_line(&lines[0], degrees, rho, 0.8 * bin, 0.8 * config.rho_step);
            double off = angle_off(&lines[0], degrees, rho, &rho_off);
            angle_squares += off * off / bin / bin;
            rho_squares += rho_off * rho_off / config.rho_step / config.rho_step;
            lines_seen++;
        }
    }
    assert_true(sqrt(angle_squares / lines_seen) < 0.2);
    assert_true(sqrt(rho_squares / lines_seen) < 0.3);
}

static void signs_of_angle_and_rho(void **state)
{
    (void)state;
    const iris_hough_config config = config_of(180, 1, 60);
    const struct {
        double degrees, rho;
        int32_t x, y; /* a point of it */
    } cases[] = {{0, 20, 100, 3}, {0, -20, 60, 90}, {-90, 12, 20, 48}, {45, 0, 90, 50}, {-45, 0, 70, 50}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        iris_image mask = blank(161, 121);
        double lean = tan(cases[i].degrees * PI / 180);
        for (int32_t k = -60; k <= 60; k++) { /* up the image is to smaller y */
            if (cases[i].degrees == -90) {
                set(&mask, 80 + k, cases[i].y);
            } else {
                set(&mask, cases[i].x + (int32_t)lround((cases[i].y - (60 + k)) * lean), 60 + k);
            }
        }
        iris_hough_line line;
        assert_int_equal(find(&line, 1, &mask, &config), 1);
        assert_line(&line, cases[i].degrees, cases[i].rho, 0.5, 0.75);
    }
}

static void a_line_across_the_wrap_is_one_line(void **state)
{
    (void)state;
    for (int32_t h = 99; h <= 102; h++) {
        for (int i = -12; i <= 12; i++) {
            iris_image mask = blank(200, h);
            double rho = 7 * i / 3.0, degrees = -90 + i / 8.0;
            draw(&mask, degrees, rho);
            iris_hough_config config = config_of(90, 2, 30);
            iris_hough_line lines[4];
            assert_int_equal(find(lines, 4, &mask, &config), 1);
            assert_line(&lines[0], degrees, rho, 1.6, 1.6);
        }
    }
}

/* Every direction, once from -90 and once from 0 degrees: level lines are at the wrap of the first only. */
static void where_the_half_turn_begins_does_not_matter(void **state)
{
    (void)state;
    for (int i = -12; i <= 12; i++) {
        iris_image mask = blank(200, 100);
        double rho = 7 * i / 3.0 + 0.1, degrees = -90 + i / 8.0 + 0.03;
        draw(&mask, degrees, rho);
        iris_hough_config config = config_of(90, 2, 30);
        iris_hough_line at_wrap, inside;
        assert_int_equal(find(&at_wrap, 1, &mask, &config), 1);
        config.angle_min = config.angle_max = 0;
        assert_int_equal(find(&inside, 1, &mask, &config), 1);
        assert_int_equal(at_wrap.votes, inside.votes);
        assert_line(&at_wrap, inside.angle / DEGREE, inside.rho_q16 / 65536.0, 0.02, 0.02);
    }
}

static void bounds_leave_lines_out(void **state)
{
    (void)state;
    iris_image mask = blank(160, 120);
    draw(&mask, 5, 40);
    draw(&mask, 70, -10);
    draw(&mask, -80, -20);
    iris_hough_config config = config_of(90, 2, 40);
    iris_hough_line lines[8];
    assert_int_equal(find(lines, 8, &mask, &config), 3);
    config.theta_bins = 60;
    config.angle_min = iris_angle_from_degrees(-60);
    config.angle_max = iris_angle_from_degrees(60);
    assert_int_equal(find(lines, 8, &mask, &config), 1);
    assert_line(&lines[0], 5, 40, 1.6, 1.6);
    config.rho_max = 30;
    assert_int_equal(find(lines, 8, &mask, &config), 0);
    /* 60 to -60 is 60 to 120: both of the others, and the line at -80 with its rho negated, as for 100 */
    config.rho_max = 30;
    config.rho_min = -30;
    config.theta_bins = 30;
    config.angle_min = iris_angle_from_degrees(60);
    config.angle_max = iris_angle_from_degrees(-60);
    assert_int_equal(find(lines, 8, &mask, &config), 2);
    int first = lines[0].angle < 0; /* which of them is that at -80 */
    assert_line(&lines[!first], -80, -20, 1.6, 1.6);
    assert_true(lines[!first].angle < 0);
    assert_line(&lines[first], 70, -10, 1.6, 1.6);
    config.rho_max = 0;
    assert_int_equal(find(lines, 8, &mask, &config), 1);
    assert_line(&lines[0], 70, -10, 1.6, 1.6);
}

static void parallel_lines_are_told_apart(void **state)
{
    (void)state;
    for (double degrees = -90; degrees < 90; degrees += 15) {
        iris_image mask = blank(160, 120);
        draw(&mask, degrees, -8);
        draw(&mask, degrees, 8);
        iris_hough_config config = config_of(180, 1, 60);
        iris_hough_line lines[4];
        assert_int_equal(find(lines, 4, &mask, &config), 2);
        double off;
        angle_off(&lines[0], degrees, -8, &off);
        int second = off < 8;
        assert_line(&lines[!second], degrees, -8, 0.8, 0.8);
        assert_line(&lines[second], degrees, 8, 0.8, 0.8);
        config.rho_separation = 20;
        assert_int_equal(find(lines, 4, &mask, &config), 1);
    }
}

/* Pixels at which the gray level changes by more than `limit` across and down together. */
static void mark_edges(const iris_image *mask, const uint8_t *gray, int limit)
{
    int32_t w = mask->w;
    for (int32_t y = 1; y < mask->h - 1; y++) {
        for (int32_t x = 1; x < w - 1; x++) {
            const uint8_t *p = gray + y * w + x;
            if (abs(p[1] - p[-1]) + abs(p[w] - p[-w]) > limit) {
                set(mask, x, y);
            }
        }
    }
}

/* Each point is within `pixels` of one of the lines. */
static void assert_passes(const iris_hough_line *lines, int32_t count, iris_size size,
                          const double (*points)[2], int32_t point_count, double pixels)
{
    for (int32_t i = 0; i < point_count; i++) {
        int32_t near = 0;
        for (int32_t k = 0; k < count; k++) {
            double angle = lines[k].angle * PI / 32768;
            double rho = (points[i][0] - (size.w - 1) / 2.0) * cos(angle) +
                         (points[i][1] - (size.h - 1) / 2.0) * sin(angle);
            near += fabs(rho - lines[k].rho_q16 / 65536.0) <= pixels;
        }
        assert_true(near >= 1);
    }
}

/* The road below row 165: the solid line on the left and the dashed one on the right, and nothing else. */
static void two_lane_lines_of_a_road(void **state)
{
    (void)state;
    static uint8_t gray[480 * 270];
    size_t bytes;
    uint8_t *file = load_file(data_path("hough/lane_solidYellowCurve.bmp"), &bytes);
    if (!file) {
        skip();
    }
    /* 24 bits, bottom-up: offset of the pixels at byte 10 */
    const uint8_t *pixels = file + (file[10] | file[11] << 8);
    assert_true(bytes >= (size_t)(pixels - file) + 480 * 270 * 3 && file[18] == (480 & 255) &&
                file[28] == 24);
    for (int32_t i = 0; i < 480 * 270; i++) {
        const uint8_t *bgr = pixels + ((269 - i / 480) * 480 + i % 480) * 3;
        gray[i] = (uint8_t)((bgr[0] + 5 * bgr[1] + 2 * bgr[2]) / 8);
    }
    free(file);
    iris_image mask = blank(480, 105);
    mark_edges(&mask, gray + 165 * 480, 90);
    iris_hough_config config = config_of(180, 2, 40);
    config.angle_min = iris_angle_from_degrees(-70);
    config.angle_max = iris_angle_from_degrees(70);
    iris_hough_line lines[4];
    assert_int_equal(find(lines, 4, &mask, &config), 2);
    /* read off the picture: the solid line leans right, the dashed one left; both ends of each */
    assert_true(lines[0].angle > 50 * DEGREE && lines[0].angle < 60 * DEGREE);
    assert_true(lines[1].angle > -62 * DEGREE && lines[1].angle < -55 * DEGREE);
    assert_passes(lines, 1, (iris_size){480, 105}, (const double[][2]){{84, 102}, {150, 54}}, 2, 4);
    assert_passes(lines + 1, 1, (iris_size){480, 105}, (const double[][2]){{276, 14}, {316, 38}}, 2, 4);
}

/* The thick lines of a sudoku's grid in perspective; points on them read off the picture. */
static void thick_lines_of_a_grid(void **state)
{
    (void)state;
    picture grid = load_pnm(data_path("hough/sudoku_half.pgm"));
    if (!grid.pixels) {
        skip();
    }
    iris_image mask = blank(grid.w, grid.h);
    mark_edges(&mask, grid.pixels, 50);
    free(grid.pixels);
    iris_hough_config config = config_of(90, 2, 120);
    iris_hough_line lines[16];
    int32_t count;
    iris_scratch scratch = arena(sizeof memory);
    assert_int_equal(iris_hough_lines(lines, 16, &count, &mask, &config, &scratch), IRIS_OK);
    const double points[][2] = {{102, 150}, {176, 150}, {252, 150}, {60, 43},
                                {60, 107},  {60, 179},  {60, 255}};
    assert_passes(lines, 7, (iris_size){grid.w, grid.h}, points, 7, 5);
    assert_true(count <= 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_line_at_every_angle_in_noise),
        cmocka_unit_test(signs_of_angle_and_rho),
        cmocka_unit_test(a_line_across_the_wrap_is_one_line),
        cmocka_unit_test(where_the_half_turn_begins_does_not_matter),
        cmocka_unit_test(bounds_leave_lines_out),
        cmocka_unit_test(parallel_lines_are_told_apart),
        cmocka_unit_test(two_lane_lines_of_a_road),
        cmocka_unit_test(thick_lines_of_a_grid),
    };
    return cmocka_run_group_tests_name("hough lines", tests, NULL, NULL);
}
