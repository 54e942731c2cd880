#include "digest.h"

#include "iris/integral.h"

#define W 36
#define H 25

static void made(void)
{
    iris_image src = digest_picture(IRIS_GRAY8, W, H);
    iris_image integral = digest_canvas(IRIS_GRAY_U32, W + 1, H + 1);
    digest_number(iris_integral(&integral, &src));
    digest_view(&integral);
    digest_number(iris_integral_squares(&integral, &src));
    digest_view(&integral);
}

static void of_mask(void)
{
    iris_image src = digest_picture(IRIS_MASK1, W, H);
    iris_image integral = digest_canvas(IRIS_GRAY_U32, W + 1, H + 1);
    digest_number(iris_integral(&integral, &src));
    digest_view(&integral);
}

static void boxes(void)
{
    iris_image src = digest_picture(IRIS_GRAY8, W, H);
    iris_image integral = digest_canvas(IRIS_GRAY_U32, W + 1, H + 1);
    iris_image squares = digest_canvas(IRIS_GRAY_U32, W + 1, H + 1);
    (void)iris_integral(&integral, &src);
    (void)iris_integral_squares(&squares, &src);
    for (int i = 0; i < 50; i++) {
        uint32_t sum = 0;
        iris_q16 mean = 0, variance = 0;
        iris_rect box = {0};
        box.x = digest_between(0, W / 2);
        box.y = digest_between(0, H / 2);
        box.w = digest_between(1, W / 2);
        box.h = digest_between(1, H / 2);
        digest_number(iris_integral_sum(&sum, &integral, box));
        digest_number(iris_integral_mean(&mean, &integral, box));
        digest_number(iris_integral_variance(&variance, &integral, &squares, box));
        digest_number(sum);
        digest_number(mean);
        digest_number(variance);
    }
}

const digest_operation digest_integral[] = {
    {"integral.made", made}, {"integral.of_mask", of_mask}, {"integral.boxes", boxes}, {NULL, NULL}};
