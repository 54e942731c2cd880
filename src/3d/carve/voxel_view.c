/* Where a view shows voxels. */
#include "voxel_parts.h"

#define VIEW_BITS 58 /* of the greatest homogeneous coordinate at a corner of the world */

/* Row `row` of M times the world's corner: bit 0, 1, 2 of `corner` say where it is at `most`. With 64 fraction bits. */
static iris_wide corner_value(const iris_voxel_world *world, const iris_q32 m[12], int row, int corner)
{
    iris_wide sum = iris_wide_mul(m[4 * row + 3], IRIS_Q32_ONE);
    for (int axis = 0; axis < 3; axis++) {
        const iris_vec3 place = corner >> axis & 1 ? world->most : world->least;
        sum = iris_wide_add(sum, iris_wide_mul(m[4 * row + axis], iris_voxel_coordinate(place, axis)));
    }
    return sum;
}

/* a / 2^shift, or times 2^-shift where shift is negative; it fits. */
static int64_t scaled(iris_wide a, int shift)
{
    if (shift >= 0) {
        return iris_wide_round_shift_sat(a, shift);
    }
    return (int64_t)(a.low << -shift);
}

iris_status iris_voxel_view_init(iris_voxel_view *view, const iris_voxel_world *world, const iris_q32 m[12])
{
    iris_status status = view && m ? iris_voxel_check(world) : IRIS_ERR_ARG;
    int most = 0;
    if (status != IRIS_OK) {
        return status;
    }
    for (int row = 0; row < 3; row++) {
        for (int corner = 0; corner < 8; corner++) {
            int bits = iris_wide_bits(corner_value(world, m, row, corner));
            most = bits > most ? bits : most;
        }
    }
    if (most == 0) {
        return IRIS_ERR_RANGE;
    }
    const int shift = most - VIEW_BITS;
    for (int row = 0; row < 3; row++) {
        const int64_t first = scaled(corner_value(world, m, row, 0), shift);
        view->at[row] = first;
        for (int axis = 0; axis < 3; axis++) {
            const int64_t along = scaled(corner_value(world, m, row, 1 << axis), shift) - first;
            view->step[axis][row] =
                iris_wide_div_sat(iris_wide_from(along), 2 * (int64_t)world->counts[axis]);
        }
    }
    return IRIS_OK;
}

static void take_in(iris_q32 *least, iris_q32 *most, iris_q32 place)
{
    *least = place < *least ? place : *least;
    *most = place > *most ? place : *most;
}

iris_status iris_voxel_footprint(iris_voxel_bounds *bounds, const iris_voxel_world *world,
                                 const iris_voxel_view *view, iris_voxel voxel)
{
    iris_voxel_bounds seen = {{INT64_MAX, INT64_MAX}, {INT64_MIN, INT64_MIN}};
    iris_status status = bounds && view ? iris_voxel_check(world) : IRIS_ERR_ARG;
    if (status != IRIS_OK) {
        return status;
    }
    if (!iris_voxel_is_inside(world, voxel)) {
        return IRIS_ERR_RANGE;
    }
    for (int corner = 0; corner < 8; corner++) {
        const iris_voxel at = {2 * voxel.x + 2 * (corner & 1), 2 * voxel.y + (corner & 2),
                               2 * voxel.z + (corner >> 1 & 2)};
        const int64_t depth = iris_voxel_homogeneous(view, 2, at);
        if (depth <= 0) {
            return IRIS_ERR_RANGE;
        }
        take_in(&seen.least.x, &seen.most.x, iris_q32_div_sat(iris_voxel_homogeneous(view, 0, at), depth));
        take_in(&seen.least.y, &seen.most.y, iris_q32_div_sat(iris_voxel_homogeneous(view, 1, at), depth));
    }
    *bounds = seen;
    return IRIS_OK;
}

/* A plane is the picture of a camera in the eye, whose focal length is the eye's distance from it. */
iris_status iris_voxel_plane_matrix(iris_q32 m[12], const iris_pose *plane, iris_vec3 eye)
{
    if (!m || !plane) {
        return IRIS_ERR_ARG;
    }
    const iris_vec3 seen = iris_pose_into(plane, eye);
    if (seen.z >= 0) {
        return IRIS_ERR_RANGE;
    }
    const iris_q32 away = seen.z == INT64_MIN ? INT64_MAX : -seen.z;
    const iris_sensor camera = {.intrinsics = {away, away, 0, seen.x, seen.y}, .pose = {plane->turn, eye}};
    iris_sensor_matrix(m, &camera);
    return IRIS_OK;
}
