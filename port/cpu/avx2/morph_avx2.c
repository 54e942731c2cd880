/* The largest and the smallest around, 32 samples at a time. */
#include "vector.h"

/* `least` and `step` are constants in the following functions, so that each is compiled for all of them. */
INLINE __m256i join(__m256i a, __m256i b, int least)
{
    return least ? _mm256_min_epu8(a, b) : _mm256_max_epu8(a, b);
}

/* The columns of three rows. */
INLINE __m256i column_at(const uint8_t *const rows[3], int32_t i, int least)
{
    return join(join(load32(rows[0] + i), load32(rows[1] + i), least), load32(rows[2] + i), least);
}

INLINE __m256i around_at(const uint8_t *const rows[3], int32_t i, int32_t step, int least)
{
    __m256i beside = join(column_at(rows, i - step, least), column_at(rows, i + step, least), least);
    return join(beside, column_at(rows, i, least), least);
}

/* n >= 32. Each column is looked at once, as long as the next 32 are there. */
INLINE void around_row(uint8_t *dst, const uint8_t *const from[3], int32_t step, int32_t n, int least)
{
    const uint8_t *const rows[3] = {from[0], from[1], from[2]};
    __m256i left = column_at(rows, -step, least), here = column_at(rows, 0, least);
    int32_t i = 0;
#pragma GCC unroll 2
    for (; i < n - 63; i += 32) {
        __m256i next = column_at(rows, i + 32, least), middle = between(here, next);
        store32(dst + i, join(join(left, here, least), behind(here, middle, step), least));
        left = before(middle, next, step);
        here = next;
    }
    if (i < n - 32) {
        store32(dst + i, join(join(left, here, least), column_at(rows, i + step, least), least));
    }
    store32(dst + n - 32, around_at(rows, n - 32, step, least));
}

void iris_row_max9_u8_avx2(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n)
{
    if (n < 32) {
        iris_row_max9_u8_sse(dst, rows, step, n);
    } else if (step == 1) {
        around_row(dst, rows, 1, n, 0);
    } else {
        around_row(dst, rows, 3, n, 0);
    }
}

void iris_row_min9_u8_avx2(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n)
{
    if (n < 32) {
        iris_row_min9_u8_sse(dst, rows, step, n);
    } else if (step == 1) {
        around_row(dst, rows, 1, n, 1);
    } else {
        around_row(dst, rows, 3, n, 1);
    }
}
