/* IRIS-3D - maps of space: voxels as voxel.h has them, with odds as grid.h has them. Pictures of depths taken from known
 * poses make one map, in which their errors average out (report, section 3.5).
 *
 * Null pointers are IRIS_ERR_ARG.
 */
#ifndef IRIS_3D_VOXEL_MAP_H
#define IRIS_3D_VOXEL_MAP_H

#include "iris/3d/grid.h"
#include "iris/3d/voxel.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_VOXEL_MAP_BYTES(nx, ny, nz) ((size_t)(nx) * (size_t)(ny) * (size_t)(nz))

/* A box of space: x and y on the floor as in map_pose.h, z up from it. Rows along x follow each other along y, then z. */
typedef struct {
    int8_t *odds;        /* the caller's, IRIS_VOXEL_MAP_BYTES of the counts */
    int32_t counts[3];   /* 1 to IRIS_VOXEL_SIDE_MAX each */
    int32_t cell_mm;     /* a voxel's side, 1 to IRIS_GRID_CELL_MAX_MM */
    int32_t least_mm[3]; /* the corner of voxel 0, within IRIS_MAP_PLACE_MAX_MM */
} iris_voxel_map;

/* Makes *map in `bytes` bytes at `odds`, which stay the caller's, all unknown.
 * IRIS_ERR_RANGE: a number outside its range above, or too few bytes. O(voxels). */
iris_status iris_voxel_map_init(iris_voxel_map *map, int8_t *odds, size_t bytes, const int32_t counts[3],
                                int32_t cell_mm, const int32_t least_mm[3]);

typedef struct {
    iris_fusion fusion; /* default: as grid.h */
    int32_t
        every; /* pixels: of so many rows one is taken, and of so many of its pixels, 1 and more; default 2 */
} iris_voxel_fusion;

/* As given above. Null is ignored. */
void iris_voxel_fusion_defaults(iris_voxel_fusion *config);

#define IRIS_VOXEL_MAP_FUSE_SCRATCH_BYTES(nx, ny, nz)                                                        \
    IRIS_SCRATCH_ROUND((IRIS_VOXEL_MAP_BYTES(nx, ny, nz) + 31u) / 32u * 4u)

/* Adds a picture of depths taken by a camera on a robot at `robot`: each pixel is a ray from the lens to what it sees, and
 * counts as a beam does in iris_grid_fuse: a voxel counts once in a picture, hits before misses, less where depths are
 * unsure. What is farther than the camera's far_mm frees the way so far. The camera's low_mm and high_mm do not matter.
 * config may be null for the defaults.
 * IRIS_ERR_ARG: an invalid map, camera (scan.h), or config; errors of iris_image_check; IRIS_ERR_FORMAT: depth is not
 * IRIS_GRAY_U16; IRIS_ERR_RANGE: the lens is outside of the map; IRIS_ERR_SCRATCH: less than
 * IRIS_VOXEL_MAP_FUSE_SCRATCH_BYTES(...). Nothing is changed then.
 * O(voxels / 32 + pixels taken * voxels passed). */
iris_status iris_voxel_map_fuse(const iris_voxel_map *map, iris_map_pose robot, const iris_image *depth,
                                const iris_depth_camera *camera, const iris_voxel_fusion *config,
                                iris_scratch *scratch);

/* The voxels whose odds are at least `odds` (IRIS_ODDS_OCCUPIED, say), as a world of bits in `bytes` bytes at `bits`, for
 * iris_carve_write_ply and all else in voxel.h. Its unit is the meter.
 * IRIS_ERR_ARG: an invalid map; IRIS_ERR_RANGE: less than IRIS_VOXEL_BYTES of the counts. O(voxels). */
iris_status iris_voxel_map_solid(iris_voxel_world *world, uint32_t *bits, size_t bytes,
                                 const iris_voxel_map *map, int32_t odds);

#ifdef __cplusplus
}
#endif

#endif
