#include "bench.h"

#include "iris/xt/automaton.h"
#include "iris/xt/canny.h"
#include "iris/xt/canny_adapt.h"
#include "iris/xt/edge.h"
#include "iris/xt/edge_points.h"

static const iris_border replicate;
static iris_image dx, dy, angles;

static void prepare_wide(void)
{
    dx = bench_canvas(IRIS_GRAY_S16);
    dy = bench_canvas(IRIS_GRAY_S16);
    angles = bench_canvas(IRIS_GRAY_U16);
}

static iris_status magnitude(iris_edge_operator op)
{
    iris_edge_config config;
    iris_edge_defaults(&config);
    config.op = op;
    return iris_edge_magnitude(&bench_frame.gray_to, &bench_frame.gray, &config, replicate,
                               &bench_frame.scratch);
}

static iris_status sobel(void)
{
    return magnitude(IRIS_EDGE_SOBEL);
}

static iris_status prewitt(void)
{
    return magnitude(IRIS_EDGE_PREWITT);
}

static iris_status isotropic(void)
{
    return magnitude(IRIS_EDGE_ISOTROPIC);
}

static iris_status roberts(void)
{
    return magnitude(IRIS_EDGE_ROBERTS);
}

static iris_status laplacian(void)
{
    return magnitude(IRIS_EDGE_LAPLACIAN);
}

static iris_status gradient(void)
{
    return iris_edge_gradient(&dx, &dy, &bench_frame.gray, NULL, replicate, &bench_frame.scratch);
}

static iris_status direction(void)
{
    return iris_edge_direction(&angles, &bench_frame.gray, NULL, replicate, &bench_frame.scratch);
}

static iris_status mask(void)
{
    return iris_edge_mask(&bench_frame.mask_to, &bench_frame.gray, NULL, replicate, &bench_frame.scratch);
}

static iris_status zero_crossings(void)
{
    iris_edge_config config;
    iris_edge_defaults(&config);
    config.op = IRIS_EDGE_LAPLACIAN;
    return iris_edge_mask(&bench_frame.mask_to, &bench_frame.gray, &config, replicate, &bench_frame.scratch);
}

static iris_status zero_crossings_of_log(void)
{
    iris_edge_config config;
    iris_edge_defaults(&config);
    config.op = IRIS_EDGE_LOG;
    return iris_edge_mask(&bench_frame.mask_to, &bench_frame.gray, &config, replicate, &bench_frame.scratch);
}

static iris_status canny(void)
{
    return iris_canny(&bench_frame.mask_to, &bench_frame.gray, NULL, replicate, &bench_frame.scratch);
}

static iris_status canny_unsmoothed(void)
{
    iris_canny_config config;
    iris_canny_defaults(&config);
    config.sigma_q16 = 0;
    return iris_canny(&bench_frame.mask_to, &bench_frame.gray, &config, replicate, &bench_frame.scratch);
}

static iris_edge_point *edge_points;

#define EDGE_POINTS 4096

static void prepare_points(void)
{
    edge_points =
        (iris_edge_point *)iris_scratch_take(&bench_frame.scratch, EDGE_POINTS * sizeof *edge_points);
}

static iris_status points(void)
{
    int32_t count;
    return iris_edge_points(edge_points, edge_points ? EDGE_POINTS : 0, &count, &bench_frame.gray, NULL,
                            &bench_frame.scratch);
}

static iris_status adapt(void)
{
    iris_canny_config config;
    iris_canny_defaults(&config);
    return iris_canny_adapt(&config, &bench_frame.gray, &bench_frame.scratch);
}

static iris_status automaton(void)
{
    return iris_automaton(&bench_frame.mask_to, &bench_frame.gray, NULL, replicate, &bench_frame.scratch);
}

const bench_case bench_edge[] = {
    {"edges, Sobel magnitude", sobel, NULL},
    {"edges, Prewitt magnitude", prewitt, NULL},
    {"edges, isotropic magnitude", isotropic, NULL},
    {"edges, Roberts magnitude", roberts, NULL},
    {"edges, Laplacian magnitude", laplacian, NULL},
    {"edges, Sobel gradient", gradient, prepare_wide},
    {"edges, Sobel direction", direction, prepare_wide},
    {"edges, Sobel mask", mask, NULL},
    {"edges, Laplacian zero crossings", zero_crossings, NULL},
    {"edges, LoG zero crossings, sigma 1.4", zero_crossings_of_log, NULL},
    {"edges, cellular automaton", automaton, NULL},
    {"edges, Canny, sigma 1.4", canny, NULL},
    {"edges, Canny, not smoothed", canny_unsmoothed, NULL},
    {"edge points, sigma 1.4", points, prepare_points},
    {"edges, thresholds for Canny, sigma 1.4", adapt, NULL},
    {0},
};
