/* How much of two pictures a pair of rectified views shows: see rectify.h. */
#ifndef IRIS_RECTIFY_WINDOW_H
#define IRIS_RECTIFY_WINDOW_H

#include "iris/3d/rectify.h"

/* A place on the picture plane of the views, with 24 fraction bits. */
typedef struct {
    int32_t x, y;
} iris_plane_place;

/* The edge of a camera's picture as the views' picture plane has it: IRIS_RECTIFY_SAMPLES places, all around. `turn` is
 * from the camera to the views. What has no ray, or is beside the axis by more than four focal lengths, is replaced by
 * what is nearer to the picture's middle. Returns 0: the middle is no better. */
int iris_rectify_outline(iris_plane_place *outline, const iris_sensor *camera, const iris_mat3 *turn,
                         iris_size size);

/* The intrinsics of the views. Returns 0: there is no common part. */
int iris_rectify_window(iris_intrinsics *made, iris_plane_place *const outlines[2], iris_size size,
                        iris_rectify_keep keep);

#endif
