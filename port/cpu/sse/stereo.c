/* Stereo pairs: many steps of a pixel at once. */
#include "lanes.h"

enum { HALVES = LANES / 2 }; /* values of 16 bits */

/* ---- census ---- */

/* `bit` where the row is darker. */
INLINE lanes darker(lanes own, const uint8_t *row, int bit)
{
    lanes other = load_lanes(row), not_darker = V(cmpeq_epi8)(V(max_epu8)(own, other), other);
    return VSI(andnot)(not_darker, V(set1_epi8)((char)(1 << bit)));
}

INLINE lanes darker4(lanes own, const uint8_t *const *at, int bit)
{
    lanes two = VSI(or)(darker(own, at[0], bit), darker(own, at[1], bit + 1));
    return VSI(or)(two, VSI(or)(darker(own, at[2], bit + 2), darker(own, at[3], bit + 3)));
}

/* Where the 24 neighbors are, by rows. */
INLINE void census_at(uint8_t *const planes[3], const uint8_t *const rows[5], int32_t i)
{
    const uint8_t *a = rows[0] + i, *b = rows[1] + i, *c = rows[2] + i, *d = rows[3] + i, *e = rows[4] + i;
    const uint8_t *at[24] = {a - 2, a - 1, a,     a + 1, a + 2, b - 2, b - 1, b,
                             b + 1, b + 2, c - 2, c - 1, c + 1, c + 2, d - 2, d - 1,
                             d,     d + 1, d + 2, e - 2, e - 1, e,     e + 1, e + 2};
    const lanes own = load_lanes(c);
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        store_lanes(planes[k] + i, VSI(or)(darker4(own, at + 8 * k, 0), darker4(own, at + 8 * k + 4, 4)));
    }
}

void iris_row_census_u8_sse(uint8_t *const planes[3], const uint8_t *const rows[5], int32_t n)
{
    if (n < LANES) {
        iris_row_census_u8_c(planes, rows, n);
        return;
    }
    for (int32_t x = 0; x < n; x += LANES) {
        census_at(planes, rows, x > n - LANES ? n - LANES : x);
    }
}

/* ---- costs ---- */

INLINE lanes bits_of(lanes value)
{
    const lanes low = V(set1_epi8)(15);
#ifdef __AVX2__
    const lanes counts =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4));
#else
    const lanes counts = _mm_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4);
#endif
    lanes high = VSI(and)(V(srli_epi16)(value, 4), low);
    return V(add_epi8)(V(shuffle_epi8)(counts, VSI(and)(value, low)), V(shuffle_epi8)(counts, high));
}

/* A pixel of the left picture. */
typedef struct {
    lanes first, second, third, gray;
} place;

INLINE place place_at(const iris_row_pair *pair, int32_t x, int census, int gray)
{
    const lanes none = V(set1_epi8)(0);
    return (place){census ? V(set1_epi8)((char)pair->left[0][x]) : none,
                   census ? V(set1_epi8)((char)pair->left[1][x]) : none,
                   census ? V(set1_epi8)((char)pair->left[2][x]) : none,
                   gray ? V(set1_epi8)((char)pair->left[3][x]) : none};
}

/* Its costs at steps `at` - x and following. census and gray are constants. */
INLINE lanes costs_of(const place *left, const uint8_t *const right[4], ptrdiff_t at, int census, int gray)
{
    lanes sum = V(set1_epi8)(0);
    if (census) {
        lanes first = bits_of(VSI(xor)(left->first, load_lanes(right[0] + at)));
        lanes second = bits_of(VSI(xor)(left->second, load_lanes(right[1] + at)));
        lanes third = bits_of(VSI(xor)(left->third, load_lanes(right[2] + at)));
        sum = V(add_epi8)(first, V(add_epi8)(second, third));
    }
    if (gray) {
        lanes other = load_lanes(right[3] + at), own = left->gray;
        lanes apart = VSI(or)(V(subs_epu8)(own, other), V(subs_epu8)(other, own));
        apart = V(min_epu8)(apart, V(set1_epi8)(32));
        sum = census ? V(add_epi8)(sum, apart) : apart;
    }
    return sum;
}

/* Pixel x and the steps from d on alone. */
static iris_row_pair rest_of(const iris_row_pair *pair, int32_t x, int32_t d)
{
    iris_row_pair rest = {.steps = pair->steps - d};
    for (int k = 0; k < 4; k++) {
        rest.left[k] = pair->left[k] ? pair->left[k] + x : NULL;
        rest.right[k] = pair->left[k] ? pair->right[k] - x + d : NULL;
    }
    return rest;
}

INLINE void costs_row(uint8_t *costs, const iris_row_pair *pair, int32_t n, int census, int gray)
{
    const int32_t steps = pair->steps, whole = steps / LANES * LANES;
    const iris_row_pair views = *pair;
    for (int32_t x = 0; x < n; x++, costs += steps) {
        const place left = place_at(&views, x, census, gray);
        for (int32_t d = 0; d < whole; d += LANES) {
            store_lanes(costs + d, costs_of(&left, views.right, d - x, census, gray));
        }
        if (whole < steps) {
            const iris_row_pair rest = rest_of(pair, x, whole);
            iris_row_costs_u8_c(costs + whole, &rest, 1);
        }
    }
}

void iris_row_costs_u8_sse(uint8_t *costs, const iris_row_pair *pair, int32_t n)
{
    if (!pair->left[3]) {
        costs_row(costs, pair, n, 1, 0);
    } else if (!pair->left[0]) {
        costs_row(costs, pair, n, 0, 1);
    } else {
        costs_row(costs, pair, n, 1, 1);
    }
}

/* Adds bytes with a sign to as many values. */
INLINE void add_bytes(uint16_t *sums, lanes bytes)
{
    bytes = in_order(bytes);
    lanes sign = V(cmpgt_epi8)(V(set1_epi8)(0), bytes);
    store_lanes(sums, V(add_epi16)(load_lanes(sums), V(unpacklo_epi8)(bytes, sign)));
    store_lanes(sums + HALVES, V(add_epi16)(load_lanes(sums + HALVES), V(unpackhi_epi8)(bytes, sign)));
}

INLINE void slide_row(uint16_t *sums, const iris_row_pair *enter, const iris_row_pair *leave, int32_t n,
                      int census, int gray)
{
    const int32_t steps = enter->steps, whole = steps / LANES * LANES;
    const iris_row_pair in = *enter, out = *leave;
    for (int32_t x = 0; x < n; x++, sums += steps) {
        const place more = place_at(&in, x, census, gray), less = place_at(&out, x, census, gray);
        for (int32_t d = 0; d < whole; d += LANES) {
            add_bytes(sums + d, V(sub_epi8)(costs_of(&more, in.right, d - x, census, gray),
                                            costs_of(&less, out.right, d - x, census, gray)));
        }
        if (whole < steps) {
            const iris_row_pair rest = rest_of(enter, x, whole), rest_out = rest_of(leave, x, whole);
            iris_row_slide_costs_u16_c(sums + whole, &rest, &rest_out, 1);
        }
    }
}

void iris_row_slide_costs_u16_sse(uint16_t *sums, const iris_row_pair *enter, const iris_row_pair *leave,
                                  int32_t n)
{
    if (!leave) {
        iris_row_slide_costs_u16_c(sums, enter, leave, n);
    } else if (!enter->left[3]) {
        slide_row(sums, enter, leave, n, 1, 0);
    } else if (!enter->left[0]) {
        slide_row(sums, enter, leave, n, 0, 1);
    } else {
        slide_row(sums, enter, leave, n, 1, 1);
    }
}

/* ---- sums of windows ---- */

/* `count` vectors of each pixel, which is a constant. */
INLINE void roll_vectors(uint16_t *sums, const uint16_t *enter, const uint16_t *leave, int32_t steps,
                         int32_t n, int count)
{
    lanes sum[4] = {V(set1_epi8)(0)};
    for (int k = 0; k < count && n > 0; k++) {
        sum[k] = load_lanes(sums - steps + k * HALVES);
    }
    for (int32_t x = 0; x < n; x++, sums += steps, enter += steps, leave += steps) {
        for (int k = 0; k < count; k++) {
            lanes more = V(sub_epi16)(load_lanes(enter + k * HALVES), load_lanes(leave + k * HALVES));
            sum[k] = V(add_epi16)(sum[k], more);
            store_lanes(sums + k * HALVES, sum[k]);
        }
    }
}

void iris_row_roll_u16_sse(uint16_t *sums, const uint16_t *enter, const uint16_t *leave, int32_t steps,
                           int32_t n)
{
    if (steps % HALVES != 0) {
        iris_row_roll_u16_c(sums, enter, leave, steps, n);
        return;
    }
    int32_t d = 0;
    for (; d <= steps - 4 * HALVES; d += 4 * HALVES) {
        roll_vectors(sums + d, enter + d, leave + d, steps, n, 4);
    }
    for (; d < steps; d += HALVES) {
        roll_vectors(sums + d, enter + d, leave + d, steps, n, 1);
    }
}

/* ---- the least ---- */

/* The least value, in all of them. */
INLINE lanes least_of(lanes values)
{
#ifdef __AVX2__
    __m128i half = _mm_min_epu16(_mm256_castsi256_si128(values), _mm256_extracti128_si256(values, 1));
    return _mm256_broadcastw_epi16(_mm_minpos_epu16(half));
#else
    return _mm_shuffle_epi8(_mm_minpos_epu16(values), _mm_set1_epi16(0x0100));
#endif
}

/* Which of 2 * HALVES values are `least`; those from `end` on are none. */
INLINE uint64_t matches(const uint16_t *costs, int32_t d, int32_t end, lanes least)
{
    lanes first = V(set1_epi8)(0), second = first;
    if (d >= end) {
        return 0;
    }
    first = V(cmpeq_epi16)(load_lanes(costs + d), least);
    if (d + HALVES < end) {
        second = V(cmpeq_epi16)(load_lanes(costs + d + HALVES), least);
    }
    return (uint32_t)V(movemask_epi8)(in_order(V(packs_epi16)(first, second)));
}

/* The step of the first least one; steps are whole vectors. */
INLINE int32_t first_least(const uint16_t *costs, int32_t steps)
{
    lanes all = load_lanes(costs);
    for (int32_t d = HALVES; d < steps; d += HALVES) {
        all = V(min_epu16)(all, load_lanes(costs + d));
    }
    const lanes least = least_of(all);
    int32_t d = 0;
    uint64_t mask = matches(costs, 0, steps, least) | matches(costs, LANES, steps, least) << LANES;
    while (mask == 0) {
        d += 2 * LANES;
        mask = matches(costs, d, steps, least) | matches(costs, d + LANES, steps, least) << LANES;
    }
    return d + __builtin_ctzll(mask);
}

void iris_row_least_u16_sse(const iris_row_least *to, const uint16_t *costs, int32_t steps, int32_t apart,
                            int32_t n)
{
    if (steps % HALVES != 0) {
        iris_row_least_u16_c(to, costs, steps, apart, n);
        return;
    }
    const iris_row_least at = *to;
    for (int32_t x = 0; x < n; x++, costs += apart) {
        int32_t step = first_least(costs, steps);
        int32_t inside = step > 0 && step < steps - 1;
        at.step[x] = (uint16_t)step;
        at.least[x] = costs[step];
        at.before[x] = costs[step - inside];
        at.behind[x] = costs[step + inside];
    }
}

/* ---- the right picture's view ---- */

/* Values from the one at `by`, 0 to 3, a constant, on; behind the last one there are the greatest. */
INLINE lanes from_value(lanes here, int by)
{
    const lanes none = V(set1_epi8)(-1);
#ifdef __AVX2__
    lanes over = _mm256_permute2x128_si256(here, none, 0x21);
#else
    lanes over = none;
#endif
    return by == 0   ? here
           : by == 1 ? V(alignr_epi8)(over, here, 2)
           : by == 2 ? V(alignr_epi8)(over, here, 4)
                     : V(alignr_epi8)(over, here, 6);
}

/* Least values and their steps. */
typedef struct {
    lanes least, step;
} seen;

/* The first of two, or the second one where that is less. */
INLINE seen lower(seen first, seen second)
{
    lanes least = V(min_epu16)(first.least, second.least);
    lanes same = V(cmpeq_epi16)(least, first.least);
    return (seen){least, V(blendv_epi8)(second.step, first.step, same)};
}

/* Four pixels, of which each is seen one place further on than the one before: the places from e on. */
INLINE seen four_pixels(const uint16_t *costs, int32_t steps, int32_t e, int is_last)
{
    const uint16_t *at = costs + e;
    lanes step = V(set1_epi16)((short)e);
#ifdef __AVX2__
    step = _mm256_add_epi16(step, _mm256_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
#else
    step = _mm_add_epi16(step, _mm_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7));
#endif
    seen pixel[4];
#pragma GCC unroll 4
    for (int j = 0; j < 4; j++, at += steps) {
        pixel[j].least = is_last ? from_value(load_lanes(at), j) : load_lanes(at + j);
        pixel[j].step = V(add_epi16)(step, V(set1_epi16)((short)j));
    }
    return lower(lower(pixel[0], pixel[1]), lower(pixel[2], pixel[3]));
}

INLINE void see(uint16_t *least, uint16_t *step, seen now)
{
    seen all = lower((seen){load_lanes(least), load_lanes(step)}, now);
    store_lanes(least, all.least);
    store_lanes(step, all.step);
}

void iris_row_facing_u16_sse(uint16_t *least, uint16_t *step, const uint16_t *costs, int32_t steps, int32_t n)
{
    int32_t x = 0;
    for (; x < n - 3 && steps % HALVES == 0; x += 4, costs += 4 * (ptrdiff_t)steps, least -= 4, step -= 4) {
        int32_t e = 0;
        for (; e < steps - HALVES; e += HALVES) {
            see(least + e, step + e, four_pixels(costs, steps, e, 0));
        }
        see(least + e, step + e, four_pixels(costs, steps, e, 1));
        for (int32_t j = 1; j < 4; j++) { /* places before the first one: the first steps of the others */
            iris_row_facing_u16_c(least - j, step - j, costs + (ptrdiff_t)j * steps, j, 1);
        }
    }
    iris_row_facing_u16_c(least, step, costs, steps, n - x);
}
