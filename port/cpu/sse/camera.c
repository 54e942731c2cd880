/* Rows of cameras to colors. */
#include "vector.h"

/* Sixteen pixels from their channels. */
static inline void store_888(uint8_t *dst, __m128i first, __m128i second, __m128i third)
{
    const __m128i first0 = _mm_setr_epi8(0, -1, -1, 1, -1, -1, 2, -1, -1, 3, -1, -1, 4, -1, -1, 5);
    const __m128i second0 = _mm_setr_epi8(-1, 0, -1, -1, 1, -1, -1, 2, -1, -1, 3, -1, -1, 4, -1, -1);
    const __m128i third0 = _mm_setr_epi8(-1, -1, 0, -1, -1, 1, -1, -1, 2, -1, -1, 3, -1, -1, 4, -1);
    const __m128i first1 = _mm_setr_epi8(-1, -1, 6, -1, -1, 7, -1, -1, 8, -1, -1, 9, -1, -1, 10, -1);
    const __m128i second1 = _mm_setr_epi8(5, -1, -1, 6, -1, -1, 7, -1, -1, 8, -1, -1, 9, -1, -1, 10);
    const __m128i third1 = _mm_setr_epi8(-1, 5, -1, -1, 6, -1, -1, 7, -1, -1, 8, -1, -1, 9, -1, -1);
    const __m128i first2 = _mm_setr_epi8(-1, 11, -1, -1, 12, -1, -1, 13, -1, -1, 14, -1, -1, 15, -1, -1);
    const __m128i second2 = _mm_setr_epi8(-1, -1, 11, -1, -1, 12, -1, -1, 13, -1, -1, 14, -1, -1, 15, -1);
    const __m128i third2 = _mm_setr_epi8(10, -1, -1, 11, -1, -1, 12, -1, -1, 13, -1, -1, 14, -1, -1, 15);
    store16(dst,
            _mm_or_si128(_mm_or_si128(_mm_shuffle_epi8(first, first0), _mm_shuffle_epi8(second, second0)),
                         _mm_shuffle_epi8(third, third0)));
    store16(dst + 16,
            _mm_or_si128(_mm_or_si128(_mm_shuffle_epi8(first, first1), _mm_shuffle_epi8(second, second1)),
                         _mm_shuffle_epi8(third, third1)));
    store16(dst + 32,
            _mm_or_si128(_mm_or_si128(_mm_shuffle_epi8(first, first2), _mm_shuffle_epi8(second, second2)),
                         _mm_shuffle_epi8(third, third2)));
}

/* ---- YUV ---- */

/* 16-bit factors of two neighbors, the first in the low half. */
static inline __m128i factors(int16_t first, int16_t second)
{
    return _mm_set1_epi32((int32_t)((uint32_t)(uint16_t)second << 16 | (uint16_t)first));
}

/* Eight pixels of a channel: their luma, four and four, and the tint of each two. */
static inline __m128i tinted(__m128i luma0, __m128i luma1, __m128i tint)
{
    __m128i low = _mm_srai_epi32(_mm_add_epi32(luma0, _mm_unpacklo_epi32(tint, tint)), 8);
    __m128i high = _mm_srai_epi32(_mm_add_epi32(luma1, _mm_unpackhi_epi32(tint, tint)), 8);
    return _mm_packs_epi32(low, high);
}

/* Eight pixels: y in 16 bits, U and V in turn. */
static inline void colors_of_8(__m128i rgb[3], __m128i y, __m128i uv)
{
    const __m128i one = _mm_set1_epi16(1);
    y = _mm_sub_epi16(y, _mm_set1_epi16(16));
    uv = _mm_sub_epi16(uv, _mm_set1_epi16(128));
    __m128i luma0 = _mm_madd_epi16(_mm_unpacklo_epi16(y, one), factors(298, 128));
    __m128i luma1 = _mm_madd_epi16(_mm_unpackhi_epi16(y, one), factors(298, 128));
    rgb[0] = tinted(luma0, luma1, _mm_madd_epi16(uv, factors(0, 409)));
    rgb[1] = tinted(luma0, luma1, _mm_madd_epi16(uv, factors(-100, -208)));
    rgb[2] = tinted(luma0, luma1, _mm_madd_epi16(uv, factors(516, 0)));
}

void iris_row_rgb888_nv12_sse(uint8_t *dst, const uint8_t *luma, const uint8_t *chroma, int32_t n)
{
    const __m128i zero = _mm_setzero_si128();
    for (; n >= 16; n -= 16, dst += 48, luma += 16, chroma += 16) {
        __m128i y = load16(luma), uv = load16(chroma), low[3], high[3];
        colors_of_8(low, _mm_unpacklo_epi8(y, zero), _mm_unpacklo_epi8(uv, zero));
        colors_of_8(high, _mm_unpackhi_epi8(y, zero), _mm_unpackhi_epi8(uv, zero));
        store_888(dst, _mm_packus_epi16(low[0], high[0]), _mm_packus_epi16(low[1], high[1]),
                  _mm_packus_epi16(low[2], high[2]));
    }
    iris_row_rgb888_nv12_c(dst, luma, chroma, n);
}

/* ---- Bayer ---- */

/* The means of four in the odd bytes; the even ones are 0. */
static inline __m128i odd_means(__m128i a, __m128i b, __m128i c, __m128i d)
{
    __m128i sum = _mm_add_epi16(_mm_add_epi16(_mm_srli_epi16(a, 8), _mm_srli_epi16(b, 8)),
                                _mm_add_epi16(_mm_srli_epi16(c, 8), _mm_srli_epi16(d, 8)));
    return _mm_slli_epi16(_mm_srli_epi16(_mm_add_epi16(sum, _mm_set1_epi16(2)), 2), 8);
}

/* Sixteen pixels, the even ones green. */
static inline void demosaic_16(uint8_t *dst, const uint8_t *const rows[3], int32_t own)
{
    const __m128i even = _mm_set1_epi16(0xFF);
    __m128i row = load16(rows[1]), left = load16(rows[1] - 1), right = load16(rows[1] + 1);
    __m128i above = load16(rows[0]), below = load16(rows[2]);
    __m128i of_row = _mm_blendv_epi8(row, _mm_avg_epu8(left, right), even);
    __m128i green = _mm_blendv_epi8(odd_means(left, right, above, below), row, even);
    __m128i corners =
        odd_means(load16(rows[0] - 1), load16(rows[0] + 1), load16(rows[2] - 1), load16(rows[2] + 1));
    __m128i far = _mm_blendv_epi8(corners, _mm_avg_epu8(above, below), even);
    store_888(dst, own == 0 ? of_row : far, green, own == 0 ? far : of_row);
}

void iris_row_888_bayer_sse(uint8_t *dst, const uint8_t *const rows[3], int32_t own, int32_t green, int32_t n)
{
    int32_t x = green != 0 && n > 0; /* a pixel that is not green */
    iris_row_888_bayer_c(dst, rows, own, green, x);
    for (; x + 16 <= n; x += 16) {
        const uint8_t *const here[3] = {rows[0] + x, rows[1] + x, rows[2] + x};
        demosaic_16(dst + 3 * x, here, own);
    }
    const uint8_t *const rest[3] = {rows[0] + x, rows[1] + x, rows[2] + x};
    iris_row_888_bayer_c(dst + 3 * x, rest, own, 0, n - x);
}
