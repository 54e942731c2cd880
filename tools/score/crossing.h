/* Lines on a floor as a tilted camera sees them, painted from formulas: what junctions are measured on. */
#ifndef SCORE_CROSSING_H
#define SCORE_CROSSING_H

#include <stdint.h>

#include "iris/image.h"

#define CROSSING_ARMS 4

typedef enum {
    CROSSING_END = 0, /* as iris_junction_type */
    CROSSING_CORNER,
    CROSSING_T,
    CROSSING_Y,
    CROSSING_PLUS,
    CROSSING_STRAIGHT, /* a line that goes on */
    CROSSING_EMPTY     /* a floor without a line */
} crossing_kind;

typedef struct {
    crossing_kind kind;
    int arms;
    double x, y;                     /* of the junction in the picture */
    double angle_deg[CROSSING_ARMS]; /* of the branches in the picture, 0 up, positive right */
    double width;                    /* of the line there, pixels to the side */
} crossing_truth;

/* Paints picture number `seed` of a kind into gray (IRIS_GRAY8): at random line width, height, tilt (30 to 60 degrees
 * below the horizon), field of view, turn, offset, gray levels, light, and noise. bright: a bright line on a dark floor. */
void crossing_paint(crossing_truth *truth, const iris_image *gray, crossing_kind kind, int bright,
                    uint32_t seed);

#endif
