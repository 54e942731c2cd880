/* How like two outlines are by their height functions. */
#ifndef IRIS_XT_SHAPE_HEIGHTS_H
#define IRIS_XT_SHAPE_HEIGHTS_H

#include "iris/xt/shape.h"

typedef uint8_t
    iris_shape_heights[IRIS_SHAPE_HEIGHTS_PER_POINT]; /* of a point: 128 is 0, 0 and 255 the diameter */

typedef struct {
    iris_shape_heights *shape, *model, *mirrored; /* IRIS_SHAPE_POINTS each */
    uint8_t *ways;                                /* IRIS_SHAPE_POINTS * (2 * IRIS_SHAPE_GIVE + 1) */
} iris_shape_memory;

/* A mirror image must be better by this much, 0.03: many things are nearly symmetric, and the angle of the one that is not
 * mirrored is the one that is asked for. */
#define IRIS_SHAPE_MIRROR_LEAD_Q16 2048

typedef struct {
    iris_q16 score_q16;
    iris_angle angle;
    int32_t mirrored;
} iris_shape_likeness;

void iris_shape_heights_of(iris_shape_heights *heights, const iris_shape *shape);

/* memory->shape has the shape's heights. */
iris_shape_likeness iris_shape_heights_compare(const iris_shape_memory *memory, const iris_shape *shape,
                                               const iris_shape *model, int mirrored);

#endif
