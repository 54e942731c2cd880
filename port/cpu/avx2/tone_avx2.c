/* Tables of levels that are a straight line, computed 32 levels at a time. */
#include "kernel_tone.h"

#include <immintrin.h>

#include "kernel.h"

static inline __m256i load32(const void *from)
{
    return _mm256_loadu_si256((const __m256i *)from);
}

static inline void store32(void *to, __m256i vector)
{
    _mm256_storeu_si256((__m256i *)to, vector);
}

/* high: 256 times a. */
static inline __m256i line_16(__m256i high, const tone_line *line)
{
    __m256i sum = _mm256_mulhi_epu16(high, _mm256_set1_epi16((int16_t)line->part));
    if (!line->keeps) {
        __m256i a = _mm256_srli_epi16(high, 8);
        sum = _mm256_add_epi16(sum, _mm256_mullo_epi16(a, _mm256_set1_epi16((int16_t)line->whole)));
    }
    return _mm256_srli_epi16(_mm256_add_epi16(sum, _mm256_set1_epi16((int16_t)line->add)),
                             line->keeps ? 9 : 8);
}

/* One of two loops: a line that keeps has no whole part, and what is beyond its range is beyond white by itself. */
static inline __attribute__((always_inline)) void apply(uint8_t *dst, const uint8_t *src,
                                                        const tone_line *line, int32_t n)
{
    const __m256i zero = _mm256_setzero_si256();
    const __m256i low = _mm256_set1_epi8((char)line->low), range = _mm256_set1_epi8((char)line->range);
    for (int32_t i = 0; i < n; i += 32) {
        __m256i a = _mm256_subs_epu8(load32(src + i), low);
        a = line->keeps ? a : _mm256_min_epu8(a, range);
        __m256i first = line_16(_mm256_unpacklo_epi8(zero, a), line);
        __m256i second = line_16(_mm256_unpackhi_epi8(zero, a), line);
        __m256i sum = _mm256_packus_epi16(first, second);
        store32(dst + i, line->keeps ? _mm256_adds_epu8(sum, a) : sum);
    }
}

static void apply_line(uint8_t *dst, const uint8_t *src, const tone_line *line, int32_t n)
{
    if (line->keeps) {
        const tone_line kept = {line->low, line->range, 0, line->part, line->add, 9, 1};
        apply(dst, src, &kept, n);
    } else {
        const tone_line steep = {line->low, line->range, line->whole, line->part, line->add, 8, 0};
        apply(dst, src, &steep, n);
    }
}

void iris_row_tone_u8_avx2(uint8_t *dst, const uint8_t *src, const uint8_t level[256], int32_t n)
{
    tone_line line;
    int32_t done = 0;
    if (n >= TONE_LONG && tone_line_of(&line, level)) {
        done = n / 32 * 32;
        apply_line(dst, src, &line, done);
    }
    iris_row_tone_u8_c(dst + done, src + done, level, n - done);
}
