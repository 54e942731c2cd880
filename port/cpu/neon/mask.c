/* Gray levels against one limit. */
#include "bits.h"

static inline uint32_t above_32(const uint8_t *src, uint8x16_t limit)
{
    return word_of_32(vcgtq_u8(vld1q_u8(src), limit), vcgtq_u8(vld1q_u8(src + 16), limit));
}

/* The last word comes from the last 32 pixels of the row, some of which may be in the word before it. */
void iris_row_above_u8_neon(uint32_t *mask, const uint8_t *src, uint8_t limit, int32_t n)
{
    if (n < 32) {
        iris_row_above_u8_c(mask, src, limit, n);
        return;
    }
    const uint8x16_t limits = vdupq_n_u8(limit);
    int32_t words = n / 32, rest = n % 32;
    for (int32_t word = 0; word < words; word++) {
        mask[word] = above_32(src + 32 * word, limits);
    }
    if (rest > 0) {
        iris_row_put_bits(&mask[words], above_32(src + n - 32, limits) >> (32 - rest), rest);
    }
}
