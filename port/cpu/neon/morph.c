/* The largest, the smallest, and differences, sixteen samples at a time; joined masks, four words at a time. The last
 * vector is looked at first: where a row is changed in place, it cannot be looked at again. */
#include <arm_neon.h>

#include "kernel.h"

static inline uint8x16_t max3_at(const uint8_t *a, const uint8_t *b, const uint8_t *c, int32_t i)
{
    return vmaxq_u8(vmaxq_u8(vld1q_u8(a + i), vld1q_u8(b + i)), vld1q_u8(c + i));
}

static inline uint8x16_t min3_at(const uint8_t *a, const uint8_t *b, const uint8_t *c, int32_t i)
{
    return vminq_u8(vminq_u8(vld1q_u8(a + i), vld1q_u8(b + i)), vld1q_u8(c + i));
}

void iris_row_max3_u8_neon(uint8_t *dst, const uint8_t *a, const uint8_t *b, const uint8_t *c, int32_t n)
{
    if (n < 16) {
        iris_row_max3_u8_c(dst, a, b, c, n);
        return;
    }
    uint8x16_t last = max3_at(a, b, c, n - 16);
    for (int32_t i = 0; i < n - 16; i += 16) {
        vst1q_u8(dst + i, max3_at(a, b, c, i));
    }
    vst1q_u8(dst + n - 16, last);
}

void iris_row_min3_u8_neon(uint8_t *dst, const uint8_t *a, const uint8_t *b, const uint8_t *c, int32_t n)
{
    if (n < 16) {
        iris_row_min3_u8_c(dst, a, b, c, n);
        return;
    }
    uint8x16_t last = min3_at(a, b, c, n - 16);
    for (int32_t i = 0; i < n - 16; i += 16) {
        vst1q_u8(dst + i, min3_at(a, b, c, i));
    }
    vst1q_u8(dst + n - 16, last);
}

void iris_row_minus_u8_neon(uint8_t *dst, const uint8_t *a, const uint8_t *b, int32_t n)
{
    if (n < 16) {
        iris_row_minus_u8_c(dst, a, b, n);
        return;
    }
    uint8x16_t last = vqsubq_u8(vld1q_u8(a + n - 16), vld1q_u8(b + n - 16));
    for (int32_t i = 0; i < n - 16; i += 16) {
        vst1q_u8(dst + i, vqsubq_u8(vld1q_u8(a + i), vld1q_u8(b + i)));
    }
    vst1q_u8(dst + n - 16, last);
}

/* Sixteen from `step` before here on, and from `step` behind; step is a constant. */
#define BEFORE(left, here, step)  vextq_u8(left, here, 16 - (step))
#define BEHIND(here, right, step) vextq_u8(here, right, step)

/* The largest of three columns around. */
static inline uint8x16_t max9_at(const uint8_t *const rows[3], int32_t step, int32_t i)
{
    uint8x16_t left = max3_at(rows[0], rows[1], rows[2], i - step),
               here = max3_at(rows[0], rows[1], rows[2], i);
    return vmaxq_u8(vmaxq_u8(left, here), max3_at(rows[0], rows[1], rows[2], i + step));
}

/* The same of sixteen and sixteen more from pixel 16 on, as long as the next sixteen can be looked at. */
#define MAX9_INNER(step)                                                                                     \
    for (int32_t i = 16; i < n - 31; i += 16) {                                                              \
        uint8x16_t right = max3_at(a, b, c, i + 16);                                                         \
        uint8x16_t beside = vmaxq_u8(BEFORE(left, here, step), BEHIND(here, right, step));                   \
        vst1q_u8(dst + i, vmaxq_u8(here, beside));                                                           \
        left = here;                                                                                         \
        here = right;                                                                                        \
    }

void iris_row_max9_u8_neon(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n)
{
    if (n < 32) {
        iris_row_max9_u8_c(dst, rows, step, n);
        return;
    }
    const uint8_t *a = rows[0], *b = rows[1], *c = rows[2];
    uint8x16_t left = max3_at(a, b, c, 0), here = max3_at(a, b, c, 16);
    vst1q_u8(dst, max9_at(rows, step, 0));
    if (step == 1) {
        MAX9_INNER(1)
    } else {
        MAX9_INNER(3)
    }
    if (n > 32) {
        vst1q_u8(dst + n - 32, max9_at(rows, step, n - 32));
    }
    vst1q_u8(dst + n - 16, max9_at(rows, step, n - 16));
}

/* The smallest of three columns around. */
static inline uint8x16_t min9_at(const uint8_t *const rows[3], int32_t step, int32_t i)
{
    uint8x16_t left = min3_at(rows[0], rows[1], rows[2], i - step),
               here = min3_at(rows[0], rows[1], rows[2], i);
    return vminq_u8(vminq_u8(left, here), min3_at(rows[0], rows[1], rows[2], i + step));
}

/* The same of sixteen and sixteen more from pixel 16 on, as long as the next sixteen can be looked at. */
#define MIN9_INNER(step)                                                                                     \
    for (int32_t i = 16; i < n - 31; i += 16) {                                                              \
        uint8x16_t right = min3_at(a, b, c, i + 16);                                                         \
        uint8x16_t beside = vminq_u8(BEFORE(left, here, step), BEHIND(here, right, step));                   \
        vst1q_u8(dst + i, vminq_u8(here, beside));                                                           \
        left = here;                                                                                         \
        here = right;                                                                                        \
    }

void iris_row_min9_u8_neon(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n)
{
    if (n < 32) {
        iris_row_min9_u8_c(dst, rows, step, n);
        return;
    }
    const uint8_t *a = rows[0], *b = rows[1], *c = rows[2];
    uint8x16_t left = min3_at(a, b, c, 0), here = min3_at(a, b, c, 16);
    vst1q_u8(dst, min9_at(rows, step, 0));
    if (step == 1) {
        MIN9_INNER(1)
    } else {
        MIN9_INNER(3)
    }
    if (n > 32) {
        vst1q_u8(dst + n - 32, min9_at(rows, step, n - 32));
    }
    vst1q_u8(dst + n - 16, min9_at(rows, step, n - 16));
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

static inline void join_rows(uint32_t *dst, const uint32_t *const rows[3], uint32_t all, int32_t words)
{
    uint32x4_t last = joined_at(rows, all, words - 4);
    for (int32_t i = 0; i < words - 4; i += 4) {
        vst1q_u32(dst + i, joined_at(rows, all, i));
    }
    vst1q_u32(dst + words - 4, last);
}

void iris_row_join_rows_mask_neon(uint32_t *dst, const uint32_t *a, const uint32_t *b, const uint32_t *c,
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

void iris_row_agree_mask_neon(uint32_t *dst, const uint32_t *src, int32_t at, uint32_t turn, int32_t words)
{
    const uint32_t *from = src + (at >> 5);
    uint32x4_t turned = vdupq_n_u32(turn);
    int32_t shift = at & 31;
    int32_t i = 0;
    for (; i < words - 3; i += 4) {
        vst1q_u32(dst + i, vandq_u32(vld1q_u32(dst + i), veorq_u32(pixels_of(from + i, shift), turned)));
    }
    iris_row_agree_mask_c(dst + i, src + i, at, turn, words - i);
}
