/* Sums of rows, down and across. */
#include "kernel.h"

void iris_row_binomial5_u8_c(uint16_t *sums, const uint8_t *const rows[5], int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        uint32_t outer = (uint32_t)rows[0][i] + rows[4][i], inner = (uint32_t)rows[1][i] + rows[3][i];
        sums[i] = (uint16_t)(outer + 4u * inner + 6u * rows[2][i]);
    }
}

void iris_row_halve_u16_c(uint8_t *dst, const uint16_t *sums, int32_t n)
{
    for (int32_t i = 0; i < n; i++, sums += 2) {
        uint32_t outer = (uint32_t)sums[-2] + sums[2], inner = (uint32_t)sums[-1] + sums[1];
        dst[i] = (uint8_t)((outer + 4u * inner + 6u * sums[0] + 128u) >> 8);
    }
}

void iris_row_integral_u8_c(uint32_t *dst, const uint32_t *above, const uint8_t *src, int32_t n)
{
    uint32_t sum = 0;
    for (int32_t i = 0; i < n; i++) {
        sum += src[i];
        dst[i] = above[i] + sum;
    }
}
