#include "digest.h"

#include "iris/xt/automaton.h"
#include "iris/xt/canny.h"
#include "iris/xt/canny_adapt.h"
#include "iris/xt/edge.h"
#include "iris/xt/edge_points.h"

#define W 45
#define H 24

static const iris_border borders[] = {{IRIS_BORDER_REPLICATE, 0},
                                      {IRIS_BORDER_REFLECT101, 0},
                                      {IRIS_BORDER_CONSTANT, 99},
                                      {IRIS_BORDER_SKIP, 0}};

static iris_edge_config config_of(int op)
{
    iris_edge_config config;
    iris_edge_defaults(&config);
    config.op = (iris_edge_operator)op;
    return config;
}

static void gradient(void)
{
    iris_image gray = digest_picture(IRIS_GRAY8, W, H);
    iris_image dx = digest_canvas(IRIS_GRAY_S16, W, H), dy = digest_canvas(IRIS_GRAY_S16, W, H);
    iris_scratch scratch = digest_scratch(IRIS_EDGE_SCRATCH_BYTES(W));
    for (int op = IRIS_EDGE_SOBEL; op <= IRIS_EDGE_LAPLACIAN; op++) {
        iris_edge_config config = config_of(op);
        digest_number(iris_edge_gradient(&dx, op == IRIS_EDGE_LAPLACIAN ? NULL : &dy, &gray, &config,
                                         borders[op % 4], &scratch));
        digest_view(&dx);
        digest_view(&dy);
    }
}

static void magnitude(void)
{
    iris_image gray = digest_picture(IRIS_GRAY8, W, H), dst = digest_canvas(IRIS_GRAY8, W, H);
    iris_scratch scratch = digest_scratch(IRIS_EDGE_SCRATCH_BYTES(W));
    for (int op = IRIS_EDGE_SOBEL; op <= IRIS_EDGE_LAPLACIAN; op++) {
        iris_edge_config config = config_of(op);
        config.gain_q16 <<= op;
        digest_number(iris_edge_magnitude(&dst, &gray, &config, borders[op % 4], &scratch));
        digest_view(&dst);
    }
}

static void direction(void)
{
    iris_image gray = digest_picture(IRIS_GRAY8, W, H), dst = digest_canvas(IRIS_GRAY_U16, W, H);
    iris_scratch scratch = digest_scratch(IRIS_EDGE_SCRATCH_BYTES(W));
    for (int op = IRIS_EDGE_SOBEL; op <= IRIS_EDGE_ROBERTS; op++) {
        iris_edge_config config = config_of(op);
        digest_number(iris_edge_direction(&dst, &gray, &config, borders[op % 4], &scratch));
        digest_view(&dst);
    }
}

static void mask(void)
{
    iris_image gray = digest_picture(IRIS_GRAY8, W, H), dst = digest_canvas(IRIS_MASK1, W, H);
    iris_scratch scratch = digest_scratch(IRIS_EDGE_SCRATCH_BYTES(W));
    for (int op = IRIS_EDGE_SOBEL; op <= IRIS_EDGE_LAPLACIAN; op++) {
        iris_edge_config config = config_of(op);
        config.threshold = 50;
        digest_number(iris_edge_mask(&dst, &gray, &config, borders[op % 4], &scratch));
        digest_view(&dst);
    }
}

static void log_mask(void)
{
    iris_image gray = digest_picture(IRIS_GRAY8, W, H), dst = digest_canvas(IRIS_MASK1, W, H);
    iris_image values = digest_canvas(IRIS_GRAY_S16, W, H);
    iris_edge_config config = config_of(IRIS_EDGE_LOG);
    iris_scratch scratch = digest_scratch(IRIS_EDGE_LOG_SCRATCH_BYTES(W, 120000));
    for (int i = 0; i < 4; i++) {
        config.sigma_q16 = 30000 * (i + 1);
        digest_number(iris_edge_mask(&dst, &gray, &config, borders[i], &scratch));
        digest_view(&dst);
        digest_number(iris_edge_gradient(&values, NULL, &gray, &config, borders[i], &scratch));
        digest_view(&values);
    }
}

static void canny(void)
{
    iris_image gray = digest_picture(IRIS_GRAY8, W, H), dst = digest_canvas(IRIS_MASK1, W, H);
    for (int i = 0; i < 4; i++) {
        static const iris_canny_config configs[] = {
            {91750, 40, 100}, {0, 100, 300}, {60000, 10, 200}, {40000, 0, 50}};
        iris_scratch scratch = digest_scratch(IRIS_CANNY_SCRATCH_BYTES(W, H, configs[i].sigma_q16));
        digest_number(iris_canny(&dst, &gray, &configs[i], borders[i], &scratch));
        digest_view(&dst);
    }
}

static void automaton(void)
{
    iris_image gray = digest_picture(IRIS_GRAY8, W, H), dst = digest_canvas(IRIS_MASK1, W, H);
    iris_scratch scratch = digest_scratch(IRIS_AUTOMATON_SCRATCH_BYTES(W));
    for (int i = 0; i < 4; i++) {
        iris_automaton_config config = {(uint8_t)(5 + 10 * i), i};
        digest_number(iris_automaton(&dst, &gray, &config, borders[i], &scratch));
        digest_view(&dst);
    }
}

static void points(void)
{
    iris_edge_point found[100];
    int32_t count = 0;
    iris_image gray = digest_picture(IRIS_GRAY8, W, H);
    iris_canny_config config;
    iris_canny_defaults(&config);
    iris_scratch scratch = digest_scratch(IRIS_EDGE_POINTS_SCRATCH_BYTES(W, H, config.sigma_q16));
    digest_number(iris_edge_points(found, 100, &count, &gray, &config, &scratch));
    digest_number(count);
    for (int32_t i = 0; i < count && i < 100; i++) {
        digest_number(found[i].x);
        digest_number(found[i].y);
        digest_number(found[i].angle);
    }
}

static void adapt(void)
{
    iris_image gray = digest_picture(IRIS_GRAY8, W, H);
    for (int32_t i = 0; i < 2; i++) {
        iris_canny_config config = {i * 91750, 0, 0};
        iris_scratch scratch = digest_scratch(IRIS_CANNY_ADAPT_SCRATCH_BYTES(W, config.sigma_q16));
        digest_number(iris_canny_adapt(&config, &gray, &scratch));
        digest_number(config.low);
        digest_number(config.high);
    }
}

const digest_operation digest_edge[] = {
    {"edge.gradient", gradient},   {"edge.magnitude", magnitude},
    {"edge.direction", direction}, {"edge.mask", mask},
    {"edge.log", log_mask},        {"canny.mask", canny},
    {"automaton.mask", automaton}, {"edge.points", points},
    {"canny.adapt", adapt},        {NULL, NULL},
};
