/* Gray levels against one limit. */
#include "vector.h"

static inline uint32_t above_32(const uint8_t *src, __m128i limit)
{
    __m128i first = load16(src), second = load16(src + 16);
    __m128i not_first = _mm_cmpeq_epi8(_mm_min_epu8(first, limit), first);
    __m128i not_second = _mm_cmpeq_epi8(_mm_min_epu8(second, limit), second);
    return ~high_bits(not_first, not_second);
}

/* The last word comes from the last 32 pixels of the row, some of which may be in the word before it. */
void iris_row_above_u8_sse(uint32_t *mask, const uint8_t *src, uint8_t limit, int32_t n)
{
    if (n < 32) {
        iris_row_above_u8_c(mask, src, limit, n);
        return;
    }
    const __m128i limits = _mm_set1_epi8((char)limit);
    int32_t words = n / 32, rest = n % 32;
    for (int32_t word = 0; word < words; word++) {
        mask[word] = above_32(src + 32 * word, limits);
    }
    if (rest > 0) {
        iris_row_put_bits(&mask[words], above_32(src + n - 32, limits) >> (32 - rest), rest);
    }
}
