/* What the floor's files share. */
#ifndef IRIS_XT_FLOOR_PARTS_H
#define IRIS_XT_FLOOR_PARTS_H

#include "iris/xt/floor.h"

#define IRIS_FLOOR_ENTRY_MAX ((iris_q32)1 << 62)

/* row . (x, y, 1), with 16 fraction bits more than the row has. */
iris_wide iris_floor_row(const int64_t row[3], iris_place at);

/* (x / w, y / w). Returns 0, *to untouched, when w is not above 0 or a quotient beyond 32767. */
int iris_floor_divide(iris_place *to, iris_wide x, iris_wide y, iris_wide w);

#endif
