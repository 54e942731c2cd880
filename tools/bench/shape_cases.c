#include "bench.h"

#include "iris/xt/contour.h"
#include "iris/xt/moments.h"

static iris_status contours(void)
{
    iris_contour found[16];
    int32_t count;
    return iris_contour_find(found, 16, &count, &bench_frame.mask, &bench_frame.scratch);
}

static iris_status moments(void)
{
    iris_mask_moments sums;
    iris_invariants invariants;
    iris_status status = iris_mask_moments_sum(&sums, &bench_frame.mask);
    return status == IRIS_OK ? iris_moments_invariants(&invariants, &sums) : status;
}

const bench_case bench_shape[] = {
    {"contours of a mask", contours, NULL},
    {"moments of a mask to the third order, Hu", moments, NULL},
    {0},
};
