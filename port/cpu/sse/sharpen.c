/* Unsharp mask of a row. */
#include "vector.h"

/* The amount is a whole number and a signed fraction of 16 bits. */
typedef struct {
    __m128i whole, fraction, threshold;
} sharpening;

static inline __m128i sharpen_8(__m128i src, __m128i blurred, const sharpening *by)
{
    __m128i difference = _mm_sub_epi16(src, blurred);
    __m128i high = _mm_mulhi_epi16(difference, by->fraction), low = _mm_mullo_epi16(difference, by->fraction);
    __m128i change = _mm_add_epi16(high, _mm_srli_epi16(low, 15));
    change = _mm_add_epi16(change, _mm_mullo_epi16(difference, by->whole));
    __m128i counts = _mm_cmpgt_epi16(_mm_abs_epi16(difference), by->threshold);
    return _mm_add_epi16(src, _mm_and_si128(change, counts));
}

void iris_row_sharpen_u8_sse(uint8_t *dst, const uint8_t *src, const uint8_t *blurred, iris_row_sharpening by,
                             int32_t n)
{
    int16_t fraction = (int16_t)by.amount_q16;
    const sharpening spread = {_mm_set1_epi16((int16_t)((by.amount_q16 - fraction) >> 16)),
                               _mm_set1_epi16(fraction), _mm_set1_epi16((int16_t)by.threshold)};
    const __m128i zero = _mm_setzero_si128();
    for (; n >= 16; n -= 16, dst += 16, src += 16, blurred += 16) {
        __m128i s = load16(src), b = load16(blurred);
        __m128i low = sharpen_8(_mm_unpacklo_epi8(s, zero), _mm_unpacklo_epi8(b, zero), &spread);
        __m128i high = sharpen_8(_mm_unpackhi_epi8(s, zero), _mm_unpackhi_epi8(b, zero), &spread);
        store16(dst, _mm_packus_epi16(low, high));
    }
    iris_row_sharpen_u8_c(dst, src, blurred, by, n);
}
