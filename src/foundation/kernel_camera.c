/* Rows of cameras to colors. */
#include "kernel.h"
#include "yuv.h"

void iris_row_rgb888_nv12_c(uint8_t *dst, const uint8_t *luma, const uint8_t *chroma, int32_t n)
{
    for (int32_t i = 0; i < n; i += 2, chroma += 2) {
        iris_yuv_tint tint = iris_yuv_tint_of(chroma[0], chroma[1]);
        for (int32_t k = i; k < n && k < i + 2; k++) {
            int32_t bright = iris_yuv_luma(luma[k]);
            dst[3 * k] = iris_yuv_channel(bright + tint.r);
            dst[3 * k + 1] = iris_yuv_channel(bright + tint.g);
            dst[3 * k + 2] = iris_yuv_channel(bright + tint.b);
        }
    }
}

void iris_row_every_second_u8_c(uint8_t *dst, const uint8_t *src, int32_t which, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        dst[i] = src[2 * i + which];
    }
}

static inline uint8_t mean2(uint32_t a, uint32_t b)
{
    return (uint8_t)((a + b + 1u) >> 1);
}

static inline uint8_t mean4(uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    return (uint8_t)((a + b + c + d + 2u) >> 2);
}

void iris_row_888_bayer_c(uint8_t *dst, const uint8_t *const rows[3], int32_t own, int32_t green, int32_t n)
{
    const uint8_t *above = rows[0], *row = rows[1], *below = rows[2];
    const int32_t far = 2 - own;
    for (int32_t x = 0; x < n; x++, dst += 3) {
        if (x % 2 == green) {
            dst[own] = mean2(row[x - 1], row[x + 1]);
            dst[1] = row[x];
            dst[far] = mean2(above[x], below[x]);
        } else {
            dst[own] = row[x];
            dst[1] = mean4(row[x - 1], row[x + 1], above[x], below[x]);
            dst[far] = mean4(above[x - 1], above[x + 1], below[x - 1], below[x + 1]);
        }
    }
}
