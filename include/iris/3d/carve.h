/* IRIS-3D - space carving: what is solid, from silhouettes seen by cameras that are known.
 *
 * A world of voxels begins whole. Each view takes away the voxels whose middles it shows outside of the object; what is
 * left is the visual hull. A voxel that a view does not show, as it is outside of the picture or not in front of the
 * camera, is kept: nobody has seen that it is empty. Views come one after the other, in any order, with the same result.
 * Report, section 3.4.4; K. N. Kutulakos and S. M. Seitz 2000; blocks after R. Szeliski 1993.
 */
#ifndef IRIS_3D_CARVE_H
#define IRIS_3D_CARVE_H

#include "iris/3d/voxel.h"
#include "iris/image.h"
#include "iris/scratch.h"
#include "iris/stream.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Working memory of iris_carve_view for silhouettes of w x h pixels: their integral image. */
#define IRIS_CARVE_SCRATCH_BYTES(w, h) IRIS_SCRATCH_ROUND(((size_t)(w) + 1u) * ((size_t)(h) + 1u) * 4u)

/* Takes away the voxels of the world that the view shows outside of the silhouette.
 *   silhouette  IRIS_MASK1, sides up to IRIS_SIDE_MAX - 1; selected is the object
 *   m           the projective matrix to its pixels: see iris_voxel_view_init; without a lens (undistort before)
 * The voxel's middle is shown in the pixel that is nearest (halves go right and down).
 * IRIS_ERR_ARG: null pointer, invalid world or view; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: a side too long, or m is all 0;
 * IRIS_ERR_SCRATCH. The world is untouched then.
 * O(pixels) once; blocks of 8 x 8 x 8 voxels are kept or go at once where their footprint is all object, all
 * background, or outside of the picture, by two divisions for each of 8 corners; in others each voxel that is left takes
 * two divisions. The result is that of asking each voxel, bit by bit. */
iris_status iris_carve_view(const iris_voxel_world *world, const iris_image *silhouette, const iris_q32 m[12],
                            iris_scratch *scratch);

/* Writes the middles of the surface's voxels (iris_voxel_surface) as a PLY file: text, a vertex x y z with 9 decimals in
 * each line, in the world's unit. IRIS_ERR_ARG; IRIS_ERR_IO: the sink failed, some bytes may have been taken.
 * O(words + vertices). */
iris_status iris_carve_write_ply(iris_sink sink, const iris_voxel_world *world);

#ifdef __cplusplus
}
#endif

#endif
