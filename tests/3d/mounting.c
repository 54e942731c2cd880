/* Floors and bird's-eye views from how a camera is mounted, against the camera above a floor in double precision. */
#include "iris/3d/mounting.h"

#include <stdio.h>

#include "random3d.h"
#include "test.h"
#include "xt/floor_camera.h"

static iris_q32 q32_of(double value)
{
    return (iris_q32)llround(value * 4294967296.0);
}

static iris_mounting mounting_of(const test_camera *c)
{
    iris_mounting made = {.height = q32_of(c->height),
                          .tilt = q32_of(c->tilt),
                          .pan = q32_of(c->pan),
                          .roll = q32_of(-c->roll), /* there it is the picture that turns clockwise */
                          .ahead = q32_of(c->ahead)};
    return made;
}

static iris_camera_model model_of(const test_camera *c)
{
    iris_camera_model made = {
        {c->w, c->h}, {q32_of(c->focal), q32_of(c->focal), 0, q32_of(c->cx), q32_of(c->cy)}, {.k1 = 0}};
    return made;
}

static void floors(void **state)
{
    (void)state;
    double worst_px = 0, worst_mm = 0;
    for (int i = 0; i < 2000; i++) {
        test_camera c = any_camera();
        const double aside = uniform(-100, 100);
        iris_mounting mounting = mounting_of(&c);
        const iris_camera_model model = model_of(&c);
        iris_floor floor;
        mounting.right = q32_of(aside);
        assert_int_equal(iris_mounting_floor(&floor, &mounting, &model), IRIS_OK);
        assert_true(floor.size.w == c.w && floor.size.h == c.h);
        for (int k = 0; k < 20; k++) {
            double u = uniform(0, c.w - 1), v = uniform(0, c.h - 1), x, y, again_u, again_v;
            iris_place found;
            if (!camera_floor(&x, &y, &c, u, v) || hypot(x, y) > 1900) {
                continue;
            }
            (void)camera_sees(&again_u, &again_v, &c, x, y);
            assert_int_equal(iris_floor_image(&found, &floor, place_at(x + aside, y)), IRIS_OK);
            double off = fmax(fabs(found.x_q16 / 65536.0 - u), fabs(found.y_q16 / 65536.0 - v));
            worst_px = fmax(worst_px, off);
            if (hypot(x, y) < 3 * c.height) {
                assert_int_equal(iris_floor_point(&found, &floor, place_at(u, v)), IRIS_OK);
                off = fmax(fabs(found.x_q16 / 65536.0 - x - aside), fabs(found.y_q16 / 65536.0 - y));
                worst_mm = fmax(worst_mm, off / c.height);
            }
        }
    }
    printf("#: floors: at most %.1e px off, near ones %.1e of the height\n", worst_px, worst_mm);
    assert_true(worst_px <= 0.001 && worst_mm <= 2e-6);
}

/* A camera 100 mm above (0, 0), 45 degrees down: its axis meets the floor 100 mm ahead. */
static void by_hand(void **state)
{
    (void)state;
    const iris_q32 one = IRIS_Q32_ONE;
    iris_mounting mounting = {.height = 100 * one, .tilt = IRIS_PI_Q32 / 4};
    iris_pose pose;
    assert_int_equal(iris_mounting_pose(&pose, &mounting), IRIS_OK);
    iris_vec3 seen = iris_pose_into(&pose, (iris_vec3){0, 100 * one, 0});
    assert_true(llabs(seen.x) < 1000 && llabs(seen.y) < 1000 && fabs(real(seen.z) - 100 * sqrt(2)) < 1e-6);
    seen = iris_pose_into(&pose, (iris_vec3){10 * one, 100 * one, 0});
    assert_true(fabs(real(seen.x) - 10) < 1e-6); /* right is right */
    seen = iris_pose_into(&pose, (iris_vec3){0, 50 * one, 0});
    assert_true(seen.y > 0); /* near is down */
    mounting.tilt = 0;
    mounting.pan = IRIS_PI_Q32 / 2; /* looks to the right */
    assert_int_equal(iris_mounting_pose(&pose, &mounting), IRIS_OK);
    seen = iris_pose_into(&pose, (iris_vec3){70 * one, 0, 100 * one});
    assert_true(fabs(real(seen.z) - 70) < 1e-6 && llabs(seen.x) < 1000);
    mounting.pan = 0;
    mounting.roll = IRIS_PI_Q32 / 2; /* lies on its right side: what is right of it is up */
    assert_int_equal(iris_mounting_pose(&pose, &mounting), IRIS_OK);
    seen = iris_pose_into(&pose, (iris_vec3){30 * one, 0, 100 * one});
    assert_true(fabs(real(seen.y) + 30) < 1e-6 && llabs(seen.x) < 1000);
}

/* The level of the floor at a place: smooth, so that bilinear levels are near. */
static double level_at(double x, double y)
{
    return 128 + 60 * sin(x / 25) + 60 * sin(y / 30);
}

static double lens_k1, lens_k2;

/* What a pixel of the camera with a lens of k1 and k2 sees of the floor. The lens is solved by repetition. */
static uint8_t rendered(const test_camera *c, double u, double v)
{
    double seen_x = (u - c->cx) / c->focal, seen_y = (v - c->cy) / c->focal, x = seen_x, y = seen_y;
    for (int i = 0; i < 60; i++) {
        double r2 = x * x + y * y, by = 1 + lens_k1 * r2 + lens_k2 * r2 * r2;
        x = seen_x / by;
        y = seen_y / by;
    }
    double mm_x, mm_y;
    if (!camera_floor(&mm_x, &mm_y, c, c->cx + c->focal * x, c->cy + c->focal * y)) {
        return 0;
    }
    return (uint8_t)(level_at(mm_x, mm_y) + 0.5);
}

enum { W = 320, H = 240, MAP_W = 101, MAP_H = 61 };

static void views_through_a_lens(void **state)
{
    (void)state;
    static uint8_t pixels[H][W], map_pixels[MAP_H][MAP_W];
    static iris_place places[IRIS_REMAP_PLACES(MAP_W, MAP_H, 2)];
    test_camera c = {.w = W,
                     .h = H,
                     .focal = 250,
                     .cx = 161,
                     .cy = 118,
                     .height = 200,
                     .ahead = 30,
                     .tilt = 0.7,
                     .roll = 0.05,
                     .pan = -0.1};
    const iris_mounting mounting = mounting_of(&c);
    iris_sensor sensor = {.intrinsics = model_of(&c).intrinsics};
    iris_image src, map;
    iris_remap_view view;
    iris_remap remap;
    lens_k1 = -0.2;
    lens_k2 = 0.03;
    sensor.lens = (iris_lens){.k1 = q32_of(lens_k1), .k2 = q32_of(lens_k2), .direction = IRIS_LENS_BENDS};
    for (int y = 0; y < H; y++) {
        for (int x = 0; x < W; x++) {
            pixels[y][x] = rendered(&c, x, y);
        }
    }
    const iris_size whole = {W, H}, map_size = {MAP_W, MAP_H};
    assert_int_equal(iris_image_wrap(&src, pixels, sizeof pixels, whole, W, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_image_wrap(&map, map_pixels, sizeof map_pixels, map_size, MAP_W, IRIS_GRAY8),
                     IRIS_OK);
    /* 3 mm to a pixel, from 150 mm to the left and 340 mm ahead */
    const iris_birdseye_window window = {{MAP_W, MAP_H}, place_at(-150, 340), 3 * 65536, 9};
    assert_int_equal(iris_mounting_view(&view, &mounting, &window), IRIS_OK);
    assert_int_equal(iris_remap_init(&remap, places, &view, &sensor, (iris_size){W, H}), IRIS_OK);
    assert_int_equal(iris_remap_draw(&map, &src, &remap), IRIS_OK);
    double worst = 0, sum = 0;
    int seen = 0;
    for (int y = 0; y < MAP_H; y++) {
        for (int x = 0; x < MAP_W; x++) {
            if (map_pixels[y][x] != 9) {
                double off = fabs(map_pixels[y][x] - level_at(-150 + 3 * x, 340 - 3 * y));
                worst = fmax(worst, off);
                sum += off;
                seen++;
            }
        }
    }
    printf("#: bird's-eye view through a lens: %d pixels, levels at most %.1f off, %.2f on average\n", seen,
           worst, sum / seen);
    assert_true(seen > MAP_W * MAP_H * 9 / 10 && worst <= 4 && sum / seen < 1);
}

static void refusals(void **state)
{
    (void)state;
    const iris_q32 one = IRIS_Q32_ONE;
    const iris_mounting good = {.height = 100 * one, .tilt = one};
    iris_mounting wrong[] = {good, good, good, good, good};
    iris_camera_model model = {{640, 480}, {500 * one, 500 * one, 0, 320 * one, 240 * one}, {.k1 = 0}};
    iris_birdseye_window window = {{10, 10}, {0, 0}, 65536, 0};
    iris_pose pose;
    iris_floor floor, before;
    iris_remap_view view;
    wrong[0].height = IRIS_MOUNTING_HEIGHT_MIN - 1;
    wrong[1].height = IRIS_MOUNTING_FAR + 1;
    wrong[2].right = -IRIS_MOUNTING_FAR - 1;
    wrong[3].ahead = INT64_MIN;
    wrong[4].height = INT64_MIN;
    memset(&floor, 7, sizeof floor);
    before = floor;
    for (int i = 0; i < 5; i++) {
        assert_int_equal(iris_mounting_pose(&pose, &wrong[i]), IRIS_ERR_RANGE);
        assert_int_equal(iris_mounting_floor(&floor, &wrong[i], &model), IRIS_ERR_RANGE);
        assert_int_equal(iris_mounting_view(&view, &wrong[i], &window), IRIS_ERR_RANGE);
    }
    model.intrinsics.alpha_v = 0;
    assert_int_equal(iris_mounting_floor(&floor, &good, &model), IRIS_ERR_RANGE);
    model.intrinsics.alpha_v = INT64_MAX;
    assert_int_equal(iris_mounting_floor(&floor, &good, &model), IRIS_ERR_RANGE);
    assert_memory_equal(&floor, &before, sizeof floor);
    assert_int_equal(iris_mounting_floor(NULL, &good, &model), IRIS_ERR_ARG);
    assert_int_equal(iris_mounting_floor(&floor, NULL, &model), IRIS_ERR_ARG);
    assert_int_equal(iris_mounting_floor(&floor, &good, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_mounting_pose(NULL, &good), IRIS_ERR_ARG);
    assert_int_equal(iris_mounting_pose(&pose, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_mounting_view(NULL, &good, &window), IRIS_ERR_ARG);
    assert_int_equal(iris_mounting_view(&view, NULL, &window), IRIS_ERR_ARG);
    assert_int_equal(iris_mounting_view(&view, &good, NULL), IRIS_ERR_ARG);
    window.mm_per_pixel_q16 = IRIS_BIRDSEYE_SCALE_MIN - 1;
    assert_int_equal(iris_mounting_view(&view, &good, &window), IRIS_ERR_ARG);
    window.mm_per_pixel_q16 = IRIS_BIRDSEYE_SCALE_MIN;
    window.size.h = 0;
    assert_int_equal(iris_mounting_view(&view, &good, &window), IRIS_ERR_RANGE);
}

/* Any numbers: the sanitizers look on. */
static void any_numbers(void **state)
{
    (void)state;
    for (int i = 0; i < 20000; i++) {
        const iris_mounting mounting = {any_q32(), any_q32(), any_q32(), any_q32(), any_q32(), any_q32()};
        const iris_camera_model model = {
            {640, 480}, {any_q32(), any_q32(), any_q32(), any_q32(), any_q32()}, {.k1 = 0}};
        const iris_birdseye_window window = {
            {(int32_t)any_q32(), 10}, {(int32_t)any_q32(), (int32_t)any_q32()}, (int32_t)any_q32(), 0};
        iris_floor floor;
        iris_remap_view view;
        (void)iris_mounting_floor(&floor, &mounting, &model);
        (void)iris_mounting_view(&view, &mounting, &window);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(floors),   cmocka_unit_test(by_hand),     cmocka_unit_test(views_through_a_lens),
        cmocka_unit_test(refusals), cmocka_unit_test(any_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
