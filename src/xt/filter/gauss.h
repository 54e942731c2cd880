/* The bell curve, in integers. */
#ifndef IRIS_XT_GAUSS_H
#define IRIS_XT_GAUSS_H

#include "iris/fixed.h"

/* exp(-squared / (2 sigma^2)) with 31 fraction bits, within 8 units (4e-9): 2^31 for squared = 0. squared: 0 to 2^24,
 * of a distance in pixels; sigma at least 0.1. One 64-bit division. */
uint32_t iris_gauss_q31(int32_t squared, iris_q16 sigma_q16);

#endif
