#include "bench.h"

#include "iris/xt/contour.h"

static iris_status contours(void)
{
    iris_contour found[16];
    int32_t count;
    return iris_contour_find(found, 16, &count, &bench_frame.mask, &bench_frame.scratch);
}

const bench_case bench_shape[] = {
    {"contours of a mask", contours, NULL},
    {0},
};
