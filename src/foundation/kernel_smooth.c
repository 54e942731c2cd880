/* Medians of rows of 16 bits. */
#include "kernel.h"

typedef uint16_t median_value;

static inline median_value median_least(median_value a, median_value b)
{
    return a < b ? a : b;
}

static inline median_value median_greatest(median_value a, median_value b)
{
    return a < b ? b : a;
}

#include "kernel_median.h"

#define PIECE 32 /* pixels at a time, whose columns are sorted once */

static inline void load5(median_value v[5], const uint16_t *row)
{
    v[0] = row[0];
    v[1] = row[1];
    v[2] = row[2];
    v[3] = row[3];
    v[4] = row[4];
}

/* Columns of five rows from two pixels before i on. */
static void sort_columns(uint16_t sorted[5][PIECE + 4], const uint16_t *const rows[5], int32_t i, int32_t n)
{
    const uint16_t *a = rows[0] + i - 2, *b = rows[1] + i - 2, *c = rows[2] + i - 2, *d = rows[3] + i - 2;
    const uint16_t *e = rows[4] + i - 2;
    for (int32_t k = 0; k < n; k++) {
        median_value v[5] = {a[k], b[k], c[k], d[k], e[k]};
        sort5(v);
        sorted[0][k] = v[0];
        sorted[1][k] = v[1];
        sorted[2][k] = v[2];
        sorted[3][k] = v[3];
        sorted[4][k] = v[4];
    }
}

static void medians(uint16_t *restrict dst, uint16_t sorted[5][PIECE + 4], int32_t n)
{
    for (int32_t k = 0; k < n; k++) {
        median_value rank[5][5];
        load5(rank[0], sorted[0] + k);
        load5(rank[1], sorted[1] + k);
        load5(rank[2], sorted[2] + k);
        load5(rank[3], sorted[3] + k);
        load5(rank[4], sorted[4] + k);
        dst[k] = median25(rank);
    }
}

void iris_row_median25_u16_c(uint16_t *dst, const uint16_t *const rows[5], int32_t n)
{
    uint16_t sorted[5][PIECE + 4];
    for (int32_t i = 0; i < n; i += PIECE) {
        int32_t piece = n - i < PIECE ? n - i : PIECE;
        sort_columns(sorted, rows, i, piece + 4);
        medians(dst + i, sorted, piece);
    }
}
