#include "iris/3d/mounting.h"

#define SHRINK 6 /* a floor's numbers are 1/64 of K [R | -R t]: they fit */

static int is_near(iris_q32 length)
{
    return length <= IRIS_MOUNTING_FAR && length >= -IRIS_MOUNTING_FAR;
}

iris_status iris_mounting_pose(iris_pose *pose, const iris_mounting *mounting)
{
    static const iris_vec3 right = {IRIS_Q32_ONE, 0, 0}, down = {0, IRIS_Q32_ONE, 0},
                           forward = {0, 0, IRIS_Q32_ONE};
    /* of a level camera that looks ahead: its x, y, and z in the world */
    static const iris_mat3 level = {{IRIS_Q32_ONE, 0, 0, 0, 0, -IRIS_Q32_ONE, 0, IRIS_Q32_ONE, 0}};
    iris_mat3 tilt, pan, roll;
    if (!pose || !mounting) {
        return IRIS_ERR_ARG;
    }
    if (mounting->height < IRIS_MOUNTING_HEIGHT_MIN || !is_near(mounting->height) ||
        !is_near(mounting->right) || !is_near(mounting->ahead)) {
        return IRIS_ERR_RANGE;
    }
    /* what turns the camera turns what it sees the other way */
    iris_rotation_about(&pan, down, mounting->pan);
    iris_mat3_transpose(&pan, &pan);
    iris_rotation_about(&tilt, right, mounting->tilt);
    iris_rotation_about(&roll, forward, mounting->roll);
    iris_mat3_transpose(&roll, &roll);
    iris_mat3_multiply(&pan, &pan, &level);
    iris_mat3_multiply(&tilt, &tilt, &pan);
    iris_mat3_multiply(&pose->turn, &roll, &tilt);
    pose->place = (iris_vec3){mounting->right, mounting->ahead, mounting->height};
    return IRIS_OK;
}

/* K times a column of [R | -R t], into column `k` of the numbers. */
static void take_column(iris_q32 numbers[9], int k, const iris_intrinsics *of, iris_vec3 column)
{
    iris_wide u = iris_wide_add(iris_wide_mul(of->alpha_u, column.x), iris_wide_mul(of->shear, column.y));
    iris_wide v = iris_wide_mul(of->alpha_v, column.y);
    u = iris_wide_add(u, iris_wide_mul(of->u0, column.z));
    v = iris_wide_add(v, iris_wide_mul(of->v0, column.z));
    numbers[k] = iris_wide_round_shift_sat(u, 32 + SHRINK);
    numbers[3 + k] = iris_wide_round_shift_sat(v, 32 + SHRINK);
    numbers[6 + k] = iris_wide_round_shift_sat(iris_wide_from(column.z), SHRINK);
}

iris_status iris_mounting_floor(iris_floor *floor, const iris_mounting *mounting,
                                const iris_camera_model *camera)
{
    iris_pose pose;
    iris_q32 numbers[9];
    if (!floor || !mounting || !camera) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_mounting_pose(&pose, mounting);
    if (status != IRIS_OK || camera->intrinsics.alpha_u <= 0 || camera->intrinsics.alpha_v <= 0) {
        return IRIS_ERR_RANGE;
    }
    const iris_q32 *r = pose.turn.m;
    take_column(numbers, 0, &camera->intrinsics, (iris_vec3){r[0], r[3], r[6]});
    take_column(numbers, 1, &camera->intrinsics, (iris_vec3){r[1], r[4], r[7]});
    take_column(numbers, 2, &camera->intrinsics, iris_pose_into(&pose, (iris_vec3){0, 0, 0}));
    return iris_floor_init(floor, camera->size, numbers) == IRIS_OK ? IRIS_OK : IRIS_ERR_RANGE;
}

iris_status iris_mounting_view(iris_remap_view *view, const iris_mounting *mounting,
                               const iris_birdseye_window *window)
{
    iris_pose pose;
    if (!view || !mounting || !window || window->mm_per_pixel_q16 < IRIS_BIRDSEYE_SCALE_MIN ||
        window->mm_per_pixel_q16 > IRIS_BIRDSEYE_SCALE_MAX) {
        return IRIS_ERR_ARG;
    }
    if (window->size.w < 1 || window->size.w > IRIS_SIDE_MAX || window->size.h < 1 ||
        window->size.h > IRIS_SIDE_MAX || iris_mounting_pose(&pose, mounting) != IRIS_OK) {
        return IRIS_ERR_RANGE;
    }
    const iris_q32 scale = (iris_q32)window->mm_per_pixel_q16 * 65536;
    const iris_q32 x = (iris_q32)window->corner.x_q16 * 65536, y = (iris_q32)window->corner.y_q16 * 65536;
    const iris_q32 alpha = iris_q32_div_sat(mounting->height, scale);
    const iris_intrinsics down = {alpha, alpha, 0, iris_q32_div_sat(mounting->right - x, scale),
                                  iris_q32_div_sat(y - mounting->ahead, scale)};
    iris_remap_view_defaults(view, &down, window->size);
    /* from the camera to the world, and there y back and z down */
    iris_mat3_transpose(&view->turn, &pose.turn);
    for (int k = 3; k < 9; k++) {
        view->turn.m[k] = -view->turn.m[k];
    }
    view->step_bits = 2;
    view->fill = window->fill;
    return IRIS_OK;
}
