/* Weighted sums of rows, and what becomes of them. */
#include "kernel.h"

void iris_row_taps_u8_c(int32_t *sums, const iris_row_tap *taps, int32_t count, int32_t n)
{
    for (int32_t k = 0; k < count; k++) {
        const uint8_t *src = taps[k].src;
        int32_t weight = taps[k].weight;
        for (int32_t i = 0; i < n; i++) {
            sums[i] += weight * src[i];
        }
    }
}

void iris_row_taps_s32_c(int32_t *sums, const int32_t *src, const int32_t *weights, int32_t count,
                         int32_t step, int32_t n)
{
    for (int32_t k = 0; k < count; k++, src += step) {
        int32_t weight = weights[k];
        for (int32_t i = 0; weight != 0 && i < n; i++) {
            sums[i] += weight * src[i];
        }
    }
}

void iris_row_settle_u8_c(uint8_t *dst, const int32_t *sums, const iris_row_quotient *quotient, int32_t n)
{
    const iris_row_quotient q = *quotient;
    int32_t limit = 255 * q.divisor;
    for (int32_t i = 0; i < n; i++) {
        int32_t sum = sums[i];
        sum = sum >= 0 ? sum : q.absolute ? q.divisor - 1 - sum : 0;
        sum = sum < limit ? sum : limit;
        dst[i] = (uint8_t)((uint64_t)(uint32_t)sum * q.factor >> q.shift);
    }
}

#define TILE 64

void iris_row_filter_u8_c(uint8_t *dst, const iris_row_tap *taps, int32_t count,
                          const iris_row_quotient *quotient, int32_t n)
{
    int32_t sums[TILE];
    for (int32_t from = 0; from < n; from += TILE) {
        int32_t some = n - from < TILE ? n - from : TILE;
        for (int32_t i = 0; i < some; i++) {
            sums[i] = quotient->start;
        }
        for (int32_t k = 0; k < count; k++) {
            iris_row_tap tap = {taps[k].src + from, taps[k].weight};
            iris_row_taps_u8_c(sums, &tap, 1, some);
        }
        iris_row_settle_u8_c(dst + from, sums, quotient, some);
    }
}

void iris_row_filter_s32_c(uint8_t *dst, const int32_t *src, const iris_row_line *line,
                           const iris_row_quotient *quotient, int32_t n)
{
    int32_t sums[TILE];
    for (int32_t from = 0; from < n; from += TILE) {
        int32_t some = n - from < TILE ? n - from : TILE;
        for (int32_t i = 0; i < some; i++) {
            sums[i] = quotient->start;
        }
        iris_row_taps_s32_c(sums, src + from, line->weights, line->count, line->step, some);
        iris_row_settle_u8_c(dst + from, sums, quotient, some);
    }
}
