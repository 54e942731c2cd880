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

/* ---- costs, of whole vectors of steps ---- */

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

INLINE void costs_row(uint8_t *costs, const iris_row_pair *pair, int32_t n, int census, int gray)
{
    const int32_t steps = pair->steps;
    const iris_row_pair views = *pair;
    for (int32_t x = 0; x < n; x++, costs += steps) {
        const place left = place_at(&views, x, census, gray);
        for (int32_t d = 0; d < steps; d += LANES) {
            store_lanes(costs + d, costs_of(&left, views.right, d - x, census, gray));
        }
    }
}

void iris_row_costs_u8_sse(uint8_t *costs, const iris_row_pair *pair, int32_t n)
{
    if (pair->steps % LANES != 0) {
        iris_row_costs_u8_c(costs, pair, n);
    } else if (!pair->left[3]) {
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
    const int32_t steps = enter->steps;
    const iris_row_pair in = *enter, out = *leave;
    for (int32_t x = 0; x < n; x++, sums += steps) {
        const place more = place_at(&in, x, census, gray), less = place_at(&out, x, census, gray);
        for (int32_t d = 0; d < steps; d += LANES) {
            add_bytes(sums + d, V(sub_epi8)(costs_of(&more, in.right, d - x, census, gray),
                                            costs_of(&less, out.right, d - x, census, gray)));
        }
    }
}

void iris_row_slide_costs_u16_sse(uint16_t *sums, const iris_row_pair *enter, const iris_row_pair *leave,
                                  int32_t n)
{
    if (!leave || enter->steps % LANES != 0) {
        iris_row_slide_costs_u16_c(sums, enter, leave, n);
    } else if (!enter->left[3]) {
        slide_row(sums, enter, leave, n, 1, 0);
    } else if (!enter->left[0]) {
        slide_row(sums, enter, leave, n, 0, 1);
    } else {
        slide_row(sums, enter, leave, n, 1, 1);
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
