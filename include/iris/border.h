/* IRIS - borders: what lies beyond the edge of a picture, for operations that look at a pixel's surroundings.
 *
 * Every such operation takes an iris_border; all zeros is the default, REPLICATE. The edge is the view's: of a region of
 * interest nothing outside is looked at. Report, section 2.2 (which knows SKIP).
 */
#ifndef IRIS_BORDER_H
#define IRIS_BORDER_H

#include <stddef.h>
#include <stdint.h>

#include "iris/scratch.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    IRIS_BORDER_REPLICATE = 0, /* aaa|abcd|ddd: the nearest pixel of the picture */
    IRIS_BORDER_REFLECT101,    /* dcb|abcd|cba: mirrored at the outermost pixel, as often as needed */
    IRIS_BORDER_CONSTANT,      /* vvv|abcd|vvv: `value` in every channel */
    IRIS_BORDER_SKIP /* pixels whose surroundings leave the picture are not evaluated: dst keeps its value there */
} iris_border_rule;

typedef struct {
    iris_border_rule rule;
    uint8_t value; /* of CONSTANT; else ignored */
} iris_border;

/* The pixel that stands for position i of a row or column of n pixels: 0 to n - 1; -1 when that is the constant value.
 * Any i of int32_t, n at least 1. SKIP counts as REPLICATE. No two neighboring positions are farther apart than two
 * neighbors. O(1). */
int32_t iris_border_index(int32_t i, int32_t n, iris_border_rule rule);

/* Working memory of an operation that keeps the rows around a row: `samples` bytes in a row (the width times the channels
 * that are looked at), of which `before` are looked at to the left and `after` to the right of it beyond the edges,
 * and `reach` rows above and below, the larger of the two counts. */
#define IRIS_BORDER_ROWS_BYTES(samples, before, after, reach)                                                \
    (IRIS_SCRATCH_ROUND(IRIS_SCRATCH_ROUND(before) + (size_t)(samples) + (size_t)(after)) *                  \
     (2u * (size_t)(reach) + 2u))

#ifdef __cplusplus
}
#endif

#endif
