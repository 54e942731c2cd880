/* Edges: gradients, their sizes against limits, and where they are greatest. */
#include "lanes.h"

/* 16 bits each of every second byte of a row, from an even one and from an odd one on. Work is done on these: they cost
 * no shuffles. */
typedef struct {
    lanes even, odd;
} halves;

INLINE halves split(const uint8_t *from)
{
    lanes bytes = load_lanes(from);
    return (halves){VSI(and)(bytes, V(set1_epi16)(255)), V(srli_epi16)(bytes, 8)};
}

/* Columns of three rows, every second one: the first vector from pixel i - 1 on, the next from i, i + 1, and i + 2. */
typedef struct {
    lanes sum[4], here[4],
        down[4]; /* of all three; the middle one; what the lowest is more than the upper one */
} columns;

INLINE columns columns_at(const uint8_t *const rows[3], int32_t i)
{
    columns c;
#pragma GCC unroll 2
    for (int side = 0; side < 2; side++) {
        int32_t from = i - 1 + 2 * side;
        halves above = split(rows[0] + from), here = split(rows[1] + from), below = split(rows[2] + from);
        c.here[2 * side] = here.even;
        c.here[2 * side + 1] = here.odd;
        c.down[2 * side] = V(sub_epi16)(below.even, above.even);
        c.down[2 * side + 1] = V(sub_epi16)(below.odd, above.odd);
        c.sum[2 * side] = V(add_epi16)(V(add_epi16)(above.even, here.even), below.even);
        c.sum[2 * side + 1] = V(add_epi16)(V(add_epi16)(above.odd, here.odd), below.odd);
    }
    return c;
}

/* What the middle difference counts beyond once; `more` holds 256 times its share, where it is not all of it. */
INLINE lanes extra(lanes middle, lanes more, int is_sobel)
{
    return is_sobel ? middle : V(mulhrs_epi16)(middle, more);
}

/* The pixels between columns k and k + 2. */
INLINE lanes dx_of(const columns *c, int k, lanes more, int is_sobel)
{
    return V(add_epi16)(V(sub_epi16)(c->sum[k + 2], c->sum[k]),
                        extra(V(sub_epi16)(c->here[k + 2], c->here[k]), more, is_sobel));
}

INLINE lanes dy_of(const columns *c, int k, lanes more, int is_sobel)
{
    return V(add_epi16)(V(add_epi16)(c->down[k], c->down[k + 2]),
                        V(add_epi16)(c->down[k + 1], extra(c->down[k + 1], more, is_sobel)));
}

INLINE lanes size_of(lanes dx, lanes dy)
{
    return V(add_epi16)(V(abs_epi16)(dx), V(abs_epi16)(dy));
}

INLINE void store_both(int16_t *to, lanes even, lanes odd)
{
    store_halves(to, V(unpacklo_epi16)(even, odd), V(unpackhi_epi16)(even, odd));
}

/* The last pixels may be some that were done before: so in all kernels here. */
INLINE void gradient(const iris_row_gradient *to, const uint8_t *const rows[3], lanes more, int is_sobel,
                     int32_t n)
{
    for (int32_t start = 0; start < n; start += LANES) {
        int32_t i = start < n - LANES ? start : n - LANES;
        const columns c = columns_at(rows, i);
        lanes dx = dx_of(&c, 0, more, is_sobel), dx_odd = dx_of(&c, 1, more, is_sobel);
        lanes dy = dy_of(&c, 0, more, is_sobel), dy_odd = dy_of(&c, 1, more, is_sobel);
        store_both(to->dx + i, dx, dx_odd);
        store_both(to->dy + i, dy, dy_odd);
        store_both(to->size + i, size_of(dx, dy), size_of(dx_odd, dy_odd));
    }
}

void iris_row_gradient_u8_sse(const iris_row_gradient *to, const uint8_t *const rows[3], int32_t more,
                              int32_t n)
{
    if (n < LANES) {
        iris_row_gradient_u8_c(to, rows, more, n);
    } else if (more == 128) {
        gradient(to, rows, VSI(setzero)(), 1, n);
    } else {
        gradient(to, rows, V(set1_epi16)((int16_t)(more * 256)), 0, n);
    }
}

/* A gain that is even: a whole number, and half of its fraction. */
typedef struct {
    lanes whole, half;
} even_gain;

INLINE even_gain spread_gain(uint32_t gain_q16)
{
    return (even_gain){V(set1_epi16)((int16_t)(gain_q16 >> 16)),
                       V(set1_epi16)((int16_t)((gain_q16 & 0xffffu) >> 1))};
}

/* Bytes of sizes below 2048, so that times 16 they fit 16 bits. */
INLINE lanes levels(lanes even, lanes odd, const even_gain *by)
{
    const lanes white = V(set1_epi16)(255);
    even = V(add_epi16)(V(mullo_epi16)(even, by->whole), V(mulhrs_epi16)(even, by->half));
    odd = V(add_epi16)(V(mullo_epi16)(odd, by->whole), V(mulhrs_epi16)(odd, by->half));
    return VSI(or)(V(min_epi16)(even, white), V(slli_epi16)(V(min_epi16)(odd, white), 8));
}

INLINE void gradient_gain(uint8_t *dst, const uint8_t *const rows[3], lanes more, int is_sobel,
                          uint32_t gain_q16, int32_t n)
{
    const even_gain by = spread_gain(gain_q16);
    for (int32_t start = 0; start < n; start += LANES) {
        int32_t i = start < n - LANES ? start : n - LANES;
        const columns c = columns_at(rows, i);
        lanes even = size_of(dx_of(&c, 0, more, is_sobel), dy_of(&c, 0, more, is_sobel));
        lanes odd = size_of(dx_of(&c, 1, more, is_sobel), dy_of(&c, 1, more, is_sobel));
        store_lanes(dst + i, levels(even, odd, &by));
    }
}

void iris_row_gradient_gain_u8_sse(uint8_t *dst, const uint8_t *const rows[3], int32_t more,
                                   uint32_t gain_q16, int32_t n)
{
    if (n < LANES || gain_q16 % 2 != 0) {
        iris_row_gradient_gain_u8_c(dst, rows, more, gain_q16, n);
    } else if (more == 128) {
        gradient_gain(dst, rows, VSI(setzero)(), 1, gain_q16, n);
    } else {
        gradient_gain(dst, rows, V(set1_epi16)((int16_t)(more * 256)), 0, gain_q16, n);
    }
}

INLINE lanes bend(lanes above, lanes below, lanes left, lanes right, lanes here)
{
    lanes around = V(add_epi16)(V(add_epi16)(above, below), V(add_epi16)(left, right));
    return V(abs_epi16)(V(sub_epi16)(around, V(slli_epi16)(here, 2)));
}

void iris_row_laplacian_gain_u8_sse(uint8_t *dst, const uint8_t *const rows[3], uint32_t gain_q16, int32_t n)
{
    if (n < LANES || gain_q16 % 2 != 0) {
        iris_row_laplacian_gain_u8_c(dst, rows, gain_q16, n);
        return;
    }
    const even_gain by = spread_gain(gain_q16);
    for (int32_t start = 0; start < n; start += LANES) {
        int32_t i = start < n - LANES ? start : n - LANES;
        halves above = split(rows[0] + i), below = split(rows[2] + i);
        halves left = split(rows[1] + i - 1), right = split(rows[1] + i + 1);
        lanes even = bend(above.even, below.even, left.even, right.even, left.odd);
        lanes odd = bend(above.odd, below.odd, left.odd, right.odd, right.even);
        store_lanes(dst + i, levels(even, odd, &by));
    }
}

typedef struct {
    __m128i white, whole, part;
} gains;

/* Eight sizes times the gain, rounded; above 255 and below 32768 where they are white. */
static inline __m128i gain_8(const int16_t *size, const gains *by)
{
    __m128i sizes = _mm_min_epi16(_mm_abs_epi16(load16(size)), by->white);
    __m128i high = _mm_mulhi_epu16(sizes, by->part), low = _mm_mullo_epi16(sizes, by->part);
    return _mm_add_epi16(_mm_add_epi16(_mm_mullo_epi16(sizes, by->whole), high), _mm_srli_epi16(low, 15));
}

/* The last sixteen pixels may be some that were done before. */
void iris_row_gain_s16_sse(uint8_t *dst, const int16_t *size, uint32_t gain_q16, int32_t n)
{
    if (n < 16) {
        iris_row_gain_s16_c(dst, size, gain_q16, n);
        return;
    }
    const uint32_t white = gain_q16 <= 512 ? 32767 : (256u << 16) / gain_q16 + 1;
    const gains by = {_mm_set1_epi16((int16_t)(white < 32767 ? white : 32767)),
                      _mm_set1_epi16((int16_t)(gain_q16 >> 16)), _mm_set1_epi16((int16_t)gain_q16)};
    for (int32_t i = 0; i < n; i += 16) {
        int32_t at = i + 16 <= n ? i : n - 16;
        store16(dst + at, _mm_packus_epi16(gain_8(size + at, &by), gain_8(size + at + 8, &by)));
    }
}

static inline uint32_t above_32(const int16_t *src, __m128i limit)
{
    __m128i first =
        _mm_packs_epi16(_mm_cmpgt_epi16(load16(src), limit), _mm_cmpgt_epi16(load16(src + 8), limit));
    __m128i second =
        _mm_packs_epi16(_mm_cmpgt_epi16(load16(src + 16), limit), _mm_cmpgt_epi16(load16(src + 24), limit));
    return high_bits(first, second);
}

/* The last word comes from the last 32 pixels of the row, some of which may be in the word before it. */
void iris_row_above_s16_sse(uint32_t *mask, const int16_t *src, int32_t limit, int32_t n)
{
    if (n < 32) {
        iris_row_above_s16_c(mask, src, limit, n);
        return;
    }
    const __m128i limits = _mm_set1_epi16((int16_t)limit);
    int32_t words = n / 32, rest = n % 32;
    for (int32_t word = 0; word < words; word++) {
        mask[word] = above_32(src + 32 * word, limits);
    }
    if (rest > 0) {
        iris_row_put_bits(&mask[words], above_32(src + n - 32, limits) >> (32 - rest), rest);
    }
}

/* All ones where two values add up to more than the threshold, as unsigned numbers. */
static inline __m128i exceeds(__m128i a, __m128i b, __m128i threshold)
{
    __m128i within = _mm_cmpeq_epi16(_mm_subs_epu16(_mm_add_epi16(a, b), threshold), _mm_setzero_si128());
    return _mm_xor_si128(within, _mm_set1_epi16(-1));
}

/* All ones where one value is above 0 and the other below. */
static inline __m128i opposite(__m128i a, __m128i b)
{
    return _mm_cmplt_epi16(_mm_sign_epi16(a, b), _mm_setzero_si128());
}

/* All ones where here is the pixel of a crossing from before to after. */
static inline __m128i crossing_8(__m128i before, __m128i here, __m128i after, __m128i threshold)
{
    __m128i size = _mm_abs_epi16(here), size_before = _mm_abs_epi16(before),
            size_after = _mm_abs_epi16(after);
    __m128i from = _mm_and_si128(_mm_and_si128(opposite(before, here), _mm_cmpgt_epi16(size_before, size)),
                                 exceeds(size_before, size, threshold));
    __m128i to = _mm_and_si128(_mm_andnot_si128(_mm_cmpgt_epi16(size, size_after), opposite(after, here)),
                               exceeds(size, size_after, threshold));
    __m128i at_zero = _mm_and_si128(_mm_cmpeq_epi16(here, _mm_setzero_si128()), opposite(before, after));
    return _mm_or_si128(_mm_or_si128(from, to),
                        _mm_and_si128(at_zero, exceeds(size_before, size_after, threshold)));
}

static inline __m128i crossings_8(const int16_t *const rows[3], int32_t i, __m128i threshold)
{
    __m128i here = load16(rows[1] + i);
    return _mm_or_si128(crossing_8(load16(rows[1] + i - 1), here, load16(rows[1] + i + 1), threshold),
                        crossing_8(load16(rows[0] + i), here, load16(rows[2] + i), threshold));
}

static inline __m128i crossings_16(const int16_t *const rows[3], int32_t i, __m128i threshold)
{
    return _mm_packs_epi16(crossings_8(rows, i, threshold), crossings_8(rows, i + 8, threshold));
}

/* The last word comes from the last 32 pixels of the row, some of which may be in the word before it. */
void iris_row_crossings_s16_sse(uint32_t *mask, const int16_t *const rows[3], int32_t threshold, int32_t n)
{
    if (n < 32) {
        iris_row_crossings_s16_c(mask, rows, threshold, n);
        return;
    }
    const __m128i least = _mm_set1_epi16((int16_t)threshold);
    for (int32_t start = 0; start < n; start += 32) {
        int32_t count = n - start < 32 ? n - start : 32, from = start + count - 32;
        uint32_t bits = high_bits(crossings_16(rows, from, least), crossings_16(rows, from + 16, least));
        iris_row_put_bits(&mask[start / 32], bits >> (-count & 31), count);
    }
}

/* LANES / 2 pixels from i on: all ones where the size is greatest across the edge. */
INLINE lanes ridge_at(const iris_row_ridges *rows, int32_t i)
{
    const int16_t *above = rows->size[0] + i, *here = rows->size[1] + i, *below = rows->size[2] + i;
    lanes dx = load_lanes(rows->dx + i), dy = load_lanes(rows->dy + i), size = load_lanes(here);
    lanes across = V(abs_epi16)(dx), down = V(abs_epi16)(dy);
    lanes twice = V(add_epi16)(across, across);
    lanes t = V(mulhi_epu16)(twice, V(set1_epi16)(13573));
    lanes is_steep = V(cmpgt_epi16)(down, t);
    lanes is_upright = V(cmpgt_epi16)(down, V(add_epi16)(twice, t));
    lanes leans_left = V(srai_epi16)(VSI(xor)(dx, dy), 15);
    lanes is_diagonal = VSI(andnot)(is_upright, is_steep);
    lanes before = V(blendv_epi8)(load_lanes(above - 1), load_lanes(above + 1), leans_left);
    lanes after = V(blendv_epi8)(load_lanes(below + 1), load_lanes(below - 1), leans_left);
    before =
        V(blendv_epi8)(V(blendv_epi8)(load_lanes(here - 1), before, is_steep), load_lanes(above), is_upright);
    after =
        V(blendv_epi8)(V(blendv_epi8)(load_lanes(here + 1), after, is_steep), load_lanes(below), is_upright);
    /* Not below is above one less. */
    after = V(add_epi16)(after, VSI(xor)(is_diagonal, V(set1_epi16)(-1)));
    return VSI(and)(V(cmpgt_epi16)(size, before), V(cmpgt_epi16)(size, after));
}

INLINE lanes above_limit(const int16_t *size, lanes limit)
{
    return V(packs_epi16)(V(cmpgt_epi16)(load_lanes(size), limit),
                          V(cmpgt_epi16)(load_lanes(size + LANES / 2), limit));
}

/* LANES pixels from i on: bits of the weak ones, and above 32 of them of the strong ones. */
INLINE uint64_t ridges_at(const iris_row_ridges *rows, int32_t i, lanes low, lanes high)
{
    lanes weak = above_limit(rows->size[1] + i, low);
    if (V(movemask_epi8)(weak) == 0) {
        return 0;
    }
    weak = VSI(and)(weak, V(packs_epi16)(ridge_at(rows, i), ridge_at(rows, i + LANES / 2)));
    lanes strong = VSI(and)(weak, above_limit(rows->size[1] + i, high));
    return (uint32_t)V(movemask_epi8)(in_order(weak)) | (uint64_t)(uint32_t)V(movemask_epi8)(in_order(strong))
                                                            << 32;
}

/* The last word comes from the last 32 pixels of the row, some of which may be in the word before it. */
void iris_row_ridges_s16_sse(uint32_t *weak, uint32_t *strong, const iris_row_ridges *rows, int32_t n)
{
    if (n < 32) {
        iris_row_ridges_s16_c(weak, strong, rows, n);
        return;
    }
    const lanes low = V(set1_epi16)((int16_t)rows->low), high = V(set1_epi16)((int16_t)rows->high);
    for (int32_t start = 0; start < n; start += 32) {
        int32_t count = n - start < 32 ? n - start : 32, from = start + count - 32;
        uint64_t bits = ridges_at(rows, from, low, high);
        if (LANES < 32) {
            bits |= ridges_at(rows, from + 16, low, high) << 16;
        }
        iris_row_put_bits(&weak[start / 32], (uint32_t)bits >> (-count & 31), count);
        iris_row_put_bits(&strong[start / 32], (uint32_t)(bits >> 32) >> (-count & 31), count);
    }
}

/* How much two rows of bytes differ, either way. */
static inline __m128i apart_16(const uint8_t *a, const uint8_t *b)
{
    __m128i first = load16(a), second = load16(b);
    return _mm_or_si128(_mm_subs_epu8(first, second), _mm_subs_epu8(second, first));
}

static inline __m128i alike_16(const uint8_t *const rows[3], int32_t i, __m128i limit)
{
    __m128i most =
        _mm_max_epu8(apart_16(rows[1] + i - 1, rows[1] + i + 1), apart_16(rows[0] + i, rows[2] + i));
    return _mm_cmpeq_epi8(_mm_max_epu8(most, limit), limit);
}

/* The last word comes from the last 32 pixels of the row, some of which may be in the word before it. */
void iris_row_unlike_u8_sse(uint32_t *mask, const uint8_t *const rows[3], uint8_t limit, int32_t n)
{
    if (n < 32) {
        iris_row_unlike_u8_c(mask, rows, limit, n);
        return;
    }
    const __m128i limits = _mm_set1_epi8((char)limit);
    for (int32_t start = 0; start < n; start += 32) {
        int32_t count = n - start < 32 ? n - start : 32, from = start + count - 32;
        uint32_t bits = ~high_bits(alike_16(rows, from, limits), alike_16(rows, from + 16, limits));
        iris_row_put_bits(&mask[start / 32], bits >> (-count & 31), count);
    }
}
