/* Means of small square windows: all columns are added. */
#include "vector.h"

#include "kernel_box.h"

/* Up to this side that takes less than running sums. */
#define FEW 5

INLINE __m256i mean_16(const uint16_t *columns, int32_t side, int32_t step, __m256i add, __m256i factor)
{
    for (int32_t k = 0; k < side; k++) {
        add = _mm256_add_epi16(add, load32(columns + k * step));
    }
    return _mm256_mulhi_epu16(add, factor);
}

/* n >= 32. The last 32 may overlap those before them: dst and columns are disjoint. */
INLINE void few(uint8_t *dst, const uint16_t *columns, int32_t side, int32_t step, int32_t n)
{
    const box_division by = box_division_of(side);
    const __m256i factor = _mm256_set1_epi16((int16_t)by.factor), add = _mm256_set1_epi16((int16_t)by.add);
    const __m128i shift = _mm_cvtsi32_si128(by.shift - 16);
    for (int32_t x = 0; x < n; x += 32) {
        int32_t i = x < n - 32 ? x : n - 32;
        __m256i low = _mm256_srl_epi16(mean_16(columns + i, side, step, add, factor), shift);
        __m256i high = _mm256_srl_epi16(mean_16(columns + i + 16, side, step, add, factor), shift);
        store32(dst + i, _mm256_permute4x64_epi64(_mm256_packus_epi16(low, high), 0xd8));
    }
}

void iris_row_box_mean_u8_avx2(uint8_t *dst, const uint16_t *columns, int32_t side, int32_t step, int32_t n)
{
    if (n < 32 || side > FEW) {
        iris_row_box_mean_u8_sse(dst, columns, side, step, n);
    } else if (side == 3) {
        few(dst, columns, 3, step, n);
    } else {
        few(dst, columns, side, step, n);
    }
}
