/* IRIS-XT - edge points: Canny's edges as a list, with the direction of each.
 *
 * What a Hough transform votes with. A point that knows its direction votes for the few lines, circles, or shapes that
 * fit it, not for all that pass through it: less work, and far fewer votes by chance. Report, sections 2.4 and 2.5;
 * D. H. Ballard, "Generalizing the Hough transform to detect arbitrary shapes", 1981.
 */
#ifndef IRIS_XT_EDGE_POINTS_H
#define IRIS_XT_EDGE_POINTS_H

#include "iris/xt/canny.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    int16_t x, y;     /* pixels */
    iris_angle angle; /* in which the picture gets brighter: 0 right, 16384 down, -16384 up */
} iris_edge_point;

/* Edge points of a picture of this size, for functions that take all of that. */
typedef struct {
    iris_edge_point *points; /* may be null when count is 0 */
    int32_t count;
    iris_size size;
} iris_edge_list;

/* Working memory: what canny.h takes, and one bit per pixel. 160x120 at sigma 1.4: 17 KB. */
#define IRIS_EDGE_POINTS_SCRATCH_BYTES(w, h, sigma_q16)                                                      \
    (IRIS_CANNY_SCRATCH_BYTES(w, h, sigma_q16) + IRIS_SCRATCH_ROUND(4u * IRIS_CANNY_WORDS(w) * (size_t)(h)))

/* The pixels that iris_canny marks in src, IRIS_GRAY8, row by row, each from the left, and the direction of the 3x3
 * Sobel gradient of the smoothed picture there (the nearest angle or one beside it). config null: the defaults. Beyond
 * the picture its edge goes on (IRIS_BORDER_REPLICATE). *count is the number of all. points may be null when capacity
 * is 0.
 *
 * IRIS_ERR_FULL: more edges than capacity; points has `capacity` of them, evenly selected.
 * IRIS_ERR_ARG: null pointer, negative capacity, or what canny.h says; the errors of iris_image_check;
 * IRIS_ERR_FORMAT; IRIS_ERR_SCRATCH. As canny.h, the smoothing twice; and 18 steps of shifts and additions per edge. */
iris_status iris_edge_points(iris_edge_point *points, int32_t capacity, int32_t *count, const iris_image *src,
                             const iris_canny_config *config, iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
