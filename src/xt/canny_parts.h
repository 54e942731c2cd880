/* The steps of Canny's edges. */
#ifndef IRIS_XT_CANNY_PARTS_H
#define IRIS_XT_CANNY_PARTS_H

#include <stdint.h>

#include "iris/image.h"

/* Three rows of gradients around a row; each is read one pixel beyond its ends. */
typedef struct {
    const int16_t *above, *here, *below; /* |dx| + |dy| */
    const int16_t *dx, *dy;              /* of the middle row */
    int32_t low, high;
} iris_canny_rows;

/* Of n pixels of the middle row: bit = the gradient is greatest across the edge and above low (weak) or above high
 * (strong). Bits past n are 0. */
void iris_canny_suppress(uint32_t *weak, uint32_t *strong, const iris_canny_rows *rows, int32_t n);

/* Weak pixels become strong when one of their eight neighbors is, until there are none. */
typedef struct {
    const iris_image *strong; /* the result */
    const uint32_t *part;     /* a row: the bits of strong that count and may change */
    int32_t top, bottom;      /* rows top to bottom - 1 of strong count and may change */
    const uint32_t *weak;     /* all rows of the picture, without padding; bits outside of part are 0 */
    uint32_t *dirty;          /* bit i: word i of weak is to be looked at; all are 0 in the end */
} iris_hysteresis;

void iris_hysteresis_run(const iris_hysteresis *h);

#endif
