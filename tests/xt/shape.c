/* Perimeter sampling against geometry and a slow walk; correlation against all shifts in double precision. */
#include <math.h>

#include "iris/xt/shape.h"
#include "shape_mask.h"

#define TURN 6.283185307179586

static uint32_t words[(SHAPE_SIDE_MAX / 32 + 4) * SHAPE_SIDE_MAX];
static shape drawn;
static uint16_t first[IRIS_SHAPE_SAMPLES_MAX], second[IRIS_SHAPE_SAMPLES_MAX];
static uint32_t seed = 3;

static iris_image drawn_mask(void)
{
    size_t bytes = iris_format_row_bytes(IRIS_MASK1, drawn.w) * (size_t)drawn.h;
    return shape_mask(words, bytes, &drawn, 0, ~0u);
}

static void clear(int32_t w, int32_t h)
{
    drawn.w = w;
    drawn.h = h;
    memset(drawn.at, 0, sizeof drawn.at);
}

static iris_shape_rays sample(uint16_t *to, const iris_shape_sampling *config)
{
    iris_image mask = drawn_mask();
    iris_shape_rays rays;
    assert_int_equal(iris_shape_sample(to, &rays, &mask, config), IRIS_OK);
    return rays;
}

static double pixels(const iris_shape_rays *rays, uint16_t distance)
{
    return distance / 32768.0 * rays->longest_q16 / 65536;
}

static void rectangle(void **state)
{
    (void)state;
    clear(140, 90);
    for (int32_t y = 20; y < 61; y++) {
        memset(&drawn.at[y][30], 1, 71);
    }
    iris_shape_sampling config;
    iris_shape_sampling_defaults(&config);
    for (int32_t n = 4; n <= IRIS_SHAPE_SAMPLES_MAX; n += 37) {
        config.samples = n;
        iris_shape_rays rays = sample(first, &config);
        assert_int_equal(rays.x_q16, 65 << 16);
        assert_int_equal(rays.y_q16, 40 << 16);
        assert_int_equal(rays.missing, 0);
        for (int32_t k = 0; k < n; k++) {
            double c = fabs(cos(TURN * k / n)), s = fabs(sin(TURN * k / n));
            double expected = fmin(c > 1e-9 ? 35.5 / c : 1e9, s > 1e-9 ? 20.5 / s : 1e9);
            assert_true(fabs(pixels(&rays, first[k]) - expected) < 0.02);
        }
    }
}

static void disc(int32_t x0, int32_t y0, double r, double hole)
{
    for (int32_t i = 0; i < drawn.w * drawn.h; i++) {
        int32_t x = i % drawn.w - x0, y = i / drawn.w - y0;
        drawn.at[i / drawn.w][i % drawn.w] |= x * x + y * y <= r * r && x * x + y * y > hole * hole;
    }
}

static void first_and_last(void **state)
{
    (void)state;
    clear(160, 160);
    disc(80, 80, 30, 20);
    disc(80, 80, 60, 50);
    iris_shape_sampling config;
    iris_shape_sampling_defaults(&config);
    iris_shape_rays inner = sample(first, NULL);
    config.crossing = IRIS_SHAPE_LAST;
    iris_shape_rays outer = sample(second, &config);
    for (int k = 0; k < 128; k++) {
        assert_true(fabs(pixels(&inner, first[k]) - 30) < 1.1);
        assert_true(fabs(pixels(&outer, second[k]) - 60) < 1.1);
        assert_true(first[k] > 31000 && first[k] <= IRIS_SHAPE_ONE);
    }
    config.has_point = 1; /* on the ring, next to the outer edge */
    config.x_q16 = 135 << 16;
    config.y_q16 = 80 << 16;
    config.crossing = IRIS_SHAPE_FIRST;
    outer = sample(second, &config);
    assert_true(fabs(pixels(&outer, second[0]) - 5.5) < 0.6 && fabs(pixels(&outer, second[64]) - 4.5) < 0.6);
}

/* A thin outline, with steps over corners: no ray slips through; where it is gone, rays meet nothing. */
static void thin_outlines(void **state)
{
    (void)state;
    for (int round = 0; round < 40; round++) {
        clear(200, 200);
        double a = 30 + next_random(&seed) % 60, b = 30 + next_random(&seed) % 60;
        for (int i = 0; i < 4000; i++) {
            int32_t x = (int32_t)floor(100.3 + a * cos(TURN * i / 4000)),
                    y = (int32_t)floor(99.9 + b * sin(TURN * i / 4000));
            drawn.at[y][x] = 1;
        }
        for (int32_t i = 0; i < 200 * 200; i++) { /* corners of steps go, as a thinned outline has none */
            int32_t x = i % 200, y = i / 200;
            int across = shape_at(&drawn, x - 1, y) + shape_at(&drawn, x + 1, y);
            int down = shape_at(&drawn, x, y - 1) + shape_at(&drawn, x, y + 1);
            if (drawn.at[y][x] && across == 1 && down == 1) {
                drawn.at[y][x] = 0;
            }
        }
        iris_shape_sampling config;
        iris_shape_sampling_defaults(&config);
        config.samples = 360;
        iris_shape_rays rays = sample(first, &config);
        assert_int_equal(rays.missing, 0);
        for (int32_t y = 0; y < 100; y++) {
            memset(drawn.at[y], 0, 200); /* the upper half */
        }
        config.has_point = 1;
        config.x_q16 = config.y_q16 = 100 << 16;
        rays = sample(first, &config);
        assert_true(rays.missing > 150 && rays.missing < 190);
        for (int k = 0; k < 360; k++) {
            assert_true(first[k] == IRIS_SHAPE_MISSING ? k < 5 || k > 175 : k < 185 || k > 355);
        }
        iris_shape_entry entries[360];
        int32_t count = 0;
        assert_int_equal(iris_shape_table(entries, &count, first, 360, rays.longest_q16), IRIS_OK);
        assert_int_equal(count, 360 - rays.missing);
        for (int32_t i = 0; i < count; i++) {
            double turn = entries[i].angle / 65536.0 * TURN, r = entries[i].distance_q16 / 65536.0 - 0.5;
            int32_t x = (int32_t)floor(100.5 + r * cos(turn)), y = (int32_t)floor(100.5 + r * sin(turn));
            int near = 0;
            for (int k = 0; k < 9; k++) {
                near |= shape_at(&drawn, x + k % 3 - 1, y + k / 3 - 1);
            }
            assert_true(near);
        }
    }
}

/* Steps of a hundredth of a pixel: corners of pixels may be missed. */
static void as_a_slow_walk(void **state)
{
    (void)state;
    int differ = 0;
    for (int round = 0; round < 30; round++) {
        clear(1 + (int32_t)(next_random(&seed) % 60), 1 + (int32_t)(next_random(&seed) % 60));
        for (int blob = 0; blob < 7; blob++) {
            disc((int32_t)(next_random(&seed) % 60), (int32_t)(next_random(&seed) % 60),
                 next_random(&seed) % 14, blob % 2 * 4);
        }
        drawn.at[0][0] = 1;
        iris_shape_sampling config = {48, round % 2 ? IRIS_SHAPE_LAST : IRIS_SHAPE_FIRST, 1, 0, 0};
        config.x_q16 = (int32_t)(next_random(&seed) % ((uint32_t)drawn.w * 65536u - 32768u));
        config.y_q16 = (int32_t)(next_random(&seed) % ((uint32_t)drawn.h * 65536u - 32768u));
        iris_shape_rays rays = sample(first, &config);
        for (int k = 0; k < 48; k++) {
            double c = cos(TURN * k / 48), s = sin(TURN * k / 48), x = config.x_q16 / 65536.0,
                   y = config.y_q16 / 65536.0, found = -1;
            int was = 0;
            for (int i = 0; i < 10000; i++) {
                int is =
                    shape_at(&drawn, (int)floor(x + c * i / 100 + 0.5), (int)floor(y + s * i / 100 + 0.5));
                if (was && !is) {
                    found = i / 100.0;
                    if (round % 2 == 0) {
                        break;
                    }
                }
                was = is;
            }
            differ +=
                first[k] == IRIS_SHAPE_MISSING ? found >= 0 : fabs(pixels(&rays, first[k]) - found) > 0.03;
        }
    }
    assert_true(differ <= 30 * 48 / 50);
}

/* --- correlation --- */

static void draw_sequence(uint16_t *to, int32_t n, uint32_t missing_of_256)
{
    for (int32_t i = 0; i < n; i++) {
        uint32_t r = next_random(&seed);
        to[i] = r % 256 < missing_of_256 ? IRIS_SHAPE_MISSING : (uint16_t)(r / 256 % 32769);
    }
}

/* The degree of one shift; -1 when it is beyond the tolerances. */
static double degree_slowly(const uint16_t *a, const uint16_t *b, int32_t n, int32_t shift, int mirrored,
                            const iris_shape_tolerance *t)
{
    double error = 0, signal = 0, compared = 0;
    for (int32_t i = 0; i < n; i++) {
        double x = a[(n + shift + (mirrored ? -i : i)) % n], y = b[i];
        if (x <= IRIS_SHAPE_ONE && y <= IRIS_SHAPE_ONE) {
            error += fmax(0, fabs(x - y) - t->tolerance);
            signal += fmax(x, y);
            compared++;
        }
    }
    int within =
        error <= signal * t->cumulative_q16 / 65536 && n - compared <= n * (t->missing_q16 / 65536.0);
    return within && signal > 0 ? 1 - error / signal : -1;
}

static void as_all_shifts_in_double(void **state)
{
    (void)state;
    for (int round = 0; round < 400; round++) {
        int32_t n = 4 + (int32_t)(next_random(&seed) % 90);
        iris_shape_tolerance t = {(int32_t)(next_random(&seed) % 9000), (int32_t)(next_random(&seed) % 65537),
                                  (int32_t)(next_random(&seed) % 65537), round % 2};
        draw_sequence(first, n, (uint32_t)(round % 3) * 30);
        draw_sequence(second, n, (uint32_t)(round % 4) * 20);
        iris_shape_correlation best;
        assert_int_equal(iris_shape_correlate(&best, first, second, n, &t), IRIS_OK);
        double most = -1;
        for (int32_t k = 0; k < n << t.mirrored; k++) {
            most = fmax(most, degree_slowly(first, second, n, k % n, k >= n, &t));
        }
        assert_true(fabs(best.degree_q16 / 65536.0 - fmax(0, most)) < 2e-5);
        if (most >= 0) {
            assert_true(fabs(degree_slowly(first, second, n, best.shift, best.mirrored, &t) - most) < 1e-9);
        } else {
            assert_true(best.degree_q16 == 0 && best.compared == 0);
        }
    }
}

static void finds_the_turn(void **state)
{
    (void)state;
    for (int32_t shift = 0; shift < 90; shift++) {
        for (int mirrored = 0; mirrored < 2; mirrored++) {
            draw_sequence(second, 90, 0);
            for (int32_t i = 0; i < 90; i++) {
                first[(shift + (mirrored ? 90 - i : i)) % 90] = second[i];
            }
            first[7] = first[8] = second[70] = IRIS_SHAPE_MISSING;
            iris_shape_correlation best;
            assert_int_equal(iris_shape_correlate(&best, first, second, 90, NULL), IRIS_OK);
            assert_int_equal(best.degree_q16, IRIS_Q16_ONE);
            assert_int_equal(best.shift, shift);
            assert_int_equal(best.mirrored, mirrored);
            assert_true(best.compared == 87 || best.compared == 88);
            double turn = shift * 4 - (mirrored ? 180 : 0), angle = best.angle / 65536.0 * 360;
            assert_true(fabs(remainder(turn - angle, 360)) < 2.01);
        }
    }
    for (int32_t part = -4; part <= 4; part++) { /* between the steps */
        for (int32_t i = 0; i < 64; i++) {
            first[i] = (uint16_t)(20000 + 9000 * cos(TURN * (i - 10 - part / 10.0) / 64));
            second[i] = (uint16_t)(20000 + 9000 * cos(TURN * i / 64));
        }
        const iris_shape_tolerance none = {0, 65536, 0, 0};
        iris_shape_correlation best;
        assert_int_equal(iris_shape_correlate(&best, first, second, 64, &none), IRIS_OK);
        assert_int_equal(best.shift, 10);
        assert_true(fabs(best.angle / 1024.0 - 10 - part / 10.0) < 0.05);
    }
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    static uint8_t bytes[64];
    iris_image gray, mask;
    assert_int_equal(iris_image_wrap(&gray, bytes, sizeof bytes, (iris_size){8, 8}, 0, IRIS_GRAY8), IRIS_OK);
    clear(8, 8);
    mask = drawn_mask();
    uint16_t to[8] = {77, 77, 77, 77, 77, 77, 77, 77};
    iris_shape_sampling c = {8, IRIS_SHAPE_FIRST, 0, 0, 0};
    iris_shape_rays rays = {7, 7, 7, 7};
    assert_int_equal(iris_shape_sample(NULL, &rays, &mask, &c), IRIS_ERR_ARG);
    assert_int_equal(iris_shape_sample(to, &rays, NULL, &c), IRIS_ERR_ARG);
    assert_int_equal(iris_shape_sample(to, &rays, &gray, &c), IRIS_ERR_FORMAT);
    assert_int_equal(iris_shape_sample(to, &rays, &mask, &c), IRIS_ERR_RANGE); /* nothing is selected */
    c.samples = 3;
    assert_int_equal(iris_shape_sample(to, &rays, &mask, &c), IRIS_ERR_ARG);
    c = (iris_shape_sampling){8, (iris_shape_crossing)2, 0, 0, 0};
    assert_int_equal(iris_shape_sample(to, &rays, &mask, &c), IRIS_ERR_ARG);
    c = (iris_shape_sampling){8, IRIS_SHAPE_FIRST, 2, 0, 0};
    assert_int_equal(iris_shape_sample(to, &rays, &mask, &c), IRIS_ERR_ARG);
    c = (iris_shape_sampling){8, IRIS_SHAPE_FIRST, 1, 8 << 16, 0};
    assert_int_equal(iris_shape_sample(to, &rays, &mask, &c), IRIS_ERR_RANGE);
    assert_int_equal(to[0], 77);
    assert_int_equal(rays.missing, 7);
    c.x_q16 = 0;
    assert_int_equal(iris_shape_sample(to, &rays, &mask, &c), IRIS_OK);
    assert_true(rays.missing == 8 && rays.longest_q16 == 0 && to[3] == IRIS_SHAPE_MISSING);
    iris_shape_entry entries[8];
    int32_t count = 77;
    assert_int_equal(iris_shape_table(NULL, &count, to, 8, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_shape_table(entries, NULL, to, 8, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_shape_table(entries, &count, NULL, 8, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_shape_table(entries, &count, to, 3, 1), IRIS_ERR_ARG);
    assert_int_equal(count, 77);
    iris_shape_correlation best = {7, 7, 7, 7, 7};
    iris_shape_tolerance t = {-1, 0, 0, 0};
    assert_int_equal(iris_shape_correlate(NULL, to, to, 8, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_shape_correlate(&best, NULL, to, 8, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_shape_correlate(&best, to, NULL, 8, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_shape_correlate(&best, to, to, IRIS_SHAPE_SAMPLES_MAX + 1, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_shape_correlate(&best, to, to, 8, &t), IRIS_ERR_ARG);
    t = (iris_shape_tolerance){0, 65537, 0, 0};
    assert_int_equal(iris_shape_correlate(&best, to, to, 8, &t), IRIS_ERR_ARG);
    t = (iris_shape_tolerance){0, 0, -1, 0};
    assert_int_equal(iris_shape_correlate(&best, to, to, 8, &t), IRIS_ERR_ARG);
    t = (iris_shape_tolerance){0, 0, 0, 2};
    assert_int_equal(iris_shape_correlate(&best, to, to, 8, &t), IRIS_ERR_ARG);
    to[5] = 40000;
    assert_int_equal(iris_shape_correlate(&best, to, to, 8, NULL), IRIS_ERR_RANGE);
    assert_int_equal(best.degree_q16, 7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rectangle),
        cmocka_unit_test(first_and_last),
        cmocka_unit_test(thin_outlines),
        cmocka_unit_test(as_a_slow_walk),
        cmocka_unit_test(finds_the_turn),
        cmocka_unit_test(as_all_shifts_in_double),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("shape", tests, NULL, NULL);
}
