/* Samples at other places, 32 bytes at a time: see ../sse/sample.c. */
#include <immintrin.h>

#include "kernel.h"

static inline __m128i load16(const void *from)
{
    return _mm_loadu_si128((const __m128i *)from);
}

static inline __m256i load_two(const uint8_t *first, const uint8_t *second)
{
    return _mm256_inserti128_si256(_mm256_castsi128_si256(load16(first)), load16(second), 1);
}

/* What eight places mean: four of them are picked out of each sixteen bytes. */
typedef struct {
    int32_t base[2];
    __m256i pick, weights;
} eight;

static inline int32_t base_of(int32_t at, int32_t end)
{
    return at > end - 16 ? end - 16 : at < 0 ? 0 : at;
}

/* `end` is behind the last byte that may be read. 0 when the places are too far apart. */
static inline int eight_at(eight *to, const iris_row_places *places, int32_t i, int32_t end)
{
    const int32_t *at = places->at + i, step = places->step, again = step - 1;
    const int32_t first = base_of(at[0] - again, end), second = base_of(at[4] - again, end);
    if (end < 16 || at[3] + again + step - first > 15 || at[7] + again + step - second > 15) {
        return 0;
    }
    const __m256i base = _mm256_inserti128_si256(_mm256_set1_epi32(first), _mm_set1_epi32(second), 1);
    __m256i from = _mm256_sub_epi32(_mm256_loadu_si256((const __m256i *)(const void *)at), base);
    __m256i next = _mm256_slli_epi32(_mm256_add_epi32(from, _mm256_set1_epi32(step)), 16);
    __m256i weight = _mm256_cvtepu16_epi32(load16(places->weight + i));
    to->base[0] = first;
    to->base[1] = second;
    to->pick = _mm256_or_si256(_mm256_or_si256(from, next), _mm256_set1_epi32((int32_t)0x80008000u));
    to->weights = _mm256_or_si256(_mm256_slli_epi32(weight, 16),
                                  _mm256_sub_epi32(_mm256_set1_epi32((int32_t)IRIS_ROW_WHOLE), weight));
    return 1;
}

static inline __m256i across(const uint8_t *row, const eight *places)
{
    __m256i bytes = load_two(row + places->base[0], row + places->base[1]);
    return _mm256_madd_epi16(_mm256_shuffle_epi8(bytes, places->pick), places->weights);
}

void iris_row_between_u8_avx2(uint8_t *dst, const uint8_t *const rows[2], const iris_row_places *places,
                              uint32_t down, int32_t n)
{
    const __m256i lower = _mm256_set1_epi32((int32_t)down), half = _mm256_set1_epi32(1 << 21);
    const int32_t end = n > 0 ? places->at[n - 1] + places->step + 1 : 0;
    for (int32_t i = 0; i < n;) {
        eight at;
        if (i + 8 <= n && eight_at(&at, places, i, end)) {
            __m256i above = across(rows[0], &at), below = across(rows[1], &at);
            __m256i sum = _mm256_add_epi32(_mm256_slli_epi32(above, 11), half);
            sum = _mm256_add_epi32(sum, _mm256_mullo_epi32(_mm256_sub_epi32(below, above), lower));
            sum = _mm256_srli_epi32(sum, 22);
            __m128i both = _mm_packus_epi32(_mm256_castsi256_si128(sum), _mm256_extracti128_si256(sum, 1));
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

/* Rows k and k + 4 (k + 8 and k + 12 in the other half) become every second byte of rows 2 k and 2 k + 1; three times, and
 * eight rows are columns. */
static inline void interleave(__m256i to[8], const __m256i from[8])
{
    for (int k = 0; k < 4; k++) {
        to[2 * k] = _mm256_unpacklo_epi8(from[k], from[k + 4]);
        to[2 * k + 1] = _mm256_unpackhi_epi8(from[k], from[k + 4]);
    }
}

void iris_row_columns16_u8_avx2(uint8_t *dst, ptrdiff_t stride, const uint8_t *const rows[16], int32_t n)
{
    int32_t i = 0;
    for (; i + 16 <= n; i += 16) {
        __m256i a[8], b[8];
        for (int k = 0; k < 8; k++) {
            a[k] = load_two(rows[k] + i, rows[k + 8] + i);
        }
        interleave(b, a);
        interleave(a, b);
        interleave(b, a);
        for (int k = 0; k < 8; k++, dst += 2 * stride) {
            __m256i two = _mm256_permute4x64_epi64(b[k], 0xd8);
            _mm_storeu_si128((__m128i *)(void *)dst, _mm256_castsi256_si128(two));
            _mm_storeu_si128((__m128i *)(void *)(dst + stride), _mm256_extracti128_si256(two, 1));
        }
    }
    for (; i < n; i++, dst += stride) {
        for (int k = 0; k < 16; k++) {
            dst[k] = rows[k][i];
        }
    }
}
