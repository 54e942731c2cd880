/* IRIS-3D - rotations: as a matrix, as an axis with an angle, as pan, tilt, and roll, and as a quaternion.
 *
 * A rotation is an iris_mat3 whose rows have length 1 and are perpendicular to each other, and which does not mirror:
 * it turns vectors, iris_mat3_vector(&r, v), positive angles from x to y, from y to z, from z to x. Angles are
 * radians with 32 fraction bits. Report, section 2.7 (pan, tilt, roll). O(1) each. Null pointers are not allowed.
 * Results may be operands.
 */
#ifndef IRIS_3D_ROTATION_H
#define IRIS_3D_ROTATION_H

#include "iris/3d/matrix.h"
#include "iris/radians.h"

#ifdef __cplusplus
extern "C" {
#endif

/* w + x i + y j + z k, of length 1. The same rotation has two: all signs may be turned. */
typedef struct {
    iris_q32 w, x, y, z;
} iris_quaternion;

/* Elementary rotations: pan about x, then tilt about y, then roll about z. */
typedef struct {
    iris_q32 pan, tilt, roll;
} iris_angles;

/* By `radians` about an axis of length 1. Each number is within 2 units. */
void iris_rotation_about(iris_mat3 *r, iris_vec3 axis, iris_q32 radians);

/* About the direction of v by its length in radians (Rodrigues' vector), up to pi within 4 units. (0, 0, 0) is no
 * rotation. */
void iris_rotation_from_vector(iris_mat3 *r, iris_vec3 v);

/* The vector of length 0 to pi: 8 units off at most as a rotation. */
iris_vec3 iris_rotation_to_vector(const iris_mat3 *r);

void iris_rotation_from_angles(iris_mat3 *r, iris_angles angles);

/* tilt is within -pi/2 .. pi/2. pan is 0 where tilt is nearer than 2^-20 to one of these ends: there only the sum of
 * pan and roll counts. 128 units off at most as a rotation, near the ends 2^-20. */
iris_angles iris_rotation_to_angles(const iris_mat3 *r);

/* A quaternion of any length but 0, which is no rotation. */
void iris_rotation_from_quaternion(iris_mat3 *r, iris_quaternion q);

/* w is not negative. 8 units off at most as a rotation. */
iris_quaternion iris_rotation_to_quaternion(const iris_mat3 *r);

/* Products of many rotations drift: this makes one of them again, near r. IRIS_ERR_RANGE: r is no rotation at all. */
iris_status iris_rotation_tidy(iris_mat3 *r);

#ifdef __cplusplus
}
#endif

#endif
