/* Rows of distances, sixteen pixels at a time. Sums end at 65535. */
#include "vector.h"

void iris_row_select_u16_avx2(uint16_t *dst, const uint32_t *mask, int32_t n)
{
    const __m256i bits = _mm256_setr_epi16(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192,
                                           16384, (short)0x8000);
    int32_t i = 0;
    for (; i < n - 31; i += 32) {
        uint32_t word = mask[i / 32];
        __m256i low = _mm256_set1_epi16((short)word), high = _mm256_set1_epi16((short)(word >> 16));
        store32(dst + i, _mm256_cmpeq_epi16(_mm256_and_si256(low, bits), bits));
        store32(dst + i + 16, _mm256_cmpeq_epi16(_mm256_and_si256(high, bits), bits));
    }
    iris_row_select_u16_c(dst + i, mask + i / 32, n - i);
}

/* The last sixteen pixels may overlap those before them: what is near is near the second time too. n >= 16. */
static void reach_straight(uint16_t *row, const uint16_t *other, __m256i straight, int32_t n)
{
    for (int32_t x = 0; x < n; x += 16) {
        int32_t i = x > n - 16 ? n - 16 : x;
        store32(row + i, _mm256_min_epu16(load32(row + i), _mm256_adds_epu16(load32(other + i), straight)));
    }
}

/* The pixel at an end, of whose neighbors one is there. */
static void reach_end(uint16_t *pixel, uint32_t here, uint32_t beside, iris_row_steps steps)
{
    uint32_t straight = here + steps.straight, diagonal = beside + steps.diagonal;
    uint32_t near = straight < diagonal ? straight : diagonal;
    *pixel = near < *pixel ? (uint16_t)near : *pixel;
}

void iris_row_reach_u16_avx2(uint16_t *row, const uint16_t *other, iris_row_steps steps, int32_t n)
{
    const __m256i straight = _mm256_set1_epi16((short)steps.straight);
    const __m256i diagonal = _mm256_set1_epi16((short)steps.diagonal);
    if (n < 18) {
        iris_row_reach_u16_sse(row, other, steps, n);
        return;
    }
    if (steps.diagonal == 65535) {
        reach_straight(row, other, straight, n);
        return;
    }
    reach_end(row, other[0], other[1], steps);
    for (int32_t x = 1; x < n - 1; x += 16) {
        int32_t i = x > n - 17 ? n - 17 : x;
        __m256i beside = _mm256_min_epu16(load32(other + i - 1), load32(other + i + 1));
        __m256i near = _mm256_min_epu16(_mm256_adds_epu16(load32(other + i), straight),
                                        _mm256_adds_epu16(beside, diagonal));
        store32(row + i, _mm256_min_epu16(load32(row + i), near));
    }
    reach_end(row + n - 1, other[n - 1], other[n - 2], steps);
}

/* ---- along a row ---- */

/* The least of the sixteen and of those before them, with a step for each pixel between: by one, two and four pixels in each
 * half, and then on from the first half. */
static inline __m256i spread_right(__m256i v, __m256i step, __m256i ramp)
{
    const __m256i far = _mm256_set1_epi16(-1), last = _mm256_set1_epi16(0x0f0e);
    __m256i steps2 = _mm256_slli_epi16(step, 1), steps4 = _mm256_slli_epi16(step, 2);
    v = _mm256_min_epu16(v, _mm256_adds_epu16(_mm256_alignr_epi8(v, far, 14), step));
    v = _mm256_min_epu16(v, _mm256_adds_epu16(_mm256_alignr_epi8(v, far, 12), steps2));
    v = _mm256_min_epu16(v, _mm256_adds_epu16(_mm256_alignr_epi8(v, far, 8), steps4));
    __m256i carry = _mm256_shuffle_epi8(_mm256_permute2x128_si256(far, v, 0x20), last);
    return _mm256_min_epu16(v, _mm256_adds_epu16(carry, ramp));
}

static inline __m256i spread_left(__m256i v, __m256i step, __m256i ramp)
{
    const __m256i far = _mm256_set1_epi16(-1), first = _mm256_set1_epi16(0x0100);
    __m256i steps2 = _mm256_slli_epi16(step, 1), steps4 = _mm256_slli_epi16(step, 2);
    v = _mm256_min_epu16(v, _mm256_adds_epu16(_mm256_alignr_epi8(far, v, 2), step));
    v = _mm256_min_epu16(v, _mm256_adds_epu16(_mm256_alignr_epi8(far, v, 4), steps2));
    v = _mm256_min_epu16(v, _mm256_adds_epu16(_mm256_alignr_epi8(far, v, 8), steps4));
    __m256i carry = _mm256_shuffle_epi8(_mm256_permute2x128_si256(v, far, 0x31), first);
    return _mm256_min_epu16(v, _mm256_adds_epu16(carry, ramp));
}

/* Steps of a ramp in each half, and along all sixteen. */
static inline __m256i ramp_of(__m256i step, int16_t first, int16_t way)
{
    const __m256i at = _mm256_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    __m256i count =
        _mm256_add_epi16(_mm256_mullo_epi16(at, _mm256_set1_epi16(way)), _mm256_set1_epi16(first));
    return _mm256_mullo_epi16(count, step);
}

void iris_row_spread_right_u16_avx2(uint16_t *row, uint16_t step, int32_t n)
{
    const __m256i each = _mm256_set1_epi16((short)step), last = _mm256_set1_epi16(0x0f0e);
    const __m256i ramp = ramp_of(each, 1, 1), half = _mm256_permute4x64_epi64(ramp, 0x44);
    const __m256i sixteen = _mm256_slli_epi16(each, 4);
    __m256i before = _mm256_set1_epi16(-1); /* the pixel before, sixteen times */
    int32_t i = 0;
    for (; i < n - 15; i += 16) {
        __m256i v = spread_right(load32(row + i), each, half);
        store32(row + i, _mm256_min_epu16(v, _mm256_adds_epu16(before, ramp)));
        v = _mm256_shuffle_epi8(_mm256_permute4x64_epi64(v, 0xff), last);
        before = _mm256_min_epu16(v, _mm256_adds_epu16(before, sixteen));
    }
    uint32_t left = (uint16_t)_mm256_extract_epi16(before, 0);
    for (; i < n; i++) {
        left = left + step < row[i] ? left + step : row[i];
        row[i] = (uint16_t)left;
    }
}

void iris_row_spread_left_u16_avx2(uint16_t *row, uint16_t step, int32_t n)
{
    const __m256i each = _mm256_set1_epi16((short)step), first = _mm256_set1_epi16(0x0100);
    const __m256i ramp = ramp_of(each, 16, -1), half = _mm256_permute4x64_epi64(ramp, 0xee);
    const __m256i sixteen = _mm256_slli_epi16(each, 4);
    __m256i before = _mm256_set1_epi16(-1);
    int32_t i = n;
    for (; i > 15; i -= 16) {
        __m256i v = spread_left(load32(row + i - 16), each, half);
        store32(row + i - 16, _mm256_min_epu16(v, _mm256_adds_epu16(before, ramp)));
        v = _mm256_shuffle_epi8(_mm256_permute4x64_epi64(v, 0), first);
        before = _mm256_min_epu16(v, _mm256_adds_epu16(before, sixteen));
    }
    uint32_t right = (uint16_t)_mm256_extract_epi16(before, 0);
    for (; i > 0; i--) {
        right = right + step < row[i - 1] ? right + step : row[i - 1];
        row[i - 1] = (uint16_t)right;
    }
}
