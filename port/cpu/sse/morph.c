/* The largest and the smallest around, sixteen samples at a time; joined masks, four words at a time. */
#include "vector.h"

#define INLINE static inline __attribute__((always_inline))

/* `least` and `step` are constants in the following functions, so that each is compiled for all of them. */
INLINE __m128i join(__m128i a, __m128i b, int least)
{
    return least ? _mm_min_epu8(a, b) : _mm_max_epu8(a, b);
}

/* The columns of three rows. */
INLINE __m128i column_at(const uint8_t *const rows[3], int32_t i, int least)
{
    return join(join(load16(rows[0] + i), load16(rows[1] + i), least), load16(rows[2] + i), least);
}

INLINE __m128i around_at(const uint8_t *const rows[3], int32_t i, int32_t step, int least)
{
    __m128i beside = join(column_at(rows, i - step, least), column_at(rows, i + step, least), least);
    return join(beside, column_at(rows, i, least), least);
}

/* What is `step` before `right` and behind `left`, of two that follow on one another. */
INLINE __m128i before(__m128i left, __m128i right, int32_t step)
{
    return step == 1 ? _mm_alignr_epi8(right, left, 15) : _mm_alignr_epi8(right, left, 13);
}

INLINE __m128i behind(__m128i left, __m128i right, int32_t step)
{
    return step == 1 ? _mm_alignr_epi8(right, left, 1) : _mm_alignr_epi8(right, left, 3);
}

/* n >= 16. Each column is looked at once, as long as the next sixteen are there. */
INLINE void around_row(uint8_t *dst, const uint8_t *const from[3], int32_t step, int32_t n, int least)
{
    const uint8_t *const rows[3] = {from[0], from[1], from[2]};
    __m128i left = column_at(rows, -step, least), here = column_at(rows, 0, least);
    int32_t i = 0;
    for (; i < n - 31; i += 16) {
        __m128i next = column_at(rows, i + 16, least);
        store16(dst + i, join(join(left, here, least), behind(here, next, step), least));
        left = before(here, next, step);
        here = next;
    }
    if (i < n - 16) {
        store16(dst + i, join(join(left, here, least), column_at(rows, i + step, least), least));
    }
    store16(dst + n - 16, around_at(rows, n - 16, step, least));
}

void iris_row_max9_u8_sse(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n)
{
    if (n < 16) {
        iris_row_max9_u8_c(dst, rows, step, n);
    } else if (step == 1) {
        around_row(dst, rows, 1, n, 0);
    } else {
        around_row(dst, rows, 3, n, 0);
    }
}

void iris_row_min9_u8_sse(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n)
{
    if (n < 16) {
        iris_row_min9_u8_c(dst, rows, step, n);
    } else if (step == 1) {
        around_row(dst, rows, 1, n, 1);
    } else {
        around_row(dst, rows, 3, n, 1);
    }
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
