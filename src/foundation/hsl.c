#include "hsl.h"

#include "iris/color.h"

iris_hsl iris_hsl_from_color(iris_color color)
{
    return iris_hsl_of(color.r, color.g, color.b, 1536, 65535);
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

static void color_put(uint8_t *pixel, iris_color color, int red)
{
    pixel[red] = color.r;
    pixel[1] = color.g;
    pixel[2 - red] = color.b;
}

void iris_hsl48_row_from_888(uint16_t *dst, const uint8_t *src, int32_t n, int red)
{
    for (int32_t i = 0; i < n; i++, src += 3, dst += 3) {
        iris_hsl hsl = iris_hsl_of(src[red], src[1], src[2 - red], 1536, 65535);
        dst[0] = hsl.h;
        dst[1] = hsl.s;
        dst[2] = hsl.l;
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
