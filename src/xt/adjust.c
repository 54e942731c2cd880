/* Independent adjustment of color channels. */
#include "../foundation/hsl_fine.h"
#include "tone_picture.h"

#include "iris/xt/tone.h"

static int32_t clamp(int32_t value, int32_t high)
{
    return value < 0 ? 0 : value > high ? high : value;
}

/* What is added. */
static iris_hsl_fine shift_of(const iris_adjustment *by)
{
    int32_t degrees = by->hue % 360;
    degrees = degrees < 0 ? degrees + 360 : degrees;
    return (iris_hsl_fine){degrees * 65536 / 60, by->saturation * IRIS_HSL_FINE_S / 100,
                           (int32_t)((int64_t)by->lightness * IRIS_HSL_FINE_L / 100)};
}

static iris_color color_shifted(iris_color color, iris_hsl_fine add)
{
    iris_hsl_fine hsl = iris_hsl_fine_of(color);
    int is_gray = color.r == color.g && color.g == color.b;
    hsl.h_q16 = (hsl.h_q16 + add.h_q16) % IRIS_HSL_FINE_TURN;
    hsl.s_q20 = is_gray ? 0 : clamp(hsl.s_q20 + add.s_q20, IRIS_HSL_FINE_S);
    hsl.l_q20 = clamp(hsl.l_q20 + add.l_q20, IRIS_HSL_FINE_L);
    return iris_hsl_fine_color(hsl);
}

static int is_outside(int32_t value, int32_t limit)
{
    return value < -limit || value > limit;
}

iris_status iris_adjust(const iris_image *dst, const iris_image *src, const iris_adjustment *by)
{
    iris_status status = by ? iris_tone_check(dst, src) : IRIS_ERR_ARG;
    if (status != IRIS_OK || src->format == IRIS_GRAY8) {
        return status != IRIS_OK ? status : IRIS_ERR_FORMAT;
    }
    if (is_outside(by->red, 255) || is_outside(by->green, 255) || is_outside(by->blue, 255) ||
        is_outside(by->saturation, 100) || is_outside(by->lightness, 100)) {
        return IRIS_ERR_RANGE;
    }
    int red = src->format == IRIS_RGB888 ? 0 : 2;
    iris_hsl_fine add = shift_of(by);
    int is_shifted = add.h_q16 != 0 || add.s_q20 != 0 || add.l_q20 != 0;
    for (int32_t y = 0; y < src->h; y++) {
        uint8_t *to = (uint8_t *)iris_image_row(dst, y);
        const uint8_t *from = (const uint8_t *)iris_image_row(src, y);
        for (int32_t i = 0; i < 3 * src->w; i += 3) {
            iris_color color = iris_tone_color_at(from + i, red);
            color.r = (uint8_t)clamp(color.r + by->red, 255);
            color.g = (uint8_t)clamp(color.g + by->green, 255);
            color.b = (uint8_t)clamp(color.b + by->blue, 255);
            iris_tone_color_put(to + i, is_shifted ? color_shifted(color, add) : color, red);
        }
    }
    return IRIS_OK;
}
