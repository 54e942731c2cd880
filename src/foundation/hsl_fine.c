#include "hsl_fine.h"

#include "hsl.h"

iris_hsl_fine iris_hsl_fine_of(iris_color color)
{
    iris_hsl_extent extent = iris_hsl_extent_of(color.r, color.g, color.b);
    iris_hsl_fine hsl = {0, 0, extent.sum << 20};
    if (extent.chroma > 0) {
        int32_t hue = iris_hsl_hue_times_chroma(color.r, color.g, color.b, extent);
        int32_t limit = iris_hsl_chroma_limit(extent.sum);
        hsl.h_q16 = ((hue << 16) + extent.chroma / 2) / extent.chroma;
        hsl.s_q20 = ((extent.chroma << 20) + limit / 2) / limit;
    }
    return hsl;
}

/* The part of the chroma, with 16 fraction bits, that a channel lies above m when the hue is h away from that channel's: all
 * of it up to 60 degrees away, none from 120 on. */
static int32_t share_q16(int32_t h_q16)
{
    int32_t away = h_q16 >= IRIS_HSL_FINE_TURN / 2 ? IRIS_HSL_FINE_TURN - h_q16 : h_q16;
    int32_t share = (2 << 16) - away;
    return share < 0 ? 0 : share > 1 << 16 ? 1 << 16 : share;
}

static uint8_t channel(int32_t low_q20, int32_t chroma_q20, int32_t h_q16)
{
    int64_t twice_q20 = low_q20 + (((int64_t)chroma_q20 * share_q16(h_q16)) >> 15);
    return (uint8_t)((twice_q20 + (1 << 20)) >> 21);
}

iris_color iris_hsl_fine_color(iris_hsl_fine hsl)
{
    int32_t limit_q20 = hsl.l_q20 <= IRIS_HSL_FINE_L / 2 ? hsl.l_q20 : IRIS_HSL_FINE_L - hsl.l_q20;
    int32_t chroma_q20 = (int32_t)(((int64_t)hsl.s_q20 * limit_q20) >> 20);
    int32_t low_q20 = hsl.l_q20 - chroma_q20; /* twice m */
    int32_t from_green = hsl.h_q16 + (hsl.h_q16 < 2 << 16 ? 4 << 16 : -(2 << 16));
    int32_t from_blue = hsl.h_q16 + (hsl.h_q16 < 4 << 16 ? 2 << 16 : -(4 << 16));
    iris_color color = {channel(low_q20, chroma_q20, hsl.h_q16), channel(low_q20, chroma_q20, from_green),
                        channel(low_q20, chroma_q20, from_blue)};
    return color;
}
