#include "bench.h"

#include "iris/pyramid.h"
#include "iris/xt/convolve.h"

static const iris_border replicate;
static int32_t weights[IRIS_KERNEL_SIDE_MAX * IRIS_KERNEL_SIDE_MAX];
static iris_kernel kernel;
static iris_image wide, half;

/* Weights that are no product of a column and a row. */
static void make_any(int32_t side)
{
    for (int32_t i = 0; i < side * side; i++) {
        weights[i] = 1 + i % 7;
    }
    kernel = (iris_kernel){weights, side, side, 4 * side * side, 0, 0};
}

static void any_3(void)
{
    make_any(3);
}

static void any_5(void)
{
    make_any(5);
}

static void any_7(void)
{
    make_any(7);
}

static void product_5(void)
{
    (void)iris_kernel_gaussian(&kernel, weights, 52429);
}

static void sobel_wide(void)
{
    wide = bench_canvas(IRIS_GRAY_S16);
    (void)iris_kernel_sobel(&kernel, weights, IRIS_KERNEL_X);
}

static void prepare_half(void)
{
    half = bench_canvas_of(IRIS_GRAY8, (bench_frame.gray.w + 1) / 2, (bench_frame.gray.h + 1) / 2);
}

static iris_status correlate(void)
{
    return iris_correlate(&bench_frame.gray_to, &bench_frame.gray, &kernel, replicate, &bench_frame.scratch);
}

static iris_status correlate_color(void)
{
    return iris_correlate(&bench_frame.rgb_to, &bench_frame.rgb, &kernel, replicate, &bench_frame.scratch);
}

static iris_status correlate_wide(void)
{
    return iris_correlate(&wide, &bench_frame.gray, &kernel, replicate, &bench_frame.scratch);
}

static iris_status pyramid_down(void)
{
    return iris_pyramid_down(&half, &bench_frame.gray, replicate, &bench_frame.scratch);
}

static iris_status pyramid_up(void)
{
    return iris_pyramid_up(&bench_frame.gray_to, &half, replicate, &bench_frame.scratch);
}

const bench_case bench_convolve[] = {
    {"convolve 3x3", correlate, any_3},
    {"convolve 5x5", correlate, any_5},
    {"convolve 7x7", correlate, any_7},
    {"convolve RGB, 3x3", correlate_color, any_3},
    {"convolve 5x5, separable", correlate, product_5},
    {"convolve 3x3 to S16, separable", correlate_wide, sobel_wide},
    {"pyramid, one level down", pyramid_down, prepare_half},
    {"pyramid, one level up", pyramid_up, prepare_half},
    {0},
};
