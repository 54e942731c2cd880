/* IRIS-3D - points, directions, lines, and planes in space.
 *
 * Coordinates have 32 fraction bits (wide.h): from -2147483648 up to below 2147483648 of any unit, in steps of
 * 2.3e-10. Results beyond that are the nearest number that fits. x is right, y down, z forward, as in camera.h.
 * Report, section 3.4.3 (Coordinate, Point, Parametric). O(1) each. Null pointers are not allowed here.
 */
#ifndef IRIS_3D_VECTOR_H
#define IRIS_3D_VECTOR_H

#include "iris/status.h"
#include "iris/wide.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A point or a direction. */
typedef struct {
    iris_q32 x, y, z;
} iris_vec3;

/* All points origin + t direction. */
typedef struct {
    iris_vec3 origin, direction;
} iris_line3;

/* All points p with normal . p = offset. */
typedef struct {
    iris_vec3 normal; /* of length 1 */
    iris_q32 offset;  /* the plane's distance from (0, 0, 0), negative against the normal */
} iris_plane;

/* Sum, difference, product with a number. */
iris_vec3 iris_vec3_add(iris_vec3 a, iris_vec3 b);
iris_vec3 iris_vec3_sub(iris_vec3 a, iris_vec3 b);
iris_vec3 iris_vec3_scale(iris_vec3 a, iris_q32 factor);

/* Rounded once: half a unit off at most. */
iris_q32 iris_vec3_dot(iris_vec3 a, iris_vec3 b);
iris_vec3 iris_vec3_cross(iris_vec3 a, iris_vec3 b);

/* At most 2 units below the true length of vectors below 2^28, 1e-17 of it of longer ones. */
iris_q32 iris_vec3_length(iris_vec3 a);

/* The direction of a with length 1, each coordinate to 1 unit, however short a is. IRIS_ERR_RANGE: a has no length;
 * *unit is untouched. */
iris_status iris_vec3_normalize(iris_vec3 *unit, iris_vec3 a);

/* The line through two points, its direction from a to b of length 1. IRIS_ERR_RANGE: one point only. */
iris_status iris_line3_through(iris_line3 *line, iris_vec3 a, iris_vec3 b);

/* origin + t direction. */
iris_vec3 iris_line3_point(const iris_line3 *line, iris_q32 t);

/* How far p is from the line, whose direction has length 1. */
iris_q32 iris_line3_distance(const iris_line3 *line, iris_vec3 p);

/* Where two lines, with directions of length 1, come nearest to each other: halfway between, and how far apart they
 * are there. IRIS_ERR_RANGE: they are parallel to 2^-14 (0.003 degrees). Report, section 2.8 (intersection of two
 * rays). */
iris_status iris_line3_meet(iris_vec3 *middle, iris_q32 *gap, const iris_line3 *a, const iris_line3 *b);

/* The plane through three points; its normal is (b - a) x (c - a). IRIS_ERR_RANGE: they are on one line. */
iris_status iris_plane_through(iris_plane *plane, iris_vec3 a, iris_vec3 b, iris_vec3 c);

/* How far p is from the plane, positive on the side to which the normal points. */
iris_q32 iris_plane_distance(const iris_plane *plane, iris_vec3 p);

/* Where the line goes through the plane: the t of iris_line3_point, and the point. IRIS_ERR_RANGE: they are parallel,
 * or it is beyond what t can be. */
iris_status iris_plane_meet(iris_vec3 *point, iris_q32 *t, const iris_plane *plane, const iris_line3 *line);

#ifdef __cplusplus
}
#endif

#endif
