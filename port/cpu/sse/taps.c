/* Weighted sums of rows. Where a window's sums fit 16 bits, which small weights' do, taps side by side are taken in pairs
 * from where they lie, the sums of even and odd pixels apart. Other taps are brought side by side: two samples times
 * two weights are one instruction, of bytes with weights that fit a byte (NARROW), and of 16 bits (WIDE). */
#include "lanes.h"

enum { UNFIT, NARROW, WIDE, PAIRS = (IRIS_ROW_TAPS + 1) / 2 };

typedef struct {
    const uint8_t *a[PAIRS], *b[PAIRS];
    uint32_t weights[PAIRS]; /* two pairs of bytes, or a pair of 16 bits */
    int32_t pairs, kind;
    uint8_t end[PAIRS]; /* of groups of pairs whose sums fit 16 bits: 255 * 128 at most */
    int32_t groups;
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
    plan->groups = 0;
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
            plan->end[plan->groups++] = (uint8_t)p;
            in_group = 0;
        }
        in_group += first + second;
    }
    plan->end[plan->groups++] = (uint8_t)plan->pairs;
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
        plan->weights[p] = plan->kind == NARROW ? ((first & 0xff) | (second & 0xff) << 8) * 0x00010001u
                                                : (first & 0xffff) | second << 16;
    }
}

INLINE lanes weights_of(uint32_t weights)
{
    return V(set1_epi32)((int32_t)weights);
}

/* Adds the pairs from `first` to below `end`, of the pixels from i on, in 16 bits. */
INLINE void add_narrow(lanes sums[2], const tap_plan *plan, int32_t first, int32_t end, int32_t i)
{
    for (int32_t p = first; p < end; p++) {
        lanes a = load_lanes(plan->a[p] + i), b = load_lanes(plan->b[p] + i),
              w = weights_of(plan->weights[p]);
        sums[0] = V(add_epi16)(sums[0], V(maddubs_epi16)(V(unpacklo_epi8)(a, b), w));
        sums[1] = V(add_epi16)(sums[1], V(maddubs_epi16)(V(unpackhi_epi8)(a, b), w));
    }
}

INLINE void widen(lanes sums[4], const lanes half[2])
{
#pragma GCC unroll 4
    for (int h = 0; h < 2; h++) {
        lanes sign = V(srai_epi16)(half[h], 15);
        sums[2 * h] = V(add_epi32)(sums[2 * h], V(unpacklo_epi16)(half[h], sign));
        sums[2 * h + 1] = V(add_epi32)(sums[2 * h + 1], V(unpackhi_epi16)(half[h], sign));
    }
}

/* Adds all pairs, of LANES pixels from i on; the sums are in the order that bytes have when they are widened twice. */
INLINE void add_all(lanes sums[4], const tap_plan *plan, int32_t i)
{
    const lanes zero = VSI(setzero)();
    for (int32_t g = 0, p = 0; plan->kind == NARROW && g < plan->groups; p = plan->end[g++]) {
        lanes half[2] = {zero, zero};
        add_narrow(half, plan, p, plan->end[g], i);
        widen(sums, half);
    }
    for (int32_t p = 0; plan->kind == WIDE && p < plan->pairs; p++) {
        lanes a = load_lanes(plan->a[p] + i), b = load_lanes(plan->b[p] + i),
              w = weights_of(plan->weights[p]);
        lanes low = V(unpacklo_epi8)(a, b), high = V(unpackhi_epi8)(a, b);
        sums[0] = V(add_epi32)(sums[0], V(madd_epi16)(V(unpacklo_epi8)(low, zero), w));
        sums[1] = V(add_epi32)(sums[1], V(madd_epi16)(V(unpackhi_epi8)(low, zero), w));
        sums[2] = V(add_epi32)(sums[2], V(madd_epi16)(V(unpacklo_epi8)(high, zero), w));
        sums[3] = V(add_epi32)(sums[3], V(madd_epi16)(V(unpackhi_epi8)(high, zero), w));
    }
}

void iris_row_taps_u8_sse(int32_t *sums, const iris_row_tap *taps, int32_t count, int32_t n)
{
    tap_plan plan;
    make_plan(&plan, taps, count);
    int32_t whole = plan.kind == UNFIT ? 0 : n / LANES * LANES;
    for (int32_t i = 0; i < whole; i += LANES) {
        lanes all[4];
        uint8_t *at = (uint8_t *)(sums + i);
#pragma GCC unroll 4
        for (int v = 0; v < 4; v++) {
            all[v] = load_parts(at + 16 * v, 64);
        }
        add_all(all, &plan, i);
#pragma GCC unroll 4
        for (int v = 0; v < 4; v++) {
            store_parts(at + 16 * v, all[v], 64);
        }
    }
    for (int32_t k = 0; k < count && whole < n; k++) {
        iris_row_tap tap = {taps[k].src + whole, taps[k].weight};
        iris_row_taps_u8_c(sums + whole, &tap, 1, n - whole);
    }
}

/* How to divide sums of 32 bits: by a shift, or as the plain body does. */
typedef struct {
    int by_shift, shift;
    lanes divisor, limit, factor;
} division;

static division make_division(const iris_row_quotient *q)
{
    int by_shift = q->factor == (uint32_t)1 << 31;
    return (division){by_shift, by_shift ? q->shift - 31 : q->shift, V(set1_epi32)(q->divisor),
                      V(set1_epi32)(255 * q->divisor), V(set1_epi32)((int32_t)q->factor)};
}

/* Minus the quotient where sums are negative. */
INLINE lanes absolute_s32(lanes sum, const division *by)
{
    lanes negative = V(srai_epi32)(sum, 31);
    return V(add_epi32)(VSI(xor)(sum, negative), VSI(and)(negative, by->divisor));
}

INLINE lanes divide32(lanes sum, const division *by)
{
    sum = V(min_epi32)(V(max_epi32)(sum, VSI(setzero)()), by->limit);
    lanes even = V(srli_epi64)(V(mul_epu32)(sum, by->factor), by->shift);
    lanes odd = V(srli_epi64)(V(mul_epu32)(V(srli_epi64)(sum, 32), by->factor), by->shift);
    return VSI(or)(even, V(slli_epi64)(odd, 32));
}

/* Sums to bytes, in their order. */
INLINE lanes settle_all(const lanes given[4], const division *by, int absolute)
{
    lanes s[4] = {given[0], given[1], given[2], given[3]};
#pragma GCC unroll 4
    for (int v = 0; v < 4; v++) {
        s[v] = absolute ? absolute_s32(s[v], by) : s[v];
        s[v] = by->by_shift ? V(srai_epi32)(s[v], by->shift) : divide32(s[v], by);
    }
    return V(packus_epi16)(V(packs_epi32)(s[0], s[1]), V(packs_epi32)(s[2], s[3]));
}

/* What there is to do to a sum. */
typedef struct {
    int shifts;   /* instead of multiplying and shifting */
    int corrects; /* the quotient may be 1 too great */
    int absolute;
} settling;

/* A window whose sums fit 16 bits without a sign: `below` is added to all of them, and the most that the weights below 0
 * can make of bytes. Pairs of taps that lie side by side come first, those alone last. */
typedef struct {
    struct {
        const uint8_t *src;
        uint32_t even, odd; /* weights of the bytes of an even and of an odd pixel, twice */
    } tap[IRIS_ROW_TAPS];
    int32_t pairs, alone;
    int32_t below, most;   /* of all sums, with what is added */
    int32_t first;         /* what a sum begins with */
    int32_t shift, factor; /* to divide: the upper 16 bits of a product, shifted */
    settling how;
} byte_plan;

static inline int fits_byte(int32_t weight)
{
    return weight >= -127 && weight <= 127;
}

/* The sum of |weights|, or more than can be. */
static int32_t plan_taps(byte_plan *plan, const iris_row_tap *taps, int32_t count)
{
    int32_t sizes = 0, sum = 0, pairs = 0, alone = 0;
    plan->pairs = plan->alone = plan->below = 0;
    for (int32_t k = 0; k < count; k++) {
        int32_t weight = taps[k].weight, next = k + 1 < count ? taps[k + 1].weight : 0;
        if (!fits_byte(weight)) {
            return INT16_MAX;
        }
        int paired = k + 1 < count && taps[k + 1].src == taps[k].src + 1 && fits_byte(next) &&
                     size_of(weight) + size_of(next) <= 128;
        next = paired ? next : 0;
        int32_t at = paired ? pairs++ : IRIS_ROW_TAPS - ++alone;
        uint32_t low = (uint32_t)weight & 0xff;
        plan->tap[at].src = taps[k].src;
        plan->tap[at].even = (low | ((uint32_t)next & 0xff) << 8) * 0x00010001u;
        plan->tap[at].odd = low * 0x01000100u;
        sizes += size_of(weight) + size_of(next);
        sum += weight + next;
        k += paired;
    }
    plan->pairs = pairs;
    plan->alone = alone;
    plan->below = 255 * ((sizes - sum) / 2);
    return sizes;
}

/* 1 when such sums are divided by 16 bits too. The factor is 2^(16 + shift) / divisor rounded up, so that the quotient is
 * at most 1 too great; exact where the excess times the most is below 2^(16 + shift). */
static int plan_bytes(byte_plan *plan, const iris_row_tap *taps, int32_t count, const iris_row_quotient *q)
{
    int32_t sum = plan_taps(plan, taps, count);
    if (q->divisor > INT16_MAX || q->start < 0 || q->start > INT16_MAX) {
        return 0;
    }
    plan->first = q->start + plan->below;
    plan->most = q->start + 255 * sum;
    plan->shift = q->shift - 31;
    uint32_t divisor = (uint32_t)q->divisor, one = (uint32_t)65536 << plan->shift;
    uint32_t factor = (one + divisor - 1) / divisor, excess = factor * divisor - one;
    plan->factor = (int32_t)factor;
    uint64_t most = (uint64_t)(plan->most < 255 * q->divisor ? plan->most : 255 * q->divisor);
    plan->how = (settling){excess == 0, excess * most >= one, q->absolute};
    return plan->most + q->divisor <= UINT16_MAX;
}

typedef struct {
    lanes below, mirror, limit, factor, divisor;
} byte_division;

/* Quotients of sums that are `below` too great, 0 to 255. */
INLINE lanes settle_bytes(lanes sums, const byte_division *by, settling how, int shift)
{
    lanes n = V(subs_epu16)(sums, by->below);
    if (how.absolute) { /* what is less than the divisor on the other side does not count */
        n = V(max_epu16)(n, V(subs_epu16)(by->mirror, sums));
    }
    n = V(min_epu16)(n, by->limit);
    lanes quotient = V(srli_epi16)(how.shifts ? n : V(mulhi_epu16)(n, by->factor), shift);
    if (how.corrects) {
        lanes above = V(subs_epu16)(V(mullo_epi16)(quotient, by->divisor), n);
        lanes exact = V(cmpeq_epi16)(above, VSI(setzero)());
        quotient = V(sub_epi16)(V(sub_epi16)(quotient, V(set1_epi16)(1)), exact);
    }
    return quotient;
}

/* Sums of the pixels from i on, in `vectors` pairs of even and odd ones. */
INLINE void sum_bytes(lanes sums[4], const byte_plan *plan, int vectors, int32_t i)
{
#pragma GCC unroll 4
    for (int v = 0; v < 2 * vectors; v++) {
        sums[v] = V(set1_epi16)((int16_t)plan->first);
    }
    for (int32_t p = 0; p < plan->pairs; p++) {
        const uint8_t *src = plan->tap[p].src + i;
        lanes w = weights_of(plan->tap[p].even);
#pragma GCC unroll 4
        for (int v = 0; v < 2 * vectors; v++) {
            lanes bytes = load_lanes(src + v / 2 * LANES + v % 2);
            sums[v] = V(add_epi16)(sums[v], V(maddubs_epi16)(bytes, w));
        }
    }
    for (int32_t k = IRIS_ROW_TAPS - plan->alone; k < IRIS_ROW_TAPS; k++) {
        const uint8_t *src = plan->tap[k].src + i;
        lanes even = weights_of(plan->tap[k].even), odd = weights_of(plan->tap[k].odd);
#pragma GCC unroll 4
        for (int v = 0; v < 2 * vectors; v += 2) {
            lanes bytes = load_lanes(src + v / 2 * LANES);
            sums[v] = V(add_epi16)(sums[v], V(maddubs_epi16)(bytes, even));
            sums[v + 1] = V(add_epi16)(sums[v + 1], V(maddubs_epi16)(bytes, odd));
        }
    }
}

/* The last pixels of a row come again, where it is no multiple of the vectors. */
INLINE void filter_bytes(uint8_t *dst, const byte_plan *plan, const iris_row_quotient *q, int vectors,
                         settling how, int32_t n)
{
    const int32_t limit = 255 * q->divisor < UINT16_MAX ? 255 * q->divisor : UINT16_MAX,
                  width = vectors * LANES;
    const byte_division by = {V(set1_epi16)((int16_t)plan->below),
                              V(set1_epi16)((int16_t)(plan->below + q->divisor - 1)),
                              V(set1_epi16)((int16_t)limit), V(set1_epi16)((int16_t)plan->factor),
                              V(set1_epi16)((int16_t)q->divisor)};
    for (int32_t start = 0; start < n; start += width) {
        int32_t i = start < n - width ? start : n - width;
        lanes sums[4];
        sum_bytes(sums, plan, vectors, i);
#pragma GCC unroll 2
        for (int v = 0; v < 2 * vectors; v += 2) {
            lanes even = settle_bytes(sums[v], &by, how, plan->shift);
            lanes odd = settle_bytes(sums[v + 1], &by, how, plan->shift);
            store_lanes(dst + i + v / 2 * LANES, VSI(or)(even, V(slli_epi16)(odd, 8)));
        }
    }
}

/* Its vectors' stack is not the plan's. */
static __attribute__((noinline)) void filter_row(uint8_t *dst, const byte_plan *plan,
                                                 const iris_row_quotient *q, int32_t n)
{
    const settling any = plan->how;
    if (n < 2 * LANES) {
        filter_bytes(dst, plan, q, 1, any, n);
    } else if (any.absolute) {
        filter_bytes(dst, plan, q, 2, any, n);
    } else if (any.shifts) {
        filter_bytes(dst, plan, q, 2, (settling){1, 0, 0}, n);
    } else if (any.corrects) {
        filter_bytes(dst, plan, q, 2, (settling){0, 1, 0}, n);
    } else {
        filter_bytes(dst, plan, q, 2, (settling){0, 0, 0}, n);
    }
}

static int filter_by_bytes(uint8_t *dst, const iris_row_tap *taps, int32_t count,
                           const iris_row_quotient *quotient, int32_t n)
{
    byte_plan plan;
    if (!plan_bytes(&plan, taps, count, quotient)) {
        return 0;
    }
    filter_row(dst, &plan, quotient, n);
    return 1;
}

static void filter_by_sums(uint8_t *dst, const iris_row_tap *taps, int32_t count,
                           const iris_row_quotient *quotient, int32_t n)
{
    tap_plan plan;
    make_plan(&plan, taps, count);
    if (plan.kind == UNFIT) {
        iris_row_filter_u8_c(dst, taps, count, quotient, n);
        return;
    }
    const division by = make_division(quotient);
    const lanes begin = V(set1_epi32)(quotient->start);
    for (int32_t start = 0; start < n; start += LANES) {
        int32_t i = start < n - LANES ? start : n - LANES;
        lanes all[4] = {begin, begin, begin, begin};
        add_all(all, &plan, i);
        store_lanes(dst + i, settle_all(all, &by, quotient->absolute));
    }
}

void iris_row_filter_u8_sse(uint8_t *dst, const iris_row_tap *taps, int32_t count,
                            const iris_row_quotient *quotient, int32_t n)
{
    if (n < LANES) {
        iris_row_filter_u8_c(dst, taps, count, quotient, n);
    } else if (!filter_by_bytes(dst, taps, count, quotient, n)) {
        filter_by_sums(dst, taps, count, quotient, n);
    }
}
