#include "bench.h"

#include "iris/xt/contour.h"
#include "iris/xt/moments.h"
#include "iris/xt/shape.h"

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

static iris_status signature(void)
{
    uint16_t rays[128];
    return iris_shape_sample(rays, NULL, &bench_frame.mask, NULL);
}

static iris_contour outline;
static iris_shape shape, model;

static void find_outline(void)
{
    int32_t count;
    (void)iris_contour_find(&outline, 1, &count, &bench_frame.mask, &bench_frame.scratch);
    (void)iris_shape_describe(&shape, &outline, &bench_frame.mask, &bench_frame.scratch);
    model = shape;
    for (int i = 0; i < IRIS_SHAPE_POINTS; i++) {
        model.x[i] = (int16_t)(shape.x[(i + 20) % IRIS_SHAPE_POINTS] / 2);
        model.y[i] = shape.y[(i + 20) % IRIS_SHAPE_POINTS];
    }
}

static iris_status describe(void)
{
    iris_shape made;
    return iris_shape_describe(&made, &outline, &bench_frame.mask, &bench_frame.scratch);
}

static iris_status match(iris_shape_method method)
{
    iris_shape_found found;
    iris_shape_matching config;
    const iris_shape_library library = {&model, 1};
    iris_shape_matching_defaults(&config, method);
    return iris_shape_match(&found, &shape, &library, &config, &bench_frame.scratch);
}

static iris_status heights(void)
{
    return match(IRIS_SHAPE_HEIGHTS);
}

static iris_status rays(void)
{
    return match(IRIS_SHAPE_RADIAL);
}

const bench_case bench_shape[] = {
    {"contours of a mask", contours, NULL},
    {"moments of a mask to the third order, Hu", moments, NULL},
    {"radial signature of a mask, 128 rays", signature, NULL},
    {"shape described", describe, find_outline},
    {"shape against one model, heights", heights, find_outline},
    {"shape against one model, radial", rays, find_outline},
    {0},
};
