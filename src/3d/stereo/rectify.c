#include "iris/3d/rectify.h"

#include <string.h>

#include "iris/3d/stereo.h"
#include "rectify_window.h"

#define NEAREST  ((iris_q32)1 << 16) /* of the cameras to each other */
#define ASIDE    (IRIS_Q32_ONE / 2)  /* sine of the angle between the baseline and where cameras look */
#define LONGEST  8                   /* focal lengths of a camera: a view so narrow shows nothing in common */
#define SIDE_MIN 16

static iris_vec3 axis_of(const iris_sensor *camera, int row)
{
    const iris_q32 *m = camera->pose.turn.m + 3 * row;
    return (iris_vec3){m[0], m[1], m[2]};
}

/* From the world to the views: the baseline, across it, and between the two directions in which the cameras look. */
static iris_rectify_flaw frame_of(iris_mat3 *turn, iris_q32 *baseline, const iris_sensor cameras[2])
{
    const iris_vec3 between = iris_vec3_sub(cameras[1].pose.place, cameras[0].pose.place);
    const iris_vec3 ahead = axis_of(&cameras[0], 2), other = axis_of(&cameras[1], 2);
    iris_vec3 x, mean, z;
    *baseline = iris_vec3_length(between);
    if (*baseline < NEAREST || iris_vec3_normalize(&x, between) != IRIS_OK) {
        return IRIS_RECTIFY_ONE_PLACE;
    }
    if (iris_vec3_dot(ahead, other) < 0 ||
        iris_vec3_normalize(&mean, iris_vec3_add(ahead, other)) != IRIS_OK) {
        return IRIS_RECTIFY_APART;
    }
    const iris_vec3 across = iris_vec3_sub(mean, iris_vec3_scale(x, iris_vec3_dot(x, mean)));
    if (iris_vec3_length(across) < ASIDE || iris_vec3_normalize(&z, across) != IRIS_OK ||
        iris_vec3_dot(ahead, z) < ASIDE || iris_vec3_dot(other, z) < ASIDE) {
        return IRIS_RECTIFY_ALONG;
    }
    if (iris_vec3_dot(iris_vec3_add(axis_of(&cameras[0], 0), axis_of(&cameras[1], 0)), x) < -IRIS_Q32_ONE) {
        return IRIS_RECTIFY_SWAPPED;
    }
    const iris_vec3 y = iris_vec3_cross(z, x);
    *turn = (iris_mat3){{x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z}};
    return iris_rotation_tidy(turn) == IRIS_OK ? IRIS_RECTIFY_FINE : IRIS_RECTIFY_APART;
}

static iris_rectify_flaw rectify(iris_rectified *made, const iris_sensor cameras[2], const iris_size sizes[2],
                                 const iris_rectify_config *config, iris_plane_place *const outlines[2])
{
    const iris_size size = config->size.w > 0 ? config->size : sizes[0];
    iris_intrinsics lens_free = {0};
    iris_mat3 turn = {{0}};
    iris_rectify_flaw flaw = frame_of(&turn, &made->baseline, cameras);
    iris_q32 longest = 0;
    for (int k = 0; k < 2 && flaw == IRIS_RECTIFY_FINE; k++) {
        iris_mat3 back;
        const iris_q32 alpha = cameras[k].intrinsics.alpha_u;
        longest = alpha > longest ? alpha : longest;
        iris_mat3_transpose(&back, &cameras[k].pose.turn);
        iris_mat3_multiply(&made->views[k].turn, &turn, &back);
        if (!iris_rectify_outline(outlines[k], &cameras[k], &made->views[k].turn, sizes[k])) {
            flaw = IRIS_RECTIFY_APART;
        }
    }
    if (flaw == IRIS_RECTIFY_FINE && (!iris_rectify_window(&lens_free, outlines, size, config->keep) ||
                                      lens_free.alpha_u / LONGEST > longest)) {
        flaw = IRIS_RECTIFY_APART;
    }
    for (int k = 0; k < 2 && flaw == IRIS_RECTIFY_FINE; k++) {
        const iris_mat3 from_camera = made->views[k].turn;
        iris_remap_view_defaults(&made->views[k], &lens_free, size);
        made->views[k].turn = from_camera;
        made->cameras[k] = (iris_sensor){.intrinsics = lens_free, .pose = {turn, cameras[k].pose.place}};
    }
    made->focal = lens_free.alpha_u;
    return flaw;
}

static int is_size(iris_size size, int32_t least, int32_t most)
{
    return size.w >= least && size.h >= least && size.w <= most && size.h <= most;
}

static int is_sound(const iris_sensor cameras[2], const iris_size sizes[2], const iris_rectify_config *config)
{
    int sound = config->keep == IRIS_RECTIFY_VALID || config->keep == IRIS_RECTIFY_ALL;
    for (int k = 0; k < 2; k++) {
        sound = sound && is_size(sizes[k], 2, IRIS_REMAP_SOURCE_MAX) && cameras[k].intrinsics.alpha_u > 0 &&
                cameras[k].intrinsics.alpha_v > 0;
    }
    const int as_left = config->size.w == 0 && config->size.h == 0;
    return sound && is_size(as_left ? sizes[0] : config->size, SIDE_MIN, IRIS_SIDE_MAX);
}

iris_status iris_rectify(iris_rectified *made, const iris_sensor cameras[2], const iris_size sizes[2],
                         const iris_rectify_config *config, iris_scratch *scratch)
{
    static const iris_rectify_config plain = {{0, 0}, IRIS_RECTIFY_VALID};
    iris_plane_place *outlines[2];
    if (!made || !cameras || !sizes || !scratch) {
        return IRIS_ERR_ARG;
    }
    config = config ? config : &plain;
    if (!is_sound(cameras, sizes, config)) {
        return IRIS_ERR_RANGE;
    }
    size_t mark = iris_scratch_mark(scratch);
    outlines[0] = iris_scratch_take(scratch, IRIS_RECTIFY_SAMPLES * sizeof *outlines[0]);
    outlines[1] = iris_scratch_take(scratch, IRIS_RECTIFY_SAMPLES * sizeof *outlines[1]);
    if (outlines[0] && outlines[1]) {
        memset(made, 0, sizeof *made);
        made->flaw = rectify(made, cameras, sizes, config, outlines);
    }
    iris_scratch_release(scratch, mark);
    return !outlines[0] || !outlines[1]      ? IRIS_ERR_SCRATCH
           : made->flaw == IRIS_RECTIFY_FINE ? IRIS_OK
                                             : IRIS_ERR_DATA;
}

iris_status iris_rectify_point(iris_vec3 *world, const iris_rectified *rectified, iris_vec2 pixel,
                               uint16_t disparity)
{
    iris_vec2 p;
    if (!world || !rectified) {
        return IRIS_ERR_ARG;
    }
    const iris_sensor *camera = &rectified->cameras[0];
    const iris_q32 depth = iris_stereo_depth(disparity, rectified->baseline, rectified->focal);
    if (disparity <= 1 || depth == IRIS_STEREO_INFINITY ||
        iris_intrinsics_plane(&p, &camera->intrinsics, pixel) != IRIS_OK) {
        return IRIS_ERR_RANGE;
    }
    const iris_vec3 seen = {iris_q32_mul_sat(p.x, depth), iris_q32_mul_sat(p.y, depth), depth};
    const iris_vec3 at = iris_pose_out_of(&camera->pose, seen);
    const iris_q32 numbers[6] = {seen.x, seen.y, seen.z, at.x, at.y, at.z};
    for (int i = 0; i < 6; i++) {
        if (numbers[i] == INT64_MAX || numbers[i] == INT64_MIN) {
            return IRIS_ERR_RANGE;
        }
    }
    *world = at;
    return IRIS_OK;
}
