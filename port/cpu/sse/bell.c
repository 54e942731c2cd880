/* Symmetric weighted sums: _mm_mulhrs_epi16 is the rounded product. The last samples of a row come again, where it is
 * no multiple of the vectors. Every radius has loops of its own that are unrolled. */
#include "vector.h"

#define INLINE static inline __attribute__((always_inline))

typedef struct {
    __m128i w[IRIS_BELL_RADIUS + 1];
} bell_weights;

INLINE bell_weights spread(const int16_t *weights, int32_t radius)
{
    bell_weights all;
    for (int32_t k = 0; k <= IRIS_BELL_RADIUS; k++) {
        all.w[k] = _mm_set1_epi16(k <= radius ? weights[k] : 0);
    }
    return all;
}

/* (a + b) * 64 * weight, of eight pairs of bytes. */
INLINE __m128i weigh_pairs(__m128i pairs, __m128i weight)
{
    return _mm_mulhrs_epi16(_mm_maddubs_epi16(pairs, _mm_set1_epi8(64)), weight);
}

INLINE void down(int16_t *dst, const uint8_t *const *rows, const int16_t *weights, int32_t radius, int32_t n)
{
    const bell_weights by = spread(weights, radius);
    for (int32_t i = 0; i < n; i += 16) {
        int32_t at = i < n - 16 ? i : n - 16;
        __m128i center = load16(rows[radius] + at);
        __m128i low = weigh_pairs(_mm_unpacklo_epi8(center, _mm_setzero_si128()), by.w[0]);
        __m128i high = weigh_pairs(_mm_unpackhi_epi8(center, _mm_setzero_si128()), by.w[0]);
#pragma GCC unroll 8
        for (int32_t k = 1; k <= radius; k++) {
            __m128i above = load16(rows[radius - k] + at), below = load16(rows[radius + k] + at);
            low = _mm_add_epi16(low, weigh_pairs(_mm_unpacklo_epi8(above, below), by.w[k]));
            high = _mm_add_epi16(high, weigh_pairs(_mm_unpackhi_epi8(above, below), by.w[k]));
        }
        store16(dst + at, low);
        store16(dst + at + 8, high);
    }
}

void iris_row_bell_down_sse(int16_t *dst, const uint8_t *const *rows, const int16_t *weights, int32_t radius,
                            int32_t n)
{
    if (n < 16) {
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

INLINE __m128i across_8(const int16_t *src, const bell_weights *by, int32_t radius, int32_t step)
{
    __m128i sum = _mm_mulhrs_epi16(load16(src), by->w[0]);
#pragma GCC unroll 8
    for (int32_t k = 1; k <= radius; k++) {
        __m128i pair = _mm_add_epi16(load16(src - k * step), load16(src + k * step));
        sum = _mm_add_epi16(sum, _mm_mulhrs_epi16(pair, by->w[k]));
    }
    return sum;
}

void iris_row_bell_across_sse(int16_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                              int32_t step, int32_t n)
{
    const bell_weights by = spread(weights, radius);
    for (; n >= 8; n -= 8, dst += 8, src += 8) {
        store16(dst, across_8(src, &by, radius, step));
    }
    iris_row_bell_across_c(dst, src, weights, radius, step, n);
}

INLINE __m128i to_bytes(__m128i first, __m128i second)
{
    const __m128i half = _mm_set1_epi16(32);
    return _mm_packus_epi16(_mm_srli_epi16(_mm_add_epi16(first, half), 6),
                            _mm_srli_epi16(_mm_add_epi16(second, half), 6));
}

INLINE void across_u8(uint8_t *dst, const int16_t *src, const bell_weights by, int32_t radius, int32_t step,
                      int32_t n)
{
    for (int32_t i = 0; i < n; i += 16) {
        int32_t at = i < n - 16 ? i : n - 16;
        store16(dst + at,
                to_bytes(across_8(src + at, &by, radius, step), across_8(src + at + 8, &by, radius, step)));
    }
}

void iris_row_bell_across_u8_sse(uint8_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                                 int32_t step, int32_t n)
{
    if (n < 16) {
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
