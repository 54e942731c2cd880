/* Sums and comparisons in blocks of 8 pixels. */
#include "vector.h"

/* 32 pixels, 4 blocks, at a time. A block in 32 bits: sum in the low half, limit, and below in the highest byte. */
void iris_row_scan8_u8_sse(iris_block8 *block, const uint8_t *src, int32_t n)
{
    const __m128i zero = _mm_setzero_si128(), limit_byte = _mm_set1_epi32(0xff0000);
    const __m128i first_two = _mm_setr_epi8(2, 2, 2, 2, 2, 2, 2, 2, 6, 6, 6, 6, 6, 6, 6, 6);
    const __m128i last_two = _mm_add_epi8(first_two, _mm_set1_epi8(8));
    const __m128i to_below = _mm_setr_epi8(-1, -1, -1, 0, -1, -1, -1, 1, -1, -1, -1, 2, -1, -1, -1, 3);
    for (; n >= 32; n -= 32, src += 32, block += 4) {
        __m128i blocks = load16(block), a = load16(src), b = load16(src + 16);
        __m128i not_a = _mm_cmpeq_epi8(_mm_max_epu8(a, _mm_shuffle_epi8(blocks, first_two)), a);
        __m128i not_b = _mm_cmpeq_epi8(_mm_max_epu8(b, _mm_shuffle_epi8(blocks, last_two)), b);
        __m128i below = _mm_cvtsi32_si128((int32_t)~high_bits(not_a, not_b));
        __m128i sums = _mm_packs_epi32(_mm_sad_epu8(a, zero), _mm_sad_epu8(b, zero));
        blocks = _mm_or_si128(_mm_and_si128(blocks, limit_byte), _mm_shuffle_epi8(below, to_below));
        store16(block, _mm_or_si128(blocks, sums));
    }
    iris_row_scan8_u8_c(block, src, n);
}
