/* Samples at other places, 32 bytes at a time: see ../sse/sample.c. */
#include <immintrin.h>

#include "kernel.h"

#define INLINE static inline __attribute__((always_inline))

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

/* Above and below, 16 bits each, between these places: their sum by (256 - down, down), as signed numbers. */
INLINE __m128i down_by(__m256i both, __m256i y)
{
    __m256i down = _mm256_and_si256(_mm256_srli_epi32(y, 8), _mm256_set1_epi32(255));
    __m256i weights =
        _mm256_add_epi32(_mm256_sub_epi32(_mm256_slli_epi32(down, 16), down), _mm256_set1_epi32(256));
    __m256i sum = _mm256_madd_epi16(_mm256_xor_si256(both, _mm256_set1_epi16(INT16_MIN)), weights);
    sum = _mm256_srli_epi32(_mm256_add_epi32(sum, _mm256_set1_epi32(32768 * 257)), 16);
    return _mm_packus_epi32(_mm256_castsi256_si128(sum), _mm256_extracti128_si256(sum, 1));
}

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
    return down_by(both, at->y);
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

/* ---- along a way with bends ---- */

/* Four times eight pixels that are straight. Of each the first place and the steps in 4096ths, 16 bits each: x, dx, y, dy from
 * the lowest on; and the corner (x, y) of what all of them lie in, 16 bytes of two rows or, where more is 1, of three. */
typedef struct {
    uint64_t ways[4];
    int32_t corners[8], more[8];
} four_bent;

/* Of four bends, eight pixels each. 0 when some lie in no such bytes. */
INLINE int find_four(four_bent *to, const int32_t *at, int32_t w)
{
    __m256i from = load_two((const uint8_t *)at, (const uint8_t *)(at + 4));
    __m256i next = load_two((const uint8_t *)(at + 2), (const uint8_t *)(at + 6));
    __m256i step = _mm256_srai_epi32(_mm256_sub_epi32(next, from), 4);
    step = _mm256_srai_epi32(_mm256_add_epi32(step, _mm256_set1_epi32(4)), 3);
    __m256i end = _mm256_slli_epi32(_mm256_sub_epi32(_mm256_slli_epi32(step, 3), step), 4);
    end = _mm256_add_epi32(from, end);
    __m256i first = _mm256_srai_epi32(_mm256_min_epi32(from, end), 16);
    __m256i last = _mm256_srai_epi32(_mm256_max_epi32(from, end), 16);
    __m256i room = _mm256_set1_epi64x((int64_t)INT32_MAX << 32 | (uint32_t)(w - 16));
    first = _mm256_min_epi32(first, room);
    __m256i more = _mm256_sub_epi32(last, first);
    __m256i part = _mm256_srli_epi32(_mm256_sub_epi32(from, _mm256_slli_epi32(first, 16)), 4);
    _mm256_storeu_si256((__m256i *)(void *)to->ways,
                        _mm256_blend_epi16(part, _mm256_slli_epi32(step, 16), 0xaa));
    _mm256_storeu_si256((__m256i *)(void *)to->corners, first);
    _mm256_storeu_si256((__m256i *)(void *)to->more, more);
    __m256i most = _mm256_set1_epi64x((int64_t)1 << 32 | 14);
    return _mm256_testz_si256(_mm256_cmpgt_epi32(more, most), _mm256_cmpgt_epi32(more, most));
}

/* Value `which` of each half, eight times. */
INLINE __m256i eight_times(__m256i ways, int which)
{
    return _mm256_shuffle_epi8(ways, _mm256_set1_epi16((short)(2 * which + 256 * (2 * which + 1))));
}

/* Pairs of left and right bytes, by `part` of 256 between them. */
INLINE __m256i across_pairs(__m256i pairs, __m256i part)
{
    __m256i left = _mm256_and_si256(pairs, _mm256_set1_epi16(255)), right = _mm256_srli_epi16(pairs, 8);
    return _mm256_add_epi16(_mm256_mullo_epi16(_mm256_sub_epi16(right, left), part),
                            _mm256_slli_epi16(left, 8));
}

INLINE __m256i down_pairs(__m256i both, __m256i weights)
{
    __m256i sum = _mm256_madd_epi16(_mm256_xor_si256(both, _mm256_set1_epi16(INT16_MIN)), weights);
    return _mm256_srli_epi32(_mm256_add_epi32(sum, _mm256_set1_epi32(32768 * 257)), 16);
}

/* Rows a and b of the pictures that two times eight pixels are in. */
INLINE __m256i pick_pairs(const uint8_t *a, const uint8_t *b, __m256i pick)
{
    return _mm256_shuffle_epi8(load_two(a, b), pick);
}

/* Those of `which` and the next. */
INLINE void draw_16(uint8_t *dst, const iris_row_bends *way, const four_bent *four, int which)
{
    const int32_t *corner = four->corners + 2 * which, *more = four->more + 2 * which;
    const uint8_t *a = way->src + corner[1] * way->stride + corner[0], *a_low = a + way->stride;
    const uint8_t *b = way->src + corner[3] * way->stride + corner[2], *b_low = b + way->stride;
    const __m256i count = _mm256_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7);
    const __m256i fraction = _mm256_set1_epi16(255);
    __m256i ways =
        _mm256_permute4x64_epi64(_mm256_castsi128_si256(load16((const uint8_t *)(four->ways + which))), 0x10);
    __m256i x = _mm256_add_epi16(eight_times(ways, 0), _mm256_mullo_epi16(eight_times(ways, 1), count));
    __m256i y = _mm256_add_epi16(eight_times(ways, 2), _mm256_mullo_epi16(eight_times(ways, 3), count));
    __m256i pick = _mm256_mullo_epi16(_mm256_srli_epi16(x, 12), _mm256_set1_epi16(0x0101));
    pick = _mm256_add_epi16(pick, _mm256_set1_epi16(0x0100));
    __m256i first = pick_pairs(a, b, pick);
    __m256i second = pick_pairs(a_low, b_low, pick);
    __m256i third = pick_pairs(a_low + more[1] * way->stride, b_low + more[3] * way->stride, pick);
    __m256i low = _mm256_cmpgt_epi16(y, _mm256_set1_epi16(4095));
    __m256i right = _mm256_and_si256(_mm256_srli_epi16(x, 4), fraction);
    __m256i above = across_pairs(_mm256_blendv_epi8(first, second, low), right);
    __m256i below = across_pairs(_mm256_blendv_epi8(second, third, low), right);
    __m256i down = _mm256_and_si256(_mm256_srli_epi16(y, 4), fraction);
    __m256i up = _mm256_sub_epi16(_mm256_set1_epi16(256), down);
    __m256i made =
        _mm256_packus_epi32(down_pairs(_mm256_unpacklo_epi16(above, below), _mm256_unpacklo_epi16(up, down)),
                            down_pairs(_mm256_unpackhi_epi16(above, below), _mm256_unpackhi_epi16(up, down)));
    made = _mm256_permute4x64_epi64(_mm256_packus_epi16(made, made), 0x08);
    _mm_storeu_si128((__m128i *)(void *)dst, _mm256_castsi256_si128(made));
}

/* n pixels from i on, which all lie between two bends. */
INLINE void draw_straight(uint8_t *dst, const iris_row_bends *way, int32_t i, int32_t n)
{
    const int32_t *at = way->places + 2 * (i >> way->bits), part = i & ((1 << way->bits) - 1);
    iris_row_way straight = {way->src, way->stride, at[0], at[1], 0, 0};
    straight.dx = iris_row_bends_step(at[0], at[2], way->bits);
    straight.dy = iris_row_bends_step(at[1], at[3], way->bits);
    straight.x += part * straight.dx;
    straight.y += part * straight.dy;
    iris_row_along_u8_avx2(dst + i, &straight, n);
}

void iris_row_bends_u8_avx2(uint8_t *dst, const iris_row_bends *way, int32_t n)
{
    const iris_row_bends on = *way;
    const int32_t side = 1 << on.bits;
    for (int32_t i = 0; i < n;) {
        four_bent four;
        if (side == 8 && on.w >= 16 && i + 32 <= n && find_four(&four, on.places + i / 4, on.w)) {
            draw_16(dst + i, &on, &four, 0);
            draw_16(dst + i + 16, &on, &four, 2);
            i += 32;
        } else {
            draw_straight(dst, &on, i, n - i < side ? n - i : side);
            i += side;
        }
    }
}
