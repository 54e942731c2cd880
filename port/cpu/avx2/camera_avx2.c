/* Rows of cameras to colors. */
#include "vector.h"

/* 32 pixels from their channels: in each half three times sixteen bytes, which then come in order. */
static inline void store_888(uint8_t *dst, __m256i first, __m256i second, __m256i third)
{
    /* Byte 3 i of a half is sample i of the first channel. With each channel's samples in an order in which every third
     * byte has the one that it needs, three vectors are three blends. */
    const __m256i order0 =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 11, 6, 1, 12, 7, 2, 13, 8, 3, 14, 9, 4, 15, 10, 5));
    const __m256i order1 =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(5, 0, 11, 6, 1, 12, 7, 2, 13, 8, 3, 14, 9, 4, 15, 10));
    const __m256i order2 =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(10, 5, 0, 11, 6, 1, 12, 7, 2, 13, 8, 3, 14, 9, 4, 15));
    const __m256i at_1 =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0));
    const __m256i at_2 =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0));
    __m256i a = _mm256_shuffle_epi8(first, order0), b = _mm256_shuffle_epi8(second, order1);
    __m256i c = _mm256_shuffle_epi8(third, order2);
    __m256i v0 = _mm256_blendv_epi8(_mm256_blendv_epi8(a, b, at_1), c, at_2);
    __m256i v1 = _mm256_blendv_epi8(_mm256_blendv_epi8(b, c, at_1), a, at_2);
    __m256i v2 = _mm256_blendv_epi8(_mm256_blendv_epi8(c, a, at_1), b, at_2);
    store32(dst, _mm256_permute2x128_si256(v0, v1, 0x20));
    store32(dst + 32, _mm256_permute2x128_si256(v2, v0, 0x30));
    store32(dst + 64, _mm256_permute2x128_si256(v1, v2, 0x31));
}

/* ---- YUV ---- */

/* 16-bit factors of two neighbors, the first in the low half. */
static inline __m256i factors(int16_t first, int16_t second)
{
    return _mm256_set1_epi32((int32_t)((uint32_t)(uint16_t)second << 16 | (uint16_t)first));
}

/* Sixteen pixels of a channel: their luma, in two parts, and the tint of each two. */
static inline __m256i tinted(__m256i luma0, __m256i luma1, __m256i tint)
{
    __m256i low = _mm256_srai_epi32(_mm256_add_epi32(luma0, _mm256_unpacklo_epi32(tint, tint)), 8);
    __m256i high = _mm256_srai_epi32(_mm256_add_epi32(luma1, _mm256_unpackhi_epi32(tint, tint)), 8);
    return _mm256_packs_epi32(low, high);
}

/* Eight pixels of each half: y in 16 bits, U and V in turn. */
static inline void colors_of_16(__m256i rgb[3], __m256i y, __m256i uv)
{
    const __m256i one = _mm256_set1_epi16(1);
    y = _mm256_sub_epi16(y, _mm256_set1_epi16(16));
    uv = _mm256_sub_epi16(uv, _mm256_set1_epi16(128));
    __m256i luma0 = _mm256_madd_epi16(_mm256_unpacklo_epi16(y, one), factors(298, 128));
    __m256i luma1 = _mm256_madd_epi16(_mm256_unpackhi_epi16(y, one), factors(298, 128));
    rgb[0] = tinted(luma0, luma1, _mm256_madd_epi16(uv, factors(0, 409)));
    rgb[1] = tinted(luma0, luma1, _mm256_madd_epi16(uv, factors(-100, -208)));
    rgb[2] = tinted(luma0, luma1, _mm256_madd_epi16(uv, factors(516, 0)));
}

void iris_row_rgb888_nv12_avx2(uint8_t *dst, const uint8_t *luma, const uint8_t *chroma, int32_t n)
{
    const __m256i zero = _mm256_setzero_si256();
    for (; n >= 32; n -= 32, dst += 96, luma += 32, chroma += 32) {
        __m256i y = load32(luma), uv = load32(chroma), low[3], high[3];
        colors_of_16(low, _mm256_unpacklo_epi8(y, zero), _mm256_unpacklo_epi8(uv, zero));
        colors_of_16(high, _mm256_unpackhi_epi8(y, zero), _mm256_unpackhi_epi8(uv, zero));
        store_888(dst, _mm256_packus_epi16(low[0], high[0]), _mm256_packus_epi16(low[1], high[1]),
                  _mm256_packus_epi16(low[2], high[2]));
    }
    iris_row_rgb888_nv12_sse(dst, luma, chroma, n);
}

/* ---- Bayer ---- */

/* The means of four in the odd bytes; the even ones are 0. */
static inline __m256i odd_means(__m256i a, __m256i b, __m256i c, __m256i d)
{
    __m256i sum = _mm256_add_epi16(_mm256_add_epi16(_mm256_srli_epi16(a, 8), _mm256_srli_epi16(b, 8)),
                                   _mm256_add_epi16(_mm256_srli_epi16(c, 8), _mm256_srli_epi16(d, 8)));
    return _mm256_slli_epi16(_mm256_srli_epi16(_mm256_add_epi16(sum, _mm256_set1_epi16(2)), 2), 8);
}

/* 32 pixels, the even ones green. */
static inline void demosaic_32(uint8_t *dst, const uint8_t *const rows[3], int32_t own)
{
    const __m256i even = _mm256_set1_epi16(0xFF);
    __m256i row = load32(rows[1]), left = load32(rows[1] - 1), right = load32(rows[1] + 1);
    __m256i above = load32(rows[0]), below = load32(rows[2]);
    __m256i of_row = _mm256_blendv_epi8(row, _mm256_avg_epu8(left, right), even);
    __m256i green = _mm256_blendv_epi8(odd_means(left, right, above, below), row, even);
    __m256i corners =
        odd_means(load32(rows[0] - 1), load32(rows[0] + 1), load32(rows[2] - 1), load32(rows[2] + 1));
    __m256i far = _mm256_blendv_epi8(corners, _mm256_avg_epu8(above, below), even);
    store_888(dst, own == 0 ? of_row : far, green, own == 0 ? far : of_row);
}

void iris_row_888_bayer_avx2(uint8_t *dst, const uint8_t *const rows[3], int32_t own, int32_t green,
                             int32_t n)
{
    int32_t x = green != 0 && n > 0; /* a pixel that is not green */
    iris_row_888_bayer_c(dst, rows, own, green, x);
    for (; x + 32 <= n; x += 32) {
        const uint8_t *const here[3] = {rows[0] + x, rows[1] + x, rows[2] + x};
        demosaic_32(dst + 3 * x, here, own);
    }
    const uint8_t *const rest[3] = {rows[0] + x, rows[1] + x, rows[2] + x};
    iris_row_888_bayer_sse(dst + 3 * x, rest, own, 0, n - x);
}
