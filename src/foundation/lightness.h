/* Another lightness for a color, with hue and saturation of HSL kept: every channel's distance from the middle of the
 * largest and the smallest one grows or shrinks as the room for chroma does, which one division tells.
 */
#ifndef IRIS_FOUNDATION_LIGHTNESS_H
#define IRIS_FOUNDATION_LIGHTNESS_H

#include <stdint.h>

#include "hsl.h"

/* The channels a, b, c of a pixel, in any order, get the lightness l, of M + m, 0..510, with 20 fraction bits. to may be
 * from. Within 0.51 of the exact value; the color's own lightness changes nothing. */
static inline void iris_lightness_set(uint8_t *to, const uint8_t *from, iris_hsl_extent extent, int32_t l_q20)
{
    int32_t limit = iris_hsl_chroma_limit(extent.sum);
    int32_t limit_q20 = l_q20 <= 255 << 20 ? l_q20 : (510 << 20) - l_q20;
    int32_t ratio_q20 = limit_q20 / (limit > 0 ? limit : 1);
    for (int c = 0; c < 3; c++) {
        /* At most the chroma, which is at most limit. */
        int32_t twice_q20 = l_q20 + (2 * from[c] - extent.sum) * ratio_q20;
        to[c] = (uint8_t)((twice_q20 + (1 << 20)) >> 21);
    }
}

#endif
