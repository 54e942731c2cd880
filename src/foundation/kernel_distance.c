/* Row kernels of distances: the plain C bodies. */
#include "kernel.h"

#define FAR 65535u /* sums end here */

static uint16_t nearer(uint32_t a, uint32_t b)
{
    return (uint16_t)(a < b ? a : b);
}

void iris_row_select_u16_c(uint16_t *dst, const uint32_t *mask, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        dst[i] = (uint16_t)(0u - (mask[i / 32] >> i % 32 & 1));
    }
}

static void reach_straight(uint16_t *row, const uint16_t *other, uint32_t straight, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        row[i] = nearer(row[i], other[i] + straight);
    }
}

void iris_row_reach_u16_c(uint16_t *row, const uint16_t *other, iris_row_steps steps, int32_t n)
{
    if (steps.diagonal == FAR) {
        reach_straight(row, other, steps.straight, n);
        return;
    }
    uint32_t left = FAR;
    for (int32_t i = 0; i < n; i++) {
        uint32_t right = i + 1 < n ? other[i + 1] : FAR;
        row[i] = nearer(row[i], other[i] + (uint32_t)steps.straight);
        row[i] = nearer(row[i], (left < right ? left : right) + steps.diagonal);
        left = other[i];
    }
}

void iris_row_spread_right_u16_c(uint16_t *row, uint16_t step, int32_t n)
{
    uint32_t before = FAR;
    for (int32_t i = 0; i < n; i++) {
        before = row[i] = nearer(row[i], before + step);
    }
}

void iris_row_spread_left_u16_c(uint16_t *row, uint16_t step, int32_t n)
{
    uint32_t before = FAR;
    for (int32_t i = n - 1; i >= 0; i--) {
        before = row[i] = nearer(row[i], before + step);
    }
}
