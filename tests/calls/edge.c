/* Edges. */
#include "iris/xt/edge.h"

#include "calls.h"
#include "iris/xt/automaton.h"
#include "iris/xt/canny.h"
#include "iris/xt/canny_adapt.h"
#include "iris/xt/edge_points.h"

static iris_edge_config config;

static const iris_edge_config *any_config(void)
{
    iris_edge_defaults(&config);
    if (draw_chance(10)) {
        return NULL;
    }
    config.op = (iris_edge_operator)draw_int(IRIS_EDGE_SOBEL, IRIS_EDGE_LOG);
    if (draw_chance(2)) {
        config.gain_q16 = draw_int(0, IRIS_EDGE_GAIN_END - 1);
        config.threshold = draw_int(0, draw_chance(4) ? IRIS_EDGE_THRESHOLD_END - 1 : 300);
        config.sigma_q16 = draw_int(IRIS_BLUR_SIGMA_MIN, draw_chance(10) ? IRIS_BLUR_SIGMA_MAX : 200000);
    }
    return draw_given(&config, sizeof config);
}

/* For the config drawn last. */
static iris_scratch *any_scratch(int32_t w)
{
    int smooths = config.sigma_q16 >= IRIS_BLUR_SIGMA_MIN && config.sigma_q16 <= IRIS_BLUR_SIGMA_MAX;
    return draw_scratch(config.op != IRIS_EDGE_LOG ? IRIS_EDGE_SCRATCH_BYTES(w)
                        : smooths                  ? IRIS_EDGE_LOG_SCRATCH_BYTES(w, config.sigma_q16)
                                                   : 0);
}

static void gradient(void)
{
    iris_size size = draw_size();
    const iris_image *dx = draw_output(IRIS_GRAY_S16, size);
    const iris_image *src = draw_input(IRIS_GRAY8, size);
    const iris_edge_config *given = any_config();
    int has_dy = config.op != IRIS_EDGE_LAPLACIAN && config.op != IRIS_EDGE_LOG;
    const iris_image *dy = draw_chance(has_dy ? 3 : 20) == has_dy ? NULL : draw_output(IRIS_GRAY_S16, size);
    iris_border border = draw_border();
    iris_scratch *scratch = any_scratch(size.w);
    CALL(iris_edge_gradient(dx, dy, src, given, border, scratch));
}

static void from_gray(iris_format format,
                      iris_status (*operation)(const iris_image *dst, const iris_image *src,
                                               const iris_edge_config *config, iris_border border,
                                               iris_scratch *scratch))
{
    iris_size size = draw_size();
    const iris_image *dst = draw_output(format, size);
    const iris_image *src = draw_input(IRIS_GRAY8, size);
    const iris_edge_config *given = any_config();
    iris_border border = draw_border();
    iris_scratch *scratch = any_scratch(size.w);
    CALL(operation(dst, src, given, border, scratch));
}

static void magnitude(void)
{
    from_gray(IRIS_GRAY8, iris_edge_magnitude);
}

static void direction(void)
{
    from_gray(IRIS_GRAY_U16, iris_edge_direction);
}

static void mask(void)
{
    from_gray(IRIS_MASK1, iris_edge_mask);
}

static void canny(void)
{
    iris_canny_config by;
    iris_canny_defaults(&by);
    if (draw_chance(2)) {
        by.sigma_q16 =
            draw_chance(2) ? 0 : draw_int(IRIS_BLUR_SIGMA_MIN, draw_chance(8) ? IRIS_BLUR_SIGMA_MAX : 200000);
        by.low = draw_int(0, draw_chance(4) ? IRIS_CANNY_THRESHOLD_END - 1 : 100);
        by.high = draw_int(by.low > 0 ? by.low : 0, IRIS_CANNY_THRESHOLD_END - 1);
    }
    int fits =
        by.sigma_q16 == 0 || (by.sigma_q16 >= IRIS_BLUR_SIGMA_MIN && by.sigma_q16 <= IRIS_BLUR_SIGMA_MAX);
    iris_size size = draw_size();
    const iris_image *mask = draw_output(IRIS_MASK1, size);
    const iris_image *src = draw_input(IRIS_GRAY8, size);
    const iris_canny_config *given = draw_given(&by, sizeof by);
    iris_border border = draw_border();
    iris_scratch *scratch = draw_scratch(fits ? IRIS_CANNY_SCRATCH_BYTES(size.w, size.h, by.sigma_q16) : 0);
    CALL(iris_canny(mask, src, given, border, scratch));
}

static void automaton(void)
{
    iris_automaton_config by = {(uint8_t)draw_below(256), draw_int(0, IRIS_AUTOMATON_GENERATIONS_MAX)};
    iris_size size = draw_size();
    const iris_image *mask = draw_output(IRIS_MASK1, size);
    const iris_image *src = draw_input(IRIS_GRAY8, size);
    const iris_automaton_config *given = draw_chance(10) ? NULL : draw_given(&by, sizeof by);
    iris_border border = draw_border();
    iris_scratch *scratch = draw_scratch(IRIS_AUTOMATON_SCRATCH_BYTES(size.w));
    CALL(iris_automaton(mask, src, given, border, scratch));
}

static void edge_points(void)
{
    iris_size size = draw_size();
    iris_canny_config canny = {draw_chance(2) ? 0 : draw_int(IRIS_BLUR_SIGMA_MIN, 200000), draw_int(0, 60),
                               draw_int(60, 300)};
    int smooths = canny.sigma_q16 >= IRIS_BLUR_SIGMA_MIN && canny.sigma_q16 <= IRIS_BLUR_SIGMA_MAX;
    int32_t capacity = draw_within(-1, 100);
    iris_edge_point *points = OR_NULL(draw_results((size_t)(capacity > 0 ? capacity : 0) * sizeof *points));
    int32_t *count = OR_NULL(draw_results(sizeof *count));
    const iris_image *src = draw_input(IRIS_GRAY8, size);
    const iris_canny_config *given = OR_NULL(draw_given(&canny, sizeof canny));
    iris_scratch *scratch =
        draw_scratch_up_to(size.w > 0 && size.h > 0
                               ? IRIS_EDGE_POINTS_SCRATCH_BYTES(size.w, size.h, smooths ? canny.sigma_q16 : 0)
                               : 0);
    CALL(iris_edge_points(points, capacity, count, src, given, scratch));
}

static void canny_adapt(void)
{
    iris_size size = draw_size();
    iris_canny_config canny = {draw_chance(2) ? 0 : draw_int(IRIS_BLUR_SIGMA_MIN, 200000), 1, 2};
    int smooths = canny.sigma_q16 >= IRIS_BLUR_SIGMA_MIN && canny.sigma_q16 <= IRIS_BLUR_SIGMA_MAX;
    iris_canny_config *to = OR_NULL(draw_results(sizeof *to));
    if (to) {
        *to = canny;
    }
    const iris_image *src = draw_input(IRIS_GRAY8, size);
    iris_scratch *scratch = draw_scratch_up_to(
        size.w > 0 ? IRIS_CANNY_ADAPT_SCRATCH_BYTES(size.w, smooths ? canny.sigma_q16 : 0) : 0);
    CALL(iris_canny_adapt(to, src, scratch));
}

const random_call calls_edge[] = {
    {"iris_edge_gradient", gradient},
    {"iris_edge_magnitude", magnitude},
    {"iris_edge_direction", direction},
    {"iris_edge_mask", mask},
    {"iris_canny", canny},
    {"iris_automaton", automaton},
    {"iris_edge_points", edge_points},
    {"iris_canny_adapt", canny_adapt},
    {NULL, NULL},
};
