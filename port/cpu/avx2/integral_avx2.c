/* Integral images, sixteen pixels at a time. */
#include <immintrin.h>

#include "kernel.h"

/* Lane i of each half plus all before it. */
static inline __m256i scan_u16(__m256i v)
{
    v = _mm256_add_epi16(v, _mm256_slli_si256(v, 2));
    v = _mm256_add_epi16(v, _mm256_slli_si256(v, 4));
    return _mm256_add_epi16(v, _mm256_slli_si256(v, 8));
}

static inline void put_8(uint32_t *dst, const uint32_t *above, __m256i before, __m128i sums)
{
    __m256i upper = _mm256_loadu_si256((const __m256i *)(const void *)above);
    __m256i sum = _mm256_add_epi32(_mm256_cvtepu16_epi32(sums), _mm256_add_epi32(upper, before));
    _mm256_storeu_si256((__m256i *)(void *)dst, sum);
}

/* What is before a pixel's eight is summed apart, so that none waits for the sums of those before it. */
void iris_row_integral_u8_avx2(uint32_t *dst, const uint32_t *above, const uint8_t *src, int32_t n)
{
    __m256i before = _mm256_setzero_si256();
    int32_t x = 0;
    for (; x + 16 <= n; x += 16) {
        __m128i bytes = _mm_loadu_si128((const __m128i *)(const void *)(src + x));
        __m128i totals = _mm_sad_epu8(bytes, _mm_setzero_si128());
        __m256i sums = scan_u16(_mm256_cvtepu8_epi16(bytes));
        put_8(dst + x, above + x, before, _mm256_castsi256_si128(sums));
        before = _mm256_add_epi32(before, _mm256_broadcastd_epi32(totals));
        put_8(dst + x + 8, above + x + 8, before, _mm256_extracti128_si256(sums, 1));
        before = _mm256_add_epi32(before, _mm256_broadcastd_epi32(_mm_unpackhi_epi64(totals, totals)));
    }
    uint32_t rest = (uint32_t)_mm_cvtsi128_si32(_mm256_castsi256_si128(before));
    for (; x < n; x++) {
        rest += src[x];
        dst[x] = above[x] + rest;
    }
}
