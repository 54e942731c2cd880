#include "digest.h"

#include "iris/xt/convolve.h"

static void run(const iris_kernel *kernel, iris_format from, iris_format to)
{
    int32_t channels = from == IRIS_RGB888 ? 3 : 1;
    iris_image src = digest_picture(from, 19, 16);
    iris_image dst = digest_canvas(to, 19, 16);
    for (int i = 0; i < 4; i++) {
        iris_border border = {(iris_border_rule)i, 90};
        iris_scratch scratch =
            digest_scratch(IRIS_CONVOLVE_SCRATCH_BYTES(19, channels, kernel->rows, kernel->columns));
        digest_number((i % 2 ? iris_correlate : iris_convolve)(&dst, &src, kernel, border, &scratch));
        digest_view(&dst);
    }
}

static void whole(void)
{
    static const int32_t values[] = {-1, -2, -1, -1, 12, 0, -3, -2, -1, 4, 0, 7};
    iris_kernel kernel = {values, 4, 3, 7, 20, 0};
    run(&kernel, IRIS_GRAY8, IRIS_GRAY8);
}

static void separable(void)
{
    int32_t *values = digest_take(sizeof(int32_t) * 49);
    iris_kernel kernel;
    digest_number(iris_kernel_gaussian(&kernel, values, 70000));
    run(&kernel, IRIS_HSL24, IRIS_HSL24);
}

static void to_signed(void)
{
    int32_t *values = digest_take(sizeof(int32_t) * 9);
    iris_kernel kernel;
    digest_number(iris_kernel_isotropic(&kernel, values, IRIS_KERNEL_X));
    run(&kernel, IRIS_GRAY8, IRIS_GRAY_S16);
}

static void in_color(void)
{
    int32_t *values = digest_take(sizeof(int32_t) * 9);
    iris_kernel kernel;
    digest_number(iris_kernel_laplacian(&kernel, values, 8));
    kernel.absolute = 1;
    run(&kernel, IRIS_RGB888, IRIS_RGB888);
}

/* The largest of each kind. */
static void generators(void)
{
    int32_t *values = digest_take(sizeof(int32_t) * 961);
    iris_kernel kernel;
    for (int i = 0; i < 3; i++) {
        digest_number(i == 0   ? iris_kernel_gaussian(&kernel, values, IRIS_KERNEL_GAUSSIAN_SIGMA_MAX)
                      : i == 1 ? iris_kernel_log(&kernel, values, IRIS_KERNEL_LOG_SIGMA_MAX)
                               : iris_kernel_unsharp(&kernel, values, 200000, 100000));
        for (int k = 0; k < kernel.rows * kernel.columns; k++) {
            digest_number(values[k]);
        }
    }
}

const digest_operation digest_convolve[] = {
    {"convolve.whole", whole},       {"convolve.separable", separable},   {"convolve.to_signed", to_signed},
    {"convolve.in_color", in_color}, {"convolve.generators", generators}, {NULL, NULL},
};
