/* Colors against a range of hue, saturation, and lightness, 16 pixels at a time.
 *
 * The plain body compares 60 hue / C with h0 and h1. Here the hue is one of four pieces, each a base angle (0, 120,
 * 240, or 360 degrees) and a signed rest d / C within -1 to 1 of 60 degrees: 60 d >= (h0 - base) C, where a bound
 * outside -60..60 acts as -61 or 61. All factors then fit a signed byte and all products a signed word. */
#include "bits.h"

/* A bound of the hue within each piece, in degrees from its base. */
typedef struct {
    int8x16_t red, green, blue, below_red;
} hue_bound;

typedef struct {
    hue_bound h0, h1;
    uint8x8_t s0, s1;      /* percent */
    uint16x8_t l0, l1;     /* of max + min */
    uint8x16_t chroma_min; /* of max - min */
    uint8x16_t no_gray;    /* all ones: no gray belongs to the hues; else zero */
    uint8x16_t no_wrap;    /* all ones: both bounds of the hue must hold; zero: one */
} range_vectors;

static inline int8x16_t bound_from(int32_t degrees)
{
    return vdupq_n_s8((int8_t)(degrees > 61 ? 61 : degrees < -61 ? -61 : degrees));
}

static inline hue_bound hue_bound_from(int32_t degrees)
{
    hue_bound bound = {bound_from(degrees), bound_from(degrees - 120), bound_from(degrees - 240),
                       bound_from(degrees - 360)};
    return bound;
}

static inline range_vectors vectors_from(const iris_hsl_range_test *test)
{
    range_vectors range = {.h0 = hue_bound_from(test->h0),
                           .h1 = hue_bound_from(test->h1),
                           .s0 = vdup_n_u8((uint8_t)test->s0),
                           .s1 = vdup_n_u8((uint8_t)test->s1),
                           .l0 = vdupq_n_u16((uint16_t)test->l0),
                           .l1 = vdupq_n_u16((uint16_t)test->l1),
                           .chroma_min = vdupq_n_u8((uint8_t)test->chroma_min),
                           .no_gray = vdupq_n_u8(test->hue_has_gray ? 0 : 255),
                           .no_wrap = vdupq_n_u8(test->hue_wraps ? 0 : 255)};
    return range;
}

/* chroma * (bound of each pixel's piece), the first or the last 8. */
static inline int16x8_t product_of(uint8x8_t chroma, int8x8_t bound)
{
    return vmulq_s16(vreinterpretq_s16_u16(vmovl_u8(chroma)), vmovl_s8(bound));
}

static inline int16x8_t rest_of(uint8x8_t plus, uint8x8_t minus)
{
    return vmulq_n_s16(vreinterpretq_s16_u16(vsubl_u8(plus, minus)), 60);
}

typedef struct {
    uint8x16_t red, green, below_red; /* all ones in the piece; none: blue */
} pieces;

static inline int8x16_t choose(pieces piece, const hue_bound *bound)
{
    int8x16_t chosen = vbslq_s8(piece.green, bound->green, bound->blue);
    return vbslq_s8(piece.below_red, bound->below_red, vbslq_s8(piece.red, bound->red, chosen));
}

/* All ones where the hue is outside, for pixels that are not gray. */
static inline uint8x16_t misses_hue(uint8x16x3_t p, uint8x16_t max, uint8x16_t chroma,
                                    const range_vectors *range)
{
    uint8x16_t r = p.val[0], g = p.val[1], b = p.val[2];
    pieces piece = {.red = vceqq_u8(max, r)};
    piece.green = vbicq_u8(vceqq_u8(max, g), piece.red);
    uint8x16_t plus = vbslq_u8(piece.red, g, vbslq_u8(piece.green, b, r));
    uint8x16_t minus = vbslq_u8(piece.red, b, vbslq_u8(piece.green, r, g));
    piece.below_red = vandq_u8(vcltq_u8(plus, minus), piece.red);
    int8x16_t first = choose(piece, &range->h0), last = choose(piece, &range->h1);
    int16x8_t low = rest_of(vget_low_u8(plus), vget_low_u8(minus));
    int16x8_t high = rest_of(vget_high_u8(plus), vget_high_u8(minus));
    uint8x8_t c_low = vget_low_u8(chroma), c_high = vget_high_u8(chroma);
    uint16x8_t before_low = vcltq_s16(low, product_of(c_low, vget_low_s8(first)));
    uint16x8_t before_high = vcltq_s16(high, product_of(c_high, vget_high_s8(first)));
    uint16x8_t behind_low = vcgtq_s16(low, product_of(c_low, vget_low_s8(last)));
    uint16x8_t behind_high = vcgtq_s16(high, product_of(c_high, vget_high_s8(last)));
    uint8x16_t before = vcombine_u8(vmovn_u16(before_low), vmovn_u16(before_high));
    uint8x16_t behind = vcombine_u8(vmovn_u16(behind_low), vmovn_u16(behind_high));
    return vorrq_u8(vandq_u8(before, behind), vandq_u8(vorrq_u8(before, behind), range->no_wrap));
}

/* All ones where saturation or lightness is outside; limit: the chroma of a fully saturated color. */
static inline uint8x8_t misses_cone(uint8x8_t chroma, uint8x8_t limit, uint16x8_t sum,
                                    const range_vectors *range)
{
    uint16x8_t percent = vmull_u8(chroma, vdup_n_u8(100));
    uint16x8_t pale = vcltq_u16(percent, vmull_u8(limit, range->s0));
    uint16x8_t vivid = vcgtq_u16(percent, vmull_u8(limit, range->s1));
    uint16x8_t light = vorrq_u16(vcltq_u16(sum, range->l0), vcgtq_u16(sum, range->l1));
    return vmovn_u16(vorrq_u16(vorrq_u16(pale, vivid), light));
}

/* All ones where the pixel is in the range. */
static inline uint8x16_t in_range_16(const uint8_t *rgb, const range_vectors *range)
{
    uint8x16x3_t p = vld3q_u8(rgb);
    uint8x16_t max = vmaxq_u8(vmaxq_u8(p.val[0], p.val[1]), p.val[2]);
    uint8x16_t min = vminq_u8(vminq_u8(p.val[0], p.val[1]), p.val[2]);
    uint8x16_t chroma = vsubq_u8(max, min);
    uint8x16_t limit = vminq_u8(vqaddq_u8(max, min), vqaddq_u8(vmvnq_u8(max), vmvnq_u8(min)));
    uint16x8_t sum_low = vaddl_u8(vget_low_u8(max), vget_low_u8(min));
    uint16x8_t sum_high = vaddl_u8(vget_high_u8(max), vget_high_u8(min));
    uint8x8_t low = misses_cone(vget_low_u8(chroma), vget_low_u8(limit), sum_low, range);
    uint8x8_t high = misses_cone(vget_high_u8(chroma), vget_high_u8(limit), sum_high, range);
    uint8x16_t gray = vceqq_u8(chroma, vdupq_n_u8(0));
    uint8x16_t hue = vbslq_u8(gray, range->no_gray, misses_hue(p, max, chroma, range));
    uint8x16_t missed = vorrq_u8(vcombine_u8(low, high), hue);
    return vbicq_u8(vcgeq_u8(chroma, range->chroma_min), missed);
}

static inline uint32_t in_range_32(const uint8_t *rgb, const range_vectors *range)
{
    return word_of_32(in_range_16(rgb, range), in_range_16(rgb + 48, range));
}

/* The last word comes from the last 32 pixels of the row, some of which may be in the word before it. */
void iris_row_hsl_range_neon(uint32_t *mask, const uint8_t *rgb, const iris_hsl_range_test *test, int32_t n)
{
    if (n < 32) {
        iris_row_hsl_range_c(mask, rgb, test, n);
        return;
    }
    const range_vectors range = vectors_from(test);
    int32_t words = n / 32, rest = n % 32;
    for (int32_t word = 0; word < words; word++) {
        mask[word] = in_range_32(rgb + 96 * word, &range);
    }
    if (rest > 0) {
        iris_row_put_bits(&mask[words], in_range_32(rgb + 3 * (n - 32), &range) >> (32 - rest), rest);
    }
}
