/* Colors against a range of hue, saturation, and lightness, 16 pixels at a time.
 *
 * The plain body compares 60 hue / C with h0 and h1. Here the hue is one of four pieces, each a base angle (0, 120,
 * 240, or 360 degrees) and a signed rest d / C within -1 to 1 of 60 degrees: 60 d >= (h0 - base) C, where a bound
 * outside -60..60 acts as -61 or 61. All factors then fit a signed byte and all sums of two products a signed word. */
#include "vector.h"

typedef struct {
    __m128i r, g, b;
} channels;

/* A bound of the hue within each piece, in degrees from its base. */
typedef struct {
    __m128i red, green, blue, below_red;
} hue_bound;

typedef struct {
    hue_bound h0, h1;
    __m128i s0, s1;     /* bytes 100 and -bound: factors of C and of the chroma that S = 1 has */
    __m128i l0, l1;     /* words */
    __m128i chroma_min; /* bytes */
    __m128i no_gray;    /* all ones: no gray belongs to the hues; else zero */
    __m128i no_wrap;    /* all ones: both bounds of the hue must hold; zero: one */
} range_vectors;

static inline __m128i choose(__m128i condition, __m128i yes, __m128i no)
{
    return _mm_blendv_epi8(no, yes, condition);
}

static inline __m128i bound_from(int32_t degrees)
{
    return _mm_set1_epi8((char)(degrees > 61 ? 61 : degrees < -61 ? -61 : degrees));
}

static inline hue_bound hue_bound_from(int32_t degrees)
{
    hue_bound bound = {bound_from(degrees), bound_from(degrees - 120), bound_from(degrees - 240),
                       bound_from(degrees - 360)};
    return bound;
}

static inline __m128i bytes_pair(int32_t even, int32_t odd)
{
    return _mm_set1_epi16((short)((even & 0xff) | odd * 256));
}

static inline range_vectors vectors_from(const iris_hsl_range_test *test)
{
    range_vectors range = {.h0 = hue_bound_from(test->h0),
                           .h1 = hue_bound_from(test->h1),
                           .s0 = bytes_pair(100, -test->s0),
                           .s1 = bytes_pair(100, -test->s1),
                           .l0 = _mm_set1_epi16((short)test->l0),
                           .l1 = _mm_set1_epi16((short)test->l1),
                           .chroma_min = _mm_set1_epi8((char)test->chroma_min),
                           .no_gray = _mm_set1_epi8((char)-(test->hue_has_gray == 0)),
                           .no_wrap = _mm_set1_epi8((char)-(test->hue_wraps == 0))};
    return range;
}

/* Three vectors of five pixels and a third each to three channels: every byte has its place in one of them. */
static inline channels load_channels(const uint8_t *rgb)
{
    __m128i a = load16(rgb), b = load16(rgb + 16), c = load16(rgb + 32);
#define PART(vector, ...) _mm_shuffle_epi8(vector, _mm_setr_epi8(__VA_ARGS__))
    channels pixels = {
        _mm_or_si128(PART(a, 0, 3, 6, 9, 12, 15, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1),
                     _mm_or_si128(PART(b, -1, -1, -1, -1, -1, -1, 2, 5, 8, 11, 14, -1, -1, -1, -1, -1),
                                  PART(c, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 1, 4, 7, 10, 13))),
        _mm_or_si128(PART(a, 1, 4, 7, 10, 13, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1),
                     _mm_or_si128(PART(b, -1, -1, -1, -1, -1, 0, 3, 6, 9, 12, 15, -1, -1, -1, -1, -1),
                                  PART(c, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 2, 5, 8, 11, 14))),
        _mm_or_si128(PART(a, 2, 5, 8, 11, 14, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1),
                     _mm_or_si128(PART(b, -1, -1, -1, -1, -1, 1, 4, 7, 10, 13, -1, -1, -1, -1, -1, -1),
                                  PART(c, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 0, 3, 6, 9, 12, 15)))};
#undef PART
    return pixels;
}

/* Products of the bytes of a and b with the even and odd bytes of factors, in pairs: the first and the last 8 sums. */
typedef struct {
    __m128i low, high;
} sums;

static inline sums sums_of(__m128i a, __m128i b, __m128i factors)
{
    sums result = {_mm_maddubs_epi16(_mm_unpacklo_epi8(a, b), factors),
                   _mm_maddubs_epi16(_mm_unpackhi_epi8(a, b), factors)};
    return result;
}

/* a * factors, where factors are signed bytes. */
static inline sums products_of(__m128i a, __m128i factors)
{
    const __m128i zero = _mm_setzero_si128();
    sums result = {_mm_maddubs_epi16(_mm_unpacklo_epi8(a, zero), _mm_unpacklo_epi8(factors, zero)),
                   _mm_maddubs_epi16(_mm_unpackhi_epi8(a, zero), _mm_unpackhi_epi8(factors, zero))};
    return result;
}

/* Bytes that are all ones where a > b. */
static inline __m128i greater(sums a, sums b)
{
    return _mm_packs_epi16(_mm_cmpgt_epi16(a.low, b.low), _mm_cmpgt_epi16(a.high, b.high));
}

static inline sums constant(__m128i words)
{
    sums result = {words, words};
    return result;
}

/* All ones where the hue is outside, for pixels that are not gray. */
static inline __m128i misses_hue(channels p, __m128i max, __m128i chroma, const range_vectors *range)
{
    __m128i red = _mm_cmpeq_epi8(max, p.r);
    __m128i green = _mm_andnot_si128(red, _mm_cmpeq_epi8(max, p.g));
    __m128i plus = choose(red, p.g, choose(green, p.b, p.r));
    __m128i minus = choose(red, p.b, choose(green, p.r, p.g));
    __m128i below_red = _mm_andnot_si128(_mm_cmpeq_epi8(_mm_max_epu8(plus, minus), plus), red);
    const hue_bound *h0 = &range->h0, *h1 = &range->h1;
    __m128i first = choose(red, h0->red, choose(green, h0->green, h0->blue));
    __m128i last = choose(red, h1->red, choose(green, h1->green, h1->blue));
    sums rest = sums_of(plus, minus, bytes_pair(60, -60));
    __m128i before = greater(products_of(chroma, choose(below_red, h0->below_red, first)), rest);
    __m128i behind = greater(rest, products_of(chroma, choose(below_red, h1->below_red, last)));
    return _mm_or_si128(_mm_and_si128(before, behind),
                        _mm_and_si128(_mm_or_si128(before, behind), range->no_wrap));
}

/* All ones where the pixel is outside the range. */
static inline __m128i misses_16(const uint8_t *rgb, const range_vectors *range)
{
    const __m128i zero = _mm_setzero_si128(), ones = _mm_set1_epi8(-1);
    channels p = load_channels(rgb);
    __m128i max = _mm_max_epu8(_mm_max_epu8(p.r, p.g), p.b);
    __m128i min = _mm_min_epu8(_mm_min_epu8(p.r, p.g), p.b);
    __m128i chroma = _mm_sub_epi8(max, min);
    /* the chroma that a fully saturated color of this lightness has: max + min or 510 - (max + min) */
    __m128i limit = _mm_min_epu8(_mm_adds_epu8(max, min),
                                 _mm_adds_epu8(_mm_xor_si128(max, ones), _mm_xor_si128(min, ones)));
    sums lightness = sums_of(max, min, bytes_pair(1, 1));
    __m128i dark_or_bright =
        _mm_or_si128(greater(constant(range->l0), lightness), greater(lightness, constant(range->l1)));
    __m128i pale_or_vivid = _mm_or_si128(greater(constant(zero), sums_of(chroma, limit, range->s0)),
                                         greater(sums_of(chroma, limit, range->s1), constant(zero)));
    __m128i enough = _mm_cmpeq_epi8(_mm_max_epu8(chroma, range->chroma_min), chroma);
    __m128i hue = choose(_mm_cmpeq_epi8(chroma, zero), range->no_gray, misses_hue(p, max, chroma, range));
    return _mm_or_si128(_mm_or_si128(dark_or_bright, pale_or_vivid),
                        _mm_or_si128(hue, _mm_xor_si128(enough, ones)));
}

static inline uint32_t in_range_32(const uint8_t *rgb, const range_vectors *range)
{
    return ~high_bits(misses_16(rgb, range), misses_16(rgb + 48, range));
}

/* The last word comes from the last 32 pixels of the row, some of which may be in the word before it. */
void iris_row_hsl_range_sse(uint32_t *mask, const uint8_t *rgb, const iris_hsl_range_test *test, int32_t n)
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
