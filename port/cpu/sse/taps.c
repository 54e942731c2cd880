/* Weighted sums of rows. Taps are taken in pairs: two samples side by side times two weights are one instruction, of
 * bytes with weights that fit a byte (NARROW), and of 16 bits (WIDE). Narrow sums stay in 16 bits as long as they
 * fit. */
#include "vector.h"

#define INLINE static inline __attribute__((always_inline))

enum { UNFIT, NARROW, WIDE, PAIRS = IRIS_ROW_TAPS / 2 };

typedef struct {
    const uint8_t *a[PAIRS], *b[PAIRS];
    __m128i weights[PAIRS];
    int32_t pairs, kind;
    int32_t end[PAIRS];  /* of groups of pairs whose sums fit 16 bits: 255 * 128 at most */
    int32_t groups, sum; /* of |weights| */
} tap_plan;

static inline int32_t size_of(int32_t weight)
{
    return weight < 0 ? -weight : weight;
}

/* What the weights fit, and the groups. */
static void judge(tap_plan *plan, const iris_row_tap *taps, int32_t count)
{
    int32_t in_group = 0, largest = 0;
    plan->kind = NARROW;
    plan->pairs = (count + 1) / 2;
    plan->groups = plan->sum = 0;
    for (int32_t p = 0; p < plan->pairs; p++) {
        int32_t first = size_of(taps[2 * p].weight),
                second = 2 * p + 1 < count ? size_of(taps[2 * p + 1].weight) : 0;
        largest = first > largest ? first : largest;
        largest = second > largest ? second : largest;
        if (first > 127 || second > 127 || first + second > 128) {
            plan->kind = WIDE;
            continue;
        }
        if (in_group + first + second > 128) {
            plan->end[plan->groups++] = p;
            in_group = 0;
        }
        in_group += first + second;
        plan->sum += first + second;
    }
    plan->end[plan->groups++] = plan->pairs;
    plan->kind = largest > INT16_MAX ? UNFIT : plan->kind;
}

static void make_plan(tap_plan *plan, const iris_row_tap *taps, int32_t count)
{
    judge(plan, taps, count);
    for (int32_t p = 0; p < plan->pairs && plan->kind != UNFIT; p++) {
        int paired = 2 * p + 1 < count;
        uint32_t first = (uint32_t)taps[2 * p].weight, second = paired ? (uint32_t)taps[2 * p + 1].weight : 0;
        plan->a[p] = taps[2 * p].src;
        plan->b[p] = taps[2 * p + (paired ? 1 : 0)].src;
        plan->weights[p] = plan->kind == NARROW ? _mm_set1_epi16((int16_t)((first & 0xff) | second << 8))
                                                : _mm_set1_epi32((int32_t)((first & 0xffff) | second << 16));
    }
}

/* Adds the pairs from `first` to below `end`, of 16 pixels at i, in 16 bits. */
INLINE void add_narrow(__m128i sums[2], const tap_plan *plan, int32_t first, int32_t end, int32_t i)
{
#pragma GCC unroll 5
    for (int32_t p = first; p < end; p++) {
        __m128i a = load16(plan->a[p] + i), b = load16(plan->b[p] + i);
        sums[0] = _mm_add_epi16(sums[0], _mm_maddubs_epi16(_mm_unpacklo_epi8(a, b), plan->weights[p]));
        sums[1] = _mm_add_epi16(sums[1], _mm_maddubs_epi16(_mm_unpackhi_epi8(a, b), plan->weights[p]));
    }
}

INLINE void widen(__m128i sums[4], const __m128i half[2])
{
#pragma GCC unroll 4
    for (int h = 0; h < 2; h++) {
        sums[2 * h] = _mm_add_epi32(sums[2 * h], _mm_cvtepi16_epi32(half[h]));
        sums[2 * h + 1] = _mm_add_epi32(sums[2 * h + 1], _mm_cvtepi16_epi32(_mm_srli_si128(half[h], 8)));
    }
}

/* Adds all pairs, of 16 pixels at i. */
INLINE void add_all(__m128i sums[4], const tap_plan *plan, int32_t i)
{
    const __m128i zero = _mm_setzero_si128();
    for (int32_t g = 0, p = 0; plan->kind == NARROW && g < plan->groups; p = plan->end[g++]) {
        __m128i half[2] = {zero, zero};
        add_narrow(half, plan, p, plan->end[g], i);
        widen(sums, half);
    }
    for (int32_t p = 0; plan->kind == WIDE && p < plan->pairs; p++) {
        __m128i a = load16(plan->a[p] + i), b = load16(plan->b[p] + i), w = plan->weights[p];
        __m128i low = _mm_unpacklo_epi8(a, b), high = _mm_unpackhi_epi8(a, b);
        sums[0] = _mm_add_epi32(sums[0], _mm_madd_epi16(_mm_unpacklo_epi8(low, zero), w));
        sums[1] = _mm_add_epi32(sums[1], _mm_madd_epi16(_mm_unpackhi_epi8(low, zero), w));
        sums[2] = _mm_add_epi32(sums[2], _mm_madd_epi16(_mm_unpacklo_epi8(high, zero), w));
        sums[3] = _mm_add_epi32(sums[3], _mm_madd_epi16(_mm_unpackhi_epi8(high, zero), w));
    }
}

void iris_row_taps_u8_sse(int32_t *sums, const iris_row_tap *taps, int32_t count, int32_t n)
{
    tap_plan plan;
    make_plan(&plan, taps, count);
    int32_t whole = plan.kind == UNFIT ? 0 : n / 16 * 16;
    for (int32_t i = 0; i < whole; i += 16) {
        __m128i all[4];
#pragma GCC unroll 4
        for (int v = 0; v < 4; v++) {
            all[v] = load16(sums + i + 4 * v);
        }
        add_all(all, &plan, i);
#pragma GCC unroll 4
        for (int v = 0; v < 4; v++) {
            store16(sums + i + 4 * v, all[v]);
        }
    }
    for (int32_t k = 0; k < count && whole < n; k++) {
        iris_row_tap tap = {taps[k].src + whole, taps[k].weight};
        iris_row_taps_u8_c(sums + whole, &tap, 1, n - whole);
    }
}

/* How to divide: by a shift; by a factor of 16 bits, where that is exact for all sums up to 255 * divisor, which fit 16
 * bits too; or as the plain body does. */
typedef struct {
    enum { BY_SHIFT, BY_FACTOR16, BY_FACTOR32 } how;
    int shift;
    uint32_t factor16;
    __m128i divisor, limit, factor;
} division;

static division make_division(const iris_row_quotient *q)
{
    division by = {BY_FACTOR32,
                   q->shift,
                   0,
                   _mm_set1_epi32(q->divisor),
                   _mm_set1_epi32(255 * q->divisor),
                   _mm_set1_epi32((int32_t)q->factor)};
    int power = q->shift - 31; /* of two, the largest not above the divisor */
    uint32_t divisor = (uint32_t)q->divisor, one = (uint32_t)65536 << (power < 8 ? power : 8);
    uint32_t factor = (one + divisor - 1) / divisor, excess = factor * divisor - one;
    if (q->divisor == (int32_t)1 << power) {
        by.how = BY_SHIFT;
        by.shift = power;
    } else if (divisor <= 257 && excess * 255 * divisor < one) {
        by.how = BY_FACTOR16;
        by.shift = power;
        by.factor16 = factor;
    }
    return by;
}

/* Four sums: minus the quotient where they are negative. */
INLINE __m128i absolute_s32(__m128i sum, const division *by)
{
    __m128i negative = _mm_srai_epi32(sum, 31);
    return _mm_add_epi32(_mm_xor_si128(sum, negative), _mm_and_si128(negative, by->divisor));
}

INLINE __m128i divide32(__m128i sum, const division *by)
{
    sum = _mm_min_epi32(_mm_max_epi32(sum, _mm_setzero_si128()), by->limit);
    __m128i even = _mm_srli_epi64(_mm_mul_epu32(sum, by->factor), by->shift);
    __m128i odd = _mm_srli_epi64(_mm_mul_epu32(_mm_srli_epi64(sum, 32), by->factor), by->shift);
    return _mm_or_si128(even, _mm_slli_epi64(odd, 32));
}

/* 16 sums to bytes. */
INLINE __m128i settle_16(const __m128i given[4], const division *by, int absolute)
{
    __m128i s[4] = {given[0], given[1], given[2], given[3]};
#pragma GCC unroll 4
    for (int v = 0; v < 4 && absolute; v++) {
        s[v] = absolute_s32(s[v], by);
    }
    if (by->how == BY_FACTOR16) {
        __m128i limit = _mm_packus_epi32(by->limit, by->limit),
                factor = _mm_set1_epi16((int16_t)by->factor16);
        __m128i low = _mm_min_epu16(_mm_packus_epi32(s[0], s[1]), limit);
        __m128i high = _mm_min_epu16(_mm_packus_epi32(s[2], s[3]), limit);
        return _mm_packus_epi16(_mm_srli_epi16(_mm_mulhi_epu16(low, factor), by->shift),
                                _mm_srli_epi16(_mm_mulhi_epu16(high, factor), by->shift));
    }
#pragma GCC unroll 4
    for (int v = 0; v < 4; v++) {
        s[v] = by->how == BY_SHIFT ? _mm_srai_epi32(s[v], by->shift) : divide32(s[v], by);
    }
    return _mm_packus_epi16(_mm_packs_epi32(s[0], s[1]), _mm_packs_epi32(s[2], s[3]));
}

/* 16 sums of 16 bits to bytes. */
INLINE __m128i settle_narrow(__m128i low, __m128i high, const division *by, int32_t divisor, int absolute)
{
    const __m128i zero = _mm_setzero_si128(), limit = _mm_set1_epi16((int16_t)(255 * divisor));
    const __m128i factor = _mm_set1_epi16((int16_t)by->factor16), one = _mm_set1_epi16((int16_t)divisor);
    if (absolute) {
        __m128i below = _mm_srai_epi16(low, 15), below_too = _mm_srai_epi16(high, 15);
        low = _mm_add_epi16(_mm_xor_si128(low, below), _mm_and_si128(below, one));
        high = _mm_add_epi16(_mm_xor_si128(high, below_too), _mm_and_si128(below_too, one));
    }
    if (by->how == BY_SHIFT) {
        return _mm_packus_epi16(_mm_srai_epi16(low, by->shift), _mm_srai_epi16(high, by->shift));
    }
    low = _mm_mulhi_epu16(_mm_min_epi16(_mm_max_epi16(low, zero), limit), factor);
    high = _mm_mulhi_epu16(_mm_min_epi16(_mm_max_epi16(high, zero), limit), factor);
    return _mm_packus_epi16(_mm_srli_epi16(low, by->shift), _mm_srli_epi16(high, by->shift));
}

INLINE void filter_narrow(uint8_t *dst, const tap_plan *plan, const iris_row_quotient *q, int32_t pairs,
                          int32_t n)
{
    const division by = make_division(q);
    const __m128i start = _mm_set1_epi16((int16_t)q->start);
    for (int32_t i = 0; i < n; i += 16) {
        int32_t at = i < n - 16 ? i : n - 16;
        __m128i sums[2] = {start, start};
        add_narrow(sums, plan, 0, pairs, at);
        store16(dst + at, settle_narrow(sums[0], sums[1], &by, q->divisor, q->absolute));
    }
}

/* Everything fits 16 bits, up to the division. */
static int fits_narrow(const tap_plan *plan, const iris_row_quotient *q)
{
    int32_t start = size_of(q->start);
    return plan->kind == NARROW && plan->groups == 1 && start <= INT16_MAX - 255 * plan->sum &&
           q->divisor <= 128 && make_division(q).how != BY_FACTOR32;
}

void iris_row_filter_u8_sse(uint8_t *dst, const iris_row_tap *taps, int32_t count,
                            const iris_row_quotient *quotient, int32_t n)
{
    tap_plan plan;
    make_plan(&plan, taps, count);
    if (plan.kind == UNFIT || n < 16) {
        iris_row_filter_u8_c(dst, taps, count, quotient, n);
        return;
    }
    if (fits_narrow(&plan, quotient)) {
        if (plan.pairs == 5) { /* 3x3 */
            filter_narrow(dst, &plan, quotient, 5, n);
        } else if (plan.pairs == 3) { /* a cross */
            filter_narrow(dst, &plan, quotient, 3, n);
        } else {
            filter_narrow(dst, &plan, quotient, plan.pairs, n);
        }
        return;
    }
    const division by = make_division(quotient);
    const __m128i start = _mm_set1_epi32(quotient->start);
    for (int32_t i = 0; i < n; i += 16) {
        int32_t at = i < n - 16 ? i : n - 16;
        __m128i all[4] = {start, start, start, start};
        add_all(all, &plan, at);
        store16(dst + at, settle_16(all, &by, quotient->absolute));
    }
}
