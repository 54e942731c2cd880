/* Gray from three channels, and their exchange. */
#include "vector.h"

/* Four pixels give eight products: the first channel and a part of the green one, the other part and the last channel.
 * Green's factor 150 is cut in two because factors are signed bytes and sums of two products must stay below 2^15. */
static inline __m128i half_sums(const uint8_t *bytes, __m128i order, __m128i factors)
{
    return _mm_maddubs_epi16(_mm_shuffle_epi8(load16(bytes), order), factors);
}

static inline __m128i luma_of_8(__m128i first, __m128i second)
{
    __m128i sum = _mm_add_epi16(_mm_unpacklo_epi64(first, second), _mm_unpackhi_epi64(first, second));
    return _mm_srli_epi16(_mm_add_epi16(sum, _mm_set1_epi16(128)), 8);
}

/* n >= 16. The last 16 pixels may overlap those before them: dst and src are disjoint. */
static inline void luma_row(uint8_t *dst, const uint8_t *src, int32_t n, __m128i factors)
{
    const __m128i order = _mm_setr_epi8(0, 1, 3, 4, 6, 7, 9, 10, 1, 2, 4, 5, 7, 8, 10, 11);
    const __m128i order_of_last = _mm_add_epi8(order, _mm_set1_epi8(4)); /* its 12 bytes end the vector */
    for (int32_t x = 0; x < n; x += 16) {
        x = x > n - 16 ? n - 16 : x;
        const uint8_t *from = src + 3 * x;
        __m128i a = half_sums(from, order, factors);
        __m128i b = half_sums(from + 12, order, factors);
        __m128i c = half_sums(from + 24, order, factors);
        __m128i d = half_sums(from + 32, order_of_last, factors);
        store16(dst + x, _mm_packus_epi16(luma_of_8(a, b), luma_of_8(c, d)));
    }
}

void iris_row_luma_rgb888_sse(uint8_t *dst, const uint8_t *src, int32_t n)
{
    if (n < 16) {
        iris_row_luma_rgb888_c(dst, src, n);
        return;
    }
    luma_row(dst, src, n, _mm_setr_epi8(77, 51, 77, 51, 77, 51, 77, 51, 99, 29, 99, 29, 99, 29, 99, 29));
}

void iris_row_luma_bgr888_sse(uint8_t *dst, const uint8_t *src, int32_t n)
{
    if (n < 16) {
        iris_row_luma_bgr888_c(dst, src, n);
        return;
    }
    luma_row(dst, src, n, _mm_setr_epi8(29, 99, 29, 99, 29, 99, 29, 99, 51, 77, 51, 77, 51, 77, 51, 77));
}

/* Green once more in the place of alpha, so that each pixel has two sums of two products. */
static inline __m128i luma_of_4_rgba(const uint8_t *bytes)
{
    const __m128i order = _mm_setr_epi8(0, 1, 1, 2, 4, 5, 5, 6, 8, 9, 9, 10, 12, 13, 13, 14);
    return half_sums(bytes, order,
                     _mm_setr_epi8(77, 51, 99, 29, 77, 51, 99, 29, 77, 51, 99, 29, 77, 51, 99, 29));
}

static inline __m128i luma_of_8_rgba(const uint8_t *bytes)
{
    __m128i sum = _mm_hadd_epi16(luma_of_4_rgba(bytes), luma_of_4_rgba(bytes + 16));
    return _mm_srli_epi16(_mm_add_epi16(sum, _mm_set1_epi16(128)), 8);
}

void iris_row_luma_rgba8888_sse(uint8_t *dst, const uint8_t *src, int32_t n)
{
    if (n < 16) {
        iris_row_luma_rgba8888_c(dst, src, n);
        return;
    }
    for (int32_t x = 0; x < n; x += 16) {
        x = x > n - 16 ? n - 16 : x;
        store16(dst + x, _mm_packus_epi16(luma_of_8_rgba(src + 4 * x), luma_of_8_rgba(src + 4 * x + 32)));
    }
}

/* Five pixels in 16 bytes; the last byte stays as it is and is written again with the next five. The next vector is
 * loaded before this one is stored, so that in place a load never waits for the store before it. */
void iris_row_swap_888_sse(uint8_t *dst, const uint8_t *src, int32_t n)
{
    const __m128i order = _mm_setr_epi8(2, 1, 0, 5, 4, 3, 8, 7, 6, 11, 10, 9, 14, 13, 12, 15);
    if (n >= 6) {
        __m128i pixels = load16(src);
        for (; n >= 11; n -= 5, src += 15, dst += 15) {
            __m128i next = load16(src + 15);
            store16(dst, _mm_shuffle_epi8(pixels, order));
            pixels = next;
        }
        store16(dst, _mm_shuffle_epi8(pixels, order));
        n -= 5;
        src += 15;
        dst += 15;
    }
    iris_row_swap_888_c(dst, src, n);
}
