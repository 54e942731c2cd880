/* Dividing by the area of a square window, once for all ports: the mean of a sum is (sum + add) * factor >> shift, rounded
 * half up. */
#ifndef IRIS_KERNEL_BOX_H
#define IRIS_KERNEL_BOX_H

#include <stdint.h>

/* Up to this side, sums and factor fit 16 bits, and shift is 16 to 24; above, shift is 33 to 40. */
#define BOX_NARROW 16

typedef struct {
    uint32_t add, factor;
    int shift;
} box_division;

/* Of a narrow window factor is 2^shift / area, rounded to the nearest; where it is too small, one more in the sum makes
 * up for it (Robison, 2005). That this is exact for each of the 16 sides, the test of the kernel goes through.
 * Of others n / area is n * factor >> shift for every n below 2^24: at most 255 * 255^2 + 255^2 / 2. With factor =
 * floor(2^shift / area) + 1 the excess of factor * area over 2^shift is at most area, which is at most 2^(shift - 24),
 * and an excess that small never carries n / area over the next integer (Granlund and Montgomery, 1994). */
static inline box_division box_division_of(int32_t side)
{
    uint32_t area = (uint32_t)side * (uint32_t)side;
    int power = 0; /* of two, the largest not above area */
    while (area >> power > 1) {
        power++;
    }
    if (side > BOX_NARROW) {
        int shift = 25 + power;
        return (box_division){area / 2, (uint32_t)(((uint64_t)1 << shift) / area + 1), shift};
    }
    uint32_t one = (uint32_t)65536 << power, factor = (one + area / 2) / area;
    factor = factor < 65535 ? factor : 65535;
    return (box_division){area / 2 + (factor * area < one), factor, 16 + power};
}

/* What eight lanes begin with: the sum of sample i's window without its last column, and add. Lanes of a channel are
 * `step` apart and begin alike. */
static inline void box_begin(uint32_t totals[8], const uint16_t *columns, int32_t side, int32_t step,
                             uint32_t add)
{
    for (int32_t c = 0; c < 8; c++) {
        totals[c] = c < step ? add : totals[c - step];
        for (int32_t k = 0; k < side - 1 && c < step; k++) {
            totals[c] += columns[c + k * step];
        }
    }
}

#endif
