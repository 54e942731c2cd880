/* The largest and the smallest around, sixteen samples at a time; joined masks, four words at a time. */
#include "vector.h"

static inline __m128i max3_at(const uint8_t *a, const uint8_t *b, const uint8_t *c, int32_t i)
{
    return _mm_max_epu8(_mm_max_epu8(load16(a + i), load16(b + i)), load16(c + i));
}

static inline __m128i min3_at(const uint8_t *a, const uint8_t *b, const uint8_t *c, int32_t i)
{
    return _mm_min_epu8(_mm_min_epu8(load16(a + i), load16(b + i)), load16(c + i));
}

/* Sixteen from `step` before here on, and from `step` behind; step is a constant. */
#define BEFORE(left, here, step)  _mm_alignr_epi8(here, left, 16 - (step))
#define BEHIND(here, right, step) _mm_alignr_epi8(right, here, step)

/* The largest of three columns around. */
static inline __m128i max9_at(const uint8_t *const rows[3], int32_t step, int32_t i)
{
    __m128i left = max3_at(rows[0], rows[1], rows[2], i - step), here = max3_at(rows[0], rows[1], rows[2], i);
    return _mm_max_epu8(_mm_max_epu8(left, here), max3_at(rows[0], rows[1], rows[2], i + step));
}

/* The same of sixteen and sixteen more from pixel 16 on, as long as the next sixteen can be looked at. */
#define MAX9_INNER(step)                                                                                     \
    for (int32_t i = 16; i < n - 31; i += 16) {                                                              \
        __m128i right = max3_at(a, b, c, i + 16);                                                            \
        __m128i beside = _mm_max_epu8(BEFORE(left, here, step), BEHIND(here, right, step));                  \
        store16(dst + i, _mm_max_epu8(here, beside));                                                        \
        left = here;                                                                                         \
        here = right;                                                                                        \
    }

void iris_row_max9_u8_sse(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n)
{
    if (n < 32) {
        iris_row_max9_u8_c(dst, rows, step, n);
        return;
    }
    const uint8_t *a = rows[0], *b = rows[1], *c = rows[2];
    __m128i left = max3_at(a, b, c, 0), here = max3_at(a, b, c, 16);
    store16(dst, max9_at(rows, step, 0));
    if (step == 1) {
        MAX9_INNER(1)
    } else {
        MAX9_INNER(3)
    }
    if (n > 32) {
        store16(dst + n - 32, max9_at(rows, step, n - 32));
    }
    store16(dst + n - 16, max9_at(rows, step, n - 16));
}

/* The smallest of three columns around. */
static inline __m128i min9_at(const uint8_t *const rows[3], int32_t step, int32_t i)
{
    __m128i left = min3_at(rows[0], rows[1], rows[2], i - step), here = min3_at(rows[0], rows[1], rows[2], i);
    return _mm_min_epu8(_mm_min_epu8(left, here), min3_at(rows[0], rows[1], rows[2], i + step));
}

/* The same of sixteen and sixteen more from pixel 16 on, as long as the next sixteen can be looked at. */
#define MIN9_INNER(step)                                                                                     \
    for (int32_t i = 16; i < n - 31; i += 16) {                                                              \
        __m128i right = min3_at(a, b, c, i + 16);                                                            \
        __m128i beside = _mm_min_epu8(BEFORE(left, here, step), BEHIND(here, right, step));                  \
        store16(dst + i, _mm_min_epu8(here, beside));                                                        \
        left = here;                                                                                         \
        here = right;                                                                                        \
    }

void iris_row_min9_u8_sse(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n)
{
    if (n < 32) {
        iris_row_min9_u8_c(dst, rows, step, n);
        return;
    }
    const uint8_t *a = rows[0], *b = rows[1], *c = rows[2];
    __m128i left = min3_at(a, b, c, 0), here = min3_at(a, b, c, 16);
    store16(dst, min9_at(rows, step, 0));
    if (step == 1) {
        MIN9_INNER(1)
    } else {
        MIN9_INNER(3)
    }
    if (n > 32) {
        store16(dst + n - 32, min9_at(rows, step, n - 32));
    }
    store16(dst + n - 16, min9_at(rows, step, n - 16));
}

/* `all` is a constant in the following functions, so that each is compiled for both. */
static inline __m128i join3(__m128i a, __m128i b, __m128i c, uint32_t all)
{
    return all ? _mm_and_si128(_mm_and_si128(a, b), c) : _mm_or_si128(_mm_or_si128(a, b), c);
}

static inline __m128i joined_at(const uint32_t *const rows[3], uint32_t all, int32_t i)
{
    return join3(load16(rows[0] + i), load16(rows[1] + i), load16(rows[2] + i), all);
}

/* Each pixel with its neighbors; left and right: the words before and behind. */
static inline __m128i join_beside(__m128i left, __m128i here, __m128i right, uint32_t all)
{
    left = _mm_or_si128(_mm_srli_epi32(left, 31), _mm_slli_epi32(here, 1));
    right = _mm_or_si128(_mm_srli_epi32(here, 1), _mm_slli_epi32(right, 31));
    return join3(left, here, right, all);
}

static inline void join9(uint32_t *dst, const uint32_t *const rows[3], const uint32_t beside[2], uint32_t all,
                         int32_t words)
{
    const uint32_t *const from[3] = {rows[0], rows[1], rows[2]};
    __m128i before = _mm_set1_epi32((int)beside[0]), here = joined_at(from, all, 0);
    int32_t i = 0;
    for (; i < words - 7; i += 4) {
        __m128i next = joined_at(from, all, i + 4);
        store16(dst + i,
                join_beside(_mm_alignr_epi8(here, before, 12), here, _mm_alignr_epi8(next, here, 4), all));
        before = here;
        here = next;
    }
    __m128i left = _mm_alignr_epi8(here, before, 12);
    if (i < words - 4) {
        store16(dst + i, join_beside(left, here, joined_at(from, all, i + 1), all));
        left = joined_at(from, all, words - 5);
        here = joined_at(from, all, words - 4);
    }
    store16(dst + words - 4,
            join_beside(left, here, _mm_alignr_epi8(_mm_set1_epi32((int)beside[1]), here, 4), all));
}

void iris_row_join9_mask_sse(uint32_t *dst, const uint32_t *const rows[3], const uint32_t beside[2],
                             uint32_t all, int32_t words)
{
    if (words < 4) {
        iris_row_join9_mask_c(dst, rows, beside, all, words);
    } else if (all) {
        join9(dst, rows, beside, ~0u, words);
    } else {
        join9(dst, rows, beside, 0, words);
    }
}
