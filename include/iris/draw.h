/* IRIS - drawing: lines, rectangles, circles, crosses, and text on top of a picture.
 *
 * For overlays on IRIS_GRAY8 (the color's luma), IRIS_RGB888, IRIS_BGR888, and IRIS_MASK1 (1 where the luma
 * is 128 or more, else 0). Everything is clipped: coordinates may be anywhere in int32_t, and the pixels that
 * remain are exactly those of the unclipped figure. One pixel wide, opaque, no smoothing. Every function
 * returns IRIS_ERR_ARG for a null pointer, the errors of iris_image_check for a view that is not valid, and
 * IRIS_ERR_FORMAT for other formats, besides what its comment says. Report, section 3.2.2 (Buffer).
 */
#ifndef IRIS_DRAW_H
#define IRIS_DRAW_H

#include "iris/color.h"
#include "iris/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Text cells at scale 1: glyphs are 5x7, followed by one empty column and one empty row. */
#define IRIS_TEXT_CELL_W 6
#define IRIS_TEXT_CELL_H 8

#define IRIS_TEXT_SCALE_MAX 64

/* Straight line, both ends included (Bresenham 1965). The same pixels from either end: where two pixels are
 * equally near, the one on the side of the right end (mostly horizontal lines) or of the lower end (the
 * others) is drawn. O(image side). */
iris_status iris_draw_line(const iris_image *image, int32_t x0, int32_t y0, int32_t x1, int32_t y1,
                           iris_color color);

/* The outermost pixels of `rect`, or all of its pixels. An empty rectangle (w or h below 1) draws nothing.
 * O(image side), filled O(image side + pixels drawn). */
iris_status iris_draw_rect(const iris_image *image, iris_rect rect, iris_color color);
iris_status iris_draw_rect_filled(const iris_image *image, iris_rect rect, iris_color color);

/* Circle around the center of pixel (x, y) (midpoint method); radius in pixels, 0 is one pixel.
 * IRIS_ERR_RANGE: radius outside 0..IRIS_SIDE_MAX. O(radius). */
iris_status iris_draw_circle(const iris_image *image, int32_t x, int32_t y, int32_t radius, iris_color color);

/* Upright cross: (x, y) and `arm` pixels in each of the four directions.
 * IRIS_ERR_RANGE: arm below 0. O(image side). */
iris_status iris_draw_cross(const iris_image *image, int32_t x, int32_t y, int32_t arm, iris_color color);

/* Text in glyphs of 5x7 pixels, each pixel a square of `scale` pixels. (x, y) is the top left pixel of the
 * first glyph. Printable ASCII; '\n' begins a new line below the first; any other byte is drawn as a box. The
 * background is not touched (iris_draw_text_size tells what to fill).
 * IRIS_ERR_RANGE: scale outside 1..IRIS_TEXT_SCALE_MAX. O(length + pixels drawn inside the image). */
iris_status iris_draw_text(const iris_image *image, int32_t x, int32_t y, const char *text, int32_t scale,
                           iris_color color);

/* The pixels that `text` covers, without the empty column and row behind the last glyphs; {0, 0} for an empty
 * text, a null pointer, a scale out of range, or a size above INT32_MAX. O(length). */
iris_size iris_draw_text_size(const char *text, int32_t scale);

#ifdef __cplusplus
}
#endif

#endif
