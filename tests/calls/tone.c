/* Tones, histograms, and equalization. */
#include "iris/xt/tone.h"

#include "calls.h"
#include "iris/xt/equalize.h"
#include "iris/xt/histogram.h"

static iris_tone *any_tone(void)
{
    return draw_chance(60) ? NULL : draw_given(NULL, sizeof(iris_tone));
}

static iris_tone *any_result(void)
{
    return draw_chance(60) ? NULL : draw_results(sizeof(iris_tone));
}

static uint32_t *any_histogram(void)
{
    uint32_t histogram[256] = {0};
    uint32_t one_in = draw_chance(2) ? 2 : 60;
    uint32_t end = draw_chance(10) ? UINT32_MAX : 4000000;
    for (int p = 0; p < 256; p++) {
        histogram[p] = draw_chance(one_in) ? draw_below(end) : 0;
    }
    return draw_chance(60) ? NULL : draw_given(histogram, sizeof histogram);
}

static void curve(void)
{
    iris_tone *tone = any_result();
    switch (draw_below(4)) {
    case 0: {
        int32_t amount = draw_int(-255, 255);
        CALL(iris_tone_add(tone, amount));
        break;
    }
    case 1: {
        iris_q16 c = draw_int(0, 100 * IRIS_Q16_ONE);
        CALL(iris_tone_compress(tone, c));
        break;
    }
    case 2: {
        iris_q16 gamma = draw_int(1, 5 * IRIS_Q16_ONE);
        CALL(iris_tone_gamma(tone, gamma));
        break;
    }
    default: {
        int32_t low = draw_int(0, 128), high = draw_int(low, 255);
        CALL(iris_tone_levels(tone, low, high));
    }
    }
}

static void stretch(void)
{
    iris_tone_segments by;
    by.a = draw_int(0, 128);
    by.b = draw_int(by.a, 255);
    by.below = draw_int(INT32_MIN, INT32_MAX);
    by.between = draw_int(-4 * IRIS_Q16_ONE, 4 * IRIS_Q16_ONE);
    by.above = draw_int(INT32_MIN, INT32_MAX);
    iris_tone *tone = any_result();
    const iris_tone_segments *given = draw_chance(10) ? NULL : draw_given(&by, sizeof by);
    CALL(iris_tone_stretch(tone, given));
}

static void by_histogram(void)
{
    iris_tone *tone = any_result();
    const uint32_t *histogram = any_histogram();
    iris_q16 share = draw_int(0, IRIS_Q16_ONE / 2 - 1);
    if (draw_chance(2)) {
        CALL(iris_tone_stretch_share(tone, histogram, share));
    } else {
        CALL(iris_tone_equalize(tone, histogram));
    }
}

static void pictures(void)
{
    iris_size size = draw_size();
    iris_format format = draw_gray_or_color();
    const iris_image *dst = draw_output(format, size), *src = draw_input(format, size);
    const iris_tone *tone = any_tone(), *green = any_tone(), *blue = any_tone();
    switch (draw_below(3)) {
    case 0:
        CALL(iris_tone_apply(dst, src, tone));
        break;
    case 1:
        CALL(iris_tone_apply_rgb(dst, src, tone, green, blue));
        break;
    default:
        CALL(iris_tone_apply_lightness(dst, src, tone));
    }
}

static void adjust(void)
{
    iris_size size = draw_size();
    iris_format format = draw_either(IRIS_RGB888, IRIS_BGR888);
    const iris_image *dst = draw_output(format, size), *src = draw_input(format, size);
    iris_adjustment by;
    by.red = draw_int(-255, 255);
    by.green = draw_int(-255, 255);
    by.blue = draw_int(-255, 255);
    by.hue = draw_int(INT32_MIN, INT32_MAX);
    by.saturation = draw_int(-100, 100);
    by.lightness = draw_int(-100, 100);
    const iris_adjustment *given = OR_NULL(draw_given(&by, sizeof by));
    CALL(iris_adjust(dst, src, given));
}

static void histogram_of(void)
{
    static const iris_format formats[] = {IRIS_GRAY8, IRIS_MASK1, IRIS_RGB888, IRIS_BGR888, IRIS_HSL24};
    iris_size size = draw_size();
    iris_format format = formats[draw_below(5)];
    uint32_t *histogram = OR_NULL(draw_results(256 * sizeof(uint32_t)));
    const iris_image *src = draw_input(format, size);
    const iris_image *mask = draw_chance(2) ? NULL : draw_input(IRIS_MASK1, size);
    int32_t channel = format == IRIS_GRAY8 || format == IRIS_MASK1 ? draw_int(0, 0) : draw_int(-1, 2);
    CALL(iris_histogram(histogram, src, channel, mask));
}

static void measured(void)
{
    const uint32_t *histogram = any_histogram();
    iris_q16 share = draw_int(0, IRIS_Q16_ONE);
    if (draw_chance(2)) {
        uint8_t *level = OR_NULL(draw_results(1));
        CALL(iris_histogram_percentile(level, histogram, share));
    } else {
        iris_histogram_statistics *is = OR_NULL(draw_results(sizeof *is));
        CALL(iris_histogram_measure(is, histogram));
    }
}

static void equalize(void)
{
    iris_size size = draw_size();
    iris_format format = draw_gray_or_color();
    const iris_image *dst = draw_output(format, size), *src = draw_input(format, size);
    iris_scratch *scratch = draw_scratch(IRIS_EQUALIZE_SCRATCH_BYTES);
    CALL(iris_equalize(dst, src, scratch));
}

static void equalize_local(void)
{
    iris_size size = draw_size();
    iris_format format = draw_gray_or_color();
    const iris_image *dst = draw_output(format, size), *src = draw_input(format, size);
    int32_t shorter = size.w < size.h ? size.w : size.h;
    iris_equalize_local_config by;
    by.tiles = draw_int(1, shorter < 2                         ? 1
                           : shorter > IRIS_EQUALIZE_TILES_MAX ? IRIS_EQUALIZE_TILES_MAX
                                                               : shorter);
    by.limit_q16 = draw_int(0, 256 * IRIS_Q16_ONE);
    const iris_equalize_local_config *given = draw_given(&by, sizeof by);
    int fits = by.tiles > 0 && by.tiles <= IRIS_EQUALIZE_TILES_MAX;
    iris_scratch *scratch = draw_scratch(fits ? IRIS_EQUALIZE_LOCAL_SCRATCH_BYTES(by.tiles) : 0);
    CALL(iris_equalize_local(dst, src, given, scratch));
}

const random_call calls_tone[] = {
    {"iris_tone_gamma and others", curve},
    {"iris_tone_stretch", stretch},
    {"iris_tone_equalize, iris_tone_stretch_share", by_histogram},
    {"iris_tone_apply and others", pictures},
    {"iris_adjust", adjust},
    {"iris_histogram", histogram_of},
    {"iris_histogram_measure, iris_histogram_percentile", measured},
    {"iris_equalize", equalize},
    {"iris_equalize_local", equalize_local},
    {NULL, NULL},
};
