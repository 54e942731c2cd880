/* The plain C bodies of the row kernels that need more than one channel's arithmetic, on every port. */
#include "hsl.h"
#include "kernel.h"

/* Is the color in the range? Percent and degrees are compared across: C / D >= s / 100 as 100 C >= s D. */
static int in_range(const uint8_t *rgb, const iris_hsl_range_test *test)
{
    iris_hsl_extent extent = iris_hsl_extent_of(rgb[0], rgb[1], rgb[2]);
    if (extent.sum < test->l0 || extent.sum > test->l1 || extent.chroma < test->chroma_min) {
        return 0;
    }
    int32_t percent = 100 * extent.chroma;
    int32_t limit = iris_hsl_chroma_limit(extent.sum);
    if (percent < test->s0 * limit || percent > test->s1 * limit) {
        return 0;
    }
    if (extent.chroma == 0) {
        return test->hue_has_gray;
    }
    int32_t degrees = 60 * iris_hsl_hue_times_chroma(rgb[0], rgb[1], rgb[2], extent);
    int above = degrees >= test->h0 * extent.chroma;
    int below = degrees <= test->h1 * extent.chroma;
    return test->hue_wraps ? above | below : above & below;
}

void iris_row_hsl_range_c(uint32_t *mask, const uint8_t *rgb, const iris_hsl_range_test *test, int32_t n)
{
    for (int32_t start = 0; start < n; start += 32) {
        int32_t count = n - start < 32 ? n - start : 32;
        uint32_t bits = 0;
        for (int32_t i = 0; i < count; i++, rgb += 3) {
            bits |= (uint32_t)in_range(rgb, test) << i;
        }
        iris_row_put_bits(&mask[start / 32], bits, count);
    }
}

void iris_row_hsl24_888_c(uint8_t *dst, const uint8_t *src, int32_t red, int32_t n)
{
    for (int32_t i = 0; i < n; i++, src += 3, dst += 3) {
        iris_hsl hsl = iris_hsl_of(src[red], src[1], src[2 - red], 256, 255);
        dst[0] = (uint8_t)hsl.h;
        dst[1] = (uint8_t)hsl.s;
        dst[2] = (uint8_t)((hsl.l + 1) / 2);
    }
}
