/* IRIS-XT - contours: the borders of what is selected in a mask, each followed around once, and which lies in which.
 *
 * Selected pixels belong together when they touch by a side or a corner, what lies between them when it touches by a
 * side. Each part has one outer border and one border for each of its holes. A border is followed along the sides of
 * pixels, with the selected pixels at its right hand: outer borders run clockwise as seen, those of holes the other
 * way.
 *
 * It always ends. A step leads from one side of a pixel to the next by looking at two pixels, and no two sides lead to
 * the same one: at a corner the step back is as certain as the step ahead. So the way from a side is a circle that
 * comes back to just this side, after no more steps than the mask has sides. What tracers from pixel to pixel need, a
 * rule when to stop, is not needed. The nesting is that of S. Suzuki and K. Abe, "Topological structural analysis of
 * digitized binary images by border following", 1985; it is told from the nearest border at the left.
 * Report, section 3.3.3 (perimeter of a shape).
 */
#ifndef IRIS_XT_CONTOUR_H
#define IRIS_XT_CONTOUR_H

#include "iris/image.h"
#include "iris/scratch.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One border. What it encloses is, for an outer border, its part with all holes filled; for a hole, the hole with all
 * that lies in it. */
typedef struct {
    int32_t x,
        y; /* the first pixel, row by row from the left, of what it encloses; not selected for a hole */
    int32_t is_hole; /* 1 or 0 */
    int32_t parent;  /* the border right around this one: always a smaller index; -1: none */
    iris_rect box;   /* of what it encloses */
    int32_t area;    /* pixels that it encloses */
    /* selected pixels that one comes by along the border, at least 1; see iris_contour_points */
    int32_t points;
    /* so many of the steps from point to point are diagonal, the others level or upright */
    int32_t diagonals;
} iris_contour;

typedef struct {
    int16_t x, y; /* pixels */
} iris_contour_point;

/* Working memory: one bit per pixel. 640x480: 38 KB, 160x120: 2.4 KB. */
#define IRIS_CONTOUR_SCRATCH_BYTES(w, h) IRIS_SCRATCH_ROUND(((size_t)(w) + 31u) / 32u * 4u * (size_t)(h))

/* All borders in mask, IRIS_MASK1, in the order of x and y: row by row from the left. *count is the number of all. What
 * is beyond the picture counts as not selected. contours may be null when capacity is 0.
 *
 * IRIS_ERR_FULL: there are more than capacity; those that enclose most were kept (of equal ones those that come first),
 * in the same order. A border encloses less than the one around it, so no parent is missing.
 * IRIS_ERR_ARG: null pointer, or a negative capacity; the errors of iris_image_check; IRIS_ERR_FORMAT;
 * IRIS_ERR_SCRATCH.
 * O(pixels / 32 + sides of pixels along borders + count log capacity). */
iris_status iris_contour_find(iris_contour *contours, int32_t capacity, int32_t *count,
                              const iris_image *mask, iris_scratch *scratch);

/* The pixels along a border of mask: a closed polygon, in which each one touches the next by a side or a corner. It
 * starts at the contour's first pixel; for a hole at the pixel left of it. Where a part is one pixel wide, its pixels
 * come twice, there and back. *count is the number of all, contour->points. points may be null when capacity is 0.
 *
 * Only x and y of the contour are looked at. IRIS_ERR_FULL: the first `capacity` pixels were written.
 * IRIS_ERR_ARG: null pointer, or a negative capacity; the errors of iris_image_check; IRIS_ERR_FORMAT; IRIS_ERR_RANGE:
 * no border of this mask has x, y at its right side. O(sides of pixels along the border). */
iris_status iris_contour_points(iris_contour_point *points, int32_t capacity, int32_t *count,
                                const iris_contour *contour, const iris_image *mask);

#ifdef __cplusplus
}
#endif

#endif
