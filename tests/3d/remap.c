/* Pictures remapped, against the same in double precision: every pixel's place by the model of camera.h, its level by
 * bilinear interpolation there. */
#include "iris/3d/remap.h"

#include <stdio.h>

#include "random3d.h"
#include "test.h"

enum { W = 320, H = 200, VIEW_W = 301, VIEW_H = 187 };

static uint8_t source[H][W][3], view_pixels[VIEW_H][VIEW_W][3];
static iris_place places[IRIS_REMAP_PLACES(VIEW_W, VIEW_H, 0)];
static iris_remap map;

/* Waves: up to 20 levels from pixel to pixel. */
static void draw_waves(void)
{
    for (int y = 0; y < H; y++) {
        for (int x = 0; x < W; x++) {
            for (int c = 0; c < 3; c++) {
                source[y][x][c] = (uint8_t)(128 + 60 * sin(0.2 * x + c) + 60 * cos(0.15 * y + 0.1 * x));
            }
        }
    }
}

static iris_image image_of(void *pixels, int w, int h, iris_format format, size_t bytes)
{
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, pixels, bytes, (iris_size){w, h}, 0, format), IRIS_OK);
    return image;
}

static iris_sensor camera_of(double k1, double k2, double p1)
{
    const double one = 4294967296.0;
    iris_sensor camera = {
        .intrinsics = {200 * IRIS_Q32_ONE, 195 * IRIS_Q32_ONE, 0, 158 * IRIS_Q32_ONE, 103 * IRIS_Q32_ONE},
        .lens = {.k1 = (iris_q32)(k1 * one), .k2 = (iris_q32)(k2 * one), .p1 = (iris_q32)(p1 * one)}};
    iris_mat3_identity(&camera.pose.turn);
    return camera;
}

/* Where pixel (x, y) of the view comes from. */
static void place(double at[2], const iris_remap_view *view, const iris_sensor *camera, int x, int y)
{
    const iris_intrinsics *k = &view->intrinsics, *to = &camera->intrinsics;
    double py = (y - real(k->v0)) / real(k->alpha_v),
           px = (x - real(k->u0) - real(k->shear) * py) / real(k->alpha_u), ray[3];
    for (int i = 0; i < 3; i++) {
        ray[i] = real(view->turn.m[i]) * px + real(view->turn.m[3 + i]) * py + real(view->turn.m[6 + i]);
    }
    px = ray[0] / ray[2];
    py = ray[1] / ray[2];
    double r2 = px * px + py * py, radial = 1 + r2 * (real(camera->lens.k1) + r2 * real(camera->lens.k2));
    double p1 = real(camera->lens.p1);
    at[0] = real(to->alpha_u) * (px * radial + 2 * p1 * px * py) + real(to->u0);
    at[1] = real(to->alpha_v) * (py * radial + p1 * (r2 + 2 * py * py)) + real(to->v0);
}

static double level(double x, double y, int c)
{
    int left = (int)x, top = (int)y;
    double right = x - left, down = y - top;
    return (source[top][left][c] * (1 - right) + source[top][left + 1][c] * right) * (1 - down) +
           (source[top + 1][left][c] * (1 - right) + source[top + 1][left + 1][c] * right) * down;
}

/* The largest difference from double precision, at places that are well inside. */
static double worst_level(const iris_remap_view *view, const iris_sensor *camera)
{
    double worst = 0;
    int compared = 0;
    for (int y = 0; y < VIEW_H; y++) {
        for (int x = 0; x < VIEW_W; x++) {
            double at[2];
            place(at, view, camera, x, y);
            if (at[0] < -1 || at[1] < -1 || at[0] > W || at[1] > H) {
                assert_int_equal(view_pixels[y][x][1], view->fill);
            }
            for (int c = 0; c < 3 && at[0] > 1 && at[1] > 1 && at[0] < W - 2 && at[1] < H - 2;
                 c++, compared++) {
                worst = fmax(worst, fabs(level(at[0], at[1], c) - view_pixels[y][x][c]));
            }
        }
    }
    assert_true(compared > 60000);
    return worst;
}

static void as_in_double_precision(void **state)
{
    (void)state;
    static const double lenses[][3] = {{0, 0, 0}, {-0.3, 0.1, 0.002}, {0.2, 0, -0.003}, {-0.12, -0.01, 0}};
    double worst[5] = {0};
    draw_waves();
    const iris_image src = image_of(source, W, H, IRIS_RGB888, sizeof source);
    const iris_image dst = image_of(view_pixels, VIEW_W, VIEW_H, IRIS_RGB888, sizeof view_pixels);
    for (int i = 0; i < 40; i++) {
        iris_sensor camera = camera_of(lenses[i % 4][0], lenses[i % 4][1], lenses[i % 4][2]);
        iris_remap_view view;
        iris_remap_view_defaults(&view, &camera.intrinsics, (iris_size){VIEW_W, VIEW_H});
        view.fill = 77;
        view.step_bits = i / 8;
        if (i % 8 >= 4) { /* another camera, turned by 6 degrees */
            view.intrinsics = (iris_intrinsics){180 * IRIS_Q32_ONE, 180 * IRIS_Q32_ONE, IRIS_Q32_ONE,
                                                150 * IRIS_Q32_ONE, 90 * IRIS_Q32_ONE};
            iris_rotation_about(&view.turn, random_direction(), IRIS_PI_Q32 / 30);
        }
        assert_int_equal(iris_remap_init(&map, places, &view, &camera, (iris_size){W, H}), IRIS_OK);
        assert_int_equal(iris_remap_draw(&dst, &src, &map), IRIS_OK);
        worst[view.step_bits] = fmax(worst[view.step_bits], worst_level(&view, &camera));
    }
    printf("#: remapped levels, with neighbors up to 20 away: by places every pixel %.1f, 4 %.1f, 8 %.1f, 16 "
           "%.1f off\n",
           worst[0], worst[2], worst[3], worst[4]);
    assert_true(worst[0] <= 1 && worst[1] <= 1 && worst[2] <= 1.5 && worst[3] <= 4 && worst[4] <= 14);
}

/* k1 = -0.3 turns back at r = 1.054: beyond it the view is empty, to the step of the map, and not mirrored. */
static void behind_the_fold_nothing_is_seen(void **state)
{
    (void)state;
    enum { STEP = 4 };
    const double fold = sqrt(1 / 0.9);
    iris_sensor camera = camera_of(-0.3, 0, 0);
    iris_remap_view view;
    memset(source, 200, sizeof source);
    iris_remap_view_defaults(&view, &camera.intrinsics, (iris_size){VIEW_W, VIEW_H});
    view.intrinsics =
        (iris_intrinsics){80 * IRIS_Q32_ONE, 80 * IRIS_Q32_ONE, 0, 150 * IRIS_Q32_ONE, 93 * IRIS_Q32_ONE};
    view.fill = 77;
    view.step_bits = 2;
    const iris_image src = image_of(source, W, H, IRIS_RGB888, sizeof source);
    const iris_image dst = image_of(view_pixels, VIEW_W, VIEW_H, IRIS_RGB888, sizeof view_pixels);
    assert_int_equal(iris_remap_init(&map, places, &view, &camera, (iris_size){W, H}), IRIS_OK);
    assert_int_equal(iris_remap_draw(&dst, &src, &map), IRIS_OK);
    for (int y = 0; y < VIEW_H; y++) {
        for (int x = 0; x < VIEW_W; x++) {
            const double r = hypot(x - 150, y - 93);
            double at[2];
            place(at, &view, &camera, x, y);
            if (r > 80 * fold) {
                assert_int_equal(view_pixels[y][x][1], 77);
            } else if (r < 80 * fold - 2 * STEP && at[0] > 1 && at[1] > 1 && at[0] < W - 2 && at[1] < H - 2) {
                assert_int_equal(view_pixels[y][x][1], 200);
            }
        }
    }
}

static void without_a_lens_nothing_changes(void **state)
{
    (void)state;
    iris_sensor camera = camera_of(0, 0, 0);
    iris_remap_view view;
    draw_waves();
    const iris_image src = image_of(source, W, H, IRIS_RGB888, sizeof source);
    iris_image dst = image_of(view_pixels, VIEW_W, VIEW_H, IRIS_RGB888, sizeof view_pixels);
    iris_remap_view_defaults(&view, &camera.intrinsics, (iris_size){VIEW_W, VIEW_H});
    assert_int_equal(iris_remap_init(&map, places, &view, &camera, (iris_size){W, H}), IRIS_OK);
    assert_int_equal(iris_remap_draw(&dst, &src, &map), IRIS_OK);
    for (int y = 0; y < VIEW_H; y++) {
        assert_memory_equal(view_pixels[y], source[y], sizeof view_pixels[y]);
    }
}

static void gray_is_a_channel_of_color(void **state)
{
    (void)state;
    static uint8_t gray[H][W], row[VIEW_W];
    iris_sensor camera = camera_of(-0.3, 0.1, 0.001);
    iris_remap_view view;
    draw_waves();
    for (int i = 0; i < W * H; i++) {
        gray[i / W][i % W] = source[i / W][i % W][1];
    }
    const iris_image src = image_of(source, W, H, IRIS_RGB888, sizeof source),
                     one = image_of(gray, W, H, IRIS_GRAY8, sizeof gray);
    const iris_image dst = image_of(view_pixels, VIEW_W, VIEW_H, IRIS_RGB888, sizeof view_pixels);
    iris_remap_view_defaults(&view, &camera.intrinsics, (iris_size){VIEW_W, VIEW_H});
    assert_int_equal(iris_remap_init(&map, places, &view, &camera, (iris_size){W, H}), IRIS_OK);
    assert_int_equal(iris_remap_draw(&dst, &src, &map), IRIS_OK);
    for (int y = 0; y < VIEW_H; y++) {
        assert_int_equal(iris_remap_row(row, &map, &one, y), IRIS_OK);
        for (int x = 0; x < VIEW_W; x++) {
            assert_int_equal(row[x], view_pixels[y][x][1]);
        }
    }
}

static void refusals(void **state)
{
    (void)state;
    iris_sensor camera = camera_of(0, 0, 0), flat = camera;
    iris_remap_view view, wide;
    const iris_image src = image_of(source, W, H, IRIS_RGB888, sizeof source),
                     small = image_of(source, 8, 8, IRIS_RGB888, 192);
    const iris_image dst = image_of(view_pixels, VIEW_W, VIEW_H, IRIS_RGB888, sizeof view_pixels);
    const iris_image gray = image_of(view_pixels, VIEW_W, VIEW_H, IRIS_GRAY8, sizeof view_pixels);
    iris_remap_view_defaults(&view, &camera.intrinsics, (iris_size){VIEW_W, VIEW_H});
    assert_int_equal(iris_remap_init(NULL, places, &view, &camera, (iris_size){W, H}), IRIS_ERR_ARG);
    assert_int_equal(iris_remap_init(&map, places, &view, &camera, (iris_size){W, 32001}), IRIS_ERR_RANGE);
    wide = view;
    wide.size.w = 0;
    assert_int_equal(iris_remap_init(&map, places, &wide, &camera, (iris_size){W, H}), IRIS_ERR_RANGE);
    flat.intrinsics.alpha_v = 0;
    assert_int_equal(iris_remap_init(&map, places, &view, &flat, (iris_size){W, H}), IRIS_ERR_RANGE);
    assert_int_equal(iris_remap_init(&map, places, &view, &camera, (iris_size){W, H}), IRIS_OK);
    assert_int_equal(iris_remap_draw(&dst, &small, &map), IRIS_ERR_RANGE);
    assert_int_equal(iris_remap_draw(&small, &src, &map), IRIS_ERR_RANGE);
    assert_int_equal(iris_remap_draw(&gray, &src, &map), IRIS_ERR_FORMAT);
    assert_int_equal(iris_remap_draw(&dst, NULL, &map), IRIS_ERR_ARG);
    assert_int_equal(iris_remap_row(view_pixels, &map, &src, VIEW_H), IRIS_ERR_RANGE);
    assert_int_equal(iris_remap_row(view_pixels, &map, &src, -1), IRIS_ERR_RANGE);
}

/* Any camera: the sanitizers look on. */
static void any_numbers(void **state)
{
    (void)state;
    const iris_image src = image_of(source, W, H, IRIS_RGB888, sizeof source);
    const iris_image dst = image_of(view_pixels, 33, 17, IRIS_RGB888, sizeof view_pixels);
    for (int i = 0; i < 300; i++) {
        iris_sensor camera = camera_of(0, 0, 0);
        iris_remap_view view;
        iris_remap_view_defaults(&view, &camera.intrinsics, (iris_size){33, 17});
        camera.lens = (iris_lens){any_q32(),
                                  any_q32(),
                                  any_q32(),
                                  any_q32(),
                                  any_q32(),
                                  {any_q32(), any_q32()},
                                  i % 2 ? IRIS_LENS_BENDS : IRIS_LENS_CORRECTS};
        camera.intrinsics.u0 = any_q32();
        view.intrinsics.shear = any_q32();
        view.turn.m[i % 9] = any_q32();
        if (iris_remap_init(&map, places, &view, &camera, (iris_size){W, H}) == IRIS_OK) {
            assert_int_equal(iris_remap_draw(&dst, &src, &map), IRIS_OK);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_in_double_precision),
        cmocka_unit_test(behind_the_fold_nothing_is_seen),
        cmocka_unit_test(without_a_lens_nothing_changes),
        cmocka_unit_test(gray_is_a_channel_of_color),
        cmocka_unit_test(refusals),
        cmocka_unit_test(any_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
