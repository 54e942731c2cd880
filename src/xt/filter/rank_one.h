/* Is a matrix of whole numbers the product of a column and a row? */
#ifndef IRIS_XT_RANK_ONE_H
#define IRIS_XT_RANK_ONE_H

#include <stdint.h>

/* 1 when values[r * columns + c] = column[r] * row[c] for whole numbers, which are then set; 0 when it is not so, or
 * all are 0. values: above INT32_MIN. O(rows * columns). */
int iris_rank_one(int32_t *column, int32_t *row, const int32_t *values, int32_t rows, int32_t columns);

#endif
