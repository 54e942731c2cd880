/* Samples at other places: squares of 16 by 16 are transposed. */
#include "vector.h"

/* Row i and row i + 8 become every second byte of rows 2 i and 2 i + 1; four times, and rows are columns. */
static inline void interleave(__m128i to[16], const __m128i from[16])
{
    for (int k = 0; k < 8; k++) {
        to[2 * k] = _mm_unpacklo_epi8(from[k], from[k + 8]);
        to[2 * k + 1] = _mm_unpackhi_epi8(from[k], from[k + 8]);
    }
}

void iris_row_columns16_u8_sse(uint8_t *dst, ptrdiff_t stride, const uint8_t *const rows[16], int32_t n)
{
    int32_t i = 0;
    for (; i + 16 <= n; i += 16) {
        __m128i a[16], b[16];
        for (int k = 0; k < 16; k++) {
            a[k] = load16(rows[k] + i);
        }
        interleave(b, a);
        interleave(a, b);
        interleave(b, a);
        interleave(a, b);
        for (int k = 0; k < 16; k++, dst += stride) {
            store16(dst, a[k]);
        }
    }
    for (; i < n; i++, dst += stride) {
        for (int k = 0; k < 16; k++) {
            dst[k] = rows[k][i];
        }
    }
}
