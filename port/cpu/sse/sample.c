/* Samples at other places: those of four pixels are picked out of sixteen bytes; squares of 16 by 16 are transposed. */
#include "vector.h"

/* What four places mean. */
typedef struct {
    int32_t base;    /* of sixteen bytes */
    __m128i pick;    /* the pairs among them, 16 bits each */
    __m128i weights; /* of these pairs */
} four;

/* `end` is behind the last byte that may be read. 0 when the places are too far apart for sixteen bytes. */
static inline int four_at(four *to, const iris_row_places *places, int32_t i, int32_t end)
{
    int32_t again = places->step - 1, base = places->at[i] - again;
    base = base > end - 16 ? end - 16 : base < 0 ? 0 : base;
    if (end < 16 || places->at[i + 3] + again + places->step - base > 15) {
        return 0;
    }
    __m128i at = _mm_sub_epi32(load16(places->at + i), _mm_set1_epi32(base));
    __m128i second = _mm_slli_epi32(_mm_add_epi32(at, _mm_set1_epi32(places->step)), 16);
    __m128i weight = _mm_cvtepu16_epi32(_mm_loadl_epi64((const __m128i *)(const void *)(places->weight + i)));
    to->base = base;
    to->pick = _mm_or_si128(_mm_or_si128(at, second), _mm_set1_epi32((int32_t)0x80008000u));
    to->weights = _mm_or_si128(_mm_slli_epi32(weight, 16),
                               _mm_sub_epi32(_mm_set1_epi32((int32_t)IRIS_ROW_WHOLE), weight));
    return 1;
}

static inline __m128i across(const uint8_t *row, const four *places)
{
    return _mm_madd_epi16(_mm_shuffle_epi8(load16(row + places->base), places->pick), places->weights);
}

static inline __m128i between_4(const uint8_t *const rows[2], const four *places, __m128i down)
{
    __m128i above = across(rows[0], places), below = across(rows[1], places);
    __m128i sum =
        _mm_add_epi32(_mm_slli_epi32(above, 11), _mm_mullo_epi32(_mm_sub_epi32(below, above), down));
    return _mm_srli_epi32(_mm_add_epi32(sum, _mm_set1_epi32(1 << 21)), 22);
}

void iris_row_between_u8_sse(uint8_t *dst, const uint8_t *const rows[2], const iris_row_places *places,
                             uint32_t down, int32_t n)
{
    const __m128i lower = _mm_set1_epi32((int32_t)down);
    const int32_t end = n > 0 ? places->at[n - 1] + places->step + 1 : 0;
    for (int32_t i = 0; i < n;) {
        four low, high;
        if (i + 8 <= n && four_at(&low, places, i, end) && four_at(&high, places, i + 4, end)) {
            __m128i both = _mm_packus_epi32(between_4(rows, &low, lower), between_4(rows, &high, lower));
            _mm_storel_epi64((__m128i *)(void *)(dst + i), _mm_packus_epi16(both, both));
            i += 8;
            continue;
        }
        const iris_row_places rest = {places->at + i, places->weight + i, places->step};
        int32_t count = n - i < 8 ? n - i : 8;
        iris_row_between_u8_c(dst + i, rows, &rest, down, count);
        i += count;
    }
}

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

/* Sixteen at a time from both ends, until they would meet. */
void iris_row_reverse_u8_sse(uint8_t *dst, const uint8_t *src, int32_t n)
{
    const __m128i back = _mm_setr_epi8(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
    for (; n >= 32; n -= 32, src += 16, dst += 16) {
        __m128i left = _mm_shuffle_epi8(load16(src), back),
                right = _mm_shuffle_epi8(load16(src + n - 16), back);
        store16(dst, right);
        store16(dst + n - 16, left);
    }
    iris_row_reverse_u8_c(dst, src, n);
}
