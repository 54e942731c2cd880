/* Rows of distances, eight pixels at a time. Sums end at 65535; what is zero stays so, and most pixels often are. */
#include "vector.h"

static inline int is_zero(__m128i v)
{
    return _mm_testz_si128(v, v);
}

void iris_row_select_u16_sse(uint16_t *dst, const uint32_t *mask, int32_t n)
{
    const __m128i bits = _mm_setr_epi16(1, 2, 4, 8, 16, 32, 64, 128);
    int32_t i = 0;
    for (; i < n - 31; i += 32) {
        __m128i word = _mm_cvtsi32_si128((int)mask[i / 32]);
        for (int k = 0; k < 4; k++) {
            __m128i eight = _mm_shuffle_epi8(word, _mm_set1_epi8((char)k));
            store16(dst + i + 8 * k, _mm_cmpeq_epi16(_mm_and_si128(eight, bits), bits));
        }
    }
    for (; i < n; i++) {
        dst[i] = (uint16_t)(0u - (mask[i / 32] >> i % 32 & 1));
    }
}

static void reach_straight(uint16_t *row, const uint16_t *other, uint16_t straight, int32_t n)
{
    const __m128i step = _mm_set1_epi16((short)straight);
    int32_t i = 0;
    for (; i < n - 7; i += 8) {
        __m128i here = load16(row + i);
        if (!is_zero(here)) {
            store16(row + i, _mm_min_epu16(here, _mm_adds_epu16(load16(other + i), step)));
        }
    }
    for (; i < n; i++) {
        uint32_t near = (uint32_t)other[i] + straight;
        row[i] = near < row[i] ? (uint16_t)near : row[i];
    }
}

void iris_row_reach_u16_sse(uint16_t *row, const uint16_t *other, iris_row_steps steps, int32_t n)
{
    if (steps.diagonal == 65535) {
        reach_straight(row, other, steps.straight, n);
        return;
    }
    const __m128i straight = _mm_set1_epi16((short)steps.straight);
    const __m128i diagonal = _mm_set1_epi16((short)steps.diagonal);
    __m128i left = _mm_set1_epi16(-1); /* the eight before */
    int32_t i = 0;
    for (; i < n - 8; i += 8) {
        __m128i v = load16(row + i), here = load16(other + i);
        if (!is_zero(v)) {
            __m128i beside = _mm_min_epu16(_mm_alignr_epi8(here, left, 14), load16(other + i + 1));
            __m128i near = _mm_min_epu16(_mm_adds_epu16(here, straight), _mm_adds_epu16(beside, diagonal));
            store16(row + i, _mm_min_epu16(v, near));
        }
        left = here;
    }
    for (; i < n; i++) {
        uint16_t rest[3] = {i > 0 ? other[i - 1] : 65535, other[i], i + 1 < n ? other[i + 1] : 65535};
        uint32_t beside = (rest[0] < rest[2] ? rest[0] : rest[2]) + (uint32_t)steps.diagonal;
        uint32_t near = rest[1] + (uint32_t)steps.straight;
        near = near < beside ? near : beside;
        row[i] = near < row[i] ? (uint16_t)near : row[i];
    }
}

/* The least of the eight and of those before them, with a step for each pixel between: by one, two, and four pixels. */
static inline __m128i spread_right(__m128i v, __m128i step)
{
    const __m128i far = _mm_set1_epi16(-1);
    __m128i steps2 = _mm_slli_epi16(step, 1), steps4 = _mm_slli_epi16(step, 2);
    v = _mm_min_epu16(v, _mm_adds_epu16(_mm_alignr_epi8(v, far, 14), step));
    v = _mm_min_epu16(v, _mm_adds_epu16(_mm_alignr_epi8(v, far, 12), steps2));
    return _mm_min_epu16(v, _mm_adds_epu16(_mm_alignr_epi8(v, far, 8), steps4));
}

static inline __m128i spread_left(__m128i v, __m128i step)
{
    const __m128i far = _mm_set1_epi16(-1);
    __m128i steps2 = _mm_slli_epi16(step, 1), steps4 = _mm_slli_epi16(step, 2);
    v = _mm_min_epu16(v, _mm_adds_epu16(_mm_alignr_epi8(far, v, 2), step));
    v = _mm_min_epu16(v, _mm_adds_epu16(_mm_alignr_epi8(far, v, 4), steps2));
    return _mm_min_epu16(v, _mm_adds_epu16(_mm_alignr_epi8(far, v, 8), steps4));
}

void iris_row_spread_right_u16_sse(uint16_t *row, uint16_t step, int32_t n)
{
    const __m128i each = _mm_set1_epi16((short)step), eight = _mm_slli_epi16(each, 3);
    const __m128i ramp = _mm_mullo_epi16(each, _mm_setr_epi16(1, 2, 3, 4, 5, 6, 7, 8));
    const __m128i last = _mm_set1_epi16(0x0f0e);
    __m128i before = _mm_set1_epi16(-1); /* the pixel before, eight times */
    int32_t i = 0;
    for (; i < n - 7; i += 8) {
        __m128i v = load16(row + i);
        if (is_zero(v)) {
            before = v;
            continue;
        }
        v = spread_right(v, each);
        store16(row + i, _mm_min_epu16(v, _mm_adds_epu16(before, ramp)));
        before = _mm_min_epu16(_mm_shuffle_epi8(v, last), _mm_adds_epu16(before, eight));
    }
    uint32_t left = (uint32_t)_mm_extract_epi16(before, 0);
    for (; i < n; i++) {
        left = left + step < row[i] ? left + step : row[i];
        row[i] = (uint16_t)left;
    }
}

void iris_row_spread_left_u16_sse(uint16_t *row, uint16_t step, int32_t n)
{
    const __m128i each = _mm_set1_epi16((short)step), eight = _mm_slli_epi16(each, 3);
    const __m128i ramp = _mm_mullo_epi16(each, _mm_setr_epi16(8, 7, 6, 5, 4, 3, 2, 1));
    const __m128i first = _mm_set1_epi16(0x0100);
    __m128i before = _mm_set1_epi16(-1);
    int32_t i = n;
    for (; i > 7; i -= 8) {
        __m128i v = load16(row + i - 8);
        if (is_zero(v)) {
            before = v;
            continue;
        }
        v = spread_left(v, each);
        store16(row + i - 8, _mm_min_epu16(v, _mm_adds_epu16(before, ramp)));
        before = _mm_min_epu16(_mm_shuffle_epi8(v, first), _mm_adds_epu16(before, eight));
    }
    uint32_t right = (uint32_t)_mm_extract_epi16(before, 0);
    for (; i > 0; i--) {
        right = right + step < row[i - 1] ? right + step : row[i - 1];
        row[i - 1] = (uint16_t)right;
    }
}
