/* IRIS-XT - orthogonal regression: the straight line through many points.
 *
 * The sum of squared PERPENDICULAR distances is minimized, so no direction is special: upright and level
 * lines are fitted as well as any other. Linear time, all points, no list of points kept. Report, section 2.4
 * (regression); K. Pearson, "On lines and planes of closest fit to systems of points in space", 1901.
 */
#ifndef IRIS_XT_REGRESS_H
#define IRIS_XT_REGRESS_H

#include "iris/fixed.h"
#include "iris/image.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A straight line through (x, y). */
typedef struct {
    iris_q16 x_q16, y_q16; /* center of gravity of the points, pixels */
    iris_angle angle;      /* 0 straight up the image, positive when it leans right, -90 to 90 degrees */
    iris_q30 dx, dy;       /* the same as a unit vector pointing up the image (dy <= 0) */
    int32_t points;        /* points that took part */
} iris_line;

/* Sums over points. Zeroed, it is empty. Coordinates are within +-65535, and the points at most 2^30 in all,
 * so that no sum overflows; what is beyond is not added. */
typedef struct {
    int64_t n, x, y, xx, xy, yy;
} iris_moments;

/* Adds the point (x, y). O(1). */
void iris_moments_add(iris_moments *moments, int32_t x, int32_t y);

/* Adds the pixels (x0, y) to (x1, y), x0 <= x1. O(1). */
void iris_moments_add_run(iris_moments *moments, int32_t x0, int32_t x1, int32_t y);

/* The line through the points. Two points or more with a direction are needed: IRIS_ERR_RANGE for none, for a
 * single place, for a cloud that is equally wide in all directions, and for sums that points cannot have. A
 * center beyond +-32767 is saturated. IRIS_ERR_ARG: null pointer. O(1). */
iris_status iris_regress_moments(iris_line *line, const iris_moments *moments);

/* The line through all selected pixels of a mask, each pixel one point. Errors as iris_regress_moments, and
 * IRIS_ERR_FORMAT when mask is not IRIS_MASK1. Linear in words of the mask plus runs. */
iris_status iris_regress_mask(iris_line *line, const iris_image *mask);

/* A point at half-pixel resolution, so that the center of a run of pixels is a whole number. */
typedef struct {
    int16_t twice_x, twice_y; /* -32767..32767 */
} iris_point;

/* The line through count points, 0..IRIS_REGRESS_POINTS_MAX. Errors as iris_regress_moments; IRIS_ERR_ARG
 * also for a count or a coordinate out of range. O(count). */
#define IRIS_REGRESS_POINTS_MAX 16384
iris_status iris_regress_points(iris_line *line, const iris_point *points, int32_t count);

/* The line through one point per row, as line followers have them: rows y0 to y1 (y0 <= y1, both inclusive),
 * and twice_x[y] is twice the point's column, or IRIS_REGRESS_NONE for a row without one. In `trims` further
 * rounds (0..4), points farther away than 2.5 times the mean distance (and than one pixel) are left out and
 * the line is fitted again: a few strangers do not bend it. Errors as iris_regress_moments; IRIS_ERR_ARG also
 * for y0 > y1, y0 < 0, y1 > IRIS_REGRESS_ROW_MAX, or trims out of range. O(trims * rows). */
#define IRIS_REGRESS_NONE    INT16_MIN
#define IRIS_REGRESS_ROW_MAX 16383
iris_status iris_regress_rows(iris_line *line, const int16_t *twice_x, int32_t y0, int32_t y1, int32_t trims);

#ifdef __cplusplus
}
#endif

#endif
