/* Row kernels of morphology: the plain C bodies. */
#include "kernel.h"

void iris_row_max3_u8_c(uint8_t *dst, const uint8_t *a, const uint8_t *b, const uint8_t *c, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        uint8_t most = a[i] > b[i] ? a[i] : b[i];
        dst[i] = most > c[i] ? most : c[i];
    }
}

void iris_row_min3_u8_c(uint8_t *dst, const uint8_t *a, const uint8_t *b, const uint8_t *c, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        uint8_t least = a[i] < b[i] ? a[i] : b[i];
        dst[i] = least < c[i] ? least : c[i];
    }
}

static uint8_t most_at(const uint8_t *const rows[3], int32_t i)
{
    uint8_t most = rows[0][i] > rows[1][i] ? rows[0][i] : rows[1][i];
    return most > rows[2][i] ? most : rows[2][i];
}

static uint8_t least_at(const uint8_t *const rows[3], int32_t i)
{
    uint8_t least = rows[0][i] < rows[1][i] ? rows[0][i] : rows[1][i];
    return least < rows[2][i] ? least : rows[2][i];
}

void iris_row_max9_u8_c(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n)
{
    const uint8_t *const around[3] = {rows[0], rows[1], rows[2]};
    for (int32_t c = 0; c < step && c < n; c++) {
        uint8_t left = most_at(around, c - step), here = most_at(around, c);
        for (int32_t i = c; i < n; i += step) {
            uint8_t right = most_at(around, i + step), most = left > here ? left : here;
            dst[i] = most > right ? most : right;
            left = here;
            here = right;
        }
    }
}

void iris_row_min9_u8_c(uint8_t *dst, const uint8_t *const rows[3], int32_t step, int32_t n)
{
    const uint8_t *const around[3] = {rows[0], rows[1], rows[2]};
    for (int32_t c = 0; c < step && c < n; c++) {
        uint8_t left = least_at(around, c - step), here = least_at(around, c);
        for (int32_t i = c; i < n; i += step) {
            uint8_t right = least_at(around, i + step), least = left < here ? left : here;
            dst[i] = least < right ? least : right;
            left = here;
            here = right;
        }
    }
}

void iris_row_minus_u8_c(uint8_t *dst, const uint8_t *a, const uint8_t *b, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        uint8_t most = a[i] > b[i] ? a[i] : b[i]; /* which compilers know how to do with vectors */
        dst[i] = (uint8_t)(most - b[i]);
    }
}

/* 32 pixels from pixel `shift` of two words on. */
static inline uint32_t pixels_of(const uint32_t *words, int32_t shift)
{
    return words[0] >> shift | words[1] << 1 << (31 - shift);
}

void iris_row_join3_mask_c(uint32_t *dst, const uint32_t *src, const int32_t at[3], uint32_t all,
                           int32_t words)
{
    const uint32_t *a = src + (at[0] >> 5), *b = src + (at[1] >> 5), *c = src + (at[2] >> 5);
    int32_t shift_a = at[0] & 31, shift_b = at[1] & 31, shift_c = at[2] & 31;
    for (int32_t i = 0; i < words; i++) {
        uint32_t joined = pixels_of(a + i, shift_a) ^ all; /* and is or of the negatives */
        joined |= pixels_of(b + i, shift_b) ^ all;
        joined |= pixels_of(c + i, shift_c) ^ all;
        dst[i] = joined ^ all;
    }
}

static inline uint32_t join3(uint32_t a, uint32_t b, uint32_t c, uint32_t all)
{
    return all ? a & b & c : a | b | c;
}

void iris_row_join_rows_mask_c(uint32_t *dst, const uint32_t *a, const uint32_t *b, const uint32_t *c,
                               uint32_t all, int32_t words)
{
    for (int32_t i = 0; all && i < words; i++) {
        dst[i] = a[i] & b[i] & c[i];
    }
    for (int32_t i = 0; !all && i < words; i++) {
        dst[i] = a[i] | b[i] | c[i];
    }
}

void iris_row_join9_mask_c(uint32_t *dst, const uint32_t *const rows[3], const uint32_t beside[2],
                           uint32_t all, int32_t words)
{
    const uint32_t *a = rows[0], *b = rows[1], *c = rows[2];
    uint32_t left = beside[0], here = words > 0 ? join3(a[0], b[0], c[0], all) : 0;
    for (int32_t i = 0; i < words; i++) {
        uint32_t right = i + 1 < words ? join3(a[i + 1], b[i + 1], c[i + 1], all) : beside[1];
        dst[i] = join3(left >> 31 | here << 1, here, here >> 1 | right << 31, all);
        left = here;
        here = right;
    }
}

void iris_row_agree_mask_c(uint32_t *dst, const uint32_t *src, int32_t at, uint32_t turn, int32_t words)
{
    const uint32_t *from = src + (at >> 5);
    for (int32_t i = 0; i < words; i++) {
        dst[i] &= pixels_of(from + i, at & 31) ^ turn;
    }
}
