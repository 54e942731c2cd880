/* IRIS-3D - matrices of 4 x 4 numbers: what moves, turns, and scales points. Report, section 3.4.3 (Matrix4x4).
 *
 * A point (x, y, z) is the column (x, y, z, 1): iris_mat4_point(&m, p) is M p, and iris_mat4_multiply(&c, &a, &b)
 * makes of A and B what does B first. Numbers have 32 fraction bits, and those that do not fit are the nearest that
 * do. O(1) each. Null pointers are not allowed. Results may be operands.
 */
#ifndef IRIS_3D_MATRIX_H
#define IRIS_3D_MATRIX_H

#include "iris/3d/vector.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Row by row: m[4 * row + column]. */
typedef struct {
    iris_q32 m[16];
} iris_mat4;

/* Row by row: m[3 * row + column]. Rotations are kept in this form (rotation.h). */
typedef struct {
    iris_q32 m[9];
} iris_mat3;

void iris_mat4_identity(iris_mat4 *m);
void iris_mat4_translation(iris_mat4 *m, iris_vec3 by);
void iris_mat4_scaling(iris_mat4 *m, iris_vec3 factors);

/* The rotation `turn` about the point `center`, and then the move by `move`. */
void iris_mat4_motion(iris_mat4 *m, const iris_mat3 *turn, iris_vec3 center, iris_vec3 move);

/* Turns by `radians` about the line, whose direction has length 1; positive is clockwise for who looks along it. */
void iris_mat4_turn_about(iris_mat4 *m, const iris_line3 *axis, iris_q32 radians);

/* product = a b: each number rounded once, if they are all below 2^30. */
void iris_mat4_multiply(iris_mat4 *product, const iris_mat4 *a, const iris_mat4 *b);

/* The matrix that undoes m. With x the largest number of m and y that of the inverse, each number is within
 * 1 + x y^2 2^-30 units of the true one. IRIS_ERR_RANGE: m has no inverse, or it does not fit. */
iris_status iris_mat4_invert(iris_mat4 *inverse, const iris_mat4 *m);

/* M p, divided by its fourth number if that is not 1. IRIS_ERR_RANGE: the fourth number is 0. */
iris_status iris_mat4_point(iris_vec3 *moved, const iris_mat4 *m, iris_vec3 p);

void iris_mat3_identity(iris_mat3 *m);
void iris_mat3_multiply(iris_mat3 *product, const iris_mat3 *a, const iris_mat3 *b);
iris_vec3 iris_mat3_vector(const iris_mat3 *m, iris_vec3 v);

/* M^T v: of a rotation, what undoes it. */
iris_vec3 iris_mat3_transposed_vector(const iris_mat3 *m, iris_vec3 v);
void iris_mat3_transpose(iris_mat3 *transposed, const iris_mat3 *m);

/* As iris_mat4_invert. */
iris_status iris_mat3_invert(iris_mat3 *inverse, const iris_mat3 *m);

#ifdef __cplusplus
}
#endif

#endif
