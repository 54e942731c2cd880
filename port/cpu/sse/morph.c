/* The largest, the smallest, and differences, sixteen samples at a time; joined masks, four words at a time. The last
 * vector is looked at first: where a row is changed in place, it cannot be looked at again. */
#include "vector.h"

static inline __m128i max3_at(const uint8_t *a, const uint8_t *b, const uint8_t *c, int32_t i)
{
    return _mm_max_epu8(_mm_max_epu8(load16(a + i), load16(b + i)), load16(c + i));
}

static inline __m128i min3_at(const uint8_t *a, const uint8_t *b, const uint8_t *c, int32_t i)
{
    return _mm_min_epu8(_mm_min_epu8(load16(a + i), load16(b + i)), load16(c + i));
}

void iris_row_max3_u8_sse(uint8_t *dst, const uint8_t *a, const uint8_t *b, const uint8_t *c, int32_t n)
{
    if (n < 16) {
        iris_row_max3_u8_c(dst, a, b, c, n);
        return;
    }
    __m128i last = max3_at(a, b, c, n - 16);
    for (int32_t i = 0; i < n - 16; i += 16) {
        store16(dst + i, max3_at(a, b, c, i));
    }
    store16(dst + n - 16, last);
}

void iris_row_min3_u8_sse(uint8_t *dst, const uint8_t *a, const uint8_t *b, const uint8_t *c, int32_t n)
{
    if (n < 16) {
        iris_row_min3_u8_c(dst, a, b, c, n);
        return;
    }
    __m128i last = min3_at(a, b, c, n - 16);
    for (int32_t i = 0; i < n - 16; i += 16) {
        store16(dst + i, min3_at(a, b, c, i));
    }
    store16(dst + n - 16, last);
}

void iris_row_minus_u8_sse(uint8_t *dst, const uint8_t *a, const uint8_t *b, int32_t n)
{
    if (n < 16) {
        iris_row_minus_u8_c(dst, a, b, n);
        return;
    }
    __m128i last = _mm_subs_epu8(load16(a + n - 16), load16(b + n - 16));
    for (int32_t i = 0; i < n - 16; i += 16) {
        store16(dst + i, _mm_subs_epu8(load16(a + i), load16(b + i)));
    }
    store16(dst + n - 16, last);
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

/* Four words of pixels from pixel `shift` of the first on. */
static inline __m128i pixels_of(const uint32_t *words, __m128i shift)
{
    __m128i rest = _mm_sub_epi64(_mm_cvtsi32_si128(32), shift);
    return _mm_or_si128(_mm_srl_epi32(load16(words), shift), _mm_sll_epi32(load16(words + 1), rest));
}

/* `all` is a constant in the following functions, so that each is compiled for both. */
static inline __m128i join3(__m128i a, __m128i b, __m128i c, uint32_t all)
{
    return all ? _mm_and_si128(_mm_and_si128(a, b), c) : _mm_or_si128(_mm_or_si128(a, b), c);
}

/* Four words of pixels at three places, joined. */
typedef struct {
    const uint32_t *a, *b, *c;
    __m128i shift_a, shift_b, shift_c;
} places;

static inline __m128i joined3_at(const places *p, uint32_t all, int32_t i)
{
    return join3(pixels_of(p->a + i, p->shift_a), pixels_of(p->b + i, p->shift_b),
                 pixels_of(p->c + i, p->shift_c), all);
}

static inline void join_places(uint32_t *dst, const places *p, uint32_t all, int32_t words)
{
    __m128i last = joined3_at(p, all, words - 4);
    for (int32_t i = 0; i < words - 4; i += 4) {
        store16(dst + i, joined3_at(p, all, i));
    }
    store16(dst + words - 4, last);
}

void iris_row_join3_mask_sse(uint32_t *dst, const uint32_t *src, const int32_t at[3], uint32_t all,
                             int32_t words)
{
    const places p = {src + (at[0] >> 5),
                      src + (at[1] >> 5),
                      src + (at[2] >> 5),
                      _mm_cvtsi32_si128(at[0] & 31),
                      _mm_cvtsi32_si128(at[1] & 31),
                      _mm_cvtsi32_si128(at[2] & 31)};
    if (words < 4) {
        iris_row_join3_mask_c(dst, src, at, all, words);
    } else if (all) {
        join_places(dst, &p, ~0u, words);
    } else {
        join_places(dst, &p, 0, words);
    }
}

static inline __m128i joined_at(const uint32_t *const rows[3], uint32_t all, int32_t i)
{
    return join3(load16(rows[0] + i), load16(rows[1] + i), load16(rows[2] + i), all);
}

static inline void join_rows(uint32_t *dst, const uint32_t *const rows[3], uint32_t all, int32_t words)
{
    __m128i last = joined_at(rows, all, words - 4);
    for (int32_t i = 0; i < words - 4; i += 4) {
        store16(dst + i, joined_at(rows, all, i));
    }
    store16(dst + words - 4, last);
}

void iris_row_join_rows_mask_sse(uint32_t *dst, const uint32_t *a, const uint32_t *b, const uint32_t *c,
                                 uint32_t all, int32_t words)
{
    const uint32_t *const rows[3] = {a, b, c};
    if (words < 4) {
        iris_row_join_rows_mask_c(dst, a, b, c, all, words);
    } else if (all) {
        join_rows(dst, rows, ~0u, words);
    } else {
        join_rows(dst, rows, 0, words);
    }
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

void iris_row_agree_mask_sse(uint32_t *dst, const uint32_t *src, int32_t at, uint32_t turn, int32_t words)
{
    const uint32_t *from = src + (at >> 5);
    __m128i turned = _mm_set1_epi32((int)turn);
    __m128i shift = _mm_cvtsi32_si128(at & 31);
    int32_t i = 0;
    for (; i < words - 3; i += 4) {
        store16(dst + i, _mm_and_si128(load16(dst + i), _mm_xor_si128(pixels_of(from + i, shift), turned)));
    }
    iris_row_agree_mask_c(dst + i, src + i, at, turn, words - i);
}
