/* Tone curves, adjustment of colors, and equalization. */
#include "iris/xt/tone.h"

#include "calls.h"
#include "iris/xt/equalize.h"

/* A tone that a call may change. */
static iris_tone *any_tone(void)
{
    return draw_results(sizeof(iris_tone));
}

static const iris_tone *given_tone(void)
{
    return draw_given(NULL, sizeof(iris_tone));
}

/* 256 counts: a few or many, small or huge; sometimes none. */
static const uint32_t *any_histogram(void)
{
    uint32_t histogram[256] = {0};
    uint32_t sparse = 1 + draw_below(100), most = draw_chance(10) ? UINT32_MAX : 1 + draw_below(5000);
    for (int i = 0; i < 256 && !draw_chance(200); i++) {
        histogram[i] = draw_chance(sparse) ? draw_below(most) : 0;
    }
    return draw_given(histogram, sizeof histogram);
}

static void identity(void)
{
    iris_tone *tone = OR_NULL(any_tone());
    CALL(iris_tone_identity(tone));
}

static void negate(void)
{
    iris_tone *tone = OR_NULL(any_tone());
    CALL(iris_tone_negate(tone));
}

static void add(void)
{
    iris_tone *tone = OR_NULL(any_tone());
    int32_t amount = draw_int(-255, 255);
    CALL(iris_tone_add(tone, amount));
}

static void compress(void)
{
    iris_tone *tone = OR_NULL(any_tone());
    iris_q16 c = draw_int(0, draw_chance(4) ? INT32_MAX : 2 * IRIS_TONE_COMPRESS_C);
    CALL(iris_tone_compress(tone, c));
}

static void gamma_step(void)
{
    iris_tone *tone = OR_NULL(any_tone());
    iris_q16 gamma = draw_int(1, draw_chance(4) ? INT32_MAX : 4 * IRIS_Q16_ONE);
    CALL(iris_tone_gamma(tone, gamma));
}

static void stretch(void)
{
    iris_tone_segments segments;
    iris_tone_segments_defaults(&segments);
    segments.a = draw_int(0, 255);
    segments.b = draw_int(segments.a > 0 ? segments.a : 0, 255);
    if (draw_chance(2)) {
        segments.below = draw_int(INT32_MIN, INT32_MAX);
        segments.between = draw_int(INT32_MIN, INT32_MAX);
        segments.above = draw_int(INT32_MIN, INT32_MAX);
    }
    iris_tone *tone = OR_NULL(any_tone());
    const iris_tone_segments *given = draw_chance(10) ? NULL : draw_given(&segments, sizeof segments);
    CALL(iris_tone_stretch(tone, given));
}

static void levels(void)
{
    iris_tone *tone = OR_NULL(any_tone());
    int32_t low = draw_int(0, 255), high = draw_int(low > 0 ? low : 0, 255);
    CALL(iris_tone_levels(tone, low, high));
}

static void stretch_share(void)
{
    iris_tone *tone = OR_NULL(any_tone());
    const uint32_t *histogram = OR_NULL(any_histogram());
    iris_q16 share = draw_int(0, 32767);
    CALL(iris_tone_stretch_share(tone, histogram, share));
}

static void equalize_tone(void)
{
    iris_tone *tone = OR_NULL(any_tone());
    const uint32_t *histogram = OR_NULL(any_histogram());
    CALL(iris_tone_equalize(tone, histogram));
}

static void then(void)
{
    iris_tone *tone = OR_NULL(any_tone());
    const iris_tone *next = draw_chance(4) ? tone : OR_NULL(given_tone());
    CALL(iris_tone_then(tone, next));
}

static void apply(void)
{
    iris_format format = draw_gray_or_color();
    iris_size size = draw_size();
    const iris_image *dst = draw_output(format, size);
    const iris_image *src = draw_input(format, size);
    const iris_tone *tone = OR_NULL(given_tone());
    CALL(iris_tone_apply(dst, src, tone));
}

static void apply_rgb(void)
{
    iris_format format = draw_either(IRIS_RGB888, IRIS_BGR888);
    iris_size size = draw_size();
    const iris_image *dst = draw_output(format, size);
    const iris_image *src = draw_input(format, size);
    const iris_tone *red = OR_NULL(given_tone());
    const iris_tone *green = draw_chance(2) ? red : OR_NULL(given_tone());
    const iris_tone *blue = draw_chance(2) ? red : OR_NULL(given_tone());
    CALL(iris_tone_apply_rgb(dst, src, red, green, blue));
}

static void apply_lightness(void)
{
    iris_format format = draw_gray_or_color();
    iris_size size = draw_size();
    const iris_image *dst = draw_output(format, size);
    const iris_image *src = draw_input(format, size);
    const iris_tone *tone = OR_NULL(given_tone());
    CALL(iris_tone_apply_lightness(dst, src, tone));
}

static void row(void)
{
    int32_t n = draw_within(0, 70), count = draw_chance(20) ? draw_within(-1, 0) : n;
    uint8_t *dst = OR_NULL(draw_results((size_t)n));
    const uint8_t *src = draw_chance(3) ? dst : OR_NULL(draw_given(NULL, (size_t)n));
    const iris_tone *tone = OR_NULL(given_tone());
    CALL(iris_tone_row(dst, src, count, tone));
}

static void adjust(void)
{
    iris_adjustment by = {0};
    int32_t *numbers[] = {&by.red, &by.green, &by.blue, &by.hue, &by.saturation, &by.lightness};
    static const int32_t most[] = {255, 255, 255, 1000, 100, 100};
    for (int i = 0; i < 6; i++) {
        *numbers[i] = draw_chance(3)
                          ? draw_chance(3) ? draw_int(-most[i], most[i]) : draw_within(-most[i], most[i])
                          : 0;
    }
    iris_format format = draw_either(IRIS_RGB888, IRIS_BGR888);
    iris_size size = draw_size();
    const iris_image *dst = draw_output(format, size);
    const iris_image *src = draw_input(format, size);
    const iris_adjustment *given = OR_NULL(draw_given(&by, sizeof by));
    CALL(iris_adjust(dst, src, given));
}

static void equalize(void)
{
    iris_format format = draw_gray_or_color();
    iris_size size = draw_size();
    const iris_image *dst = draw_output(format, size);
    const iris_image *src = draw_input(format, size);
    iris_scratch *scratch = draw_scratch(IRIS_EQUALIZE_SCRATCH_BYTES);
    CALL(iris_equalize(dst, src, scratch));
}

static void equalize_local(void)
{
    iris_equalize_local_config config;
    iris_equalize_local_defaults(&config);
    if (draw_chance(2)) {
        config.tiles = draw_int(1, draw_chance(8) ? IRIS_EQUALIZE_TILES_MAX : 10);
        config.limit_q16 = draw_int(0, 256 * IRIS_Q16_ONE);
    }
    iris_format format = draw_gray_or_color();
    iris_size size = draw_size();
    const iris_image *dst = draw_output(format, size);
    const iris_image *src = draw_input(format, size);
    const iris_equalize_local_config *given = draw_given(&config, sizeof config);
    int fits = config.tiles >= 1 && config.tiles <= IRIS_EQUALIZE_TILES_MAX;
    iris_scratch *scratch = draw_scratch(fits ? IRIS_EQUALIZE_LOCAL_SCRATCH_BYTES(config.tiles) : 0);
    CALL(iris_equalize_local(dst, src, given, scratch));
}

const random_call calls_tone[] = {
    {"iris_tone_identity", identity},
    {"iris_tone_negate", negate},
    {"iris_tone_add", add},
    {"iris_tone_compress", compress},
    {"iris_tone_gamma", gamma_step},
    {"iris_tone_stretch", stretch},
    {"iris_tone_levels", levels},
    {"iris_tone_stretch_share", stretch_share},
    {"iris_tone_equalize", equalize_tone},
    {"iris_tone_then", then},
    {"iris_tone_apply", apply},
    {"iris_tone_apply_rgb", apply_rgb},
    {"iris_tone_apply_lightness", apply_lightness},
    {"iris_tone_row", row},
    {"iris_adjust", adjust},
    {"iris_equalize", equalize},
    {"iris_equalize_local", equalize_local},
    {NULL, NULL},
};
