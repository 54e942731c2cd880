/* Integral images. */
#include "iris/integral.h"

#include "calls.h"

static void make(iris_status (*integral_of)(const iris_image *integral, const iris_image *src),
                 iris_format format)
{
    iris_size size = draw_size();
    const iris_image *integral = draw_output(IRIS_GRAY_U32, (iris_size){size.w + 1, size.h + 1});
    const iris_image *src = draw_input(format, size);
    CALL(integral_of(integral, src));
}

static void sums(void)
{
    make(iris_integral, draw_either(IRIS_GRAY8, IRIS_MASK1));
}

static void squares(void)
{
    make(iris_integral_squares, IRIS_GRAY8);
}

static iris_rect any_box(void)
{
    return (iris_rect){draw_int(0, 20), draw_int(0, 20), draw_int(1, 30), draw_int(1, 30)};
}

static void box_sum(void)
{
    uint32_t *sum = OR_NULL(draw_results(sizeof *sum));
    const iris_image *integral = draw_input(IRIS_GRAY_U32, draw_size());
    iris_rect box = any_box();
    CALL(iris_integral_sum(sum, integral, box));
}

static void box_mean(void)
{
    iris_q16 *mean = OR_NULL(draw_results(sizeof *mean));
    const iris_image *integral = draw_input(IRIS_GRAY_U32, draw_size());
    iris_rect box = any_box();
    CALL(iris_integral_mean(mean, integral, box));
}

static void box_variance(void)
{
    iris_size size = draw_size();
    iris_q16 *variance = OR_NULL(draw_results(sizeof *variance));
    const iris_image *integral = draw_input(IRIS_GRAY_U32, size);
    const iris_image *of_squares = draw_input(IRIS_GRAY_U32, size);
    iris_rect box = any_box();
    CALL(iris_integral_variance(variance, integral, of_squares, box));
}

const random_call calls_integral[] = {
    {"iris_integral", sums},
    {"iris_integral_squares", squares},
    {"iris_integral_sum", box_sum},
    {"iris_integral_mean", box_mean},
    {"iris_integral_variance", box_variance},
    {NULL, NULL},
};
