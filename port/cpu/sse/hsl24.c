/* RGB to HSL24. There is no division by vectors of integers: it is done in writing, four binary digits at a time. */
#include "planes.h"

INLINE void store_pixels(uint8_t *to, lanes first, lanes second, lanes third)
{
    store_parts(to,
                join(PART(first, 0, -1, -1, 1, -1, -1, 2, -1, -1, 3, -1, -1, 4, -1, -1, 5),
                     PART(second, -1, 0, -1, -1, 1, -1, -1, 2, -1, -1, 3, -1, -1, 4, -1, -1),
                     PART(third, -1, -1, 0, -1, -1, 1, -1, -1, 2, -1, -1, 3, -1, -1, 4, -1)),
                48);
    store_parts(to + 16,
                join(PART(first, -1, -1, 6, -1, -1, 7, -1, -1, 8, -1, -1, 9, -1, -1, 10, -1),
                     PART(second, 5, -1, -1, 6, -1, -1, 7, -1, -1, 8, -1, -1, 9, -1, -1, 10),
                     PART(third, -1, 5, -1, -1, 6, -1, -1, 7, -1, -1, 8, -1, -1, 9, -1, -1)),
                48);
    store_parts(to + 32,
                join(PART(first, -1, 11, -1, -1, 12, -1, -1, 13, -1, -1, 14, -1, -1, 15, -1, -1),
                     PART(second, -1, -1, 11, -1, -1, 12, -1, -1, 13, -1, -1, 14, -1, -1, 15, -1),
                     PART(third, 10, -1, -1, 11, -1, -1, 12, -1, -1, 13, -1, -1, 14, -1, -1, 15)),
                48);
}

/* Four steps of a division by d of n below 16 d, d at most 2047: the rest times 16, plus the quotient. Each step doubles
 * n and subtracts 16 d where n is not less (less, it wraps around and is the greater of the two), and puts a 1 into the
 * lowest bit, which is free. less_one: 16 d - 1. */
INLINE lanes divide_4(lanes n, lanes less_one)
{
#pragma GCC unroll 4
    for (int step = 0; step < 4; step++) {
        lanes twice = V(add_epi16)(n, n);
        n = V(min_epu16)(twice, V(sub_epi16)(twice, less_one));
    }
    return n;
}

/* 256 hue / (6 chroma) rounded half up, of 16 bits each, hue below 6 chroma. No matter what where chroma is 0. */
INLINE lanes hue_of(lanes hue, lanes chroma)
{
    const lanes one = V(set1_epi16)(1), digits = V(set1_epi16)(15);
    lanes half =
        V(slli_epi16)(V(add_epi16)(chroma, V(add_epi16)(chroma, chroma)), 4); /* of 6 chroma, times 16 */
    lanes less_one = V(sub_epi16)(V(add_epi16)(half, half), one);
    lanes first = divide_4(V(slli_epi16)(hue, 4), less_one);
    lanes second = divide_4(VSI(andnot)(digits, first), less_one);
    lanes quotient = VSI(or)(V(slli_epi16)(VSI(and)(first, digits), 4), VSI(and)(second, digits));
    lanes up = V(cmpgt_epi16)(V(add_epi16)(VSI(or)(second, digits), one), half);
    return VSI(and)(V(sub_epi16)(quotient, up), V(set1_epi16)(255)); /* 256 is a whole turn, 0 */
}

/* 255 chroma / limit rounded half up, of bytes in 16 bits each; chroma is at most limit. 0 where both are 0. */
INLINE lanes saturation_of(lanes chroma, lanes limit)
{
    const lanes digits = V(set1_epi16)(15);
    lanes n = V(add_epi16)(V(sub_epi16)(V(slli_epi16)(chroma, 8), chroma), V(srli_epi16)(limit, 1));
    lanes less_one = V(sub_epi16)(V(slli_epi16)(limit, 4), V(set1_epi16)(1));
    lanes first = divide_4(V(srli_epi16)(n, 4), less_one);
    lanes second = divide_4(VSI(or)(VSI(andnot)(digits, first), VSI(and)(n, digits)), less_one);
    return VSI(or)(V(slli_epi16)(VSI(and)(first, digits), 4), VSI(and)(second, digits));
}

/* Where the largest channel is: hue = plus - minus + turns * chroma, all in bytes. */
typedef struct {
    lanes plus, minus, turns;
} hue_parts;

INLINE hue_parts parts_of(planes p, lanes max)
{
    lanes red = V(cmpeq_epi8)(max, p.r), green = V(cmpeq_epi8)(max, p.g);
    lanes plus = V(blendv_epi8)(V(blendv_epi8)(p.r, p.b, green), p.g, red);
    lanes minus = V(blendv_epi8)(V(blendv_epi8)(p.g, p.r, green), p.b, red);
    lanes below_red = VSI(andnot)(V(cmpeq_epi8)(V(max_epu8)(plus, minus), plus), V(set1_epi8)(6));
    lanes turns = V(blendv_epi8)(V(set1_epi8)(4), V(set1_epi8)(2), green);
    return (hue_parts){plus, minus, V(blendv_epi8)(turns, below_red, red)};
}

INLINE void convert(uint8_t *to, const uint8_t *from, int32_t red)
{
    const lanes zero = VSI(setzero)(), ones = V(set1_epi8)(-1),
                difference = V(set1_epi16)(-255); /* 1 and -1 */
    planes p = load_pixels(from);
    p = red ? (planes){p.b, p.g, p.r} : p;
    lanes max = V(max_epu8)(V(max_epu8)(p.r, p.g), p.b), min = V(min_epu8)(V(min_epu8)(p.r, p.g), p.b);
    lanes chroma = V(sub_epi8)(max, min);
    lanes limit = V(min_epu8)(V(adds_epu8)(max, min), V(adds_epu8)(VSI(xor)(max, ones), VSI(xor)(min, ones)));
    const hue_parts parts = parts_of(p, max);
    lanes c[2] = {V(unpacklo_epi8)(chroma, zero), V(unpackhi_epi8)(chroma, zero)};
    lanes full[2] = {V(unpacklo_epi8)(limit, zero), V(unpackhi_epi8)(limit, zero)};
    lanes turns[2] = {V(unpacklo_epi8)(parts.turns, zero), V(unpackhi_epi8)(parts.turns, zero)};
    lanes pair[2] = {V(unpacklo_epi8)(parts.plus, parts.minus), V(unpackhi_epi8)(parts.plus, parts.minus)};
    lanes hue[2], saturation[2];
#pragma GCC unroll 2
    for (int h = 0; h < 2; h++) {
        lanes angle = V(add_epi16)(V(maddubs_epi16)(pair[h], difference), V(mullo_epi16)(c[h], turns[h]));
        hue[h] = hue_of(angle, c[h]);
        saturation[h] = saturation_of(c[h], full[h]);
    }
    lanes colored = VSI(xor)(V(cmpeq_epi8)(chroma, zero), ones);
    store_pixels(to, VSI(and)(V(packus_epi16)(hue[0], hue[1]), colored),
                 V(packus_epi16)(saturation[0], saturation[1]), V(avg_epu8)(max, min));
}

/* In place, too: the last pixels go by way of a vector's worth of them. */
void iris_row_hsl24_888_sse(uint8_t *dst, const uint8_t *src, int32_t red, int32_t n)
{
    for (; n >= LANES; n -= LANES, dst += 3 * LANES, src += 3 * LANES) {
        convert(dst, src, red);
    }
    if (n > 0) {
        uint8_t last[3 * LANES] = {0};
        memcpy(last, src, 3 * (size_t)n);
        convert(last, last, red);
        memcpy(dst, last, 3 * (size_t)n);
    }
}
