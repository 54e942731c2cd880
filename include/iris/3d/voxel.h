/* IRIS-3D - voxels: a box of space in small bricks, each of which is there or not, and where a view shows them.
 * Report, section 3.4.3 (Voxel, VoxelWorker, WorldSpace).
 *
 * A world has counts[0] x counts[1] x counts[2] voxels along x, y, and z, one bit each, in the caller's memory: rows along
 * x of whole words, the first voxel in the least significant bit; rows follow each other along y, then along z. Voxel 0
 * is at the box's corner `least`. Coordinates have 32 fraction bits and any unit: a box of 0.1 loses nothing.
 *
 * Null pointers are IRIS_ERR_ARG. A world whose fields contradict this page is IRIS_ERR_ARG everywhere but in the inline
 * functions, which check nothing.
 */
#ifndef IRIS_3D_VOXEL_H
#define IRIS_3D_VOXEL_H

#include <stddef.h>

#include "iris/3d/camera.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The most voxels along an axis. */
#define IRIS_VOXEL_SIDE_MAX 1024

/* Coordinates of a world's box are nearer to 0 than this: 2^28. */
#define IRIS_VOXEL_PLACE_MAX ((iris_q32)1 << 60)

/* Words of a row of nx voxels, and bytes of a world. Constant expressions. */
#define IRIS_VOXEL_ROW_WORDS(nx)     (((size_t)(nx) + 31u) / 32u)
#define IRIS_VOXEL_BYTES(nx, ny, nz) (IRIS_VOXEL_ROW_WORDS(nx) * 4u * (size_t)(ny) * (size_t)(nz))

/* A voxel by its numbers along x, y, and z. */
typedef struct {
    int32_t x, y, z;
} iris_voxel;

typedef struct {
    uint32_t *bits;        /* the caller's, IRIS_VOXEL_BYTES of the counts */
    int32_t counts[3];     /* 1 to IRIS_VOXEL_SIDE_MAX each */
    iris_vec3 least, most; /* corners of the box; each coordinate of most above that of least */
} iris_voxel_world;

/* Makes *world of counts voxels between two corners, in `bytes` bytes at `bits`, which stays the caller's. The voxels are
 * as the memory is: see iris_voxel_fill.
 * IRIS_ERR_RANGE: a count outside its range, a corner as far away as IRIS_VOXEL_PLACE_MAX, an empty box, or too few
 * bytes. O(1). */
iris_status iris_voxel_world_init(iris_voxel_world *world, uint32_t *bits, size_t bytes,
                                  const int32_t counts[3], const iris_vec3 corners[2]);

/* All voxels there (there is not 0), or none. Bits behind the end of a row become 0. O(words). */
iris_status iris_voxel_fill(const iris_voxel_world *world, int there);

/* The words of the row along x. y and z are inside. */
static inline uint32_t *iris_voxel_row(const iris_voxel_world *world, int32_t y, int32_t z)
{
    return world->bits +
           IRIS_VOXEL_ROW_WORDS(world->counts[0]) * ((size_t)z * (size_t)world->counts[1] + (size_t)y);
}

/* Is it there: 1 or 0. Voxels outside of the world are not. */
static inline int iris_voxel_get(const iris_voxel_world *world, iris_voxel voxel)
{
    int inside = voxel.x >= 0 && voxel.x < world->counts[0] && voxel.y >= 0 && voxel.y < world->counts[1] &&
                 voxel.z >= 0 && voxel.z < world->counts[2];
    return inside && (iris_voxel_row(world, voxel.y, voxel.z)[voxel.x / 32] >> (voxel.x % 32) & 1u) != 0;
}

/* Puts it there (there is not 0), or takes it away. IRIS_ERR_RANGE: outside of the world. O(1). */
iris_status iris_voxel_set(const iris_voxel_world *world, iris_voxel voxel, int there);

/* How many there are. O(words). */
iris_status iris_voxel_count(int32_t *count, const iris_voxel_world *world);

/* The middle of a voxel, each coordinate to half a unit. IRIS_ERR_RANGE: outside of the world; *center is untouched.
 * O(1), three divisions of 128 bits. */
iris_status iris_voxel_center(iris_vec3 *center, const iris_voxel_world *world, iris_voxel voxel);

/* A row's voxels that are at the surface: there, with one of their six neighbors not there, or at the world's edge.
 * surface: IRIS_VOXEL_ROW_WORDS words, not of the world. IRIS_ERR_RANGE: no such row. O(words), 32 voxels at a time. */
iris_status iris_voxel_surface_row(uint32_t *surface, const iris_voxel_world *world, int32_t y, int32_t z);

/* The voxels at the surface, in the order x, then y, then z. *count: how many there are. voxels has room for `room`; null
 * for a room of 0, which only counts. IRIS_ERR_FULL: there are more than room, the first are listed. */
iris_status iris_voxel_surface(iris_voxel *voxels, int32_t room, int32_t *count,
                               const iris_voxel_world *world);

/* What a projective matrix does to the world, made ready for its lattice: the homogeneous place (U, V, W) of lattice
 * point (i, j, k), in halves of a voxel from the corner `least`, is at + i step[0] + j step[1] + k step[2], of one scale
 * for the three, and below 2^59 for all of the world. Voxel (x, y, z) is from (2 x, 2 y, 2 z) to 2 more in each. */
typedef struct {
    int64_t at[3];
    int64_t step[3][3];
} iris_voxel_view;

/* Makes *view of the world and M: 3 x 4, row by row, of any scale; W is above 0 in front of the camera
 * (iris_sensor_matrix gives such a one). IRIS_ERR_RANGE: M is all 0. O(1).
 * Steps are rounded: a place within the world is off by less than 2^-45 of the greatest of |U|, |V|, |W| in it. */
iris_status iris_voxel_view_init(iris_voxel_view *view, const iris_voxel_world *world, const iris_q32 m[12]);

/* Where the straight edges of a projected voxel end: in pixels, (0, 0) the middle of the top left one. */
typedef struct {
    iris_vec2 least, most;
} iris_voxel_bounds;

/* The footprint of a voxel: the bounds of its eight corners as the view shows them, and so of all that is in it.
 * IRIS_ERR_RANGE: outside of the world, or a corner is not in front of the camera; *bounds is untouched. O(1), sixteen
 * divisions of 128 bits. */
iris_status iris_voxel_footprint(iris_voxel_bounds *bounds, const iris_voxel_world *world,
                                 const iris_voxel_view *view, iris_voxel voxel);

/* The matrix that shows the world on a plane as seen from the eye: shadows of a lamp. plane->place is the plane's origin,
 * the first two rows of plane->turn are its axes, the third one its normal, away from the eye; places come out in the
 * unit of the world. IRIS_ERR_RANGE: the eye is in the plane or behind it; m is untouched. O(1). */
iris_status iris_voxel_plane_matrix(iris_q32 m[12], const iris_pose *plane, iris_vec3 eye);

#ifdef __cplusplus
}
#endif

#endif
