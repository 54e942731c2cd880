#include "lens_fold.h"

#define NEAREST  ((iris_q32)1 << 16) /* in front of the camera */
#define WIDEST   (8 * IRIS_Q32_ONE)  /* beside its axis, in focal lengths */
#define FARTHEST ((iris_q32)1 << 62)

static iris_q32 sat(iris_wide a)
{
    return iris_wide_round_shift_sat(a, 0);
}

/* a b + c, rounded once. */
static iris_q32 fused(iris_q32 a, iris_q32 b, iris_q32 c)
{
    return iris_wide_round_shift_sat(iris_wide_add(iris_wide_mul(a, b), iris_wide_mul(c, IRIS_Q32_ONE)), 32);
}

iris_vec3 iris_pose_into(const iris_pose *pose, iris_vec3 world)
{
    return iris_mat3_vector(&pose->turn, iris_vec3_sub(world, pose->place));
}

iris_vec3 iris_pose_out_of(const iris_pose *pose, iris_vec3 camera)
{
    return iris_vec3_add(iris_mat3_transposed_vector(&pose->turn, camera), pose->place);
}

/* Farther out nothing is to be told apart. */
static iris_q32 near(iris_q32 a)
{
    return a > FARTHEST ? FARTHEST : a < -FARTHEST ? -FARTHEST : a;
}

iris_vec2 iris_intrinsics_pixel(const iris_intrinsics *k, iris_vec2 p)
{
    p = (iris_vec2){near(p.x), near(p.y)};
    iris_wide u = iris_wide_add(iris_wide_mul(k->alpha_u, p.x), iris_wide_mul(k->u0, IRIS_Q32_ONE));
    u = iris_wide_add(u, iris_wide_mul(k->shear, p.y));
    return (iris_vec2){iris_wide_round_shift_sat(u, 32), fused(k->alpha_v, p.y, k->v0)};
}

iris_status iris_intrinsics_plane(iris_vec2 *p, const iris_intrinsics *k, iris_vec2 pixel)
{
    if (k->alpha_u <= 0 || k->alpha_v <= 0) {
        return IRIS_ERR_RANGE;
    }
    iris_q32 right = sat(iris_wide_sub(iris_wide_from(pixel.x), iris_wide_from(k->u0)));
    iris_q32 down = sat(iris_wide_sub(iris_wide_from(pixel.y), iris_wide_from(k->v0)));
    p->y = iris_q32_div_sat(down, k->alpha_v);
    p->x = iris_wide_div_sat(iris_wide_sub(iris_wide_mul(right, IRIS_Q32_ONE), iris_wide_mul(k->shear, p->y)),
                             k->alpha_u);
    return IRIS_OK;
}

iris_status iris_sensor_project(iris_vec2 *pixel, iris_q32 *depth, const iris_sensor *sensor, iris_vec3 world)
{
    iris_vec3 at = iris_pose_into(&sensor->pose, world);
    if (at.z < NEAREST) {
        return IRIS_ERR_RANGE;
    }
    iris_vec2 p = {iris_q32_div_sat(at.x, at.z), iris_q32_div_sat(at.y, at.z)};
    if (p.x > WIDEST || p.x < -WIDEST || p.y > WIDEST || p.y < -WIDEST) {
        return IRIS_ERR_RANGE;
    }
    iris_vec2 seen;
    if (iris_lens_show(&seen, &sensor->lens, p) != IRIS_OK) {
        return IRIS_ERR_RANGE;
    }
    *pixel = iris_intrinsics_pixel(&sensor->intrinsics, seen);
    if (depth) {
        *depth = at.z;
    }
    return IRIS_OK;
}

iris_status iris_sensor_ray(iris_line3 *ray, const iris_sensor *sensor, iris_vec2 pixel)
{
    iris_vec2 seen, straight;
    iris_vec3 direction;
    iris_status status = iris_intrinsics_plane(&seen, &sensor->intrinsics, pixel);
    if (status == IRIS_OK) {
        status = iris_lens_straighten(&straight, &sensor->lens, seen);
    }
    if (status == IRIS_OK) {
        iris_vec3 ahead = {straight.x, straight.y, IRIS_Q32_ONE};
        status = iris_vec3_normalize(&direction, iris_mat3_transposed_vector(&sensor->pose.turn, ahead));
    }
    if (status == IRIS_OK) {
        ray->origin = sensor->pose.place;
        ray->direction = direction;
    }
    return status;
}
