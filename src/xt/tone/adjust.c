/* Independent adjustment of color channels. Hue, saturation, and lightness are added with fraction bits, so that a color
 * comes back as it was when nothing is added, and as the nearest one when something is.
 */
#include "../../foundation/hsl.h"
#include "../../foundation/views.h"
#include "iris/xt/tone.h"

#define TURN_Q16 ((int32_t)6 << 16)
#define S_MAX    ((int32_t)1 << 20)
#define L_MAX    ((int32_t)510 << 20)

typedef struct {
    int32_t h_q16; /* of 60 degrees: 0 up to below TURN_Q16; 0 for grays */
    int32_t s_q20; /* 0 to S_MAX; 0 for grays */
    int32_t l_q20; /* of M + m: 0 to L_MAX */
} fine_hsl;

static inline fine_hsl hsl_of(int32_t r, int32_t g, int32_t b)
{
    iris_hsl_extent extent = iris_hsl_extent_of(r, g, b);
    fine_hsl hsl = {0, 0, extent.sum << 20};
    if (extent.chroma > 0) {
        int32_t hue = iris_hsl_hue_times_chroma(r, g, b, extent);
        int32_t limit = iris_hsl_chroma_limit(extent.sum);
        hsl.h_q16 = ((hue << 16) + extent.chroma / 2) / extent.chroma;
        hsl.s_q20 = ((extent.chroma << 20) + limit / 2) / limit;
    }
    return hsl;
}

/* The part of the chroma that a channel lies above m when the hue is h away from that channel's: all of it up to 60
 * degrees away, none from 120 on. */
static inline int32_t share_q16(int32_t h_q16)
{
    int32_t away = h_q16 >= TURN_Q16 / 2 ? TURN_Q16 - h_q16 : h_q16;
    int32_t share = (2 << 16) - away;
    return share < 0 ? 0 : share > 1 << 16 ? 1 << 16 : share;
}

static inline uint8_t channel_of(int32_t low_q20, int32_t chroma_q20, int32_t h_q16)
{
    int64_t twice_q20 = low_q20 + (((int64_t)chroma_q20 * share_q16(h_q16)) >> 15);
    return (uint8_t)((twice_q20 + (1 << 20)) >> 21);
}

/* Red goes to byte `red` of the pixel, 0 or 2. */
static inline void put_hsl(uint8_t *pixel, fine_hsl hsl, int red)
{
    int32_t limit_q20 = hsl.l_q20 <= L_MAX / 2 ? hsl.l_q20 : L_MAX - hsl.l_q20;
    int32_t chroma_q20 = (int32_t)(((int64_t)hsl.s_q20 * limit_q20) >> 20);
    int32_t low_q20 = hsl.l_q20 - chroma_q20; /* twice m */
    int32_t from_green = hsl.h_q16 + (hsl.h_q16 < 2 << 16 ? 4 << 16 : -(2 << 16));
    int32_t from_blue = hsl.h_q16 + (hsl.h_q16 < 4 << 16 ? 2 << 16 : -(4 << 16));
    pixel[red] = channel_of(low_q20, chroma_q20, hsl.h_q16);
    pixel[1] = channel_of(low_q20, chroma_q20, from_green);
    pixel[2 - red] = channel_of(low_q20, chroma_q20, from_blue);
}

static inline int32_t clamp(int32_t value, int32_t high)
{
    return value < 0 ? 0 : value > high ? high : value;
}

/* What is added. */
static fine_hsl shift_of(const iris_adjustment *by)
{
    int32_t degrees = by->hue % 360;
    degrees = degrees < 0 ? degrees + 360 : degrees;
    return (fine_hsl){degrees * 65536 / 60, by->saturation * S_MAX / 100,
                      (int32_t)((int64_t)by->lightness * L_MAX / 100)};
}

static inline fine_hsl shifted(fine_hsl hsl, fine_hsl add)
{
    int32_t h = hsl.h_q16 + add.h_q16;
    hsl.h_q16 = h >= TURN_Q16 ? h - TURN_Q16 : h;
    hsl.s_q20 = hsl.s_q20 > 0 ? clamp(hsl.s_q20 + add.s_q20, S_MAX) : 0;
    hsl.l_q20 = clamp(hsl.l_q20 + add.l_q20, L_MAX);
    return hsl;
}

static void row_adjust(uint8_t *dst, const uint8_t *src, int32_t n, int red, const iris_adjustment *by)
{
    fine_hsl add = shift_of(by);
    int is_shifted = add.h_q16 != 0 || add.s_q20 != 0 || add.l_q20 != 0;
    for (int32_t i = 0; i < 3 * n; i += 3) {
        int32_t r = clamp(src[i + red] + by->red, 255);
        int32_t g = clamp(src[i + 1] + by->green, 255);
        int32_t b = clamp(src[i + 2 - red] + by->blue, 255);
        if (is_shifted) {
            put_hsl(dst + i, shifted(hsl_of(r, g, b), add), red);
            continue;
        }
        dst[i + red] = (uint8_t)r;
        dst[i + 1] = (uint8_t)g;
        dst[i + 2 - red] = (uint8_t)b;
    }
}

static int is_outside(int32_t value, int32_t limit)
{
    return value < -limit || value > limit;
}

iris_status iris_adjust(const iris_image *dst, const iris_image *src, const iris_adjustment *by)
{
    iris_status status = by ? iris_views_check_levels(dst, src, IRIS_BORDER_NONE) : IRIS_ERR_ARG;
    if (status != IRIS_OK || src->format == IRIS_GRAY8) {
        return status != IRIS_OK ? status : IRIS_ERR_FORMAT;
    }
    if (is_outside(by->red, 255) || is_outside(by->green, 255) || is_outside(by->blue, 255) ||
        is_outside(by->saturation, 100) || is_outside(by->lightness, 100)) {
        return IRIS_ERR_ARG;
    }
    for (int32_t y = 0; y < src->h; y++) {
        row_adjust((uint8_t *)iris_image_row(dst, y), (const uint8_t *)iris_image_row(src, y), src->w,
                   src->format == IRIS_RGB888 ? 0 : 2, by);
    }
    return IRIS_OK;
}
