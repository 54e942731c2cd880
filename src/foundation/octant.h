/* The angle of a vector in the first octant, by steps that turn it onto the x axis. */
#ifndef IRIS_FOUNDATION_OCTANT_H
#define IRIS_FOUNDATION_OCTANT_H

#include <stdint.h>

#define OCTANT_STEPS 18

/* along is 2^28..2^29 - 1 at first, across 0..along; angle is in 2^-16 of an angle unit. */
typedef struct {
    int32_t along, across, angle;
} octant_vector;

/* Step 0, 1, ... turns by atan(2^-1), atan(2^-2), ... towards the axis. Without a branch: nobody can foresee to which
 * side. */
static inline octant_vector octant_turned(octant_vector v, int i)
{
    static const int32_t step[OCTANT_STEPS] = {316933406, 167458907, 85004756, 42667331, 21354465, 10679838,
                                               5340245,   2670163,   1335087,  667544,   333772,   166886,
                                               83443,     41722,     20861,    10430,    5215,     2608};
    const int32_t side = v.across >> 31; /* -1 below the axis */
    const int32_t turn_along = v.across >> (i + 1), turn_across = v.along >> (i + 1);
    return (octant_vector){v.along + ((turn_along ^ side) - side), v.across - ((turn_across ^ side) - side),
                           v.angle + ((step[i] ^ side) - side)};
}

#endif
