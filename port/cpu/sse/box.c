/* Means of square windows: running sums, made of the differences of what enters and what leaves. */
#include "kernel_box.h"

#include "vector.h"

#define INLINE static inline __attribute__((always_inline))

/* Lane i plus all lanes i - step, i - 2 step... */
INLINE __m128i scan_u16(__m128i v, int32_t step)
{
    if (step == 1) {
        v = _mm_add_epi16(v, _mm_slli_si128(v, 2));
        v = _mm_add_epi16(v, _mm_slli_si128(v, 4));
        return _mm_add_epi16(v, _mm_slli_si128(v, 8));
    }
    v = _mm_add_epi16(v, _mm_slli_si128(v, 6));
    return _mm_add_epi16(v, _mm_slli_si128(v, 12));
}

/* Eight means. total goes on to the next eight. */
INLINE __m128i narrow_8(__m128i *total, const uint16_t *columns, int32_t side, int32_t step, __m128i factor)
{
    const __m128i last = step == 1
                             ? _mm_set1_epi16(0x0f0e)
                             : _mm_setr_epi16(0x0b0a, 0x0d0c, 0x0f0e, 0x0b0a, 0x0d0c, 0x0f0e, 0x0b0a, 0x0d0c);
    __m128i leave = load16(columns);
    __m128i change = scan_u16(_mm_sub_epi16(load16(columns + (side - 1) * step), leave), step);
    __m128i after = _mm_add_epi16(*total, change); /* each sample's first column has left */
    *total = _mm_shuffle_epi8(after, last);
    return _mm_mulhi_epu16(_mm_add_epi16(after, leave), factor);
}

INLINE void narrow(uint8_t *dst, const uint16_t *columns, int32_t side, int32_t step, int32_t n)
{
    const box_division by = box_division_of(side);
    const __m128i factor = _mm_set1_epi16((int16_t)by.factor), shift = _mm_cvtsi32_si128(by.shift - 16);
    uint32_t totals[8];
    box_begin(totals, columns, side, step, by.add);
    __m128i total = _mm_packus_epi32(load16(totals), load16(totals + 4));
    for (int32_t i = 0; i < n; i += 16) {
        __m128i low = narrow_8(&total, columns + i, side, step, factor);
        __m128i high = narrow_8(&total, columns + i + 8, side, step, factor);
        store16(dst + i, _mm_packus_epi16(_mm_srl_epi16(low, shift), _mm_srl_epi16(high, shift)));
    }
}

/* Up to this side, adding all columns takes less. */
#define FEW 5

static void few(uint8_t *dst, const uint16_t *columns, int32_t side, int32_t step, int32_t n)
{
    const box_division by = box_division_of(side);
    const __m128i factor = _mm_set1_epi16((int16_t)by.factor), shift = _mm_cvtsi32_si128(by.shift - 16);
    const __m128i add = _mm_set1_epi16((int16_t)by.add);
    for (int32_t i = 0; i < n; i += 16) {
        __m128i low = add, high = add;
        for (int32_t k = 0; k < side; k++) {
            low = _mm_add_epi16(low, load16(columns + i + k * step));
            high = _mm_add_epi16(high, load16(columns + i + k * step + 8));
        }
        low = _mm_srl_epi16(_mm_mulhi_epu16(low, factor), shift);
        high = _mm_srl_epi16(_mm_mulhi_epu16(high, factor), shift);
        store16(dst + i, _mm_packus_epi16(low, high));
    }
}

INLINE __m128i scan_u32(__m128i v, int32_t step)
{
    if (step == 1) {
        v = _mm_add_epi32(v, _mm_slli_si128(v, 4));
        return _mm_add_epi32(v, _mm_slli_si128(v, 8));
    }
    return _mm_add_epi32(v, _mm_slli_si128(v, 12));
}

INLINE __m128i load_u16(const uint16_t *from)
{
    return _mm_cvtepu16_epi32(_mm_loadl_epi64((const __m128i *)(const void *)from));
}

/* Four means, times 2^(shift - 32). */
INLINE __m128i wide_4(__m128i *total, const uint16_t *columns, int32_t side, int32_t step, __m128i factor)
{
    __m128i leave = load_u16(columns);
    __m128i change = scan_u32(_mm_sub_epi32(load_u16(columns + (side - 1) * step), leave), step);
    __m128i after = _mm_add_epi32(*total, change);
    *total = step == 1 ? _mm_shuffle_epi32(after, 0xff) : _mm_shuffle_epi32(after, _MM_SHUFFLE(1, 3, 2, 1));
    __m128i sum = _mm_add_epi32(after, leave);
    __m128i even = _mm_mul_epu32(sum, factor), odd = _mm_mul_epu32(_mm_srli_epi64(sum, 32), factor);
    return _mm_blend_epi16(_mm_srli_epi64(even, 32), odd, 0xcc);
}

INLINE void wide(uint8_t *dst, const uint16_t *columns, int32_t side, int32_t step, int32_t n)
{
    const box_division by = box_division_of(side);
    const __m128i factor = _mm_set1_epi32((int32_t)by.factor), shift = _mm_cvtsi32_si128(by.shift - 32);
    uint32_t totals[8];
    box_begin(totals, columns, side, step, by.add);
    __m128i total = load16(totals);
    for (int32_t i = 0; i < n; i += 16) {
        __m128i a = wide_4(&total, columns + i, side, step, factor);
        __m128i b = wide_4(&total, columns + i + 4, side, step, factor);
        __m128i c = wide_4(&total, columns + i + 8, side, step, factor);
        __m128i d = wide_4(&total, columns + i + 12, side, step, factor);
        __m128i low = _mm_packus_epi32(a, b), high = _mm_packus_epi32(c, d);
        store16(dst + i, _mm_packus_epi16(_mm_srl_epi16(low, shift), _mm_srl_epi16(high, shift)));
    }
}

void iris_row_box_mean_u8_sse(uint8_t *dst, const uint16_t *columns, int32_t side, int32_t step, int32_t n)
{
    int32_t whole = n / 16 * 16;
    if (whole == 0) {
        iris_row_box_mean_u8_c(dst, columns, side, step, n);
        return;
    }
    if (side <= FEW) {
        few(dst, columns, side, step, whole);
    } else if (side <= BOX_NARROW && step == 1) {
        narrow(dst, columns, side, 1, whole);
    } else if (side <= BOX_NARROW) {
        narrow(dst, columns, side, 3, whole);
    } else if (step == 1) {
        wide(dst, columns, side, 1, whole);
    } else {
        wide(dst, columns, side, 3, whole);
    }
    iris_row_box_mean_u8_c(dst + whole, columns + whole, side, step, n - whole);
}
