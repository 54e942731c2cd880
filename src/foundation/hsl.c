#include "hsl.h"

#include "iris/color.h"

/* n / d rounded half up; n >= 0, d > 0. */
static uint32_t divide(int32_t n, int32_t d)
{
    return ((uint32_t)n + (uint32_t)d / 2) / (uint32_t)d;
}

/* HSL with `hues` steps to a turn and saturation up to s_max; L is the sum of the largest and smallest
 * channel. */
static iris_hsl hsl_of(iris_color color, int32_t hues, int32_t s_max)
{
    iris_hsl_extent extent = iris_hsl_extent_of(color.r, color.g, color.b);
    iris_hsl hsl = {0, 0, (uint16_t)extent.sum};
    if (extent.chroma > 0) {
        int32_t hue = iris_hsl_hue_times_chroma(color.r, color.g, color.b, extent);
        hsl.h = (uint16_t)divide(hues * hue, 6 * extent.chroma);
        hsl.s = (uint16_t)divide(s_max * extent.chroma, iris_hsl_chroma_limit(extent.sum));
    }
    return hsl;
}

iris_hsl iris_hsl_from_color(iris_color color)
{
    return hsl_of(color, 1536, 65535);
}

static iris_color color_of(uint8_t r, uint8_t g, uint8_t b)
{
    iris_color color = {r, g, b};
    return color;
}

iris_color iris_color_from_hsl(iris_hsl hsl)
{
    int32_t sum = hsl.l > 510 ? 510 : hsl.l;
    int32_t chroma = (int32_t)(((uint32_t)hsl.s * (uint32_t)iris_hsl_chroma_limit(sum) + 32767u) / 65535u);
    int32_t max = (sum + chroma + 1) / 2;
    int32_t min = max - chroma;
    int32_t rise = (hsl.h % 256 * chroma + 128) / 256;
    uint8_t high = (uint8_t)max, low = (uint8_t)min, up = (uint8_t)(min + rise), down = (uint8_t)(max - rise);
    switch (hsl.h / 256 % 6) {
    case 0:
        return color_of(high, up, low);
    case 1:
        return color_of(down, high, low);
    case 2:
        return color_of(low, high, up);
    case 3:
        return color_of(low, down, high);
    case 4:
        return color_of(up, low, high);
    default:
        return color_of(high, low, down);
    }
}

static iris_color color_at(const uint8_t *pixel, int red)
{
    return color_of(pixel[red], pixel[1], pixel[2 - red]);
}

static void color_put(uint8_t *pixel, iris_color color, int red)
{
    pixel[red] = color.r;
    pixel[1] = color.g;
    pixel[2 - red] = color.b;
}

void iris_hsl48_row_from_888(uint16_t *dst, const uint8_t *src, int32_t n, int red)
{
    for (int32_t i = 0; i < n; i++, src += 3, dst += 3) {
        iris_hsl hsl = hsl_of(color_at(src, red), 1536, 65535);
        dst[0] = hsl.h;
        dst[1] = hsl.s;
        dst[2] = hsl.l;
    }
}

void iris_hsl24_row_from_888(uint8_t *dst, const uint8_t *src, int32_t n, int red)
{
    for (int32_t i = 0; i < n; i++, src += 3, dst += 3) {
        iris_hsl hsl = hsl_of(color_at(src, red), 256, 255);
        dst[0] = (uint8_t)hsl.h;
        dst[1] = (uint8_t)hsl.s;
        dst[2] = (uint8_t)((hsl.l + 1) / 2);
    }
}

void iris_hsl48_row_to_888(uint8_t *dst, const uint16_t *src, int32_t n, int red)
{
    for (int32_t i = 0; i < n; i++, src += 3, dst += 3) {
        iris_hsl hsl = {src[0], src[1], src[2]};
        color_put(dst, iris_color_from_hsl(hsl), red);
    }
}

void iris_hsl24_row_to_888(uint8_t *dst, const uint8_t *src, int32_t n, int red)
{
    for (int32_t i = 0; i < n; i++, src += 3, dst += 3) {
        iris_hsl hsl = {(uint16_t)(src[0] * 6), (uint16_t)(src[1] * 257), (uint16_t)(src[2] * 2)};
        color_put(dst, iris_color_from_hsl(hsl), red);
    }
}
