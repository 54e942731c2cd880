/* Edges. */
#include "iris/xt/edge.h"

#include "calls.h"
#include "iris/xt/canny.h"

static const iris_edge_config *any_config(void)
{
    iris_edge_config config;
    iris_edge_defaults(&config);
    config.op = (iris_edge_operator)draw_int(IRIS_EDGE_SOBEL, IRIS_EDGE_LAPLACIAN);
    if (draw_chance(2)) {
        config.gain_q16 = draw_int(0, IRIS_EDGE_GAIN_END - 1);
        config.threshold = draw_int(0, draw_chance(4) ? IRIS_EDGE_THRESHOLD_END - 1 : 300);
    }
    return draw_chance(10) ? NULL : draw_given(&config, sizeof config);
}

static void gradient(void)
{
    iris_size size = draw_size();
    const iris_image *dx = draw_output(IRIS_GRAY_S16, size);
    const iris_image *dy = draw_chance(3) ? NULL : draw_output(IRIS_GRAY_S16, size);
    const iris_image *src = draw_input(IRIS_GRAY8, size);
    const iris_edge_config *config = any_config();
    iris_border border = draw_border();
    iris_scratch *scratch = draw_scratch(IRIS_EDGE_SCRATCH_BYTES(size.w));
    CALL(iris_edge_gradient(dx, dy, src, config, border, scratch));
}

static void from_gray(iris_format format,
                      iris_status (*operation)(const iris_image *dst, const iris_image *src,
                                               const iris_edge_config *config, iris_border border,
                                               iris_scratch *scratch))
{
    iris_size size = draw_size();
    const iris_image *dst = draw_output(format, size);
    const iris_image *src = draw_input(IRIS_GRAY8, size);
    const iris_edge_config *config = any_config();
    iris_border border = draw_border();
    iris_scratch *scratch = draw_scratch(IRIS_EDGE_SCRATCH_BYTES(size.w));
    CALL(operation(dst, src, config, border, scratch));
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
    iris_canny_config config;
    iris_canny_defaults(&config);
    if (draw_chance(2)) {
        config.sigma_q16 =
            draw_chance(2) ? 0 : draw_int(IRIS_BLUR_SIGMA_MIN, draw_chance(8) ? IRIS_BLUR_SIGMA_MAX : 200000);
        config.low = draw_int(0, draw_chance(4) ? IRIS_CANNY_THRESHOLD_END - 1 : 100);
        config.high = draw_int(config.low > 0 ? config.low : 0, IRIS_CANNY_THRESHOLD_END - 1);
    }
    int fits = config.sigma_q16 == 0 ||
               (config.sigma_q16 >= IRIS_BLUR_SIGMA_MIN && config.sigma_q16 <= IRIS_BLUR_SIGMA_MAX);
    iris_size size = draw_size();
    const iris_image *mask = draw_output(IRIS_MASK1, size);
    const iris_image *src = draw_input(IRIS_GRAY8, size);
    const iris_canny_config *given = draw_given(&config, sizeof config);
    iris_border border = draw_border();
    iris_scratch *scratch =
        draw_scratch(fits ? IRIS_CANNY_SCRATCH_BYTES(size.w, size.h, config.sigma_q16) : 0);
    CALL(iris_canny(mask, src, given, border, scratch));
}

const random_call calls_edge[] = {
    {"iris_edge_gradient", gradient},
    {"iris_edge_magnitude", magnitude},
    {"iris_edge_direction", direction},
    {"iris_edge_mask", mask},
    {"iris_canny", canny},
    {NULL, NULL},
};
