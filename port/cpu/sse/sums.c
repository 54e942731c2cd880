/* Sums of rows, down and across. */
#include "vector.h"

/* Four results in 32 bits; nothing is read past what they need. */
static inline __m128i halved_4(const uint16_t *sums)
{
    __m128i left = _mm_madd_epi16(load16(sums - 2), _mm_set1_epi32(4 << 16 | 1));
    __m128i middle = _mm_madd_epi16(load16(sums), _mm_set1_epi32(4 << 16 | 6));
    __m128i right = _mm_srli_epi32(load16(sums + 1), 16);
    __m128i sum = _mm_add_epi32(_mm_add_epi32(left, middle), _mm_add_epi32(right, _mm_set1_epi32(128)));
    return _mm_srli_epi32(sum, 8);
}

void iris_row_halve_u16_sse(uint8_t *dst, const uint16_t *sums, int32_t n)
{
    if (n < 16) {
        iris_row_halve_u16_c(dst, sums, n);
        return;
    }
    for (int32_t x = 0; x < n; x += 16) {
        x = x > n - 16 ? n - 16 : x;
        const uint16_t *s = sums + 2 * x;
        __m128i low = _mm_packs_epi32(halved_4(s), halved_4(s + 8));
        __m128i high = _mm_packs_epi32(halved_4(s + 16), halved_4(s + 24));
        store16(dst + x, _mm_packus_epi16(low, high));
    }
}

void iris_row_integral_u8_sse(uint32_t *dst, const uint32_t *above, const uint8_t *src, int32_t n)
{
    const __m128i zero = _mm_setzero_si128();
    __m128i before = zero; /* the sum so far, four times */
    int32_t x = 0;
    for (; x + 8 <= n; x += 8) {
        __m128i sum = _mm_unpacklo_epi8(_mm_loadl_epi64((const __m128i *)(const void *)(src + x)), zero);
        sum = _mm_add_epi16(sum, _mm_slli_si128(sum, 2));
        sum = _mm_add_epi16(sum, _mm_slli_si128(sum, 4));
        sum = _mm_add_epi16(sum, _mm_slli_si128(sum, 8));
        __m128i low = _mm_add_epi32(before, _mm_unpacklo_epi16(sum, zero));
        __m128i high = _mm_add_epi32(before, _mm_unpackhi_epi16(sum, zero));
        before = _mm_shuffle_epi32(high, 0xFF);
        store16(dst + x, _mm_add_epi32(low, load16(above + x)));
        store16(dst + x + 4, _mm_add_epi32(high, load16(above + x + 4)));
    }
    uint32_t rest = (uint32_t)_mm_cvtsi128_si32(before);
    for (; x < n; x++) {
        rest += src[x];
        dst[x] = above[x] + rest;
    }
}
