/* Tables of levels that are a straight line, computed sixteen levels at a time. */
#include "kernel_tone.h"

#include "vector.h"

static inline __m128i line_8(__m128i a, const tone_line *line)
{
    __m128i sum = _mm_mulhi_epu16(_mm_slli_epi16(a, 8), _mm_set1_epi16((int16_t)line->part));
    sum = _mm_add_epi16(sum, _mm_mullo_epi16(a, _mm_set1_epi16((int16_t)line->whole)));
    return _mm_srl_epi16(_mm_add_epi16(sum, _mm_set1_epi16((int16_t)line->add)),
                         _mm_cvtsi32_si128(line->shift));
}

static void apply_line(uint8_t *dst, const uint8_t *src, const tone_line *line, int32_t n)
{
    const __m128i zero = _mm_setzero_si128(), kept = line->keeps ? _mm_set1_epi8(-1) : zero;
    const __m128i low = _mm_set1_epi8((char)line->low), range = _mm_set1_epi8((char)line->range);
    for (int32_t i = 0; i < n; i += 16) {
        __m128i a = _mm_min_epu8(_mm_subs_epu8(load16(src + i), low), range);
        __m128i first = line_8(_mm_unpacklo_epi8(a, zero), line);
        __m128i second = line_8(_mm_unpackhi_epi8(a, zero), line);
        store16(dst + i, _mm_add_epi8(_mm_packus_epi16(first, second), _mm_and_si128(a, kept)));
    }
}

void iris_row_tone_u8_sse(uint8_t *dst, const uint8_t *src, const uint8_t level[256], int32_t n)
{
    tone_line line;
    int32_t done = 0;
    if (n >= TONE_LONG && tone_line_of(&line, level)) {
        done = n / 16 * 16;
        apply_line(dst, src, &line, done);
    }
    iris_row_tone_u8_c(dst + done, src + done, level, n - done);
}
