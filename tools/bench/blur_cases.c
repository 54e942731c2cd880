#include "bench.h"

#include "iris/xt/blur.h"
#include "iris/xt/median.h"
#include "iris/xt/unsharp.h"

static const iris_border replicate;

static iris_status gaussian_1(void)
{
    return iris_blur_gaussian(&bench_frame.gray_to, &bench_frame.gray, IRIS_Q16_ONE, replicate,
                              &bench_frame.scratch);
}

static iris_status gaussian_4(void)
{
    return iris_blur_gaussian(&bench_frame.gray_to, &bench_frame.gray, 4 * IRIS_Q16_ONE, replicate,
                              &bench_frame.scratch);
}

static iris_status gaussian_color(void)
{
    return iris_blur_gaussian(&bench_frame.rgb_to, &bench_frame.rgb, IRIS_Q16_ONE, replicate,
                              &bench_frame.scratch);
}

static iris_status box_3(void)
{
    return iris_blur_box(&bench_frame.gray_to, &bench_frame.gray, 3, replicate, &bench_frame.scratch);
}

static iris_status box_15(void)
{
    return iris_blur_box(&bench_frame.gray_to, &bench_frame.gray, 15, replicate, &bench_frame.scratch);
}

static iris_status median_3(void)
{
    return iris_median(&bench_frame.gray_to, &bench_frame.gray, 3, replicate, &bench_frame.scratch);
}

static iris_status median_5(void)
{
    return iris_median(&bench_frame.gray_to, &bench_frame.gray, 5, replicate, &bench_frame.scratch);
}

static iris_status unsharp(void)
{
    return iris_unsharp(&bench_frame.gray_to, &bench_frame.gray, NULL, replicate, &bench_frame.scratch);
}

const bench_case bench_blur[] = {
    {"Gaussian blur, sigma 1", gaussian_1, NULL},
    {"Gaussian blur, sigma 4", gaussian_4, NULL},
    {"Gaussian blur of RGB, sigma 1", gaussian_color, NULL},
    {"box blur 3x3", box_3, NULL},
    {"box blur 15x15", box_15, NULL},
    {"median 3x3", median_3, NULL},
    {"median 5x5", median_5, NULL},
    {"unsharp mask, sigma 1", unsharp, NULL},
    {0},
};
