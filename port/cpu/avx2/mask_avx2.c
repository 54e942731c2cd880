/* Gray levels against one limit. */
#include "vector.h"

static inline uint32_t above_32(const uint8_t *src, __m256i limit)
{
    __m256i levels = load32(src);
    return ~(uint32_t)_mm256_movemask_epi8(_mm256_cmpeq_epi8(_mm256_min_epu8(levels, limit), levels));
}

/* The last word comes from the last 32 pixels of the row, some of which may be in the word before it. */
void iris_row_above_u8_avx2(uint32_t *mask, const uint8_t *src, uint8_t limit, int32_t n)
{
    if (n < 32) {
        iris_row_above_u8_c(mask, src, limit, n);
        return;
    }
    const __m256i limits = _mm256_set1_epi8((char)limit);
    int32_t words = n / 32, rest = n % 32;
#pragma GCC unroll 2
    for (int32_t word = 0; word < words; word++) {
        mask[word] = above_32(src + 32 * word, limits);
    }
    if (rest > 0) {
        iris_row_put_bits(&mask[words], above_32(src + n - 32, limits) >> (32 - rest), rest);
    }
}
