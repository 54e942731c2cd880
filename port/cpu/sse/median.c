/* Medians of rows, sixteen samples at a time. The last ones of a row come again, where it is no multiple of sixteen. */
#include "vector.h"

#define INLINE static inline __attribute__((always_inline))

typedef __m128i median_value;

static inline median_value median_least(median_value a, median_value b)
{
    return _mm_min_epu8(a, b);
}

static inline median_value median_greatest(median_value a, median_value b)
{
    return _mm_max_epu8(a, b);
}

#include "kernel_median.h"

static inline median_value median9_at(const uint8_t *const rows[3], int32_t step, int32_t i)
{
    const uint8_t *above = rows[0] + i, *here = rows[1] + i, *below = rows[2] + i;
    median_value left[3] = {load16(above - step), load16(here - step), load16(below - step)};
    median_value center[3] = {load16(above), load16(here), load16(below)};
    median_value right[3] = {load16(above + step), load16(here + step), load16(below + step)};
    return median9(left, center, right);
}

/* Sixteen columns of three samples, sorted from above to below. */
typedef struct {
    median_value rank[3];
} columns_16;

static inline columns_16 sorted_at(const uint8_t *const rows[3], int32_t i)
{
    columns_16 sorted = {{load16(rows[0] + i), load16(rows[1] + i), load16(rows[2] + i)}};
    sort3(sorted.rank);
    return sorted;
}

/* The sixteen samples that begin `step` in front of those here, and behind: 1 or 3, a constant of each instruction. */
static inline median_value left_of(median_value here, median_value before, int32_t step)
{
    return step == 1 ? _mm_alignr_epi8(here, before, 15) : _mm_alignr_epi8(here, before, 13);
}

static inline median_value right_of(median_value here, median_value after, int32_t step)
{
    return step == 1 ? _mm_alignr_epi8(after, here, 1) : _mm_alignr_epi8(after, here, 3);
}

/* Each column is sorted once, and moved to where its neighbors need it. Returns how far that went: the sixteen columns
 * behind must be readable too. */
INLINE int32_t medians(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n)
{
    columns_16 before = sorted_at(rows, -step), here = sorted_at(rows, 0);
#pragma GCC unroll 3
    for (int r = 0; r < 3; r++) { /* its first columns are wanted last */
        before.rank[r] = right_of(_mm_setzero_si128(), before.rank[r], step);
    }
    int32_t i = 0;
    for (; i + 32 <= n + step; i += 16) {
        columns_16 after = sorted_at(rows, i + 16);
        median_value left[3], right[3];
#pragma GCC unroll 3
        for (int r = 0; r < 3; r++) {
            left[r] = left_of(here.rank[r], before.rank[r], step);
            right[r] = right_of(here.rank[r], after.rank[r], step);
        }
        store16(dst + i, median9_sorted(left, here.rank, right));
        before = here;
        here = after;
    }
    return i;
}

void iris_row_median9_u8_sse(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n)
{
    if (n < 16) {
        iris_row_median9_u8_c(dst, rows, step, n);
        return;
    }
    for (int32_t i = step == 1 ? medians(dst, rows, 1, n) : medians(dst, rows, 3, n); i < n; i += 16) {
        int32_t at = i < n - 16 ? i : n - 16;
        store16(dst + at, median9_at(rows, step, at));
    }
}

void iris_row_sort5_u8_sse(uint8_t *const sorted[5], const uint8_t *const rows[5], int32_t n)
{
    if (n < 16) {
        iris_row_sort5_u8_c(sorted, rows, n);
        return;
    }
    for (int32_t i = 0; i < n; i += 16) {
        int32_t at = i < n - 16 ? i : n - 16;
        median_value v[5] = {load16(rows[0] + at), load16(rows[1] + at), load16(rows[2] + at),
                             load16(rows[3] + at), load16(rows[4] + at)};
        sort5(v);
        for (int r = 0; r < 5; r++) {
            store16(sorted[r] + at, v[r]);
        }
    }
}

static inline void load5(median_value v[5], const uint8_t *row, int32_t step)
{
    v[0] = load16(row - 2 * step);
    v[1] = load16(row - step);
    v[2] = load16(row);
    v[3] = load16(row + step);
    v[4] = load16(row + 2 * step);
}

static inline median_value median25_at(const uint8_t *const sorted[5], int32_t step, int32_t i)
{
    median_value rank[5][5];
    load5(rank[0], sorted[0] + i, step);
    load5(rank[1], sorted[1] + i, step);
    load5(rank[2], sorted[2] + i, step);
    load5(rank[3], sorted[3] + i, step);
    load5(rank[4], sorted[4] + i, step);
    return median25(rank);
}

void iris_row_median25_u8_sse(uint8_t *dst, const uint8_t *const sorted[5], int32_t step, int32_t n)
{
    if (n < 16) {
        iris_row_median25_u8_c(dst, sorted, step, n);
        return;
    }
    for (int32_t i = 0; i < n; i += 16) {
        int32_t at = i < n - 16 ? i : n - 16;
        store16(dst + at, median25_at(sorted, step, at));
    }
}
