#include "rank_one.h"

static int32_t greatest_divisor(int32_t a, int32_t b)
{
    while (b != 0) {
        int32_t rest = a % b;
        a = b;
        b = rest;
    }
    return a < 0 ? -a : a;
}

/* The first row that is not all zeros, divided by what its values have in common, is the row: the factor of any row
 * that is a multiple of it is then a whole number. */
int iris_rank_one(int32_t *column, int32_t *row, const int32_t *values, int32_t rows, int32_t columns)
{
    int32_t pivot = 0;
    while (pivot < rows * columns && values[pivot] == 0) {
        pivot++;
    }
    if (pivot == rows * columns) {
        return 0;
    }
    const int32_t *first = values + pivot / columns * columns;
    int32_t divisor = 0;
    for (int32_t c = 0; c < columns; c++) {
        divisor = greatest_divisor(first[c], divisor);
    }
    for (int32_t c = 0; c < columns; c++) {
        row[c] = first[c] / divisor;
    }
    for (int32_t r = 0; r < rows; r++) {
        column[r] = (int32_t)((int64_t)values[r * columns + pivot % columns] * divisor / values[pivot]);
        for (int32_t c = 0; c < columns; c++) {
            if ((int64_t)column[r] * row[c] != values[r * columns + c]) {
                return 0;
            }
        }
    }
    return 1;
}
