/* Blurs and the median. */
#include "iris/xt/blur.h"

#include "calls.h"
#include "iris/xt/median.h"
#include "iris/xt/unsharp.h"

static size_t channels_of(iris_format format)
{
    return format == IRIS_GRAY8 ? 1 : 3;
}

static void gaussian(void)
{
    iris_format format = draw_gray_or_color();
    iris_size size = draw_size();
    const iris_image *dst = draw_output(format, size);
    const iris_image *src = draw_input(format, size);
    iris_q16 sigma = draw_int(IRIS_BLUR_SIGMA_MIN, draw_chance(8) ? IRIS_BLUR_SIGMA_MAX : 3 * IRIS_Q16_ONE);
    int fits = sigma >= IRIS_BLUR_SIGMA_MIN && sigma <= IRIS_BLUR_SIGMA_MAX;
    iris_border border = draw_border();
    iris_scratch *scratch =
        draw_scratch(fits ? IRIS_BLUR_GAUSSIAN_SCRATCH_BYTES(size.w, channels_of(format), sigma) : 0);
    CALL(iris_blur_gaussian(dst, src, sigma, border, scratch));
}

static void box(void)
{
    iris_format format = draw_gray_or_color();
    iris_size size = draw_size();
    const iris_image *dst = draw_output(format, size);
    const iris_image *src = draw_input(format, size);
    int32_t side = draw_int(1, draw_chance(8) ? IRIS_BLUR_SIDE_MAX : 20);
    int fits = side >= 1 && side <= IRIS_BLUR_SIDE_MAX;
    iris_border border = draw_border();
    iris_scratch *scratch =
        draw_scratch(fits ? IRIS_BLUR_BOX_SCRATCH_BYTES(size.w, channels_of(format), side) : 0);
    CALL(iris_blur_box(dst, src, side, border, scratch));
}

static void median(void)
{
    iris_format format = draw_gray_or_color();
    iris_size size = draw_size();
    const iris_image *dst = draw_output(format, size);
    const iris_image *src = draw_input(format, size);
    int32_t side = draw_chance(6) ? draw_int(1, 7) : 3 + 2 * draw_within(0, 1);
    int fits = side == 3 || side == 5;
    iris_border border = draw_border();
    iris_scratch *scratch =
        draw_scratch(fits ? IRIS_MEDIAN_SCRATCH_BYTES(size.w, channels_of(format), side) : 0);
    CALL(iris_median(dst, src, side, border, scratch));
}

static void unsharp(void)
{
    iris_unsharp_config config;
    iris_unsharp_defaults(&config);
    if (draw_chance(2)) {
        config.sigma_q16 = draw_int(IRIS_BLUR_SIGMA_MIN, draw_chance(8) ? IRIS_BLUR_SIGMA_MAX : 200000);
        config.amount_q16 = draw_int(0, IRIS_UNSHARP_AMOUNT_MAX);
        config.threshold = draw_int(0, 255);
    }
    int fits = config.sigma_q16 >= IRIS_BLUR_SIGMA_MIN && config.sigma_q16 <= IRIS_BLUR_SIGMA_MAX;
    iris_format format = draw_gray_or_color();
    iris_size size = draw_size();
    const iris_image *dst = draw_output(format, size);
    const iris_image *src = draw_input(format, size);
    const iris_unsharp_config *given = draw_given(&config, sizeof config);
    iris_border border = draw_border();
    iris_scratch *scratch =
        draw_scratch(fits ? IRIS_UNSHARP_SCRATCH_BYTES(size.w, channels_of(format), config.sigma_q16) : 0);
    CALL(iris_unsharp(dst, src, given, border, scratch));
}

const random_call calls_blur[] = {
    {"iris_blur_gaussian", gaussian}, {"iris_blur_box", box}, {"iris_median", median},
    {"iris_unsharp", unsharp},        {NULL, NULL},
};
