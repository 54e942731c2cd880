/* What worlds of voxels, their views, and carving share. */
#ifndef IRIS_3D_VOXEL_PARTS_H
#define IRIS_3D_VOXEL_PARTS_H

#include "iris/3d/voxel.h"

/* IRIS_ERR_ARG: null, or contradicts voxel.h. */
iris_status iris_voxel_check(const iris_voxel_world *world);

int iris_voxel_is_inside(const iris_voxel_world *world, iris_voxel voxel);

/* How many bits of a row are set before bit x. */
int32_t iris_voxel_row_rank(const uint32_t *bits, int32_t x);

/* How many voxels at the surface come before each row: counts[1] * counts[2] numbers, in the order of rows. */
void iris_voxel_surface_rows(int32_t *rows, const iris_voxel_world *world);

/* Along axis 0, 1, or 2. */
static inline iris_q32 iris_voxel_coordinate(iris_vec3 a, int axis)
{
    return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

/* U, V, or W (row 0, 1, 2) of a point of the lattice. Wraps for views that iris_voxel_view_init has not made. */
static inline int64_t iris_voxel_homogeneous(const iris_voxel_view *view, int row, iris_voxel lattice)
{
    return (int64_t)((uint64_t)view->at[row] + (uint64_t)view->step[0][row] * (uint64_t)lattice.x +
                     (uint64_t)view->step[1][row] * (uint64_t)lattice.y +
                     (uint64_t)view->step[2][row] * (uint64_t)lattice.z);
}

#endif
