/* Medians of rows, 32 samples at a time. The last ones of a row come again, where it is no multiple of 32. */
#include "vector.h"

typedef __m256i median_value;

static inline median_value median_least(median_value a, median_value b)
{
    return _mm256_min_epu8(a, b);
}

static inline median_value median_greatest(median_value a, median_value b)
{
    return _mm256_max_epu8(a, b);
}

#include "kernel_median.h"

/* 32 columns of three samples, sorted from above to below. */
typedef struct {
    median_value rank[3];
} columns_32;

INLINE columns_32 sorted_at(const uint8_t *const rows[3], int32_t i)
{
    columns_32 sorted = {{load32(rows[0] + i), load32(rows[1] + i), load32(rows[2] + i)}};
    sort3(sorted.rank);
    return sorted;
}

/* n >= 32. Each column is sorted once, as long as the next 32 are there. */
INLINE void medians(uint8_t *dst, const uint8_t *const from[3], int32_t step, int32_t n)
{
    const uint8_t *const rows[3] = {from[0], from[1], from[2]};
    columns_32 left = sorted_at(rows, -step), here = sorted_at(rows, 0), right;
    int32_t i = 0;
    for (; i < n - 63; i += 32) {
        columns_32 next = sorted_at(rows, i + 32), middle;
#pragma GCC unroll 3
        for (int r = 0; r < 3; r++) {
            middle.rank[r] = between(here.rank[r], next.rank[r]);
            right.rank[r] = behind(here.rank[r], middle.rank[r], step);
        }
        store32(dst + i, median9_sorted(left.rank, here.rank, right.rank));
#pragma GCC unroll 3
        for (int r = 0; r < 3; r++) {
            left.rank[r] = before(middle.rank[r], next.rank[r], step);
        }
        here = next;
    }
    if (i < n - 32) {
        right = sorted_at(rows, i + step);
        store32(dst + i, median9_sorted(left.rank, here.rank, right.rank));
    }
    i = n - 32;
    left = sorted_at(rows, i - step);
    here = sorted_at(rows, i);
    right = sorted_at(rows, i + step);
    store32(dst + i, median9_sorted(left.rank, here.rank, right.rank));
}

void iris_row_median9_u8_avx2(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n)
{
    if (n < 32) {
        iris_row_median9_u8_sse(dst, rows, step, n);
    } else if (step == 1) {
        medians(dst, rows, 1, n);
    } else {
        medians(dst, rows, 3, n);
    }
}

void iris_row_sort5_u8_avx2(uint8_t *const sorted[5], const uint8_t *const rows[5], int32_t n)
{
    if (n < 32) {
        iris_row_sort5_u8_sse(sorted, rows, n);
        return;
    }
    for (int32_t i = 0; i < n; i += 32) {
        int32_t at = i < n - 32 ? i : n - 32;
        median_value v[5] = {load32(rows[0] + at), load32(rows[1] + at), load32(rows[2] + at),
                             load32(rows[3] + at), load32(rows[4] + at)};
        sort5(v);
        for (int r = 0; r < 5; r++) {
            store32(sorted[r] + at, v[r]);
        }
    }
}

static inline void load5(median_value v[5], const uint8_t *row, int32_t step)
{
    v[0] = load32(row - 2 * step);
    v[1] = load32(row - step);
    v[2] = load32(row);
    v[3] = load32(row + step);
    v[4] = load32(row + 2 * step);
}

void iris_row_median25_u8_avx2(uint8_t *dst, const uint8_t *const sorted[5], int32_t step, int32_t n)
{
    if (n < 32) {
        iris_row_median25_u8_sse(dst, sorted, step, n);
        return;
    }
    for (int32_t i = 0; i < n; i += 32) {
        int32_t at = i < n - 32 ? i : n - 32;
        median_value rank[5][5];
        for (int r = 0; r < 5; r++) {
            load5(rank[r], sorted[r] + at, step);
        }
        store32(dst + at, median25(rank));
    }
}
