/* IRIS-XT - junctions: where lines meet, turn, and end, and where their branches lead.
 *
 * From a mask of the line (line_mask.h, or a color's pixels by iris_hsl_range_mask): T, Y, crossing, corner, and end,
 * each with its place in the image and the angle of each branch. Only the largest connected line of the mask is looked
 * at, if it leaves the image somewhere: the robot's line comes from somewhere.
 *
 * How: the mask is thinned (skeleton.h); branches hardly longer than the line is wide are taken away; branch points
 * hardly farther from each other than that are one junction. A branch's angle is that of a regression line through the
 * part of its skeleton from one to three line widths away, and the junction is where these lines meet. Three branches
 * of which two are one straight line make a T, three others a Y, more a crossing. That two branches are one straight
 * line does not depend on the camera's place, while angles do. Report, section 2.4 (skeletons, curves as short
 * segments).
 *
 * Angles are those in the image, not on the floor: 0 straight ahead (up the image), positive right, so that the way
 * back is near +-180 degrees.
 */
#ifndef IRIS_XT_JUNCTION_H
#define IRIS_XT_JUNCTION_H

#include "iris/fixed.h"
#include "iris/image.h"
#include "iris/scratch.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_JUNCTION_BRANCHES 6 /* at most */
#define IRIS_JUNCTIONS_MAX     8 /* that are found in one mask; of more the nearest */

typedef enum {
    IRIS_JUNCTION_END = 0, /* the line stops inside of the image: one branch, the line */
    IRIS_JUNCTION_CORNER,  /* a sharp bend: two branches, not within 25 degrees */
    IRIS_JUNCTION_T,       /* a straight line and a branch to one side: from whichever side one comes */
    IRIS_JUNCTION_Y,       /* three branches, no two one straight line, nor within 25 degrees */
    IRIS_JUNCTION_CROSSING /* four branches or more */
} iris_junction_type;

typedef struct {
    iris_junction_type type;
    int32_t x_q4, y_q4;    /* where the branches' middles meet, or the line stops; pixels, 4 fraction bits */
    int32_t distance_rows; /* from the bottom row; 0 or more */
    int32_t width_px;      /* of the line there, roughly */
    int32_t branch_count;
    /* from the left, -180 degrees first; behind the last one 0 */
    iris_angle branches[IRIS_JUNCTION_BRANCHES];
    /* by the length of the shortest branch in sight: 1000 for three line widths or more */
    int32_t confidence_permil;
} iris_junction;

typedef struct {
    /* 1000..10000: length of a branch, at least, in permil of the line's width; default 1300 */
    int32_t branch_permil;
    iris_angle straight; /* 0..45 degrees: two branches are one straight line if they bend less; default 18 */
    iris_angle corner;   /* 10..90 degrees: a corner bends by this or more; default 35 */
} iris_junction_config;

/* Working memory: 12 KB for 160x120. */
#define IRIS_JUNCTION_SCRATCH_BYTES(w, h)                                                                    \
    (IRIS_SCRATCH_ROUND(17u * (((size_t)(w) / 64u + 1u) * ((size_t)(h) + 2u) + 2u) +                         \
                        12u * ((size_t)(w) / 64u + 3u) + 7u) +                                               \
     IRIS_SCRATCH_ROUND(96u * 12u + 160u * 16u + 8u * ((size_t)(w) + (size_t)(h))))

/* Sensible values, as given above. Null is ignored. */
void iris_junction_defaults(iris_junction_config *config);

/* The junctions of a mask (IRIS_MASK1), the nearest to the bottom row first. The ends of a junction's branches are not
 * reported beside it, nor an end behind which the line goes on after a gap of up to three widths. Ends of two pieces up
 * to two widths from each other whose middles meet there at an angle are a corner: tape laid in pieces. The second piece
 * is looked at for nothing else. config may be null for the defaults.
 *
 * IRIS_ERR_FULL: more than capacity; the nearest are there, and *count says how many were found.
 * IRIS_ERR_ARG: null pointer (junctions may be null when capacity is 0), a negative capacity, or a config value out of
 * range; errors of iris_image_check; IRIS_ERR_FORMAT; IRIS_ERR_SCRATCH. O(iris_skeleton), and O(pixels of the skeleton
 * times width of the line). */
iris_status iris_junctions_find(iris_junction *junctions, int32_t capacity, int32_t *count,
                                const iris_image *mask, const iris_junction_config *config,
                                iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
