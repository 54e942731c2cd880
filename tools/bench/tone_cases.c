#include "bench.h"

#include "iris/xt/equalize.h"
#include "iris/xt/histogram.h"
#include "iris/xt/tone.h"

static iris_tone tone;
static uint32_t counts[256];

static void prepare_tone(void)
{
    (void)iris_tone_identity(&tone);
    (void)iris_tone_gamma(&tone, IRIS_Q16_ONE / 2);
}

static iris_status histogram(void)
{
    return iris_histogram(counts, &bench_frame.gray, 0, NULL);
}

static iris_status histogram_masked(void)
{
    return iris_histogram(counts, &bench_frame.gray, 0, &bench_frame.mask);
}

static iris_status histogram_lightness(void)
{
    return iris_histogram(counts, &bench_frame.rgb, IRIS_CHANNEL_LIGHTNESS, NULL);
}

static iris_status apply(void)
{
    return iris_tone_apply(&bench_frame.gray_to, &bench_frame.gray, &tone);
}

static iris_status apply_rgb(void)
{
    return iris_tone_apply_rgb(&bench_frame.rgb_to, &bench_frame.rgb, &tone, &tone, &tone);
}

static iris_status apply_lightness(void)
{
    return iris_tone_apply_lightness(&bench_frame.rgb_to, &bench_frame.rgb, &tone);
}

static iris_status adjust_rgb(void)
{
    const iris_adjustment by = {.red = 20, .blue = -10};
    return iris_adjust(&bench_frame.rgb_to, &bench_frame.rgb, &by);
}

static iris_status adjust_hue(void)
{
    const iris_adjustment by = {.hue = 30};
    return iris_adjust(&bench_frame.rgb_to, &bench_frame.rgb, &by);
}

static iris_status equalize(void)
{
    return iris_equalize(&bench_frame.gray_to, &bench_frame.gray, &bench_frame.scratch);
}

static iris_status equalize_local(void)
{
    return iris_equalize_local(&bench_frame.gray_to, &bench_frame.gray, NULL, &bench_frame.scratch);
}

const bench_case bench_tone[] = {
    {"tone curve on gray", apply, prepare_tone},
    {"tone curves on RGB", apply_rgb, prepare_tone},
    {"tone curve on the lightness of RGB", apply_lightness, prepare_tone},
    {"adjust red and blue", adjust_rgb, NULL},
    {"adjust the hue", adjust_hue, NULL},
    {"histogram of gray", histogram, NULL},
    {"histogram of what a mask selects", histogram_masked, NULL},
    {"histogram of the lightness of RGB", histogram_lightness, NULL},
    {"equalize gray", equalize, NULL},
    {"equalize gray locally, 8x8 tiles", equalize_local, NULL},
    {0},
};
