/* Shapes with smooth edges: they are drawn on a picture three times as large, which is made smaller at the end.
 *
 * Coordinates are pixels of the final picture; (0, 0) is the corner of its first one. Everything is clipped.
 */
#ifndef IRIS_TOOL_SMOOTH_H
#define IRIS_TOOL_SMOOTH_H

#include "canvas.h"

#define SMOOTH_POINTS_MAX 64

typedef struct {
    picture_buffer large, small;
} smooth_picture;

/* Returns a status of picture_reserve. */
iris_status smooth_begin(smooth_picture *picture, iris_size size, iris_color background);

/* Inside of the polygon, where it crosses itself by turns; at most SMOOTH_POINTS_MAX points. */
void smooth_polygon(const smooth_picture *picture, const canvas_point *points, int count, iris_color color);

/* With round ends. */
void smooth_stroke(const smooth_picture *picture, canvas_point from, canvas_point to, double width,
                   iris_color color);

void smooth_disc(const smooth_picture *picture, canvas_point center, double radius, iris_color color);

/* The final picture, IRIS_RGB888, for text and what else is drawn upon it; valid until smooth_free. */
const iris_image *smooth_end(smooth_picture *picture);

void smooth_free(smooth_picture *picture);

#endif
