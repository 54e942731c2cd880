/* Orthogonal regression: clouds against a two-pass reference in double precision, and lines worked out by hand. */
#include "iris/xt/regress.h"

#include <math.h>

#include "../picture.h"

#define PI     3.14159265358979323846
#define POINTS 4000

typedef struct {
    double x[POINTS], y[POINTS];
    int32_t count;
} cloud;

static cloud points;

typedef struct {
    double x, y, degrees;
} truth;

static truth fit_in_doubles(const cloud *c)
{
    double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    for (int32_t i = 0; i < c->count; i++) {
        x += c->x[i] / c->count;
        y += c->y[i] / c->count;
    }
    for (int32_t i = 0; i < c->count; i++) {
        xx += (c->x[i] - x) * (c->x[i] - x);
        xy += (c->x[i] - x) * (c->y[i] - y);
        yy += (c->y[i] - y) * (c->y[i] - y);
    }
    return (truth){x, y, atan2(-2 * xy, yy - xx) * 90 / PI};
}

static double angle_between(double a, double b)
{
    double off = fabs(a - b);
    return off > 90 ? 180 - off : off;
}

static void assert_line(const iris_line *line, truth expected, double degrees, double pixels)
{
    double angle = line->angle * 180.0 / 32768;
    assert_true(angle_between(angle, expected.degrees) <= degrees);
    assert_true(fabs(line->x_q16 / 65536.0 - expected.x) <= pixels);
    assert_true(fabs(line->y_q16 / 65536.0 - expected.y) <= pixels);
    assert_true(angle >= -90 && angle <= 90);
    assert_true(fabs(line->dx / 1073741824.0 - sin(angle * PI / 180)) < 1e-7);
    assert_true(fabs(line->dy / 1073741824.0 + cos(angle * PI / 180)) < 1e-7);
    assert_true(line->dy <= 0);
}

static void add(cloud *c, int32_t x, int32_t y)
{
    c->x[c->count] = x;
    c->y[c->count++] = y;
}

static iris_moments moments_of(const cloud *c)
{
    iris_moments moments = {0};
    for (int32_t i = 0; i < c->count; i++) {
        iris_moments_add(&moments, (int32_t)c->x[i], (int32_t)c->y[i]);
    }
    return moments;
}

/* Points strewn along a line of the given direction, up to `wide` pixels beside it. */
static void strew(cloud *c, double degrees, int32_t count, double length, double wide, uint32_t *seed)
{
    double s = sin(degrees * PI / 180), k = cos(degrees * PI / 180);
    c->count = 0;
    for (int32_t i = 0; i < count; i++) {
        double t = (next_random(seed) % 20001 / 10000.0 - 1) * length;
        double across = (next_random(seed) % 20001 / 10000.0 - 1) * wide;
        add(c, (int32_t)lround(t * s + across * k), (int32_t)lround(-t * k + across * s));
    }
}

static void moments_by_hand(void **state)
{
    (void)state;
    iris_moments m = {0};
    iris_moments_add(&m, 3, -2);
    iris_moments_add(&m, -1, 5);
    assert_true(m.n == 2 && m.x == 2 && m.y == 3 && m.xx == 10 && m.xy == -11 && m.yy == 29);
    for (int32_t x0 = -9; x0 <= 9; x0++) {
        for (int32_t x1 = x0; x1 <= 12; x1++) {
            iris_moments run = {0}, single = {0};
            iris_moments_add_run(&run, x0, x1, -7);
            for (int32_t x = x0; x <= x1; x++) {
                iris_moments_add(&single, x, -7);
            }
            assert_memory_equal(&run, &single, sizeof run);
        }
    }
}

static void every_direction(void **state)
{
    (void)state;
    uint32_t seed = 1;
    for (double degrees = -90; degrees <= 90; degrees += 3.75) {
        for (int kind = 0; kind < 3; kind++) {
            strew(&points, degrees,
                  kind == 0   ? 4
                  : kind == 1 ? 50
                              : POINTS,
                  kind == 0 ? 15 : 300, kind, &seed);
            iris_moments m = moments_of(&points);
            iris_line line;
            assert_int_equal(iris_regress_moments(&line, &m), IRIS_OK);
            assert_int_equal(line.points, points.count);
            assert_line(&line, fit_in_doubles(&points), kind == 0 ? 0.05 : 0.006, 1e-4);
        }
    }
}

static void axes_and_diagonals_are_exact(void **state)
{
    (void)state;
    const struct {
        int32_t dx, dy;
        iris_angle angle;
    } cases[] = {{0, -1, 0}, {1, 0, -16384}, {1, -1, 8192}, {-1, -1, -8192}};
    for (size_t i = 0; i < 4; i++) {
        for (int32_t far = 1; far < 65536; far *= 5) {
            iris_moments m = {0};
            for (int32_t k = -3; k <= 3; k++) {
                iris_moments_add(&m, cases[i].dx * k * far / 3, cases[i].dy * k * far / 3);
            }
            iris_line line;
            assert_int_equal(iris_regress_moments(&line, &m), IRIS_OK);
            assert_int_equal(line.angle, cases[i].angle);
            assert_int_equal(line.x_q16, 0);
            assert_int_equal(line.y_q16, 0);
        }
    }
}

/* Far from the origin and off it by fractions: the sums are large, their differences small. */
static void far_away(void **state)
{
    (void)state;
    uint32_t seed = 9;
    const int32_t places[][2] = {
        {32000, 32000}, {-32000, 32000}, {31000, -31000}, {-32000, -32000}, {32000, 1}};
    for (size_t i = 0; i < 5; i++) {
        for (double degrees = -88; degrees < 90; degrees += 22) {
            strew(&points, degrees, 333, 60, 3, &seed);
            for (int32_t k = 0; k < points.count; k++) {
                points.x[k] += places[i][0];
                points.y[k] += places[i][1];
            }
            iris_moments m = moments_of(&points);
            iris_line line;
            assert_int_equal(iris_regress_moments(&line, &m), IRIS_OK);
            assert_line(&line, fit_in_doubles(&points), 0.006, 1e-4);
        }
    }
}

/* A few points with fractions in their means: the truth is a formula of small integers. */
static void few_points(void **state)
{
    (void)state;
    uint32_t seed = 3;
    for (int i = 0; i < 2000; i++) {
        int32_t count = 2 + i % 6;
        strew(&points, i, count, 4, 4, &seed);
        iris_moments m = moments_of(&points);
        double n = count, xx = n * (double)m.xx - (double)m.x * (double)m.x,
               yy = n * (double)m.yy - (double)m.y * (double)m.y,
               xy = n * (double)m.xy - (double)m.x * (double)m.y;
        iris_line line;
        iris_status status = iris_regress_moments(&line, &m);
        if (xy == 0 && xx == yy) {
            continue; /* no direction; with thirds in the means either answer may come */
        }
        assert_int_equal(status, IRIS_OK);
        if (hypot(2 * xy, yy - xx) >= n * n / 2) {
            assert_line(&line, fit_in_doubles(&points), 1.0, 1e-4);
        }
    }
}

/* 2^30 points by runs, at the farthest coordinates; then the limits of what is added. */
static void a_billion_points(void **state)
{
    (void)state;
    iris_moments m = {0};
    for (int32_t k = 0; k < 16384; k++) { /* two opposite corners */
        int32_t sign = k % 2 ? 1 : -1;
        for (int32_t i = 0; i < 2; i++) {
            iris_moments_add_run(&m, sign > 0 ? 32768 : -65535, sign > 0 ? 65535 : -32768,
                                 sign * (65535 - k - i));
        }
    }
    assert_true(m.n == (int64_t)1 << 30);
    iris_line line;
    assert_int_equal(iris_regress_moments(&line, &m), IRIS_OK);
    assert_int_equal(line.points, 1 << 30);
    /* two even bands, 32768 wide and 16384 high */
    double x = 49151.5, y = 57343, xx = x * x + 32768.0 * 32768 / 12, yy = y * y + 16384.0 * 16384 / 12;
    assert_line(&line, (truth){0, 0, atan2(-2 * x * y, yy - xx) * 90 / PI}, 0.006, 1);
    iris_moments before = m;
    iris_moments_add(&m, 0, 0);
    iris_moments_add_run(&m, 0, 1, 0);
    m.n--;
    iris_moments_add_run(&m, 0, 1, 0);
    m.n++;
    assert_memory_equal(&m, &before, sizeof m);
    /* all of them in the two farthest corners: products reach 2^62 */
    for (int32_t mirror = -1; mirror <= 1; mirror += 2) {
        int64_t n = (int64_t)1 << 30, most = n * 65535 * 65535;
        m = (iris_moments){n, 0, 0, most, mirror * most, most};
        assert_int_equal(iris_regress_moments(&line, &m), IRIS_OK);
        assert_int_equal(line.angle, -mirror * 8192);
    }
    m = (iris_moments){0};
    const int32_t out[] = {65536, -65536, INT32_MAX, INT32_MIN};
    for (size_t i = 0; i < 4; i++) {
        iris_moments_add(&m, out[i], 0);
        iris_moments_add(&m, 0, out[i]);
        iris_moments_add_run(&m, 0, 5, out[i]);
        iris_moments_add_run(&m, out[i] < 0 ? out[i] : 0, out[i] < 0 ? 0 : out[i], 5);
    }
    iris_moments_add_run(&m, 1, 0, 0);
    assert_true(m.n == 0 && m.xx == 0 && m.yy == 0);
}

/* Sums at the limits that no points have: any answer, but no overflow. */
static void sums_that_are_not_of_points(void **state)
{
    (void)state;
    const int64_t n = (int64_t)1 << 30, x = n * 65535, xx = x * 65535;
    for (int i = 0; i < 243; i++) {
        iris_moments m = {n,
                          x * (i % 3 - 1),
                          x * (i / 3 % 3 - 1),
                          i / 9 % 3 ? xx : 0,
                          xx * (i / 27 % 3 - 1),
                          i / 81 ? xx : 0};
        iris_line line;
        iris_status status = iris_regress_moments(&line, &m);
        assert_true(status == IRIS_OK || status == IRIS_ERR_RANGE);
    }
    for (int i = 0; i < 6; i++) {
        iris_moments m = {2, 1, 1, 5, 1, 1};
        int64_t *fields[] = {&m.n, &m.x, &m.y, &m.xx, &m.xy, &m.yy};
        iris_line line = {7, 7, 7, 7, 7, 7};
        *fields[i] = INT64_MAX;
        assert_int_equal(iris_regress_moments(&line, &m), IRIS_ERR_RANGE);
        *fields[i] = INT64_MIN;
        assert_int_equal(iris_regress_moments(&line, &m), IRIS_ERR_RANGE);
        assert_int_equal(line.points, 7);
    }
}

static void centers_saturate(void **state)
{
    (void)state;
    iris_moments m = {0};
    iris_moments_add(&m, 65535, -40000);
    iris_moments_add(&m, 65535, -60000);
    iris_line line;
    assert_int_equal(iris_regress_moments(&line, &m), IRIS_OK);
    assert_int_equal(line.x_q16, INT32_MAX);
    assert_int_equal(line.y_q16, INT32_MIN);
    assert_int_equal(line.angle, 0);
}

static void no_direction(void **state)
{
    (void)state;
    iris_line line = {7, 7, 7, 7, 7, 7};
    iris_moments m = {0};
    assert_int_equal(iris_regress_moments(&line, &m), IRIS_ERR_RANGE);
    for (int i = 0; i < 5; i++) {
        iris_moments_add(&m, -31, 17);
        assert_int_equal(iris_regress_moments(&line, &m), IRIS_ERR_RANGE);
    }
    for (int32_t side = 2; side < 12; side++) { /* squares */
        m = (iris_moments){0};
        for (int32_t y = 0; y < side; y++) {
            iris_moments_add_run(&m, 5, 5 + side - 1, 100 + y);
        }
        assert_int_equal(iris_regress_moments(&line, &m), IRIS_ERR_RANGE);
    }
    assert_int_equal(line.points, 7);
    assert_int_equal(iris_regress_moments(NULL, &m), IRIS_ERR_ARG);
    assert_int_equal(iris_regress_moments(&line, NULL), IRIS_ERR_ARG);
}

static void points_against_doubles(void **state)
{
    (void)state;
    static iris_point list[POINTS];
    uint32_t seed = 4;
    for (double degrees = -90; degrees < 90; degrees += 7.5) {
        for (int kind = 0; kind < 3; kind++) {
            strew(&points, degrees, kind == 0 ? 3 : POINTS, kind == 2 ? 16300 : 100, kind, &seed);
            for (int32_t i = 0; i < points.count; i++) {
                list[i] = (iris_point){(int16_t)(2 * points.x[i] + 1), (int16_t)(2 * points.y[i])};
                points.x[i] += 0.5;
            }
            iris_line line;
            assert_int_equal(iris_regress_points(&line, list, points.count), IRIS_OK);
            assert_line(&line, fit_in_doubles(&points), 0.006, 1e-4);
        }
    }
    static iris_point most[IRIS_REGRESS_POINTS_MAX];
    for (int32_t i = 0; i < IRIS_REGRESS_POINTS_MAX; i++) {
        most[i] = i % 2 ? (iris_point){INT16_MAX, INT16_MAX} : (iris_point){-INT16_MAX, -INT16_MAX};
    }
    iris_line line = {7, 7, 7, 7, 7, 7};
    assert_int_equal(iris_regress_points(&line, most, IRIS_REGRESS_POINTS_MAX), IRIS_OK);
    assert_int_equal(line.angle, -8192);
    assert_int_equal(line.points, IRIS_REGRESS_POINTS_MAX);
    assert_int_equal(iris_regress_points(&line, most, IRIS_REGRESS_POINTS_MAX + 1), IRIS_ERR_ARG);
    assert_int_equal(iris_regress_points(&line, most, -1), IRIS_ERR_ARG);
    assert_int_equal(iris_regress_points(&line, most, 0), IRIS_ERR_RANGE);
    assert_int_equal(iris_regress_points(&line, most, 1), IRIS_ERR_RANGE);
    assert_int_equal(iris_regress_points(&line, NULL, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_regress_points(NULL, most, 2), IRIS_ERR_ARG);
    most[1].twice_y = INT16_MIN;
    assert_int_equal(iris_regress_points(&line, most, 2), IRIS_ERR_ARG);
    assert_int_equal(line.angle, -8192);
}

/* Rows of a line x = 60 + slope (y - 50), every fifth missing; then with strangers in a row of eight. */
static void rows_with_strangers(void **state)
{
    (void)state;
    for (double slope = -1; slope <= 1; slope += 0.125) {
        int16_t rows[101];
        points.count = 0;
        for (int32_t y = 0; y <= 100; y++) {
            double x = floor(2 * (60 + slope * (y - 50)) + 0.5) / 2;
            rows[y] = y % 5 == 2 ? IRIS_REGRESS_NONE : (int16_t)(2 * x);
            if (y % 5 != 2) {
                add(&points, 0, y);
                points.x[points.count - 1] = x;
            }
        }
        iris_line clean, bent, trimmed;
        assert_int_equal(iris_regress_rows(&clean, rows, 0, 100, 0), IRIS_OK);
        assert_int_equal(clean.points, 81);
        truth expected = fit_in_doubles(&points);
        assert_line(&clean, expected, 0.006, 1e-4);
        assert_true(angle_between(expected.degrees, -atan(slope) * 180 / PI) < 0.2);
        for (int32_t y = 90; y < 98; y++) {
            rows[y] = rows[y] == IRIS_REGRESS_NONE ? rows[y] : (int16_t)(rows[y] + 160);
        }
        assert_int_equal(iris_regress_rows(&bent, rows, 0, 100, 0), IRIS_OK);
        assert_true(angle_between(bent.angle * 180.0 / 32768, expected.degrees) > 1.5);
        assert_int_equal(iris_regress_rows(&trimmed, rows, 0, 100, 3), IRIS_OK);
        assert_line(&trimmed, expected, 0.3, 5);
        assert_int_equal(trimmed.points, 75); /* rows 90 to 97 but 92 and 97, which are missing anyway */
    }
}

/* One round of trimming from the points of `all` to *kept, by the words of the header. Returns 0 when a point is too
 * near the limit to be sure. */
static int trim_in_doubles(cloud *kept, const cloud *all, truth line)
{
    double c = cos(line.degrees * PI / 180), s = sin(line.degrees * PI / 180), distance[60] = {0}, sum = 0;
    for (int32_t i = 0; i < all->count; i++) {
        distance[i] = fabs((all->x[i] - line.x) * c + (all->y[i] - line.y) * s);
        sum += distance[i];
    }
    double limit = fmax(2.5 * sum / all->count, 1);
    kept->count = 0;
    for (int32_t i = 0; i < all->count; i++) {
        if (fabs(distance[i] - limit) < 0.5) {
            return 0;
        }
        if (distance[i] <= limit) {
            add(kept, (int32_t)all->x[i], (int32_t)all->y[i]);
        }
    }
    return 1;
}

static void a_trim_is_two_and_a_half_mean_distances(void **state)
{
    (void)state;
    static cloud kept;
    uint32_t seed = 11;
    int trials[3] = {0};
    for (int i = 0; i < 1500; i++) {
        int16_t rows[60];
        points.count = 0;
        for (int32_t y = 0; y < 60; y++) {
            int32_t spread = y % 9 == 4 ? 61 : 9;
            int32_t x = 30 + y / 4 + (int32_t)(next_random(&seed) % (uint32_t)spread) - spread / 2;
            rows[y] = (int16_t)(2 * x);
            add(&points, x, y);
        }
        truth expected = fit_in_doubles(&points);
        for (int32_t trims = 1; trims <= 2 && trim_in_doubles(&kept, &points, expected); trims++) {
            expected = fit_in_doubles(&kept);
            iris_line line;
            assert_int_equal(iris_regress_rows(&line, rows, 0, 59, trims), IRIS_OK);
            assert_int_equal(line.points, kept.count);
            assert_line(&line, expected, 0.006, 1e-4);
            trials[trims]++;
        }
    }
    assert_true(trials[1] > 20 && trials[2] > 5);
}

static void a_pixel_is_never_trimmed(void **state)
{
    (void)state;
    int16_t rows[60];
    for (int32_t y = 0; y < 60; y++) {
        rows[y] = y % 30 == 14 ? 41 : 40; /* half a pixel beside 58 others */
    }
    iris_line line;
    assert_int_equal(iris_regress_rows(&line, rows, 0, 59, 4), IRIS_OK);
    assert_int_equal(line.points, 60);
}

/* Sums that are powers of two, and so the only ones that reach the lower limit of what is rotated. */
static void diagonals_over_powers_of_two(void **state)
{
    (void)state;
    static int16_t rows[2049];
    for (int32_t y = 0; y <= 2048; y++) {
        rows[y] = IRIS_REGRESS_NONE;
    }
    for (int32_t length = 2; length <= 2048; length *= 2) {
        iris_line line;
        rows[0] = (int16_t)(2 * length);
        rows[length] = 0;
        assert_int_equal(iris_regress_rows(&line, rows, 0, length, 2), IRIS_OK);
        assert_int_equal(line.angle, 8192);
        rows[0] = 0;
        rows[length] = (int16_t)(2 * length);
        assert_int_equal(iris_regress_rows(&line, rows, 0, length, 2), IRIS_OK);
        assert_int_equal(line.angle, -8192);
        rows[length] = IRIS_REGRESS_NONE;
    }
}

static void rows_at_the_limits(void **state)
{
    (void)state;
    static int16_t rows[IRIS_REGRESS_ROW_MAX + 1];
    const int16_t patterns[][2] = {{INT16_MAX, -INT16_MAX}, {INT16_MAX, INT16_MAX}, {-INT16_MAX, -INT16_MAX}};
    for (size_t k = 0; k < 3; k++) {
        for (int32_t y = 0; y <= IRIS_REGRESS_ROW_MAX; y++) {
            rows[y] = patterns[k][k == 0 ? y > 9000 : 0];
        }
        iris_line line;
        assert_int_equal(iris_regress_rows(&line, rows, 0, IRIS_REGRESS_ROW_MAX, 4), IRIS_OK);
        if (k > 0) {
            assert_int_equal(line.angle, 0);
            assert_true(fabs(line.x_q16 / 65536.0 - patterns[k][0] / 2.0) < 0.001);
            assert_true(fabs(line.y_q16 / 65536.0 - IRIS_REGRESS_ROW_MAX / 2.0) < 0.001);
        }
    }
    iris_line line = {7, 7, 7, 7, 7, 7};
    assert_int_equal(iris_regress_rows(&line, rows, 0, IRIS_REGRESS_ROW_MAX + 1, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_regress_rows(&line, rows, -1, 5, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_regress_rows(&line, rows, 6, 5, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_regress_rows(&line, rows, 0, 5, 5), IRIS_ERR_ARG);
    assert_int_equal(iris_regress_rows(&line, rows, 0, 5, -1), IRIS_ERR_ARG);
    assert_int_equal(iris_regress_rows(NULL, rows, 0, 5, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_regress_rows(&line, NULL, 0, 5, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_regress_rows(&line, rows, 5, 5, 2), IRIS_ERR_RANGE);
    rows[3] = rows[4] = IRIS_REGRESS_NONE;
    assert_int_equal(iris_regress_rows(&line, rows, 3, 4, 2), IRIS_ERR_RANGE);
    assert_int_equal(line.points, 7);
}

/* Random masks of all widths, in views with strides of their own and garbage past w. */
static void masks_against_doubles(void **state)
{
    (void)state;
    static uint32_t words[40 * 8];
    uint32_t seed = 21;
    for (int32_t w = 1; w <= 100; w++) {
        int32_t h = 3 + w % 17;
        for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
            uint32_t noise = next_random(&seed) << 16 ^ next_random(&seed);
            words[i] = noise % 7 == 0 ? 0 : noise % 7 == 1 ? ~0u : w % 2 ? noise : noise & noise >> 3;
        }
        iris_image whole, mask;
        assert_int_equal(iris_image_wrap(&whole, words, sizeof words, (iris_size){w + 32, h + 2},
                                         w % 3 ? 20 : -24, IRIS_MASK1),
                         IRIS_OK);
        assert_int_equal(iris_image_crop(&mask, &whole, (iris_rect){32, 1, w, h}), IRIS_OK);
        points.count = 0;
        for (int32_t i = 0; i < w * h; i++) {
            const uint32_t *row = iris_image_row(&mask, i / w);
            if (row[i % w / 32] >> i % w % 32 & 1) {
                add(&points, i % w, i / w);
            }
        }
        iris_line line;
        iris_status status = iris_regress_mask(&line, &mask);
        if (points.count > 10) {
            assert_int_equal(status, IRIS_OK);
            assert_int_equal(line.points, points.count);
            assert_line(&line, fit_in_doubles(&points), 0.02, 1e-4);
        }
    }
}

static void wrong_masks_are_refused(void **state)
{
    (void)state;
    static uint32_t words[16];
    iris_image mask, gray;
    iris_line line = {7, 7, 7, 7, 7, 7};
    assert_int_equal(iris_image_wrap(&mask, words, sizeof words, (iris_size){33, 4}, 0, IRIS_MASK1), IRIS_OK);
    assert_int_equal(iris_image_wrap(&gray, words, sizeof words, (iris_size){8, 4}, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_regress_mask(&line, &mask), IRIS_ERR_RANGE); /* empty */
    words[1] = ~(uint32_t)1;                                           /* only bits past w */
    assert_int_equal(iris_regress_mask(&line, &mask), IRIS_ERR_RANGE);
    assert_int_equal(iris_regress_mask(&line, &gray), IRIS_ERR_FORMAT);
    assert_int_equal(iris_regress_mask(&line, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_regress_mask(NULL, &mask), IRIS_ERR_ARG);
    mask.w = 0;
    assert_int_equal(iris_regress_mask(&line, &mask), IRIS_ERR_ARG);
    assert_int_equal(line.points, 7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moments_by_hand),
        cmocka_unit_test(every_direction),
        cmocka_unit_test(axes_and_diagonals_are_exact),
        cmocka_unit_test(far_away),
        cmocka_unit_test(few_points),
        cmocka_unit_test(a_billion_points),
        cmocka_unit_test(sums_that_are_not_of_points),
        cmocka_unit_test(centers_saturate),
        cmocka_unit_test(no_direction),
        cmocka_unit_test(points_against_doubles),
        cmocka_unit_test(rows_with_strangers),
        cmocka_unit_test(a_trim_is_two_and_a_half_mean_distances),
        cmocka_unit_test(a_pixel_is_never_trimmed),
        cmocka_unit_test(diagonals_over_powers_of_two),
        cmocka_unit_test(rows_at_the_limits),
        cmocka_unit_test(masks_against_doubles),
        cmocka_unit_test(wrong_masks_are_refused),
    };
    return cmocka_run_group_tests_name("regress", tests, NULL, NULL);
}
