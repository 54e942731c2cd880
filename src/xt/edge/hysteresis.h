/* Hysteresis on two masks: weak pixels become strong when one of their eight neighbors is, until there are none. */
#ifndef IRIS_XT_HYSTERESIS_H
#define IRIS_XT_HYSTERESIS_H

#include "iris/image.h"

typedef struct {
    const iris_image *strong; /* the result */
    const uint32_t *part;     /* a row: the bits of strong that count and may change */
    const uint32_t *zeros;    /* a row of zeros */
    int32_t top, bottom;      /* rows top to bottom - 1 of strong count and may change */
    const uint32_t *weak;     /* all rows of the picture, without padding; bits outside of part are 0 */
    uint32_t *dirty;          /* rows of a mask of words: what is to be looked at; all are 0 in the end */
} iris_hysteresis;

void iris_hysteresis_run(const iris_hysteresis *h);

#endif
