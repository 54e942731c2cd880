/* What rows of numbers are all (nearly) perpendicular to: the right singular vector of the smallest singular value. The
 * rows come as a triangle (triangle.h, right sides 0), and inverse iteration with R^T R does the rest: each solution is
 * scaled so that the next one fits. Golub and Van Loan, Matrix Computations, 8.2.2.
 */
#ifndef IRIS_NULL_VECTOR_H
#define IRIS_NULL_VECTOR_H

#include "../../foundation/triangle.h"

#define IRIS_NULL_VECTOR_MAX 12 /* unknowns */

/* v: n numbers, of length 1. Returns its singular value: the length of R v. 60 n^2 products at most. */
iris_q32 iris_null_vector(iris_q32 *v, const iris_triangle *triangle);

/* The same among the vectors perpendicular to `to`, which has length 1. */
iris_q32 iris_null_vector_beside(iris_q32 *v, const iris_triangle *triangle, const iris_q32 *to);

/* The length of numbers, and numbers of length 1: all zeros stay. */
iris_q32 iris_numbers_length(const iris_q32 *numbers, int n);
void iris_numbers_normalize(iris_q32 *numbers, int n);

#endif
