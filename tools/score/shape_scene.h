/* Pictures with a shape in clutter and noise, a third of its outline hidden, and where it is. */
#ifndef SCORE_SHAPE_SCENE_H
#define SCORE_SHAPE_SCENE_H

#include <stdint.h>

#include "iris/image.h"

#define SCENE_W 480
#define SCENE_H 360

typedef struct {
    double x, y; /* where the template's reference point is */
    double angle_deg, scale;
} scene_truth;

/* A template: a mask, and its reference point. */
typedef struct {
    iris_image mask; /* IRIS_MASK1 */
    double x, y;
} scene_template;

/* Scene number `number` of a shape, IRIS_GRAY8: clutter of ellipses, strokes, triangles, and pieces of the shapes in
 * `others`; the shape anywhere, turned, at 0.7 to 1.4 of its size, 60 to 100 levels brighter or darker than the
 * ground; a rectangle or half the plane over a third of its outline; noise of 10 to 15 levels. Always the same for a
 * number. shape null: the clutter alone. Given back with free(image.data); data is null without memory. */
iris_image scene_make(scene_truth *truth, const scene_template *shape, const scene_template *others,
                      int count, uint32_t number);

#endif
