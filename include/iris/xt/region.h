/* IRIS-XT - regions: what is of one color and belongs together, as a table of colors, areas, and places.
 *
 * The leaves of a quadtree (quadtree.h) are merged with their neighbors: leaves that share a part of a side (a corner
 * does not count). The regions of two neighbors become one when
 *
 *   - the means of the regions differ by at most the tolerance, in every channel; or
 *   - the means of the two leaves do, and both leaves are even: their range is within the tree's tolerance, and no
 *     side is below IRIS_REGION_EVEN_SIDE. So the light on a wall or in the sky may change as far as it likes, if it
 *     changes slowly. Smaller leaves are no witnesses of that: across a blurred edge they change slowly, too.
 *
 * Then each region below the least area joins a neighbor. Both take three rounds, so that what is most alike comes
 * first: in the first round only leaves (where small regions join: regions) whose means differ by at most 15 levels
 * become one, in the second 63, in the third 255. In each round, leaf after leaf in the order of the tree is compared
 * with those above it, from left to right, then with those left of it, from top to bottom.
 *
 * The mean of a region is that of its leaves' means, weighted by their areas, and rounded. Report, sections 2.3 and
 * 2.6.
 */
#ifndef IRIS_XT_REGION_H
#define IRIS_XT_REGION_H

#include "iris/quadtree.h"
#include "iris/scratch.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_REGION_EVEN_SIDE 4 /* pixels */

typedef struct {
    int32_t tolerance;  /* gray levels, 0..255; default 25 */
    int32_t least_area; /* pixels, 0 or more; default 64 */
} iris_region_config;

typedef struct {
    iris_color mean;
    int32_t area;   /* pixels */
    int32_t leaves; /* how many */
    iris_rect box;  /* the smallest around all of it */
} iris_region;

/* Before the call: regions, capacity, and labels. */
typedef struct {
    iris_region *regions; /* the caller's, for the largest regions; may be null when capacity is 0 */
    int32_t capacity;     /* how many there is room for */
    int32_t *labels;      /* the caller's, one for each leaf of the tree */
    int32_t count;        /* of all regions */
} iris_region_table;

/* Working memory for a tree of so many leaves. */
#define IRIS_REGION_SCRATCH_BYTES(w, h, leaves)                                                              \
    (IRIS_SCRATCH_ROUND((size_t)(leaves)*32) + IRIS_SCRATCH_ROUND((size_t)(leaves)*4) +                      \
     IRIS_SCRATCH_ROUND((size_t)(w)*4) + IRIS_SCRATCH_ROUND((size_t)(h)*4))

/* Sensible values, as given above. Null is ignored. */
void iris_region_defaults(iris_region_config *config);

/* The regions of a tree, the largest first; of equal ones that with the earlier first leaf. labels says for each leaf
 * which region it belongs to, as an index of that order. config may be null for the defaults.
 *
 * IRIS_ERR_FULL: more regions than capacity; the largest are in the table, and labels are those of all.
 * IRIS_ERR_ARG: null pointer, a negative capacity, or a config value out of range; errors of iris_quadtree_check;
 * IRIS_ERR_SCRATCH. O(leaves' perimeters), six times over, each step with
 * a search of O(log(leaves)) at worst, and O(regions * log(regions)) for the order. */
iris_status iris_region_merge(iris_region_table *table, const iris_quadtree *tree,
                              const iris_region_config *config, iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
