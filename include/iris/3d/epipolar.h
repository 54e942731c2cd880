/* IRIS-3D - epipolar geometry: where in the right picture what is at a place of the left one can be. Report, section
 * 2.8, figure 9.8: the two optical centers and a point are in one plane, which goes through the right picture as a
 * line; all these lines go through the epipole, the picture of the left optical center.
 *
 * Both cameras are in one world. Places on the picture plane are in focal lengths (camera.h). Null pointers are not
 * allowed. O(1) each. Luong and Faugeras, "The fundamental matrix", 1996.
 */
#ifndef IRIS_3D_EPIPOLAR_H
#define IRIS_3D_EPIPOLAR_H

#include "iris/3d/camera.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The essential matrix E: places on the two picture planes of one point, as straight rays go, have p'^T E p = 0, with p
 * = (x, y, 1) on the left one and p' on the right one. E = [t]x R for a baseline t of length 1 in the right camera's
 * frame; each number is within 4 units. IRIS_ERR_RANGE: the cameras are at one place; *e is untouched. */
iris_status iris_epipolar_essential(iris_mat3 *e, const iris_pose *left, const iris_pose *right);

/* The fundamental matrix F = K'^-T E K^-1, the same for pixels (u, v, 1), without lenses. Of any scale: here its
 * largest number is between 2^24 and 2^25, for the smallest ones are a million times smaller. IRIS_ERR_RANGE: as
 * iris_epipolar_essential, or an alpha outside 2^-8..2^14; *f is untouched. */
iris_status iris_epipolar_fundamental(iris_mat3 *f, const iris_sensor *left, const iris_sensor *right);

/* All (x, y) with a x + b y + c = 0, a^2 + b^2 = 1: a x + b y + c is the distance of any other place from it. */
typedef struct {
    iris_q32 a, b, c;
} iris_line2;

/* a x + b y + c. */
iris_q32 iris_line2_distance(const iris_line2 *line, iris_vec2 p);

/* On the right camera's picture plane, the line of what is at the pixel of the left picture. Both lenses are minded: the
 * pixel is straightened (iris_lens_straighten), and of the line iris_lens_bend makes the curve that the right picture
 * shows. IRIS_ERR_RANGE: the cameras are at one place, the pixel sees no ray (as iris_sensor_ray) or sees the right
 * camera, or the plane does not go through the right picture plane; *line is untouched. */
iris_status iris_epipolar_line(iris_line2 *line, const iris_sensor *left, const iris_sensor *right,
                               iris_vec2 pixel);

/* By how many pixels of the right picture two places, as the pictures show them, miss to be of one point: the distance
 * from the line times the right camera's mean alpha, 0 or more. 0.001 pixels off at most for pixels that are not within
 * a degree of the epipole, with alphas below 4096. Errors as iris_epipolar_line and iris_sensor_ray. */
iris_status iris_epipolar_miss(iris_q32 *pixels, const iris_sensor *left, const iris_sensor *right,
                               iris_vec2 left_pixel, iris_vec2 right_pixel);

#ifdef __cplusplus
}
#endif

#endif
