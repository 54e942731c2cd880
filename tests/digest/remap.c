#include "digest.h"

#include "iris/3d/remap.h"
#include "iris/3d/rotation.h"

#define W 44
#define H 30

/* A camera with a strong lens. */
static iris_sensor camera(void)
{
    iris_sensor sensor = {.intrinsics = {36 * IRIS_Q32_ONE, 37 * IRIS_Q32_ONE, IRIS_Q32_ONE / 9,
                                         22 * IRIS_Q32_ONE, 14 * IRIS_Q32_ONE}};
    iris_mat3_identity(&sensor.pose.turn);
    sensor.lens.k1 = -IRIS_Q32_ONE / 3;
    sensor.lens.k2 = IRIS_Q32_ONE / 11;
    sensor.lens.p1 = IRIS_Q32_ONE / 500;
    sensor.lens.p2 = -IRIS_Q32_ONE / 700;
    return sensor;
}

static void draw(iris_format format, int step_bits, iris_vec3 turn)
{
    const iris_size size = {W, H};
    const iris_sensor sensor = camera();
    iris_remap remap;
    iris_remap_view view;
    iris_remap_view_defaults(&view, &sensor.intrinsics, size);
    iris_rotation_from_vector(&view.turn, turn);
    view.step_bits = step_bits;
    view.fill = 7;
    size_t count = IRIS_REMAP_PLACES(W, H, step_bits);
    iris_place *places = digest_take(count * sizeof *places);
    iris_image src = digest_picture(format, W, H), dst = digest_canvas(format, W, H);
    digest_number(iris_remap_init(&remap, places, &view, &sensor, size));
    digest_values(places, count * sizeof *places, sizeof places->x_q16);
    digest_number(iris_remap_draw(&dst, &src, &remap));
    digest_view(&dst);
}

static void undistort(void)
{
    draw(IRIS_GRAY8, 3, (iris_vec3){0, 0, 0});
}

static void undistort_color(void)
{
    draw(IRIS_RGB888, 3, (iris_vec3){0, 0, 0});
}

static void rectify(void)
{
    draw(IRIS_GRAY8, 2, (iris_vec3){IRIS_Q32_ONE / 10, -IRIS_Q32_ONE / 7, IRIS_Q32_ONE / 5});
}

const digest_operation digest_remap[] = {
    {"remap.undistort", undistort},
    {"remap.undistort_color", undistort_color},
    {"remap.rectify", rectify},
    {NULL, NULL},
};
