/* What the follower takes of the regression, and the regression of it. */
#ifndef IRIS_REGRESS_ROWS_H
#define IRIS_REGRESS_ROWS_H

#include "iris/xt/regress.h"

/* iris_regress_rows for arguments known to be good, but dx and dy are only within 2^-12: it needs neither the table of
 * the sine nor a product of 64 bits, which a small processor would have to be given as code. */
iris_status iris_regress_rows_rough(iris_line *line, const int16_t *twice_x, int32_t y0, int32_t y1,
                                    int32_t trims);

/* The direction of largest spread, from sums around the center (both of one scale): it has half the angle of
 * (difference, -2 xy), counted from straight up; difference is that of yy and xx. IRIS_ERR_RANGE: there is none. */
iris_status iris_line_set_angle(iris_line *line, int64_t difference, int64_t xy);

#endif
