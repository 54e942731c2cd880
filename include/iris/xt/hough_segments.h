/* IRIS-XT - segments of the lines that hough.h finds: where along an endless line its points are.
 *
 * Points near the line support it: selected pixels of a mask, or edge points with a direction that fits. Segments are
 * what lies between gaps, and each point supports one only: taking a segment takes its points away. So the segments of
 * many lines are
 *
 *     for each line, best first
 *         while (iris_hough_segment_of_edges(&segment, &edges, &line, &config, &scratch) == IRIS_OK)
 *             segment is the longest that is left of this line
 *
 * Let the transform's separations be small then (3 degrees, 4 bins of rho): a line beside a better one keeps the points
 * of its own alone, and none if it has none. Votes that are in no segment are votes by chance.
 *
 * The line is fitted to the segment's points by regression (regress.h), and they are collected anew along that, over
 * again while they become more: ends are right to about a pixel, however coarse the bins of the transform. Report,
 * section 2.4.3, step 6 ("map each maximum in the accumulator back to image space").
 */
#ifndef IRIS_XT_HOUGH_SEGMENTS_H
#define IRIS_XT_HOUGH_SEGMENTS_H

#include "iris/xt/hough.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_HOUGH_REACH_MAX (64 * 65536)

typedef struct {
    int32_t max_gap; /* pixels along the line: a longer gap ends the segment; 0..IRIS_SIDE_MAX; default 8 */
    int32_t min_length; /* pixels, 1..IRIS_SIDE_MAX; default 20 */
    /* pixels: so far from the line points support it, 0..IRIS_HOUGH_REACH_MAX; default 1 */
    iris_q16 reach_q16;
    iris_angle spread;   /* so far may the direction of an edge point be from the line's theta,
                            0..IRIS_HOUGH_SPREAD_MAX; default 3641 (20 degrees) */
    int32_t full_circle; /* 1: as in iris_hough_config, an opposite direction does not fit; default 0 */
} iris_hough_segment_config;

typedef struct {
    /* fitted to the points; votes as they were. With full_circle its theta is a direction */
    iris_hough_line line;
    iris_hough_ends ends; /* on this line, at its first and last point */
    int32_t points;       /* that support it */
} iris_hough_segment;

/* Working memory: a bit for each pixel along the longer side. 640x480: 80 bytes. */
#define IRIS_HOUGH_SEGMENT_SCRATCH_BYTES(w, h)                                                               \
    IRIS_SCRATCH_ROUND(((size_t)((w) > (h) ? (w) : (h)) + 31u) / 32u * 4u)

/* Sensible values, as given above. Null is ignored. */
void iris_hough_segment_defaults(iris_hough_segment_config *config);

/* The longest segment of the line among the selected pixels of a mask; the pixels that support it are no longer
 * selected. The line is one that was found in an image of this size; lines that do not meet it have no segments. config
 * may be null for the defaults.
 *
 * IRIS_ERR_END: no segment as long as min_length; nothing is changed.
 * IRIS_ERR_ARG: null pointer, or a config value out of range; the errors of iris_image_check; IRIS_ERR_FORMAT: mask is
 * not IRIS_MASK1; IRIS_ERR_SCRATCH. O(longer side * reach), up to ten times. */
iris_status iris_hough_segment_of_mask(iris_hough_segment *segment, const iris_image *mask,
                                       const iris_hough_line *line, const iris_hough_segment_config *config,
                                       iris_scratch *scratch);

/* The same among edge points: those that support the segment are taken out of the list, the others keep their order.
 *
 * IRIS_ERR_END as above; IRIS_ERR_ARG: null pointer, a negative count, or a config value out of range; IRIS_ERR_RANGE:
 * a side outside 1..IRIS_SIDE_MAX, or a point outside the picture; IRIS_ERR_SCRATCH. O(count), up to ten times. */
iris_status iris_hough_segment_of_edges(iris_hough_segment *segment, iris_edge_list *edges,
                                        const iris_hough_line *line, const iris_hough_segment_config *config,
                                        iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
