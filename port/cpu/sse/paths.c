/* Semi-global paths, many steps of a pixel at once. */
#include "lanes.h"

enum { HALVES = LANES / 2 }; /* values of 16 bits */

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

/* Values beginning with the last one of those before; ending with the first one of those behind. */
INLINE lanes from_before(lanes before, lanes here)
{
#ifdef __AVX2__
    return _mm256_alignr_epi8(here, _mm256_permute2x128_si256(before, here, 0x21), 14);
#else
    return _mm_alignr_epi8(here, before, 14);
#endif
}

INLINE lanes to_behind(lanes here, lanes behind)
{
#ifdef __AVX2__
    return _mm256_alignr_epi8(_mm256_permute2x128_si256(here, behind, 0x21), here, 2);
#else
    return _mm_alignr_epi8(behind, here, 2);
#endif
}

INLINE lanes load_costs(const uint8_t *costs)
{
#ifdef __AVX2__
    return _mm256_cvtepu8_epi16(load16(costs));
#else
    return _mm_cvtepu8_epi16(_mm_loadl_epi64((const __m128i *)(const void *)costs));
#endif
}

/* A pixel's step: what it costs to come from the one before. */
typedef struct {
    lanes least, most, one;
} step_on;

INLINE step_on step_from(const uint16_t *paths, int32_t steps, lanes one, uint16_t leap)
{
    lanes all = load_lanes(paths);
    for (int32_t d = HALVES; d < steps; d += HALVES) {
        all = V(min_epu16)(all, load_lanes(paths + d));
    }
    lanes least = least_of(all);
    return (step_on){least, V(add_epi16)(least, V(set1_epi16)((short)leap)), one};
}

INLINE lanes reached(lanes own, lanes beside, lanes costs, const step_on *by)
{
    lanes best = V(min_epu16)(own, V(min_epu16)(V(add_epi16)(beside, by->one), by->most));
    return V(sub_epi16)(V(add_epi16)(best, costs), by->least);
}

/* Paths of a pixel; whole vectors. What was next to a vector is read before it is overwritten. */
INLINE void go_on(uint16_t *paths, const uint16_t *from, uint16_t *sums, const uint8_t *costs, int32_t steps,
                  const step_on *by)
{
    const lanes none = V(set1_epi8)(-1);
    lanes own = load_lanes(from), before = from_before(none, own);
    for (int32_t d = 0; d < steps; d += HALVES) {
        lanes next = none, before_next = none, behind;
        if (d + HALVES < steps) {
            next = load_lanes(from + d + HALVES);
            before_next = load_lanes(from + d + HALVES - 1);
            behind = load_lanes(from + d + 1);
        } else {
            behind = to_behind(own, none);
        }
        lanes made = reached(own, V(min_epu16)(before, behind), load_costs(costs + d), by);
        store_lanes(paths + d, made);
        if (sums) {
            store_lanes(sums + d, V(add_epi16)(load_lanes(sums + d), made));
        }
        own = next;
        before = before_next;
    }
}

void iris_row_paths_u16_sse(uint16_t *paths, const uint16_t *from, uint16_t *sums,
                            const iris_row_ground *ground, int32_t n)
{
    const int32_t steps = ground->steps;
    const uint8_t *costs = ground->costs;
    const lanes one = V(set1_epi16)((short)ground->one);
    if (steps % HALVES != 0) {
        iris_row_paths_u16_c(paths, from, sums, ground, n);
        return;
    }
    for (int32_t x = 0; x < n; x++, paths += steps, from += steps, costs += steps) {
        const step_on by = step_from(from, steps, one, ground->leaps[x]);
        if (sums) {
            go_on(paths, from, sums, costs, steps, &by);
            sums += steps;
        } else {
            go_on(paths, from, NULL, costs, steps, &by);
        }
    }
}

/* The same of the pixel beside: its paths were written a moment ago, and are read as they were written. */
INLINE void go_beside(uint16_t *paths, uint16_t *sums, const uint8_t *costs, int32_t steps, lanes one,
                      uint16_t leap)
{
    const lanes none = V(set1_epi8)(-1);
    const step_on by = step_from(paths, steps, one, leap);
    lanes before = none, own = load_lanes(paths);
    for (int32_t d = 0; d < steps; d += HALVES) {
        lanes behind = d + HALVES < steps ? load_lanes(paths + d + HALVES) : none;
        lanes beside = V(min_epu16)(from_before(before, own), to_behind(own, behind));
        lanes made = reached(own, beside, load_costs(costs + d), &by);
        store_lanes(paths + d, made);
        store_lanes(sums + d, V(add_epi16)(load_lanes(sums + d), made));
        before = own;
        own = behind;
    }
}

/* The same where paths stay in registers: `count` vectors, a constant. */
INLINE void go_in_registers(lanes *paths, uint16_t *sums, const uint8_t *costs, int count, lanes one,
                            uint16_t leap)
{
    const lanes none = V(set1_epi8)(-1);
    lanes all = paths[0], made[4];
#pragma GCC unroll 4
    for (int k = 1; k < count; k++) {
        all = V(min_epu16)(all, paths[k]);
    }
    const lanes least = least_of(all);
    const step_on by = {least, V(add_epi16)(least, V(set1_epi16)((short)leap)), one};
#pragma GCC unroll 4
    for (int k = 0; k < count; k++) {
        lanes before = from_before(k > 0 ? paths[k - 1] : none, paths[k]);
        lanes behind = to_behind(paths[k], k < count - 1 ? paths[k + 1] : none);
        made[k] = reached(paths[k], V(min_epu16)(before, behind), load_costs(costs + k * HALVES), &by);
        store_lanes(sums + k * HALVES, V(add_epi16)(load_lanes(sums + k * HALVES), made[k]));
    }
#pragma GCC unroll 4
    for (int k = 0; k < count; k++) {
        paths[k] = made[k];
    }
}

INLINE void along_in_registers(uint16_t *sums, const iris_row_ground *ground, int count, int32_t n)
{
    const int32_t steps = count * HALVES;
    const lanes one = V(set1_epi16)((short)ground->one), zero = V(set1_epi8)(0);
    const uint8_t *costs = ground->costs, *costs_right = costs + (ptrdiff_t)(n - 1) * steps;
    uint16_t *sums_right = sums + (ptrdiff_t)(n - 1) * steps;
    lanes right[4] = {zero, zero, zero, zero}, left[4] = {zero, zero, zero, zero};
    for (int32_t x = 0; x < n; x++) {
        go_in_registers(right, sums, costs, count, one, ground->leaps[x]);
        go_in_registers(left, sums_right, costs_right, count, one, ground->leaps[n - x]);
        sums += steps;
        costs += steps;
        sums_right -= steps;
        costs_right -= steps;
    }
}

static void along_two(uint16_t *sums, const iris_row_ground *ground, int32_t n)
{
    along_in_registers(sums, ground, 2, n);
}

static void along_four(uint16_t *sums, const iris_row_ground *ground, int32_t n)
{
    along_in_registers(sums, ground, 4, n);
}

/* Both ways at once: neither waits for the other one. */
void iris_row_paths_along_u16_sse(uint16_t *sums, uint16_t *room, const iris_row_ground *ground, int32_t n)
{
    const int32_t steps = ground->steps;
    const lanes one = V(set1_epi16)((short)ground->one);
    uint16_t *other = room + steps;
    if (steps % HALVES != 0) {
        iris_row_paths_along_u16_c(sums, room, ground, n);
        return;
    }
    if (steps == 4 * HALVES || steps == 2 * HALVES) {
        (steps == 2 * HALVES ? along_two : along_four)(sums, ground, n);
        return;
    }
    memset(room, 0, 4 * (size_t)steps);
    for (int32_t x = 0; x < n; x++) {
        int32_t from_right = n - 1 - x;
        ptrdiff_t at = (ptrdiff_t)x * steps, at_right = (ptrdiff_t)from_right * steps;
        go_beside(room, sums + at, ground->costs + at, steps, one, ground->leaps[x]);
        go_beside(other, sums + at_right, ground->costs + at_right, steps, one,
                  ground->leaps[from_right + 1]);
    }
}
