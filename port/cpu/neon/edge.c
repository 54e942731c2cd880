/* Edges: gradients, their sizes against limits, and where they are greatest. */
#include "bits.h"

/* Sixteen numbers. */
typedef struct {
    int16x8_t low, high;
} halves;

INLINE halves minus(uint8x16_t a, uint8x16_t b)
{
    return (halves){vreinterpretq_s16_u16(vsubl_u8(vget_low_u8(a), vget_low_u8(b))),
                    vreinterpretq_s16_u16(vsubl_u8(vget_high_u8(a), vget_high_u8(b)))};
}

/* The sum of three differences, and of the middle one what `more` (times 256) says, or all of it. */
INLINE int16x8_t weigh(int16x8_t one, int16x8_t middle, int16x8_t other, int16x8_t more, int is_sobel)
{
    int16x8_t extra = is_sobel ? middle : vqrdmulhq_s16(middle, more);
    return vaddq_s16(vaddq_s16(one, other), vaddq_s16(middle, extra));
}

INLINE halves weigh_all(halves one, halves middle, halves other, int16x8_t more, int is_sobel)
{
    return (halves){weigh(one.low, middle.low, other.low, more, is_sobel),
                    weigh(one.high, middle.high, other.high, more, is_sobel)};
}

INLINE void store(int16_t *to, halves values)
{
    vst1q_s16(to, values.low);
    vst1q_s16(to + 8, values.high);
}

INLINE int16x8_t size_of(int16x8_t dx, int16x8_t dy)
{
    return vaddq_s16(vabsq_s16(dx), vabsq_s16(dy));
}

/* Sixteen pixels from i on. */
INLINE void gradient_16(const iris_row_gradient *to, const uint8_t *const rows[3], int16x8_t more,
                        int is_sobel, int32_t i)
{
    const uint8_t *above = rows[0] + i, *here = rows[1] + i, *below = rows[2] + i;
    uint8x16_t above_left = vld1q_u8(above - 1), above_right = vld1q_u8(above + 1);
    uint8x16_t below_left = vld1q_u8(below - 1), below_right = vld1q_u8(below + 1);
    halves dx = weigh_all(minus(above_right, above_left), minus(vld1q_u8(here + 1), vld1q_u8(here - 1)),
                          minus(below_right, below_left), more, is_sobel);
    store(to->dx + i, dx);
    halves dy = weigh_all(minus(below_left, above_left), minus(vld1q_u8(below), vld1q_u8(above)),
                          minus(below_right, above_right), more, is_sobel);
    store(to->dy + i, dy);
    store(to->size + i, (halves){size_of(dx.low, dy.low), size_of(dx.high, dy.high)});
}

/* The last sixteen pixels may be some that were done before. */
INLINE void gradient(const iris_row_gradient *to, const uint8_t *const rows[3], int16x8_t more, int is_sobel,
                     int32_t n)
{
    const iris_row_gradient out = *to;
    const uint8_t *const from[3] = {rows[0], rows[1], rows[2]};
    for (int32_t i = 0; i < n - 16; i += 16) {
        gradient_16(&out, from, more, is_sobel, i);
    }
    gradient_16(&out, from, more, is_sobel, n - 16);
}

void iris_row_gradient_u8_neon(const iris_row_gradient *to, const uint8_t *const rows[3], int32_t more,
                               int32_t n)
{
    if (n < 16) {
        iris_row_gradient_u8_c(to, rows, more, n);
    } else if (more == 128) {
        gradient(to, rows, vdupq_n_s16(0), 1, n);
    } else {
        gradient(to, rows, vdupq_n_s16((int16_t)(more * 256)), 0, n);
    }
}

typedef struct {
    uint16x8_t white, whole;
    uint16x4_t part;
} gains;

/* Eight sizes times the gain, rounded, at most 255. */
static inline uint8x8_t gain_8(const int16_t *size, const gains *by)
{
    uint16x8_t sizes = vminq_u16(vreinterpretq_u16_s16(vabsq_s16(vld1q_s16(size))), by->white);
    uint16x4_t low = vrshrn_n_u32(vmull_u16(vget_low_u16(sizes), by->part), 16);
    uint16x4_t high = vrshrn_n_u32(vmull_u16(vget_high_u16(sizes), by->part), 16);
    return vqmovn_u16(vmlaq_u16(vcombine_u16(low, high), sizes, by->whole));
}

/* The last eight pixels may be some that were done before. */
void iris_row_gain_s16_neon(uint8_t *dst, const int16_t *size, uint32_t gain_q16, int32_t n)
{
    if (n < 8) {
        iris_row_gain_s16_c(dst, size, gain_q16, n);
        return;
    }
    const uint32_t white = gain_q16 <= 512 ? 32767 : (256u << 16) / gain_q16 + 1;
    const gains by = {vdupq_n_u16((uint16_t)white), vdupq_n_u16((uint16_t)(gain_q16 >> 16)),
                      vdup_n_u16((uint16_t)gain_q16)};
    for (int32_t i = 0; i < n; i += 8) {
        int32_t at = i + 8 <= n ? i : n - 8;
        vst1_u8(dst + at, gain_8(size + at, &by));
    }
}

static inline uint8x16_t above_16(const int16_t *src, int16x8_t limit)
{
    return vcombine_u8(vmovn_u16(vcgtq_s16(vld1q_s16(src), limit)),
                       vmovn_u16(vcgtq_s16(vld1q_s16(src + 8), limit)));
}

static inline uint32_t above_32(const int16_t *src, int16x8_t limit)
{
    return word_of_32(above_16(src, limit), above_16(src + 16, limit));
}

/* The last word comes from the last 32 pixels of the row, some of which may be in the word before it. */
void iris_row_above_s16_neon(uint32_t *mask, const int16_t *src, int32_t limit, int32_t n)
{
    if (n < 32) {
        iris_row_above_s16_c(mask, src, limit, n);
        return;
    }
    const int16x8_t limits = vdupq_n_s16((int16_t)limit);
    for (int32_t start = 0; start < n; start += 32) {
        int32_t count = n - start < 32 ? n - start : 32;
        iris_row_put_bits(&mask[start / 32], above_32(src + start + count - 32, limits) >> (-count & 31),
                          count);
    }
}

/* All ones where one value is above 0 and the other below. */
static inline uint16x8_t opposite(int16x8_t a, int16x8_t b)
{
    uint16x8_t differ = vcltq_s16(veorq_s16(a, b), vdupq_n_s16(0));
    return vandq_u16(differ, vandq_u16(vtstq_s16(a, a), vtstq_s16(b, b)));
}

/* All ones where two sizes add up to more than the threshold. */
static inline uint16x8_t exceeds(int16x8_t a, int16x8_t b, uint16x8_t threshold)
{
    return vcgtq_u16(vreinterpretq_u16_s16(vaddq_s16(a, b)), threshold);
}

/* All ones where here is the pixel of a crossing from before to after. */
static inline uint16x8_t crossing_8(int16x8_t before, int16x8_t here, int16x8_t after, uint16x8_t threshold)
{
    int16x8_t size = vabsq_s16(here), size_before = vabsq_s16(before), size_after = vabsq_s16(after);
    uint16x8_t from = vandq_u16(vandq_u16(opposite(before, here), vcgtq_s16(size_before, size)),
                                exceeds(size_before, size, threshold));
    uint16x8_t to = vandq_u16(vandq_u16(opposite(here, after), vcleq_s16(size, size_after)),
                              exceeds(size, size_after, threshold));
    uint16x8_t at_zero = vbicq_u16(opposite(before, after), vtstq_s16(here, here));
    return vorrq_u16(vorrq_u16(from, to), vandq_u16(at_zero, exceeds(size_before, size_after, threshold)));
}

static inline uint8x8_t crossings_8(const int16_t *const rows[3], int32_t i, uint16x8_t threshold)
{
    int16x8_t here = vld1q_s16(rows[1] + i);
    uint16x8_t level = crossing_8(vld1q_s16(rows[1] + i - 1), here, vld1q_s16(rows[1] + i + 1), threshold);
    uint16x8_t upright = crossing_8(vld1q_s16(rows[0] + i), here, vld1q_s16(rows[2] + i), threshold);
    return vmovn_u16(vorrq_u16(level, upright));
}

static inline uint8x16_t crossings_16(const int16_t *const rows[3], int32_t i, uint16x8_t threshold)
{
    return vcombine_u8(crossings_8(rows, i, threshold), crossings_8(rows, i + 8, threshold));
}

/* The last word comes from the last 32 pixels of the row, some of which may be in the word before it. */
void iris_row_crossings_s16_neon(uint32_t *mask, const int16_t *const rows[3], int32_t threshold, int32_t n)
{
    if (n < 32) {
        iris_row_crossings_s16_c(mask, rows, threshold, n);
        return;
    }
    const uint16x8_t least = vdupq_n_u16((uint16_t)threshold);
    for (int32_t start = 0; start < n; start += 32) {
        int32_t count = n - start < 32 ? n - start : 32, from = start + count - 32;
        uint32_t bits = word_of_32(crossings_16(rows, from, least), crossings_16(rows, from + 16, least));
        iris_row_put_bits(&mask[start / 32], bits >> (-count & 31), count);
    }
}

/* Eight pixels from i on: all ones where the size is greatest across the edge. */
static inline uint16x8_t ridge_8(const iris_row_ridges *rows, int32_t i)
{
    const int16_t *above = rows->size[0] + i, *here = rows->size[1] + i, *below = rows->size[2] + i;
    int16x8_t dx = vld1q_s16(rows->dx + i), dy = vld1q_s16(rows->dy + i), size = vld1q_s16(here);
    int16x8_t across = vabsq_s16(dx), down = vabsq_s16(dy);
    int16x8_t t = vqdmulhq_s16(across, vdupq_n_s16(13573));
    uint16x8_t is_steep = vcgtq_s16(down, t);
    uint16x8_t is_upright = vcgtq_s16(down, vaddq_s16(vaddq_s16(across, across), t));
    uint16x8_t leans_left = vcltq_s16(veorq_s16(dx, dy), vdupq_n_s16(0));
    uint16x8_t is_diagonal = vbicq_u16(is_steep, is_upright);
    int16x8_t before = vbslq_s16(leans_left, vld1q_s16(above + 1), vld1q_s16(above - 1));
    int16x8_t after = vbslq_s16(leans_left, vld1q_s16(below - 1), vld1q_s16(below + 1));
    before = vbslq_s16(is_steep, before, vld1q_s16(here - 1));
    after = vbslq_s16(is_steep, after, vld1q_s16(here + 1));
    before = vbslq_s16(is_upright, vld1q_s16(above), before);
    after = vbslq_s16(is_upright, vld1q_s16(below), after);
    uint16x8_t is_level = vbicq_u16(vceqq_s16(size, after), is_diagonal);
    return vandq_u16(vcgtq_s16(size, before), vorrq_u16(vcgtq_s16(size, after), is_level));
}

static inline uint8x16_t ridges_16(const iris_row_ridges *rows, int32_t i)
{
    return vcombine_u8(vmovn_u16(ridge_8(rows, i)), vmovn_u16(ridge_8(rows, i + 8)));
}

/* The last word comes from the last 32 pixels of the row, some of which may be in the word before it. */
void iris_row_ridges_s16_neon(uint32_t *weak, uint32_t *strong, const iris_row_ridges *rows, int32_t n)
{
    if (n < 32) {
        iris_row_ridges_s16_c(weak, strong, rows, n);
        return;
    }
    const int16x8_t low = vdupq_n_s16((int16_t)rows->low), high = vdupq_n_s16((int16_t)rows->high);
    for (int32_t start = 0; start < n; start += 32) {
        int32_t count = n - start < 32 ? n - start : 32, from = start + count - 32;
        const int16_t *size = rows->size[1] + from;
        uint32_t weak_bits = above_32(size, low), strong_bits = 0;
        if (weak_bits != 0) {
            weak_bits &= word_of_32(ridges_16(rows, from), ridges_16(rows, from + 16));
            strong_bits = weak_bits & above_32(size, high);
        }
        iris_row_put_bits(&weak[start / 32], weak_bits >> (-count & 31), count);
        iris_row_put_bits(&strong[start / 32], strong_bits >> (-count & 31), count);
    }
}

static inline uint8x16_t unlike_16(const uint8_t *const rows[3], int32_t i, uint8x16_t limit)
{
    uint8x16_t across = vabdq_u8(vld1q_u8(rows[1] + i - 1), vld1q_u8(rows[1] + i + 1));
    uint8x16_t down = vabdq_u8(vld1q_u8(rows[0] + i), vld1q_u8(rows[2] + i));
    return vcgtq_u8(vmaxq_u8(across, down), limit);
}

/* The last word comes from the last 32 pixels of the row, some of which may be in the word before it. */
void iris_row_unlike_u8_neon(uint32_t *mask, const uint8_t *const rows[3], uint8_t limit, int32_t n)
{
    if (n < 32) {
        iris_row_unlike_u8_c(mask, rows, limit, n);
        return;
    }
    const uint8x16_t limits = vdupq_n_u8(limit);
    for (int32_t start = 0; start < n; start += 32) {
        int32_t count = n - start < 32 ? n - start : 32, from = start + count - 32;
        uint32_t bits = word_of_32(unlike_16(rows, from, limits), unlike_16(rows, from + 16, limits));
        iris_row_put_bits(&mask[start / 32], bits >> (-count & 31), count);
    }
}
