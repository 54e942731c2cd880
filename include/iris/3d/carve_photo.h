/* IRIS-3D - photo-consistent space carving: what is solid, from the colors that several cameras see.
 *
 * Silhouettes never show what is hollow. Photographs do: a voxel at the true surface has one color for all cameras that
 * see it, and one in front of a hollow shows each camera another part of what is behind it. A plane of voxels is swept
 * through the world in six directions, along each axis and back. In front of the plane all is known: each pixel of each
 * view has a flag that says whether a voxel there has explained it already. So a view sees of a voxel in the plane what
 * has no flag yet. A voxel that the views do not agree on is taken away; the others get their pixels' flags. Sweeps go
 * on until a round of six has taken nothing away. What is left is the photo hull: the largest shape that all views agree
 * on. Report, section 3.4.4; K. N. Kutulakos and S. M. Seitz, A Theory of Shape by Space Carving, 2000.
 *
 * What differs from the paper. A view takes part from the layer of voxels on that its camera is in, and within a layer
 * each view goes from its camera outwards, so that voxels of the same layer hide each other as they do in space. A pixel
 * belongs to the first voxel that the ray of its middle meets. A view judges a voxel when at least half of the pixels of
 * its projection belong to it: who sees less of it looks along the surface, past what is in the voxel. Then its range of
 * levels counts, from least to most in each channel, over all pixels whose squares touch the projection, as the surface
 * may be anywhere in the voxel. Views agree on a voxel when their ranges have a level in common, or lack no more than
 * config.levels of it. So texture finer than the voxels takes none away, as a deviation over all pixels would; colors
 * that change over several voxels show what is hollow best. Views that are in front of no common plane are not compared.
 *
 * A voxel is kept that fewer than two views judge, and one that reaches behind a camera's eye is kept by that camera.
 * Begin with the hull of the silhouettes (carve.h) where there are some: the rounds are fewer, and the background matters
 * less. Lenses are none: undistort before.
 */
#ifndef IRIS_3D_CARVE_PHOTO_H
#define IRIS_3D_CARVE_PHOTO_H

#include "iris/3d/voxel.h"
#include "iris/image.h"
#include "iris/scratch.h"
#include "iris/stream.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_CARVE_PHOTOS_MAX 255

/* What a camera sees. */
typedef struct {
    iris_image picture; /* IRIS_GRAY8, IRIS_RGB888, or IRIS_BGR888 */
    const iris_image
        *silhouette; /* IRIS_MASK1 of the same size, the object selected: no other pixel counts. Null: none */
    iris_q32 m[12];  /* the projective matrix to its pixels: see iris_voxel_view_init */
} iris_carve_photo;

/* Views that belong together: all of color or all gray, their sizes any. */
typedef struct {
    const iris_carve_photo *photos;
    int32_t count; /* 1 to IRIS_CARVE_PHOTOS_MAX */
} iris_carve_photos;

typedef struct {
    int32_t
        levels; /* how much the ranges of two views may lack of a common level, 0 to 255: noise and shine */
    int32_t rounds; /* of six sweeps, at most; at least 1 */
} iris_carve_photo_config;

/* levels 16, rounds 100. A null pointer does nothing. */
void iris_carve_photo_defaults(iris_carve_photo_config *config);

/* Where a plane is swept to. */
typedef enum {
    IRIS_SWEEP_X_UP = 0,
    IRIS_SWEEP_X_DOWN,
    IRIS_SWEEP_Y_UP,
    IRIS_SWEEP_Y_DOWN,
    IRIS_SWEEP_Z_UP,
    IRIS_SWEEP_Z_DOWN
} iris_sweep;

/* Working memory for worlds of at most `side` voxels along an axis and `views` views of at most w x h pixels: two flags
 * for each pixel, 12 bytes for each voxel of a layer, 136 for each view. */
#define IRIS_CARVE_PHOTO_SCRATCH_BYTES(side, views, w, h)                                                    \
    (IRIS_SCRATCH_ROUND((size_t)(side) * (size_t)(side)*12u) +                                               \
     IRIS_SCRATCH_ROUND(((size_t)(side) + 1u) * 4u) + IRIS_SCRATCH_ROUND((size_t)(views)*136u) +             \
     2u * IRIS_SCRATCH_ROUND((size_t)(views)*IRIS_VOXEL_ROW_WORDS(w) * 4u * (size_t)(h)))

/* One sweep. *removed: voxels that it has taken away.
 * IRIS_ERR_ARG: null pointer, invalid world or view, a count, direction, or config out of its range; IRIS_ERR_FORMAT: of a
 * picture or silhouette, also color beside gray; IRIS_ERR_RANGE: a silhouette of another size than its picture, or a
 * matrix that is no camera at a place (iris_sensor_decompose); IRIS_ERR_SCRATCH. All is untouched then.
 * config null: the defaults. O(voxels), and for each voxel at the surface and each view that takes part sixteen divisions
 * and the pixels of its footprint. */
iris_status iris_carve_photo_sweep(int32_t *removed, const iris_voxel_world *world,
                                   const iris_carve_photos *photos, iris_sweep direction,
                                   const iris_carve_photo_config *config, iris_scratch *scratch);

/* Rounds of six sweeps, until one takes nothing away or config->rounds are done. *removed: by all of them. Errors and
 * memory as for a sweep, the loop over which it is. */
iris_status iris_carve_photo_world(int32_t *removed, const iris_voxel_world *world,
                                   const iris_carve_photos *photos, const iris_carve_photo_config *config,
                                   iris_scratch *scratch);

typedef struct {
    uint8_t r, g, b;
    uint8_t views; /* that see it: 0 for a voxel that nobody sees, which is gray, 128 */
} iris_carve_color;

/* Working memory of iris_carve_colors with room for `room` voxels. */
#define IRIS_CARVE_COLORS_SCRATCH_BYTES(side, views, w, h, room)                                             \
    (IRIS_CARVE_PHOTO_SCRATCH_BYTES(side, views, w, h) +                                                     \
     IRIS_SCRATCH_ROUND((size_t)(side) * (size_t)(side)*4u) + IRIS_SCRATCH_ROUND((size_t)(room)*16u))

/* The colors of the voxels at the surface, in the order of iris_voxel_surface: means of the pixels that belong to them.
 * *count: how many there are; colors has room for `room`, at least 1. Errors as for a sweep; IRIS_ERR_FULL: there are
 * more than room, *count says how many, and colors is untouched. Time as for a sweep of two directions. */
iris_status iris_carve_colors(iris_carve_color *colors, int32_t room, int32_t *count,
                              const iris_voxel_world *world, const iris_carve_photos *photos,
                              iris_scratch *scratch);

/* Writes the middles of the surface's voxels with their colors as a PLY file: as iris_carve_write_ply, each line x y z
 * red green blue. IRIS_ERR_ARG: also when count is not that of the surface; IRIS_ERR_IO. */
iris_status iris_carve_write_colored_ply(iris_sink sink, const iris_voxel_world *world,
                                         const iris_carve_color *colors, int32_t count);

#ifdef __cplusplus
}
#endif

#endif
