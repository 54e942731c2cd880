/* Medians of rows. */
#include "kernel.h"

typedef uint32_t median_value;

static inline median_value median_least(median_value a, median_value b)
{
    return a < b ? a : b;
}

static inline median_value median_greatest(median_value a, median_value b)
{
    return a < b ? b : a;
}

#include "kernel_median.h"

static inline void sorted_column(median_value v[3], const uint8_t *const rows[3], int32_t i)
{
    v[0] = rows[0][i];
    v[1] = rows[1][i];
    v[2] = rows[2][i];
    sort3(v);
}

/* Channel by channel: each column is read and sorted once. */
void iris_row_median9_u8_c(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n)
{
    const uint8_t *const around[3] = {rows[0], rows[1], rows[2]};
    for (int32_t c = 0; c < step && c < n; c++) {
        median_value left[3], here[3], right[3];
        sorted_column(left, around, c - step);
        sorted_column(here, around, c);
        for (int32_t i = c; i < n; i += step) {
            sorted_column(right, around, i + step);
            dst[i] = (uint8_t)median9_sorted(left, here, right);
            left[0] = here[0], left[1] = here[1], left[2] = here[2];
            here[0] = right[0], here[1] = right[1], here[2] = right[2];
        }
    }
}

void iris_row_sort5_u8_c(uint8_t *const sorted[5], const uint8_t *const rows[5], int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        median_value v[5] = {rows[0][i], rows[1][i], rows[2][i], rows[3][i], rows[4][i]};
        sort5(v);
        for (int r = 0; r < 5; r++) {
            sorted[r][i] = (uint8_t)v[r];
        }
    }
}

static inline void load5(median_value v[5], const uint8_t *row, int32_t step)
{
    v[0] = row[-2 * step];
    v[1] = row[-step];
    v[2] = row[0];
    v[3] = row[step];
    v[4] = row[2 * step];
}

void iris_row_median25_u8_c(uint8_t *dst, const uint8_t *const sorted[5], int32_t step, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        median_value rank[5][5];
        load5(rank[0], sorted[0] + i, step);
        load5(rank[1], sorted[1] + i, step);
        load5(rank[2], sorted[2] + i, step);
        load5(rank[3], sorted[3] + i, step);
        load5(rank[4], sorted[4] + i, step);
        dst[i] = (uint8_t)median25(rank);
    }
}
