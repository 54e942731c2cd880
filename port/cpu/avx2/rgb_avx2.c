/* Gray from three channels: see the SSE port, of which each half of a vector does the work. */
#include "vector.h"

/* Four pixels of each half give eight products: the first channel and a part of the green one, the other part and the last
 * channel. Green's factor 150 is cut in two because factors are signed bytes and sums of two stay below 2^15. */
static inline __m256i half_sums(const uint8_t *bytes, __m256i order, __m256i factors)
{
    return _mm256_maddubs_epi16(_mm256_shuffle_epi8(load16_twice(bytes, bytes + 48), order), factors);
}

static inline __m256i luma_of_8(__m256i first, __m256i second)
{
    __m256i sum =
        _mm256_add_epi16(_mm256_unpacklo_epi64(first, second), _mm256_unpackhi_epi64(first, second));
    return _mm256_srli_epi16(_mm256_add_epi16(sum, _mm256_set1_epi16(128)), 8);
}

/* n >= 32. The last 32 pixels may overlap those before them: dst and src are disjoint. */
static inline void luma_row(uint8_t *dst, const uint8_t *src, int32_t n, __m128i of_half)
{
    const __m256i order =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 1, 3, 4, 6, 7, 9, 10, 1, 2, 4, 5, 7, 8, 10, 11));
    const __m256i order_of_last = _mm256_add_epi8(order, _mm256_set1_epi8(4)); /* its 12 bytes end the half */
    const __m256i factors = _mm256_broadcastsi128_si256(of_half);
    for (int32_t x = 0; x < n; x += 32) {
        x = x > n - 32 ? n - 32 : x;
        const uint8_t *from = src + 3 * x;
        __m256i a = half_sums(from, order, factors);
        __m256i b = half_sums(from + 12, order, factors);
        __m256i c = half_sums(from + 24, order, factors);
        __m256i d = half_sums(from + 32, order_of_last, factors);
        store32(dst + x, _mm256_packus_epi16(luma_of_8(a, b), luma_of_8(c, d)));
    }
}

void iris_row_luma_rgb888_avx2(uint8_t *dst, const uint8_t *src, int32_t n)
{
    if (n < 32) {
        iris_row_luma_rgb888_sse(dst, src, n);
        return;
    }
    luma_row(dst, src, n, _mm_setr_epi8(77, 51, 77, 51, 77, 51, 77, 51, 99, 29, 99, 29, 99, 29, 99, 29));
}

void iris_row_luma_bgr888_avx2(uint8_t *dst, const uint8_t *src, int32_t n)
{
    if (n < 32) {
        iris_row_luma_bgr888_sse(dst, src, n);
        return;
    }
    luma_row(dst, src, n, _mm_setr_epi8(29, 99, 29, 99, 29, 99, 29, 99, 51, 77, 51, 77, 51, 77, 51, 77));
}

/* Green once more in the place of alpha, so that each pixel has two sums of two products. */
static inline __m256i luma_of_8_rgba(const uint8_t *bytes)
{
    const __m256i order =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 1, 1, 2, 4, 5, 5, 6, 8, 9, 9, 10, 12, 13, 13, 14));
    const __m256i factors = _mm256_set1_epi32(29 << 24 | 99 << 16 | 51 << 8 | 77);
    __m256i low = _mm256_shuffle_epi8(load16_twice(bytes, bytes + 64), order);
    __m256i high = _mm256_shuffle_epi8(load16_twice(bytes + 16, bytes + 80), order);
    __m256i sum = _mm256_hadd_epi16(_mm256_maddubs_epi16(low, factors), _mm256_maddubs_epi16(high, factors));
    return _mm256_srli_epi16(_mm256_add_epi16(sum, _mm256_set1_epi16(128)), 8);
}

void iris_row_luma_rgba8888_avx2(uint8_t *dst, const uint8_t *src, int32_t n)
{
    if (n < 32) {
        iris_row_luma_rgba8888_sse(dst, src, n);
        return;
    }
    for (int32_t x = 0; x < n; x += 32) {
        x = x > n - 32 ? n - 32 : x;
        store32(dst + x, _mm256_packus_epi16(luma_of_8_rgba(src + 4 * x), luma_of_8_rgba(src + 4 * x + 32)));
    }
}
