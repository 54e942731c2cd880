/* IRIS-XT - several lines, told apart: each as one straight path with a width, an angle, and a length.
 *
 * Two ways, after the report's section 2.4: by the skeleton of a mask, where lines are followed from end to end and
 * straight through crossings; or by the blocks of a quadtree, which costs less and is coarser: lines that touch each
 * other are one there. Both fit each line by orthogonal regression (regress.h).
 */
#ifndef IRIS_XT_PATHS_H
#define IRIS_XT_PATHS_H

#include "iris/fixed.h"
#include "iris/image.h"
#include "iris/quadtree.h"
#include "iris/scratch.h"
#include "iris/status.h"
#include "iris/xt/region.h"

#ifdef __cplusplus
extern "C" {
#endif

/* (x0, y0) is the end nearer to the bottom; of two in one row the left one. */
typedef struct {
    int32_t x0, y0, x1, y1; /* pixels */
    int32_t width_px;       /* mean */
    int32_t length_px;      /* between the ends */
    iris_angle angle;       /* 0 straight up the image, positive when it leans right, -90 to 90 degrees */
} iris_path;

typedef struct {
    /* 0..1000: a path is this long at least, in permil of the shorter side; default 150 */
    int32_t length_permil;
    int32_t slender_permil; /* 1000..100000: and this many times as long as wide; default 2000 */
    iris_angle straight; /* 0..45 degrees: a path goes on through a crossing that bends it less; default 25 */
    int32_t bright;      /* of iris_paths_of_regions, 1: lines brighter than the floor; default 0: darker */
    int32_t contrast_permil; /* of the same, 50..900: the difference from the floor's level; default 250 */
} iris_paths_config;

/* Working memory of iris_paths_find: 12 KB for 160x120. */
#define IRIS_PATHS_SCRATCH_BYTES(w, h)                                                                       \
    (IRIS_SCRATCH_ROUND(17u * (((size_t)(w) / 64u + 1u) * ((size_t)(h) + 2u) + 2u) +                         \
                        12u * ((size_t)(w) / 64u + 3u) + 7u) +                                               \
     IRIS_SCRATCH_ROUND(96u * 12u + 160u * 16u + 8u * ((size_t)(w) + (size_t)(h))))

/* Sensible values, as given above. Null is ignored. */
void iris_paths_defaults(iris_paths_config *config);

/* The lines of a mask (IRIS_MASK1; line_mask.h makes them), the longest first. config may be null for the defaults.
 *
 * IRIS_ERR_FULL: more than capacity; the longest are there, and *count says how many were found.
 * IRIS_ERR_ARG: null pointer (paths may be null when capacity is 0), a negative capacity, or a config value out of
 * range; errors of iris_image_check; IRIS_ERR_FORMAT; IRIS_ERR_SCRATCH. O(iris_skeleton), and O(pixels of the skeleton
 * times width of the lines). */
iris_status iris_paths_find(iris_path *paths, int32_t capacity, int32_t *count, const iris_image *mask,
                            const iris_paths_config *config, iris_scratch *scratch);

/* The regions of a gray picture's tree that are lines: slender, and darker or brighter than the floor, which is the
 * largest region. tree and table are those of iris_quadtree_segment and iris_region_merge.
 *
 * IRIS_ERR_FULL and IRIS_ERR_ARG as above; IRIS_ERR_ARG also for a table without regions, or with a capacity below its
 * count; errors of iris_quadtree_check. O(regions * leaves), and O(rows of the leaves). */
iris_status iris_paths_of_regions(iris_path *paths, int32_t capacity, int32_t *count,
                                  const iris_quadtree *tree, const iris_region_table *table,
                                  const iris_paths_config *config);

#ifdef __cplusplus
}
#endif

#endif
