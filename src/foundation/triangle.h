/* Linear least squares by an orthogonal method, one equation after another: Givens rotations turn each into an upper
 * triangle, which is all that is kept of them. Golub and Van Loan, Matrix Computations, 5.2.5.
 *
 * Numbers have 32 fraction bits (any other number of them will do, too, if it is the same in all rows); magnitudes
 * from 2^-8 to 2^8 lose least.
 */
#ifndef IRIS_TRIANGLE_H
#define IRIS_TRIANGLE_H

#include "iris/wide.h"

/* iris_q32s that a triangle of n unknowns with its right side takes. */
#define IRIS_TRIANGLE_NUMBERS(n) ((n) * ((n) + 3) / 2)

/* Row j of the triangle has the columns j to n; column n is the right side. */
typedef struct {
    iris_q32 *numbers; /* IRIS_TRIANGLE_NUMBERS(n), the caller's */
    int n;             /* unknowns */
} iris_triangle;

/* Makes numbers a triangle that knows nothing. */
void iris_triangle_init(iris_triangle *triangle, iris_q32 *numbers, int n);

/* The number in column k of row j, k from j to n. */
static inline iris_q32 *iris_triangle_at(const iris_triangle *triangle, int j, int k)
{
    return triangle->numbers + (j * triangle->n - j * (j - 1) / 2 + k);
}

/* One more equation: row[0] to row[n - 1] times the unknowns is row[n]. Destroys it but for row[n], which becomes what is
 * left over: the sum of the squares of all that is left over is the least sum of squares. 0 to 2 n^2 products. */
void iris_triangle_add(const iris_triangle *triangle, iris_q32 *row);

/* The solution: n numbers. Returns 0 when there is no one solution: a diagonal number below `least`. */
int iris_triangle_solve(iris_q32 *solution, const iris_triangle *triangle, iris_q32 least);

#endif
