/* Colors against a range of hue, saturation, and lightness.
 *
 * The plain body compares 60 hue / C with h0 and h1. Here the hue is one of four pieces, each a base angle (0, 120,
 * 240, or 360 degrees) and a signed rest d / C within -1 to 1 of 60 degrees: 60 d >= (h0 - base) C, where a bound
 * outside -60..60 acts as -61 or 61. |d| is what the middle channel is more than the least one. All factors then fit a
 * signed byte and all sums of two products a signed word, of which the sign is what is asked for. */
#include "planes.h"

/* By the order of the channels: bit 0 is r >= g, bit 1 r >= b, bit 2 g >= b. */
typedef struct {
    lanes sixty;  /* 60 with the sign of d */
    lanes h0, h1; /* -(h0 - base) and h1 - base */
} hue_tables;

typedef struct {
    hue_tables hue;
    lanes s0, s1;     /* pairs of bytes: factors of C and of the chroma that S = 1 has */
    lanes dark[2];    /* the least and the most of max + min, up to 255 */
    lanes bright[2];  /* and of 510 - max - min */
    lanes chroma_min; /* 1 where no gray is in the range */
    lanes no_wrap;    /* all ones: both bounds of the hue must hold; zero: one */
} range_vectors;

static inline int32_t within(int32_t value, int32_t most)
{
    return value > most ? most : value < -most ? -most : value;
}

static lanes spread_table(const int8_t table[8])
{
    __m128i once = _mm_loadl_epi64((const __m128i *)(const void *)table);
#ifdef __AVX2__
    return _mm256_broadcastsi128_si256(once);
#else
    return once;
#endif
}

static hue_tables tables_from(const iris_hsl_range_test *test)
{
    int8_t sixty[8], h0[8], h1[8];
    for (int order = 0; order < 8; order++) {
        int red = (order & 3) == 3, g_to_b = order >> 2;
        int turned_up = red ? g_to_b : g_to_b ? !(order & 2) : order & 1;
        int32_t base = red ? (g_to_b ? 0 : 360) : g_to_b ? 120 : 240;
        sixty[order] = (int8_t)(turned_up ? 60 : -60);
        h0[order] = (int8_t)within(base - test->h0, 61);
        h1[order] = (int8_t)within(test->h1 - base, 61);
    }
    return (hue_tables){spread_table(sixty), spread_table(h0), spread_table(h1)};
}

static inline lanes byte_of(int32_t value)
{
    return V(set1_epi8)((char)(value < 255 ? value : 255));
}

static inline lanes bytes_pair(int32_t even, int32_t odd)
{
    return V(set1_epi16)((short)((even & 0xff) | odd * 256));
}

static inline range_vectors vectors_from(const iris_hsl_range_test *test)
{
    return (range_vectors){.hue = tables_from(test),
                           .s0 = bytes_pair(100, -test->s0),
                           .s1 = bytes_pair(-100, test->s1),
                           .dark = {byte_of(test->l0), byte_of(test->l1)},
                           .bright = {byte_of(510 - test->l1), byte_of(510 - test->l0)},
                           .chroma_min = byte_of(test->chroma_min > 0 || !test->hue_has_gray),
                           .no_wrap = V(set1_epi8)((char)-(test->hue_wraps == 0))};
}

/* Two bytes each times two factors, as bytes of the same sign. */
INLINE lanes signs_of(lanes low, lanes high, lanes low_factors, lanes high_factors)
{
    return V(packs_epi16)(V(maddubs_epi16)(low, low_factors), V(maddubs_epi16)(high, high_factors));
}

/* Negative where the hue is outside; of gray nothing is. */
INLINE lanes misses_hue(planes p, lanes rest, lanes chroma, const range_vectors *range)
{
    lanes order = join(VSI(and)(V(cmpeq_epi8)(V(max_epu8)(p.r, p.g), p.r), V(set1_epi8)(1)),
                       VSI(and)(V(cmpeq_epi8)(V(max_epu8)(p.r, p.b), p.r), V(set1_epi8)(2)),
                       VSI(and)(V(cmpeq_epi8)(V(max_epu8)(p.g, p.b), p.g), V(set1_epi8)(4)));
    lanes sixty = V(shuffle_epi8)(range->hue.sixty, order);
    lanes minus_sixty = V(sub_epi8)(VSI(setzero)(), sixty);
    lanes h0 = V(shuffle_epi8)(range->hue.h0, order), h1 = V(shuffle_epi8)(range->hue.h1, order);
    lanes low = V(unpacklo_epi8)(rest, chroma), high = V(unpackhi_epi8)(rest, chroma);
    lanes before = signs_of(low, high, V(unpacklo_epi8)(sixty, h0), V(unpackhi_epi8)(sixty, h0));
    lanes behind = signs_of(low, high, V(unpacklo_epi8)(minus_sixty, h1), V(unpackhi_epi8)(minus_sixty, h1));
    return VSI(or)(VSI(and)(before, behind), VSI(and)(VSI(or)(before, behind), range->no_wrap));
}

/* Not 0 where a byte is outside of two bounds. */
INLINE lanes beyond(lanes value, const lanes bounds[2])
{
    return VSI(or)(V(subs_epu8)(bounds[0], value), V(subs_epu8)(value, bounds[1]));
}

/* Bits of the pixels that are in the range. */
INLINE uint32_t in_range(const uint8_t *rgb, const range_vectors *range)
{
    const lanes ones = V(set1_epi8)(-1);
    planes p = load_pixels(rgb);
    lanes more = V(max_epu8)(p.r, p.g), less = V(min_epu8)(p.r, p.g);
    lanes max = V(max_epu8)(more, p.b), min = V(min_epu8)(less, p.b);
    lanes middle = V(max_epu8)(less, V(min_epu8)(more, p.b)), chroma = V(sub_epi8)(max, min);
    /* the chroma that a fully saturated color of this lightness has is the lesser of these */
    lanes dark = V(adds_epu8)(max, min), bright = V(adds_epu8)(VSI(xor)(max, ones), VSI(xor)(min, ones));
    lanes limit = V(min_epu8)(dark, bright);
    lanes low = V(unpacklo_epi8)(chroma, limit), high = V(unpackhi_epi8)(chroma, limit);
    lanes pale =
        VSI(or)(signs_of(low, high, range->s0, range->s0), signs_of(low, high, range->s1, range->s1));
    lanes out = join(beyond(dark, range->dark), beyond(bright, range->bright),
                     V(subs_epu8)(range->chroma_min, chroma));
    lanes left = VSI(andnot)(pale, V(cmpeq_epi8)(out, VSI(setzero)()));
    if (V(movemask_epi8)(left) == 0) { /* as most of a picture often is: the hue is not needed */
        return 0;
    }
    lanes misses = misses_hue(p, V(sub_epi8)(middle, min), chroma, range);
    return (uint32_t)V(movemask_epi8)(VSI(andnot)(misses, left));
}

INLINE uint32_t in_range_32(const uint8_t *rgb, const range_vectors *range)
{
#ifdef __AVX2__
    return in_range(rgb, range);
#else
    return in_range(rgb, range) | in_range(rgb + 48, range) << 16;
#endif
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
