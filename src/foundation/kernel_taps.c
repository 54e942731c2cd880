/* Weighted sums of rows, and what becomes of them. */
#include "kernel.h"

/* Three taps at a time, so that a sum is read and written once for them; those past the last have weight 0. */

static inline void add_taps(int32_t *sums, const iris_row_tap *taps, int32_t count, int32_t from, int32_t n)
{
    const iris_row_tap a = taps[0], b = count > 1 ? taps[1] : a, c = count > 2 ? taps[2] : a;
    const uint8_t *src = a.src + from, *second = b.src + from, *third = c.src + from;
    int32_t weight = a.weight, second_weight = count > 1 ? b.weight : 0;
    int32_t third_weight = count > 2 ? c.weight : 0;
    for (int32_t i = 0; i < n; i++) {
        sums[i] += weight * src[i] + second_weight * second[i] + third_weight * third[i];
    }
}

void iris_row_taps_u8_c(int32_t *sums, const iris_row_tap *taps, int32_t count, int32_t n)
{
    for (int32_t k = 0; k < count; k += 3) {
        add_taps(sums, taps + k, count - k, 0, n);
    }
}

void iris_row_taps_s32_c(int32_t *sums, const int32_t *src, const int32_t *weights, int32_t count,
                         int32_t step, int32_t n)
{
    for (int32_t k = 0; k < count; k += 3) {
        const int32_t *first = src + k * step, *second = count - k > 1 ? first + step : first;
        const int32_t *third = count - k > 2 ? second + step : first;
        int32_t weight = weights[k], second_weight = count - k > 1 ? weights[k + 1] : 0;
        int32_t third_weight = count - k > 2 ? weights[k + 2] : 0;
        for (int32_t i = 0; i < n; i++) {
            sums[i] += weight * first[i] + second_weight * second[i] + third_weight * third[i];
        }
    }
}

static inline void settle(uint8_t *dst, const int32_t *sums, const iris_row_quotient *quotient, int by_shift,
                          int32_t n)
{
    const iris_row_quotient q = *quotient;
    int32_t limit = 255 * q.divisor;
    for (int32_t i = 0; i < n; i++) {
        int32_t sum = sums[i];
        sum = sum >= 0 ? sum : q.absolute ? q.divisor - 1 - sum : 0;
        uint32_t part = (uint32_t)(sum < limit ? sum : limit);
        part = by_shift ? part : (uint32_t)((uint64_t)(2 * part) * q.factor >> 32);
        dst[i] = (uint8_t)(part >> (q.shift - 31));
    }
}

/* A divisor that is a power of two is a shift alone. */
void iris_row_settle_u8_c(uint8_t *dst, const int32_t *sums, const iris_row_quotient *quotient, int32_t n)
{
    if (quotient->factor == 1u << 31) {
        settle(dst, sums, quotient, 1, n);
    } else {
        settle(dst, sums, quotient, 0, n);
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
        for (int32_t k = 0; k < count; k += 3) {
            add_taps(sums, taps + k, count - k, from, some);
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
