/* The largest and the smallest around, sixteen samples at a time; joined masks, four words at a time. */
#include "bits.h"

/* is_max and step are constants in the following functions, so that each is compiled for all of them. */
INLINE uint8x16_t of_two(uint8x16_t a, uint8x16_t b, int is_max)
{
    return is_max ? vmaxq_u8(a, b) : vminq_u8(a, b);
}

/* Of three rows. */
INLINE uint8x16_t of_column(const uint8_t *a, const uint8_t *b, const uint8_t *c, int is_max)
{
    return of_two(of_two(vld1q_u8(a), vld1q_u8(b), is_max), vld1q_u8(c), is_max);
}

typedef struct {
    const uint8_t *a, *b, *c;
} columns;

INLINE uint8x16_t next_columns(columns *at, int is_max)
{
    uint8x16_t next = of_column(at->a, at->b, at->c, is_max);
    at->a += 16;
    at->b += 16;
    at->c += 16;
    HERE(at->a);
    HERE(at->b);
    HERE(at->c);
    return next;
}

/* Of three columns around, from `step` before the first pixel on. */
#define OF_BESIDE(left, right, step, is_max)                                                                 \
    of_two(of_two(left, vextq_u8(left, right, step), is_max), vextq_u8(left, right, 2 * (step)), is_max)

INLINE uint8x16_t of_9(const uint8_t *const rows[3], int32_t step, int is_max, int32_t i)
{
    const uint8_t *a = rows[0] + i, *b = rows[1] + i, *c = rows[2] + i;
    uint8x16_t beside = of_two(of_column(a - step, b - step, c - step, is_max),
                               of_column(a + step, b + step, c + step, is_max), is_max);
    return of_two(of_column(a, b, c, is_max), beside, is_max);
}

/* Each column is looked at once, but for the last vectors; those overlap what is done. */
#define ROW_OF_9(step, is_max)                                                                               \
    do {                                                                                                     \
        columns at = {rows[0] - (step), rows[1] - (step), rows[2] - (step)};                                 \
        uint8x16_t left = next_columns(&at, is_max);                                                         \
        uint8_t *to = dst;                                                                                   \
        int32_t i = 0;                                                                                       \
        for (; i <= n - 48; i += 32) {                                                                       \
            uint8x16_t right = next_columns(&at, is_max);                                                    \
            vst1q_u8(to, OF_BESIDE(left, right, step, is_max));                                              \
            to += 16;                                                                                        \
            HERE(to);                                                                                        \
            left = next_columns(&at, is_max);                                                                \
            vst1q_u8(to, OF_BESIDE(right, left, step, is_max));                                              \
            to += 16;                                                                                        \
            HERE(to);                                                                                        \
        }                                                                                                    \
        for (; i < n; i += 16) {                                                                             \
            int32_t from = i < n - 16 ? i : n - 16;                                                          \
            vst1q_u8(dst + from, of_9(rows, step, is_max, from));                                            \
        }                                                                                                    \
    } while (0)

void iris_row_max9_u8_neon(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n)
{
    if (n < 16) {
        iris_row_max9_u8_c(dst, rows, step, n);
    } else if (step == 1) {
        ROW_OF_9(1, 1);
    } else {
        ROW_OF_9(3, 1);
    }
}

void iris_row_min9_u8_neon(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n)
{
    if (n < 16) {
        iris_row_min9_u8_c(dst, rows, step, n);
    } else if (step == 1) {
        ROW_OF_9(1, 0);
    } else {
        ROW_OF_9(3, 0);
    }
}

/* Four words of pixels from pixel `shift` of the first on. */
static inline uint32x4_t pixels_of(const uint32_t *words, int32_t shift)
{
    return vorrq_u32(vshlq_u32(vld1q_u32(words), vdupq_n_s32(-shift)),
                     vshlq_u32(vld1q_u32(words + 1), vdupq_n_s32(32 - shift)));
}

/* `all` is a constant in the following functions, so that each is compiled for both. */
static inline uint32x4_t join3(uint32x4_t a, uint32x4_t b, uint32x4_t c, uint32_t all)
{
    return all ? vandq_u32(vandq_u32(a, b), c) : vorrq_u32(vorrq_u32(a, b), c);
}

/* Four words of pixels at three places, joined. */
typedef struct {
    const uint32_t *a, *b, *c;
    int32_t shift_a, shift_b, shift_c;
} places;

static inline uint32x4_t joined3_at(const places *p, uint32_t all, int32_t i)
{
    return join3(pixels_of(p->a + i, p->shift_a), pixels_of(p->b + i, p->shift_b),
                 pixels_of(p->c + i, p->shift_c), all);
}

static inline void join_places(uint32_t *dst, const places *p, uint32_t all, int32_t words)
{
    uint32x4_t last = joined3_at(p, all, words - 4);
    for (int32_t i = 0; i < words - 4; i += 4) {
        vst1q_u32(dst + i, joined3_at(p, all, i));
    }
    vst1q_u32(dst + words - 4, last);
}

void iris_row_join3_mask_neon(uint32_t *dst, const uint32_t *src, const int32_t at[3], uint32_t all,
                              int32_t words)
{
    const places p = {src + (at[0] >> 5), src + (at[1] >> 5), src + (at[2] >> 5),
                      at[0] & 31,         at[1] & 31,         at[2] & 31};
    if (words < 4) {
        iris_row_join3_mask_c(dst, src, at, all, words);
    } else if (all) {
        join_places(dst, &p, ~0u, words);
    } else {
        join_places(dst, &p, 0, words);
    }
}

static inline uint32x4_t joined_at(const uint32_t *const rows[3], uint32_t all, int32_t i)
{
    return join3(vld1q_u32(rows[0] + i), vld1q_u32(rows[1] + i), vld1q_u32(rows[2] + i), all);
}

/* Each pixel with its neighbors; left and right: the words before and behind. */
static inline uint32x4_t join_beside(uint32x4_t left, uint32x4_t here, uint32x4_t right, uint32_t all)
{
    left = vorrq_u32(vshrq_n_u32(left, 31), vshlq_n_u32(here, 1));
    right = vorrq_u32(vshrq_n_u32(here, 1), vshlq_n_u32(right, 31));
    return join3(left, here, right, all);
}

static inline void join9(uint32_t *dst, const uint32_t *const rows[3], const uint32_t beside[2], uint32_t all,
                         int32_t words)
{
    const uint32_t *const from[3] = {rows[0], rows[1], rows[2]};
    uint32x4_t before = vdupq_n_u32(beside[0]), here = joined_at(from, all, 0);
    int32_t i = 0;
    for (; i < words - 7; i += 4) {
        uint32x4_t next = joined_at(from, all, i + 4);
        vst1q_u32(dst + i, join_beside(vextq_u32(before, here, 3), here, vextq_u32(here, next, 1), all));
        before = here;
        here = next;
    }
    uint32x4_t left = vextq_u32(before, here, 3);
    if (i < words - 4) {
        vst1q_u32(dst + i, join_beside(left, here, joined_at(from, all, i + 1), all));
        left = joined_at(from, all, words - 5);
        here = joined_at(from, all, words - 4);
    }
    vst1q_u32(dst + words - 4, join_beside(left, here, vextq_u32(here, vdupq_n_u32(beside[1]), 1), all));
}

void iris_row_join9_mask_neon(uint32_t *dst, const uint32_t *const rows[3], const uint32_t beside[2],
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
