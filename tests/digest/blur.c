#include "digest.h"

#include "iris/xt/blur.h"
#include "iris/xt/unsharp.h"

static void gaussian(iris_format format, int32_t channels, int32_t w, int32_t h)
{
    static const iris_q16 sigmas[] = {IRIS_BLUR_SIGMA_MIN, 26214, 52428, 91750, 150000};
    iris_image src = digest_picture(format, w, h);
    iris_image dst = digest_canvas(format, w, h);
    for (int i = 0; i < 5; i++) {
        iris_border border = {(iris_border_rule)(i % 4), 90};
        iris_scratch scratch = digest_scratch(IRIS_BLUR_GAUSSIAN_SCRATCH_BYTES(w, channels, sigmas[i]));
        digest_number(iris_blur_gaussian(&dst, &src, sigmas[i], border, &scratch));
        digest_view(&dst);
    }
}

static void gaussian_gray(void)
{
    gaussian(IRIS_GRAY8, 1, 37, 24);
}

static void gaussian_rgb(void)
{
    gaussian(IRIS_RGB888, 3, 11, 20);
}

static void box(void)
{
    static const int32_t sides[] = {1, 2, 3, 8, 31};
    iris_image src = digest_picture(IRIS_RGB888, 11, 20);
    iris_image dst = digest_canvas(IRIS_RGB888, 11, 20);
    for (int i = 0; i < 5; i++) {
        iris_border border = {(iris_border_rule)(i % 4), 90};
        iris_scratch scratch = digest_scratch(IRIS_BLUR_BOX_SCRATCH_BYTES(11, 3, sides[i]));
        digest_number(iris_blur_box(&dst, &src, sides[i], border, &scratch));
        digest_view(&dst);
    }
}

static void unsharp(void)
{
    iris_image src = digest_picture(IRIS_RGB888, 11, 20);
    iris_image dst = digest_canvas(IRIS_RGB888, 11, 20);
    for (int i = 0; i < 4; i++) {
        iris_unsharp_config config = {40000 + 30000 * i, 30000 << i, 3 * i};
        iris_scratch scratch = digest_scratch(IRIS_UNSHARP_SCRATCH_BYTES(11, 3, config.sigma_q16));
        digest_number(iris_unsharp(&dst, &src, &config, (iris_border){(iris_border_rule)i, 90}, &scratch));
        digest_view(&dst);
    }
}

const digest_operation digest_blur[] = {
    {"blur.gaussian_gray", gaussian_gray},
    {"blur.gaussian_rgb", gaussian_rgb},
    {"blur.box", box},
    {"unsharp.rgb", unsharp},
    {NULL, NULL},
};
