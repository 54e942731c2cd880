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

/* Eight places as they go on. */
typedef struct {
    __m256i x, y;
} eight_on;

/* Four bytes are gathered for each pixel and its right neighbor, and none behind that one: from two bytes before the pixel,
 * or from the row's first byte on. */
static inline __m128i along_8(const uint8_t *src, int32_t stride, const eight_on *at)
{
    __m256i column = _mm256_srai_epi32(at->x, 16), row = _mm256_srai_epi32(at->y, 16);
    __m256i before = _mm256_min_epi32(column, _mm256_set1_epi32(2));
    __m256i from = _mm256_add_epi32(_mm256_mullo_epi32(row, _mm256_set1_epi32(stride)),
                                    _mm256_sub_epi32(column, before));
    __m256i above = _mm256_i32gather_epi32((const int *)(const void *)src, from, 1);
    __m256i below = _mm256_i32gather_epi32((const int *)(const void *)(src + stride), from, 1);
    __m256i shift = _mm256_slli_epi32(before, 3);
    above = _mm256_srlv_epi32(above, shift);
    below = _mm256_slli_epi32(_mm256_srlv_epi32(below, shift), 16);
    __m256i four = _mm256_blend_epi16(above, below, 0xaa);
    /* above and below, 16 bits each */
    const __m256i fraction = _mm256_setr_epi8(1, -1, 1, -1, 5, -1, 5, -1, 9, -1, 9, -1, 13, -1, 13, -1, 1, -1,
                                              1, -1, 5, -1, 5, -1, 9, -1, 9, -1, 13, -1, 13, -1);
    __m256i left = _mm256_and_si256(four, _mm256_set1_epi16(255)), other = _mm256_srli_epi16(four, 8);
    __m256i both = _mm256_mullo_epi16(_mm256_sub_epi16(other, left), _mm256_shuffle_epi8(at->x, fraction));
    both = _mm256_add_epi16(both, _mm256_slli_epi16(left, 8));
    /* their sum by (256 - down, down), as signed numbers */
    __m256i down = _mm256_and_si256(_mm256_srli_epi32(at->y, 8), _mm256_set1_epi32(255));
    __m256i weights =
        _mm256_add_epi32(_mm256_sub_epi32(_mm256_slli_epi32(down, 16), down), _mm256_set1_epi32(256));
    __m256i sum = _mm256_madd_epi16(_mm256_xor_si256(both, _mm256_set1_epi16(INT16_MIN)), weights);
    sum = _mm256_srli_epi32(_mm256_add_epi32(sum, _mm256_set1_epi32(32768 * 257)), 16);
    return _mm_packus_epi32(_mm256_castsi256_si128(sum), _mm256_extracti128_si256(sum, 1));
}

static inline void go_on(eight_on *at, __m256i dx, __m256i dy)
{
    at->x = _mm256_add_epi32(at->x, dx);
    at->y = _mm256_add_epi32(at->y, dy);
}

static inline __m256i begin_at(int32_t first, int32_t step)
{
    const __m256i count = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    return _mm256_add_epi32(_mm256_set1_epi32(first), _mm256_mullo_epi32(count, _mm256_set1_epi32(step)));
}

/* Rows are counted from the first place's, so that an offset fits 32 bits. */
void iris_row_along_u8_avx2(uint8_t *dst, const iris_row_way *way, int32_t n)
{
    int32_t i = 0;
    if (way->stride <= INT16_MAX && way->stride >= INT16_MIN) {
        const uint8_t *src = way->src + (way->y >> 16) * way->stride;
        const __m256i dx = _mm256_slli_epi32(_mm256_set1_epi32(way->dx), 3);
        const __m256i dy = _mm256_slli_epi32(_mm256_set1_epi32(way->dy), 3);
        eight_on at = {begin_at(way->x, way->dx), begin_at(way->y & 65535, way->dy)};
        for (; i + 8 <= n; i += 8, go_on(&at, dx, dy)) {
            __m128i made = along_8(src, (int32_t)way->stride, &at);
            _mm_storel_epi64((__m128i *)(void *)(dst + i), _mm_packus_epi16(made, made));
        }
    }
    if (i < n) {
        iris_row_way rest = *way;
        rest.x += i * way->dx;
        rest.y += i * way->dy;
        iris_row_along_u8_c(dst + i, &rest, n - i);
    }
}
