/* Differences of one row, from the rows around it. */
#ifndef IRIS_XT_EDGE_ROWS_H
#define IRIS_XT_EDGE_ROWS_H

#include "../../foundation/kernel.h"
#include "iris/xt/edge.h"

/* 128ths that a row's middle difference counts more than once: 128 is 1 2 1, 53 is 1 (square root of 2) 1. */
enum { IRIS_EDGE_MORE_SOBEL = 128, IRIS_EDGE_MORE_ISOTROPIC = 53, IRIS_EDGE_MORE_PREWITT = 0 };

/* dx, dy, and |dx| + |dy| of n pixels by op, any but LOG (of LAPLACIAN dx alone). The rows are
 * readable one pixel beyond. */
void iris_edge_row(const iris_row_gradient *to, const uint8_t *const rows[3], iris_edge_operator op,
                   int32_t n);

/* The sizes alone, times the gain, rounded, at most 255: of all but ROBERTS and LOG. */
void iris_edge_row_u8(uint8_t *dst, const uint8_t *const rows[3], iris_edge_operator op, uint32_t gain_q16,
                      int32_t n);

/* The bits of word `word` of a mask's row that stand for pixels first to end - 1. */
static inline uint32_t iris_mask_part(int32_t word, int32_t first, int32_t end)
{
    int32_t from = first - 32 * word, to = end - 32 * word;
    uint32_t below = from <= 0 ? 0 : from >= 32 ? ~(uint32_t)0 : ((uint32_t)1 << from) - 1;
    uint32_t up_to = to <= 0 ? 0 : to >= 32 ? ~(uint32_t)0 : ((uint32_t)1 << to) - 1;
    return up_to & ~below;
}

#endif
