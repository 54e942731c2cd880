/* What was found, drawn into a picture so that it can be seen: strokes as thick as the picture's size asks for.
 *
 * Coordinates are those of the frame: 0 is the middle of its first pixel. Everything is clipped.
 */
#ifndef IRIS_TOOL_CANVAS_H
#define IRIS_TOOL_CANVAS_H

#include "iris/draw.h"
#include "iris/image.h"
#include "picture.h"

/* A picture of the frame in which each of its pixels is a square. */
typedef struct {
    iris_image image; /* a format of draw.h */
    int32_t scale;
} canvas;

typedef struct {
    double x, y;
} canvas_point;

/* The image itself. */
canvas canvas_plain(const iris_image *image);

/* A frame, IRIS_RGB888, that is too small for text, enlarged in *buffer; a large one itself. Returns a status of
 * picture_reserve. */
iris_status canvas_enlarge(canvas *c, picture_buffer *buffer, const iris_image *frame);

/* The canvas pixel of a place in the frame; how many pixels a stroke reaches to both sides; and how much text is to be
 * enlarged. */
int32_t canvas_at(const canvas *c, double place);
int32_t canvas_stroke(const canvas *c);
int32_t canvas_text_scale(const canvas *c);

void canvas_line(const canvas *c, canvas_point from, canvas_point to, iris_color color);
void canvas_circle(const canvas *c, canvas_point center, double radius, iris_color color);
void canvas_cross(const canvas *c, canvas_point center, double arm, iris_color color);
void canvas_rect(const canvas *c, iris_rect rect, iris_color color); /* around its pixels */

/* From point to point; closed: and back to the first. */
void canvas_polygon(const canvas *c, const canvas_point *points, int count, int closed, iris_color color);

/* The first letter's upper left corner; with a dark outline. */
void canvas_text(const canvas *c, canvas_point at, iris_color color, const char *text);

/* Colors that can be told apart, over and over: i is 0 or more. */
iris_color canvas_color(int i);

/* In pixels of the image, `reach` to every side. */
void canvas_thick(const iris_image *image, const int32_t ends[4], int32_t reach, iris_color color);

#endif
