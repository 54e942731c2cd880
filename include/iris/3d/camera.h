/* IRIS-3D - the camera as a mathematical model: where a point in space is in the picture, and which ray a pixel sees.
 * Report, sections 2.7 (equations 2.1 to 2.18) and 3.4.3 (Sensor).
 *
 *     world            camera             picture plane          pixels
 *     X       R (X - t)  Xc     / Zc       x    lens   x~    K       u
 *     --------------->  ---------->   --------->   --------->
 *
 *            + Zc  forward                     0 ---------------> u
 *           /                                  |   \
 *          /                                   |    + (u0, v0): where the axis Zc goes through
 *         C ------- + Xc  right                |
 *         |                                    |
 *         |                                    v  v
 *         + Yc  down
 *
 * Four frames, as in the report. World: any, right-handed, in units of the user's choice. Camera: its origin C is the
 * optical center, at t in the world; x right, y down, z forward along the optical axis. Picture plane (the report's
 * image Euclidean frame): x = Xc / Zc, y = Yc / Zc, at focal length 1 in front of C instead of behind it, so that
 * nothing is upside down; there the lens bends x to x~. Pixels (its image affine frame): u = alpha_u x~ + shear y~ +
 * u0, v = alpha_v y~ + v0; (0, 0) is the center of the top left one.
 *
 * Numbers have 32 fraction bits (wide.h). Null pointers are not allowed but where it is said. Every input is taken,
 * and every loop ends.
 */
#ifndef IRIS_3D_CAMERA_H
#define IRIS_3D_CAMERA_H

#include "iris/3d/rotation.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A place in the picture, in pixels; or on the picture plane, in focal lengths. */
typedef struct {
    iris_q32 x, y;
} iris_vec2;

/* The five intrinsic parameters, in pixels. The report's K with the signs settled: alpha_u, alpha_v > 0. */
typedef struct {
    iris_q32 alpha_u, alpha_v; /* focal length in widths and in heights of a pixel */
    iris_q32 shear;            /* 0 for pixels with right angles; texts and the tool call it skew */
    iris_q32 u0, v0;           /* the principal point */
} iris_intrinsics;

/* In which direction the polynomial goes. */
typedef enum {
    IRIS_LENS_BENDS = 0, /* from where a straight ray would go to where it is seen: Zhang, OpenCV */
    IRIS_LENS_CORRECTS /* from where it is seen to where a straight ray would go: the report, equations 2.13 to 2.18 */
} iris_lens_direction;

/* What a lens does to a place p on the picture plane: with (x, y) = p - center and r^2 = x^2 + y^2, p becomes
 *
 *     p + (x, y) (k1 r^2 + k2 r^4 + k3 r^6) + (2 p1 x y + p2 (r^2 + 2 x^2), p1 (r^2 + 2 y^2) + 2 p2 x y)
 *
 * All zero: nothing. The report's second-order case is k1 alone, with IRIS_LENS_CORRECTS: k1 > 0 corrects a barrel,
 * k1 < 0 a pillow (with IRIS_LENS_BENDS the other way around: k1 < 0 makes a barrel).
 *
 * A polynomial fits a lens only so far out. Where r (1 + k1 r^2 + k2 r^4 + k3 r^6) turns back for the first time, at
 * the first root of 1 + 3 k1 r^2 + 5 k2 r^4 + 7 k3 r^6 (k1 = -0.3 alone: r = 1.054), it begins to show a second time
 * what it has shown: nothing beyond is seen. */
typedef struct {
    iris_q32 k1, k2, k3; /* radial */
    iris_q32 p1, p2;     /* tangential */
    iris_vec2 center;    /* decentering, in focal lengths: the report's (up, vp) */
    iris_lens_direction direction;
} iris_lens;

/* Where a camera is and looks: Xc = R (X - t). What texts and the tool call t, beside K [R | t], is another one: -R times
 * this place. */
typedef struct {
    iris_mat3 turn;  /* R */
    iris_vec3 place; /* t: the optical center in the world */
} iris_pose;

/* A calibrated camera: the report's Sensor. */
typedef struct {
    iris_intrinsics intrinsics;
    iris_lens lens;
    iris_pose pose;
} iris_sensor;

/* From the world to the camera and back. Within 3 units each, for places below 2^28. */
iris_vec3 iris_pose_into(const iris_pose *pose, iris_vec3 world);
iris_vec3 iris_pose_out_of(const iris_pose *pose, iris_vec3 camera);

/* What a straight ray through p on the picture plane becomes in the lens. O(1), 15 products. With numbers of real lenses (k1
 * to 0.25, k2 to 0.06) and p within half a focal length of the axis, the polynomial is within 2^-29, and what solves it
 * within 2^-27, in either function. Beyond where the polynomial turns back it is the polynomial still, but nothing that a
 * camera sees: ask iris_sensor_project. */
iris_vec2 iris_lens_bend(const iris_lens *lens, iris_vec2 p);

/* The straight ray's place of what is seen at p. One of the two directions is the polynomial itself, the other one
 * solves it, until what it gives is within 2^-28, by at most 30 of Newton's steps. IRIS_ERR_RANGE: there is no such place, or the polynomial has turned back
 * there; *straight is then the nearest that was found, or the polynomial. */
iris_status iris_lens_straighten(iris_vec2 *straight, const iris_lens *lens, iris_vec2 p);

/* From the picture plane to pixels and back. iris_intrinsics_plane: IRIS_ERR_RANGE: alpha_u or alpha_v is not above
 * 0; *p is untouched. */
iris_vec2 iris_intrinsics_pixel(const iris_intrinsics *k, iris_vec2 p);
iris_status iris_intrinsics_plane(iris_vec2 *p, const iris_intrinsics *k, iris_vec2 pixel);

/* Where the picture shows the point, and how far in front of the camera it is (Zc; depth may be null).
 * IRIS_ERR_RANGE: it is not in front of the camera (Zc below 2^-16), more than 8 focal lengths beside the axis, or so
 * far out that the lens's polynomial turns back before; outputs untouched. With a the larger alpha it is at most a (1 / Zc + 1) 2^-30 pixels off, and four times that
 * through a lens whose numbers are those of real ones (k1 to 0.25, k2 to 0.06), for points within half a focal length
 * of the axis. */
iris_status iris_sensor_project(iris_vec2 *pixel, iris_q32 *depth, const iris_sensor *sensor,
                                iris_vec3 world);

/* The ray that the pixel sees: from the optical center, of length 1. IRIS_ERR_RANGE: as iris_lens_straighten and
 * iris_intrinsics_plane; *ray untouched. The direction is within 2^-26 for alphas above 16. */
iris_status iris_sensor_ray(iris_line3 *ray, const iris_sensor *sensor, iris_vec2 pixel);

/* The projective matrix M = [K R | -K R t], row by row, without the lens: (U, V, W) = M (X, 1), u = U / W, v = V / W.
 * W is the depth. The left 3 x 3 are within 1 unit of 2^-32, the last column within 1 + |x| + |y| + |z| of the place. */
void iris_sensor_matrix(iris_q32 m[12], const iris_sensor *sensor);

/* The camera of a projective matrix of any scale and sign: R and K by an RQ decomposition, t = -A^-1 b. Both alphas
 * come out positive, and R does not mirror. The lens is none. With p the length of all five intrinsic numbers, q = p / the
 * smaller alpha, and s the length of M's third row, or 1 if that is longer, R is within 2 q 2^-32 / s of what M is exactly,
 * pixels are within 2 q p 2^-32 / s, and the place within 8 q (1 + its length) 2^-32 / s. IRIS_ERR_RANGE: A, the left 3 x 3 of M, has no inverse,
 * or numbers do not fit; *sensor untouched. */
iris_status iris_sensor_decompose(iris_sensor *sensor, const iris_q32 m[12]);

#ifdef __cplusplus
}
#endif

#endif
