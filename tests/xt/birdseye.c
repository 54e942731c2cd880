/* The bird's-eye view: where its pixels come from, against double precision, and their levels. */
#include "iris/xt/birdseye.h"

#include "xt/floor_camera.h"

static iris_birdseye_window any_window(const test_camera *c)
{
    double scale = uniform(0.5, 12), left = uniform(-800, 0), far = c->ahead + uniform(300, 2500);
    return (iris_birdseye_window){.size = {1 + (int)uniform(0, 230), 1 + (int)uniform(0, 150)},
                                  .corner = place_at(left, far),
                                  .mm_per_pixel_q16 = q16_of(scale),
                                  .fill = 77};
}

/* Where the map's pixel is in the picture by the floor's numbers; returns 0 behind the camera. */
static int true_place(double *u, double *v, const iris_floor *floor, const iris_birdseye_window *w, int x,
                      int y)
{
    double scale = w->mm_per_pixel_q16 / 65536.0, m[9];
    double right = w->corner.x_q16 / 65536.0 + scale * x, ahead = w->corner.y_q16 / 65536.0 - scale * y;
    for (int i = 0; i < 9; i++) {
        m[i] = (double)floor->to_image_q32[i];
    }
    double depth = m[6] * right + m[7] * ahead + m[8];
    *u = (m[0] * right + m[1] * ahead + m[2]) / depth;
    *v = (m[3] * right + m[4] * ahead + m[5]) / depth;
    return depth > 0;
}

static int in_picture(double u, double v, iris_size size, double margin)
{
    return u >= -0.5 + margin && v >= -0.5 + margin && u < size.w - 0.5 - margin && v < size.h - 0.5 - margin;
}

static void places_are_those_of_double_precision(void **state)
{
    (void)state;
    static iris_place places[300];
    double most = 0;
    long seen = 0, unseen = 0;
    for (int k = 0; k < 400; k++) {
        test_camera c = any_camera();
        c.roll *= k % 3; /* up to 10 degrees: depths then change along a row */
        c.pan *= 1 + k % 4;
        iris_floor plane = true_floor(&c);
        iris_birdseye_window window = any_window(&c);
        iris_birdseye b;
        assert_int_equal(iris_birdseye_init(&b, &plane, &window), IRIS_OK);
        for (int y = 0; y < window.size.h; y += 3) {
            assert_int_equal(iris_birdseye_places(places, &b, y), IRIS_OK);
            for (int x = 0; x < window.size.w; x++) {
                double u, v;
                int front = true_place(&u, &v, &plane, &window, x, y);
                if (places[x].x_q16 == INT32_MIN) {
                    assert_true(!front || !in_picture(u, v, plane.size, 0.04));
                    unseen++;
                } else {
                    assert_true(front && in_picture(u, v, plane.size, -0.04));
                    most = fmax(most, hypot(places[x].x_q16 / 65536.0 - u, places[x].y_q16 / 65536.0 - v));
                    seen++;
                }
            }
        }
    }
    assert_true(seen > 100000 && unseen > 100000);
    if (!(most < 1.0 / 16)) {
        print_error("off by %g pixels\n", most);
        fail();
    }
}

/* Levels of the map are those of its places, bilinear, within what 256 steps between pixels can do. */
static void levels_are_bilinear(void **state)
{
    (void)state;
    static uint8_t pixels[480 * 640 * 3], map[150 * 230 * 3], row[230 * 3];
    static iris_place places[230];
    for (int k = 0; k < 60; k++) {
        test_camera c = any_camera();
        int channels = k % 2 ? 3 : 1, flip = k % 4 == 3;
        iris_floor plane = true_floor(&c);
        iris_birdseye_window window = any_window(&c);
        iris_birdseye b;
        iris_image src, dst;
        iris_format format = channels == 1 ? IRIS_GRAY8 : k % 3 ? IRIS_RGB888 : IRIS_BGR888;
        for (int i = 0; i < c.w * c.h * channels; i++) {
            pixels[i] = (uint8_t)uniform(0, 255.99);
        }
        ptrdiff_t stride = (ptrdiff_t)c.w * channels;
        assert_int_equal(
            iris_image_wrap(&src, pixels, sizeof pixels, plane.size, flip ? -stride : stride, format),
            IRIS_OK);
        assert_int_equal(iris_image_wrap(&dst, map, sizeof map, window.size, 0, format), IRIS_OK);
        assert_int_equal(iris_birdseye_init(&b, &plane, &window), IRIS_OK);
        assert_int_equal(iris_birdseye_draw(&dst, &src, &b), IRIS_OK);
        for (int y = 0; y < window.size.h; y++) {
            const uint8_t *drawn = iris_image_row(&dst, y);
            assert_int_equal(iris_birdseye_places(places, &b, y), IRIS_OK);
            assert_int_equal(iris_birdseye_row(row, &b, &src, y), IRIS_OK);
            assert_memory_equal(row, drawn, (size_t)(window.size.w * channels));
            for (int i = 0; i < window.size.w * channels; i++) {
                iris_place at = places[i / channels];
                if (at.x_q16 == INT32_MIN) {
                    assert_int_equal(drawn[i], 77);
                    continue;
                }
                double u = fmin(fmax(at.x_q16 / 65536.0, 0), c.w - 1),
                       v = fmin(fmax(at.y_q16 / 65536.0, 0), c.h - 1);
                int x0 = (int)u, y0 = (int)v, x1 = x0 + (x0 < c.w - 1), y1 = y0 + (y0 < c.h - 1);
                const uint8_t *above = (const uint8_t *)iris_image_row(&src, y0) + i % channels;
                const uint8_t *below = (const uint8_t *)iris_image_row(&src, y1) + i % channels;
                double top = above[x0 * channels] * (x0 + 1 - u) + above[x1 * channels] * (u - x0);
                double bottom = below[x0 * channels] * (x0 + 1 - u) + below[x1 * channels] * (u - x0);
                assert_true(fabs(top * (y0 + 1 - v) + bottom * (v - y0) - drawn[i]) <
                            0.5 + 2 * 255 / 512.0 + 0.02);
            }
        }
    }
}

/* A picture of known squares on the floor becomes those squares. */
static void squares_are_square(void **state)
{
    (void)state;
    static uint8_t pixels[480 * 640], map[100 * 100];
    int wrong = 0, looked = 0;
    for (int k = 0; k < 40; k++) {
        test_camera c = any_camera();
        c.w = 640;
        c.h = 480;
        c.focal = 500;
        c.cx = 319.5;
        c.cy = 239.5;
        iris_floor plane = true_floor(&c);
        for (int y = 0; y < c.h; y++) {
            for (int x = 0; x < c.w; x++) {
                double right, ahead;
                int on = camera_floor(&right, &ahead, &c, x, y);
                int odd = on && (((long)floor(right / 40) + (long)floor(ahead / 40)) & 1);
                pixels[y * c.w + x] = odd ? 200 : 40;
            }
        }
        iris_image src, dst;
        iris_birdseye b;
        iris_birdseye_window window = {
            .size = {100, 100}, .corner = place_at(-99, c.ahead + 300), .mm_per_pixel_q16 = 2 * 65536};
        assert_int_equal(iris_image_wrap(&src, pixels, sizeof pixels, plane.size, 0, IRIS_GRAY8), IRIS_OK);
        assert_int_equal(iris_image_wrap(&dst, map, sizeof map, window.size, 0, IRIS_GRAY8), IRIS_OK);
        assert_int_equal(iris_birdseye_init(&b, &plane, &window), IRIS_OK);
        assert_int_equal(iris_birdseye_draw(&dst, &src, &b), IRIS_OK);
        for (int y = 0; y < 100; y++) {
            for (int x = 0; x < 100; x++) {
                double right = -99 + 2 * x, ahead = c.ahead + 300 - 2 * y;
                double edge_x = fabs(remainder(right, 40)), edge_y = fabs(remainder(ahead, 40));
                if (map[y * 100 + x] != 0 && edge_x > 5 && edge_y > 5) {
                    int odd = ((long)floor(right / 40) + (long)floor(ahead / 40)) & 1;
                    wrong += map[y * 100 + x] != (odd ? 200 : 40);
                    looked++;
                }
            }
        }
    }
    assert_true(looked > 30000);
    assert_int_equal(wrong, 0);
}

static void any_numbers_stay_harmless(void **state)
{
    (void)state;
    static uint8_t pixels[40 * 30], map[64 * 40];
    int drawn = 0;
    for (int k = 0; k < 20000; k++) {
        iris_q32 numbers[9];
        for (int i = 0; i < 9; i++) {
            double reach = pow(2, uniform(0, 62));
            numbers[i] = (iris_q32)uniform(-reach, reach);
        }
        iris_floor plane;
        if (iris_floor_init(&plane, (iris_size){40, 30}, numbers) != IRIS_OK) {
            continue;
        }
        double reach = k % 2 ? 2147483647.0 : 10000000;
        iris_birdseye_window window = {
            .size = {64, 40},
            .corner = {(int32_t)uniform(-reach, reach), (int32_t)uniform(-reach, reach)},
            .mm_per_pixel_q16 =
                (int32_t)uniform(IRIS_BIRDSEYE_SCALE_MIN, k % 3 ? 200000 : IRIS_BIRDSEYE_SCALE_MAX)};
        iris_birdseye b;
        iris_image src, dst;
        assert_int_equal(iris_birdseye_init(&b, &plane, &window), IRIS_OK);
        assert_int_equal(iris_image_wrap(&src, pixels, sizeof pixels, plane.size, 0, IRIS_GRAY8), IRIS_OK);
        assert_int_equal(iris_image_wrap(&dst, map, sizeof map, window.size, 0, IRIS_GRAY8), IRIS_OK);
        assert_int_equal(iris_birdseye_draw(&dst, &src, &b), IRIS_OK);
        drawn++;
    }
    assert_true(drawn > 5000);
}

static void arguments_are_checked(void **state)
{
    (void)state;
    static uint8_t pixels[640 * 480 * 3], map[30 * 20 * 3];
    test_camera c = any_camera();
    iris_floor plane = true_floor(&c);
    iris_birdseye_window window = {
        .size = {30, 20}, .corner = place_at(-20, c.ahead + 400), .mm_per_pixel_q16 = 65536};
    iris_birdseye b;
    iris_image src, dst;
    iris_place places[30];
    assert_int_equal(iris_birdseye_init(&b, &plane, &window), IRIS_OK);
    assert_int_equal(iris_birdseye_init(NULL, &plane, &window), IRIS_ERR_ARG);
    assert_int_equal(iris_birdseye_init(&b, NULL, &window), IRIS_ERR_ARG);
    assert_int_equal(iris_birdseye_init(&b, &plane, NULL), IRIS_ERR_ARG);
    window.mm_per_pixel_q16 = IRIS_BIRDSEYE_SCALE_MIN - 1;
    assert_int_equal(iris_birdseye_init(&b, &plane, &window), IRIS_ERR_ARG);
    window.mm_per_pixel_q16 = IRIS_BIRDSEYE_SCALE_MAX + 1;
    assert_int_equal(iris_birdseye_init(&b, &plane, &window), IRIS_ERR_ARG);
    window.mm_per_pixel_q16 = 65536;
    window.size.h = 0;
    assert_int_equal(iris_birdseye_init(&b, &plane, &window), IRIS_ERR_RANGE);
    window.size.h = IRIS_SIDE_MAX + 1;
    assert_int_equal(iris_birdseye_init(&b, &plane, &window), IRIS_ERR_RANGE);
    window.size.h = 20;
    plane.size.w = IRIS_BIRDSEYE_SOURCE_MAX + 1;
    assert_int_equal(iris_birdseye_init(&b, &plane, &window), IRIS_ERR_RANGE);

    assert_int_equal(iris_image_wrap(&src, pixels, sizeof pixels, (iris_size){c.w, c.h}, 0, IRIS_GRAY8),
                     IRIS_OK);
    assert_int_equal(iris_image_wrap(&dst, map, sizeof map, window.size, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_birdseye_draw(NULL, &src, &b), IRIS_ERR_ARG);
    assert_int_equal(iris_birdseye_draw(&dst, NULL, &b), IRIS_ERR_ARG);
    assert_int_equal(iris_birdseye_draw(&dst, &src, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_birdseye_row(NULL, &b, &src, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_birdseye_row(map, &b, &src, -1), IRIS_ERR_RANGE);
    assert_int_equal(iris_birdseye_row(map, &b, &src, 20), IRIS_ERR_RANGE);
    assert_int_equal(iris_birdseye_places(NULL, &b, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_birdseye_places(places, &b, 20), IRIS_ERR_RANGE);
    iris_image other = dst;
    other.w--;
    assert_int_equal(iris_birdseye_draw(&other, &src, &b), IRIS_ERR_RANGE);
    other = src;
    other.h--;
    assert_int_equal(iris_birdseye_draw(&dst, &other, &b), IRIS_ERR_RANGE);
    other = src;
    other.format = IRIS_BAYER8_RGGB;
    assert_int_equal(iris_birdseye_draw(&dst, &other, &b), IRIS_ERR_FORMAT);
    assert_int_equal(iris_image_wrap(&other, map, sizeof map, window.size, 0, IRIS_RGB888), IRIS_OK);
    assert_int_equal(iris_birdseye_draw(&other, &src, &b), IRIS_ERR_FORMAT);
    assert_int_equal(
        iris_image_wrap(&other, pixels + c.w * (c.h - 1), sizeof pixels / 2, window.size, 0, IRIS_GRAY8),
        IRIS_OK);
    assert_int_equal(iris_birdseye_draw(&other, &src, &b), IRIS_ERR_ALIAS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_are_those_of_double_precision),
        cmocka_unit_test(levels_are_bilinear),
        cmocka_unit_test(squares_are_square),
        cmocka_unit_test(any_numbers_stay_harmless),
        cmocka_unit_test(arguments_are_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
