/* What the HSL conversions and the range test share: a color's chroma, lightness, and hue as whole numbers,
 * and rows. */
#ifndef IRIS_FOUNDATION_HSL_H
#define IRIS_FOUNDATION_HSL_H

#include <stdint.h>

#include "iris/color.h"

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

/* n / d rounded half up; n >= 0, d > 0. */
static inline uint32_t iris_hsl_divide(int32_t n, int32_t d)
{
    return ((uint32_t)n + (uint32_t)d / 2) / (uint32_t)d;
}

/* HSL with `hues` steps to a turn and saturation up to s_max; L is the sum of the largest and smallest
 * channel. */
static inline iris_hsl iris_hsl_of(int32_t r, int32_t g, int32_t b, int32_t hues, int32_t s_max)
{
    iris_hsl_extent extent = iris_hsl_extent_of(r, g, b);
    iris_hsl hsl = {0, 0, (uint16_t)extent.sum};
    if (extent.chroma > 0) {
        int32_t hue = iris_hsl_hue_times_chroma(r, g, b, extent);
        hsl.h = (uint16_t)iris_hsl_divide(hues * hue, 6 * extent.chroma);
        hsl.s = (uint16_t)iris_hsl_divide(s_max * extent.chroma, iris_hsl_chroma_limit(extent.sum));
    }
    return hsl;
}

/* The test that finds in a row of BGR888, read as if it were RGB888, the pixels that `test` finds in its colors. */
iris_hsl_range_test iris_hsl_range_of_bgr(const iris_hsl_range_test *test);

/* Rows of n pixels between HSL and RGB888 (red = 0) or BGR888 (red = 2). HSL24 works in place. */
void iris_hsl48_row_from_888(uint16_t *dst, const uint8_t *src, int32_t n, int red);
void iris_hsl48_row_to_888(uint8_t *dst, const uint16_t *src, int32_t n, int red);
void iris_hsl24_row_to_888(uint8_t *dst, const uint8_t *src, int32_t n, int red);

#endif
