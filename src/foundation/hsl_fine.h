/* HSL with fraction bits, for what changes one of the three: from RGB and back is identity, and what is changed comes back as
 * the nearest color.
 */
#ifndef IRIS_FOUNDATION_HSL_FINE_H
#define IRIS_FOUNDATION_HSL_FINE_H

#include <stdint.h>

#include "iris/color.h"

#define IRIS_HSL_FINE_TURN ((int32_t)6 << 16)
#define IRIS_HSL_FINE_S    ((int32_t)1 << 20)
#define IRIS_HSL_FINE_L    ((int32_t)510 << 20)

typedef struct {
    int32_t h_q16; /* of 60 degrees: 0 up to below IRIS_HSL_FINE_TURN; 0 for grays */
    int32_t s_q20; /* 0 to IRIS_HSL_FINE_S; 0 for grays */
    int32_t l_q20; /* of M + m: 0 to IRIS_HSL_FINE_L */
} iris_hsl_fine;

/* O(1), two divisions for what is not gray. */
iris_hsl_fine iris_hsl_fine_of(iris_color color);

/* Within 0.51 of the exact value. hsl is in the ranges above. O(1). */
iris_color iris_hsl_fine_color(iris_hsl_fine hsl);

#endif
