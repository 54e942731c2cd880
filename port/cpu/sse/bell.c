/* Symmetric weighted sums: V(mulhrs_epi16) is the rounded product. The last samples of a row come again, where it is
 * no multiple of the vectors. Every radius has loops of its own that are unrolled. */
#include "lanes.h"

typedef struct {
    lanes w[IRIS_BELL_RADIUS + 1];
} bell_weights;

INLINE bell_weights spread(const int16_t *weights, int32_t radius)
{
    bell_weights all;
    for (int32_t k = 0; k <= IRIS_BELL_RADIUS; k++) {
        all.w[k] = V(set1_epi16)(k <= radius ? weights[k] : 0);
    }
    return all;
}

/* (a + b) * 64 * weight, of eight pairs of bytes. */
INLINE lanes weigh_pairs(lanes pairs, lanes weight)
{
    return V(mulhrs_epi16)(V(maddubs_epi16)(pairs, V(set1_epi8)(64)), weight);
}

INLINE void down(int16_t *dst, const uint8_t *const *rows, const int16_t *weights, int32_t radius, int32_t n)
{
    const bell_weights by = spread(weights, radius);
    const uint8_t *row[2 * IRIS_BELL_RADIUS + 1]; /* known not to change */
    for (int32_t k = 0; k <= 2 * radius; k++) {
        row[k] = rows[k];
    }
    for (int32_t i = 0; i < n; i += LANES) {
        int32_t at = i < n - LANES ? i : n - LANES;
        lanes center = load_lanes(row[radius] + at);
        lanes low = weigh_pairs(V(unpacklo_epi8)(center, VSI(setzero)()), by.w[0]);
        lanes high = weigh_pairs(V(unpackhi_epi8)(center, VSI(setzero)()), by.w[0]);
#pragma GCC unroll 8
        for (int32_t k = 1; k <= radius; k++) {
            lanes above = load_lanes(row[radius - k] + at), below = load_lanes(row[radius + k] + at);
            low = V(add_epi16)(low, weigh_pairs(V(unpacklo_epi8)(above, below), by.w[k]));
            high = V(add_epi16)(high, weigh_pairs(V(unpackhi_epi8)(above, below), by.w[k]));
        }
        store_halves(dst + at, low, high);
    }
}

void iris_row_bell_down_sse(int16_t *dst, const uint8_t *const *rows, const int16_t *weights, int32_t radius,
                            int32_t n)
{
    if (n < LANES) {
        iris_row_bell_down_c(dst, rows, weights, radius, n);
        return;
    }
    switch (radius) {
    case 1:
        down(dst, rows, weights, 1, n);
        break;
    case 2:
        down(dst, rows, weights, 2, n);
        break;
    case 3:
        down(dst, rows, weights, 3, n);
        break;
    case 4:
        down(dst, rows, weights, 4, n);
        break;
    default:
        down(dst, rows, weights, 5, n);
        break;
    }
}

INLINE lanes across_some(const int16_t *src, const bell_weights *by, int32_t radius, int32_t step)
{
    lanes sum = V(mulhrs_epi16)(load_lanes(src), by->w[0]);
#pragma GCC unroll 8
    for (int32_t k = 1; k <= radius; k++) {
        lanes pair = V(add_epi16)(load_lanes(src - k * step), load_lanes(src + k * step));
        sum = V(add_epi16)(sum, V(mulhrs_epi16)(pair, by->w[k]));
    }
    return sum;
}

void iris_row_bell_across_sse(int16_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                              int32_t step, int32_t n)
{
    const bell_weights by = spread(weights, radius);
    for (; n >= LANES / 2; n -= LANES / 2, dst += LANES / 2, src += LANES / 2) {
        store_lanes(dst, across_some(src, &by, radius, step));
    }
    iris_row_bell_across_c(dst, src, weights, radius, step, n);
}

/* Rounded to whole numbers, as a product by 1/64. */
INLINE lanes to_bytes(lanes first, lanes second)
{
    const lanes part = V(set1_epi16)(512);
    return in_order(V(packus_epi16)(V(mulhrs_epi16)(first, part), V(mulhrs_epi16)(second, part)));
}

INLINE void across_u8(uint8_t *dst, const int16_t *src, const bell_weights by, int32_t radius, int32_t step,
                      int32_t n)
{
    for (int32_t i = 0; i < n; i += LANES) {
        int32_t at = i < n - LANES ? i : n - LANES;
        lanes first = across_some(src + at, &by, radius, step);
        lanes second = across_some(src + at + LANES / 2, &by, radius, step);
        store_lanes(dst + at, to_bytes(first, second));
    }
}

void iris_row_bell_across_u8_sse(uint8_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                                 int32_t step, int32_t n)
{
    if (n < LANES) {
        iris_row_bell_across_u8_c(dst, src, weights, radius, step, n);
        return;
    }
    const bell_weights by = spread(weights, radius);
    switch (radius) {
    case 1:
        across_u8(dst, src, by, 1, step, n);
        break;
    case 2:
        across_u8(dst, src, by, 2, step, n);
        break;
    case 3:
        across_u8(dst, src, by, 3, step, n);
        break;
    case 4:
        across_u8(dst, src, by, 4, step, n);
        break;
    default:
        across_u8(dst, src, by, 5, step, n);
        break;
    }
}
