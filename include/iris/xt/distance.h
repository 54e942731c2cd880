/* IRIS-XT - distance: how far inside is each pixel of a mask?
 *
 * The distance of each selected pixel to the nearest one that is not selected, 0 for those: to the wall, seen from the
 * floor. What lies beyond the edge is neither. Two passes over the picture, after A. Rosenfeld and J. L. Pfaltz 1966, with
 * the steps of G. Borgefors 1986.
 */
#ifndef IRIS_XT_DISTANCE_H
#define IRIS_XT_DISTANCE_H

#include "iris/image.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    IRIS_DISTANCE_L1 = 0, /* |dx| + |dy| */
    IRIS_DISTANCE_CHAMFER /* 3 for each step to the side or up or down, 4 for a diagonal one: three times the true
                             distance, within 6 % */
} iris_distance_metric;

/* Of pixels that no clear one is near: all, when the mask has no clear pixel. Greater chamfer distances are
 * cut to it, too (from 16384 pixels on, diagonally); L1 distances never reach it. */
#define IRIS_DISTANCE_MAX 65535

/* distance: IRIS_GRAY_U16; mask: IRIS_MASK1 of the same size, disjoint from it.
 * IRIS_ERR_ARG: null pointer or unknown metric; the errors of iris_image_check; IRIS_ERR_FORMAT: other formats;
 * IRIS_ERR_RANGE: sizes differ; IRIS_ERR_ALIAS: any overlap. O(pixels), whatever the distances are. */
iris_status iris_distance_transform(const iris_image *distance, const iris_image *mask,
                                    iris_distance_metric metric);

#ifdef __cplusplus
}
#endif

#endif
