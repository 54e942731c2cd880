/* Wide symmetric weighted sums, of two distances at a time: the pairs of both side by side, times both weights, are one
 * instruction. The last samples of a row come again, where it is no multiple of the vectors. */
#include "vector.h"

#define INLINE static inline __attribute__((always_inline))

/* 16 samples, in 16 bits each: the pair of a distance, or what is at distance 0. */
typedef struct {
    __m128i low, high;
} pair_16;

/* 16 sums. */
typedef struct {
    __m128i v[4];
} sums_16;

static const pair_16 none;

/* The weights of distances k and k + 1, four times. */
INLINE __m128i two_weights(const int16_t *weights, int32_t k)
{
    int32_t both;
    memcpy(&both, weights + k, sizeof both);
    return _mm_set1_epi32(both);
}

INLINE __m128i one_weight(const int16_t *weights, int32_t k)
{
    return _mm_set1_epi32(weights[k]);
}

INLINE void add_pairs(sums_16 *sums, pair_16 even, pair_16 odd, __m128i weights)
{
    __m128i a = _mm_madd_epi16(_mm_unpacklo_epi16(even.low, odd.low), weights);
    __m128i b = _mm_madd_epi16(_mm_unpackhi_epi16(even.low, odd.low), weights);
    __m128i c = _mm_madd_epi16(_mm_unpacklo_epi16(even.high, odd.high), weights);
    __m128i d = _mm_madd_epi16(_mm_unpackhi_epi16(even.high, odd.high), weights);
    sums->v[0] = _mm_add_epi32(sums->v[0], a);
    sums->v[1] = _mm_add_epi32(sums->v[1], b);
    sums->v[2] = _mm_add_epi32(sums->v[2], c);
    sums->v[3] = _mm_add_epi32(sums->v[3], d);
}

INLINE sums_16 all_alike(int32_t start)
{
    __m128i v = _mm_set1_epi32(start);
    return (sums_16){{v, v, v, v}};
}

INLINE pair_16 shifted(sums_16 sums, int shift)
{
    __m128i a = _mm_srli_epi32(sums.v[0], shift), b = _mm_srli_epi32(sums.v[1], shift);
    __m128i c = _mm_srli_epi32(sums.v[2], shift), d = _mm_srli_epi32(sums.v[3], shift);
    return (pair_16){_mm_packus_epi32(a, b), _mm_packus_epi32(c, d)};
}

/* middle: where the row of distance 0 is. */
INLINE pair_16 pair_down(const uint8_t *src, const int32_t *middle, int32_t k)
{
    const __m128i ones = _mm_set1_epi8(1);
    __m128i a = load16(src + middle[-k]), b = load16(src + middle[k]);
    return (pair_16){_mm_maddubs_epi16(_mm_unpacklo_epi8(a, b), ones),
                     _mm_maddubs_epi16(_mm_unpackhi_epi8(a, b), ones)};
}

void iris_row_wide_down_sse(int16_t *dst, const uint8_t *src, const int32_t *at, const int16_t *weights,
                            int32_t radius, int32_t n)
{
    if (n < 16) {
        iris_row_wide_down_c(dst, src, at, weights, radius, n);
        return;
    }
    const int32_t *middle = at + radius;
    for (int32_t i = 0; i < n; i += 16) {
        int32_t from = i < n - 16 ? i : n - 16, k = 2;
        const uint8_t *here = src + from;
        __m128i center = load16(here + middle[0]);
        pair_16 first = {_mm_cvtepu8_epi16(center), _mm_unpackhi_epi8(center, _mm_setzero_si128())};
        sums_16 sums = all_alike(1 << 10);
        add_pairs(&sums, first, pair_down(here, middle, 1), two_weights(weights, 0));
        for (; k < radius; k += 2) {
            add_pairs(&sums, pair_down(here, middle, k), pair_down(here, middle, k + 1),
                      two_weights(weights, k));
        }
        if (k == radius) {
            add_pairs(&sums, pair_down(here, middle, k), none, one_weight(weights, k));
        }
        pair_16 result = shifted(sums, 11);
        store16(dst + from, result.low);
        store16(dst + from + 8, result.high);
    }
}

INLINE pair_16 pair_across(const int16_t *src, int32_t away)
{
    return (pair_16){_mm_add_epi16(load16(src - away), load16(src + away)),
                     _mm_add_epi16(load16(src + 8 - away), load16(src + 8 + away))};
}

INLINE sums_16 across_16(const int16_t *src, const int16_t *weights, int32_t radius, int32_t step,
                         int32_t start)
{
    sums_16 sums = all_alike(start);
    int32_t k = 2;
    add_pairs(&sums, (pair_16){load16(src), load16(src + 8)}, pair_across(src, step),
              two_weights(weights, 0));
    for (; k < radius; k += 2) {
        add_pairs(&sums, pair_across(src, k * step), pair_across(src, (k + 1) * step),
                  two_weights(weights, k));
    }
    if (k == radius) {
        add_pairs(&sums, pair_across(src, k * step), none, one_weight(weights, k));
    }
    return sums;
}

void iris_row_wide_across_sse(int16_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                              int32_t step, int32_t n)
{
    if (n < 16) {
        iris_row_wide_across_c(dst, src, weights, radius, step, n);
        return;
    }
    for (int32_t i = 0; i < n; i += 16) {
        int32_t from = i < n - 16 ? i : n - 16;
        pair_16 result = shifted(across_16(src + from, weights, radius, step, 1 << 16), 17);
        store16(dst + from, result.low);
        store16(dst + from + 8, result.high);
    }
}

void iris_row_wide_across_u8_sse(uint8_t *dst, const int16_t *src, const int16_t *weights, int32_t radius,
                                 int32_t step, int32_t n)
{
    if (n < 16) {
        iris_row_wide_across_u8_c(dst, src, weights, radius, step, n);
        return;
    }
    for (int32_t i = 0; i < n; i += 16) {
        int32_t from = i < n - 16 ? i : n - 16;
        pair_16 result = shifted(across_16(src + from, weights, radius, step, 1 << 22), 23);
        store16(dst + from, _mm_packus_epi16(result.low, result.high));
    }
}
