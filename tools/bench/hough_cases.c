#include "bench.h"

#include "iris/xt/hough.h"
#include "iris/xt/regress.h"

static iris_status regress(void)
{
    iris_line line;
    return iris_regress_mask(&line, &bench_frame.mask);
}

static iris_status hough_lines(void)
{
    iris_hough_config config;
    iris_hough_line lines[4];
    int32_t count;
    iris_hough_defaults(&config);
    config.theta_bins = 90;
    return iris_hough_lines(lines, 4, &count, &bench_frame.mask, &config, &bench_frame.scratch);
}

const bench_case bench_hough[] = {
    {"regression over a mask", regress, NULL},
    {"Hough lines of a mask, 90 angles", hough_lines, NULL},
    {0},
};
