/* IRIS-3D - the surface of a world of voxels as a mesh of triangles.
 *
 * A vertex at each corner of the lattice that the surface goes through, moved to the mean of the faces of voxels that meet
 * there: surface nets (S. Gibson 1998), less stepped than cubes. Each face of a voxel with nothing beside it becomes
 * two triangles. The mesh is closed: each edge is of exactly two triangles, also where voxels meet in an edge or in a
 * corner only (surfaces that touch there have vertices of their own, and one more in the middle of such an edge).
 * Seen from outside, the corners of a triangle go counterclockwise in a right-handed frame.
 * Report, section 3.4.4.
 */
#ifndef IRIS_3D_CARVE_MESH_H
#define IRIS_3D_CARVE_MESH_H

#include "iris/3d/carve_photo.h"
#include "iris/stream.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Working memory for worlds of at most `side` voxels along an axis. */
#define IRIS_CARVE_MESH_SCRATCH_BYTES(side)                                                                  \
    (IRIS_SCRATCH_ROUND(((size_t)(side) + 1u) * ((size_t)(side) + 1u) * 8u) +                                \
     IRIS_SCRATCH_ROUND((size_t)(side) * (size_t)(side)*4u))

/* What a mesh has: *vertices and *triangles. IRIS_ERR_ARG. O(voxels). */
iris_status iris_carve_mesh_count(int64_t *vertices, int64_t *triangles, const iris_voxel_world *world);

/* Writes the mesh as a PLY file: text, vertices x y z with 9 decimals in the world's unit and their colors, triangles as
 * numbers of vertices from 0.
 *   colors, count  of iris_carve_colors for the world as it is; null and 0: without colors
 * IRIS_ERR_ARG: null pointer, invalid world, or a count that is not that of the surface; IRIS_ERR_RANGE: more than 2^31
 * - 1 vertices or triangles; IRIS_ERR_SCRATCH; nothing is written then. IRIS_ERR_IO: the sink failed, some bytes may
 * have been taken. O(voxels + triangles). */
iris_status iris_carve_write_mesh(iris_sink sink, const iris_voxel_world *world,
                                  const iris_carve_color *colors, int32_t count, iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
