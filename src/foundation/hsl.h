/* What the HSL conversions and the range test share: a color's chroma, lightness, and hue as whole numbers,
 * and rows. */
#ifndef IRIS_FOUNDATION_HSL_H
#define IRIS_FOUNDATION_HSL_H

#include <stdint.h>

typedef struct {
    int32_t max;
    int32_t chroma; /* max - min: 0..255 */
    int32_t sum;    /* max + min: 0..510 */
} iris_hsl_extent;

static inline iris_hsl_extent iris_hsl_extent_of(int32_t r, int32_t g, int32_t b)
{
    int32_t max = r > g ? r : g;
    int32_t min = r > g ? g : r;
    max = b > max ? b : max;
    min = b < min ? b : min;
    iris_hsl_extent extent = {max, max - min, max + min};
    return extent;
}

/* The chroma that a fully saturated color of this lightness has. */
static inline int32_t iris_hsl_chroma_limit(int32_t sum)
{
    return sum <= 255 ? sum : 510 - sum;
}

/* Hue in units of 60 degrees / chroma: 0 up to below 6 * chroma. 0 for grays. */
static inline int32_t iris_hsl_hue_times_chroma(int32_t r, int32_t g, int32_t b, iris_hsl_extent extent)
{
    int32_t c = extent.chroma;
    int32_t hue = extent.max == r ? g - b : extent.max == g ? 2 * c + b - r : 4 * c + r - g;
    return hue < 0 ? hue + 6 * c : hue;
}

/* Rows of n pixels between HSL and RGB888 (red = 0) or BGR888 (red = 2). HSL24 works in place. */
void iris_hsl48_row_from_888(uint16_t *dst, const uint8_t *src, int32_t n, int red);
void iris_hsl24_row_from_888(uint8_t *dst, const uint8_t *src, int32_t n, int red);
void iris_hsl48_row_to_888(uint8_t *dst, const uint16_t *src, int32_t n, int red);
void iris_hsl24_row_to_888(uint8_t *dst, const uint8_t *src, int32_t n, int red);

#endif
