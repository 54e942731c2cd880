/* Convolution, and the matrices for it. */
#include "iris/xt/convolve.h"

#include "calls.h"

/* Weights of any size; mostly such that no sum overflows. */
static iris_kernel any_kernel(void)
{
    iris_kernel kernel = {NULL, draw_int(1, 5), draw_int(1, 5), 1, 0, 0};
    if (draw_chance(10)) {
        *(draw_chance(2) ? &kernel.rows : &kernel.columns) = draw_int(1, IRIS_KERNEL_SIDE_MAX);
    }
    int32_t most = draw_chance(20) ? INT32_MAX : draw_chance(3) ? 30000 : 8;
    int32_t values[IRIS_KERNEL_SIDE_MAX * IRIS_KERNEL_SIDE_MAX];
    int32_t column[IRIS_KERNEL_SIDE_MAX], row[IRIS_KERNEL_SIDE_MAX];
    int is_product = draw_chance(2), fits = kernel.rows >= 1 && kernel.rows <= IRIS_KERNEL_SIDE_MAX &&
                                            kernel.columns >= 1 && kernel.columns <= IRIS_KERNEL_SIDE_MAX;
    size_t count = fits ? (size_t)kernel.rows * (size_t)kernel.columns : 1;
    for (int32_t i = 0; i < IRIS_KERNEL_SIDE_MAX; i++) {
        column[i] = draw_within(-20, 20);
        row[i] = draw_within(-20, 20);
    }
    for (size_t i = 0; i < count; i++) {
        values[i] = is_product && fits ? column[i / (size_t)kernel.columns] * row[i % (size_t)kernel.columns]
                                       : draw_int(-most, most);
    }
    kernel.values = OR_NULL(draw_given(values, count * sizeof *values));
    kernel.divisor = draw_chance(2) ? 1 << draw_below(23) : draw_int(1, IRIS_KERNEL_DIVISOR_MAX);
    kernel.bias = draw_chance(2) ? 0 : draw_int(-500, 500);
    kernel.absolute = draw_int(0, 1);
    return kernel;
}

static void call(iris_status (*operation)(const iris_image *dst, const iris_image *src,
                                          const iris_kernel *kernel, iris_border border,
                                          iris_scratch *scratch))
{
    iris_format format = draw_chance(5) ? IRIS_HSL24 : draw_gray_or_color();
    size_t channels = format == IRIS_RGB888 || format == IRIS_BGR888 ? 3 : 1;
    iris_size size = draw_size();
    const iris_image *dst =
        draw_output(format == IRIS_GRAY8 && draw_chance(2) ? IRIS_GRAY_S16 : format, size);
    const iris_image *src = draw_input(format, size);
    iris_kernel kernel = any_kernel();
    const iris_kernel *given = OR_NULL(draw_given(&kernel, sizeof kernel));
    iris_border border = draw_border();
    int fits = kernel.rows >= 1 && kernel.rows <= IRIS_KERNEL_SIDE_MAX && kernel.columns >= 1 &&
               kernel.columns <= IRIS_KERNEL_SIDE_MAX;
    iris_scratch *scratch =
        draw_scratch(fits ? IRIS_CONVOLVE_SCRATCH_BYTES(size.w, channels, kernel.rows, kernel.columns) : 0);
    CALL(operation(dst, src, given, border, scratch));
}

static void convolve(void)
{
    call(iris_convolve);
}

static void correlate(void)
{
    call(iris_correlate);
}

static iris_kernel *result(void)
{
    return OR_NULL(draw_results(sizeof(iris_kernel)));
}

static int32_t *values_of(int32_t count)
{
    return OR_NULL(draw_results((size_t)count * sizeof(int32_t)));
}

static void by_direction(int32_t count, iris_status (*generator)(iris_kernel *kernel, int32_t *values,
                                                                 iris_kernel_direction direction))
{
    iris_kernel *kernel = result();
    int32_t *values = values_of(count);
    iris_kernel_direction direction = (iris_kernel_direction)draw_int(IRIS_KERNEL_X, IRIS_KERNEL_Y);
    CALL(generator(kernel, values, direction));
}

static void roberts(void)
{
    by_direction(4, iris_kernel_roberts);
}

static void sobel(void)
{
    by_direction(9, iris_kernel_sobel);
}

static void prewitt(void)
{
    by_direction(9, iris_kernel_prewitt);
}

static void isotropic(void)
{
    by_direction(9, iris_kernel_isotropic);
}

static void laplacian(void)
{
    iris_kernel *kernel = result();
    int32_t *values = values_of(9), neighbors = draw_int(4, 8);
    CALL(iris_kernel_laplacian(kernel, values, draw_chance(2) ? 4 : neighbors));
}

static void box(void)
{
    int32_t rows = draw_int(1, IRIS_KERNEL_SIDE_MAX), columns = draw_int(1, IRIS_KERNEL_SIDE_MAX);
    int fits = rows >= 1 && rows <= IRIS_KERNEL_SIDE_MAX && columns >= 1 && columns <= IRIS_KERNEL_SIDE_MAX;
    iris_kernel *kernel = result();
    int32_t *values = values_of(fits ? rows * columns : 0);
    CALL(iris_kernel_box(kernel, values, rows, columns));
}

static void gaussian(void)
{
    iris_q16 sigma = draw_int(IRIS_BLUR_SIGMA_MIN, IRIS_KERNEL_GAUSSIAN_SIGMA_MAX);
    int fits = sigma >= IRIS_BLUR_SIGMA_MIN && sigma <= IRIS_KERNEL_GAUSSIAN_SIGMA_MAX;
    iris_kernel *kernel = result();
    int32_t *values = values_of(fits ? IRIS_KERNEL_GAUSSIAN_VALUES(sigma) : 0);
    CALL(iris_kernel_gaussian(kernel, values, sigma));
}

static void log_of_gaussian(void)
{
    iris_q16 sigma = draw_int(IRIS_KERNEL_LOG_SIGMA_MIN, IRIS_KERNEL_LOG_SIGMA_MAX);
    int fits = sigma >= IRIS_KERNEL_LOG_SIGMA_MIN && sigma <= IRIS_KERNEL_LOG_SIGMA_MAX;
    iris_kernel *kernel = result();
    int32_t *values = values_of(fits ? IRIS_KERNEL_LOG_VALUES(sigma) : 0);
    CALL(iris_kernel_log(kernel, values, sigma));
}

static void unsharp(void)
{
    iris_q16 sigma = draw_int(IRIS_BLUR_SIGMA_MIN, IRIS_KERNEL_GAUSSIAN_SIGMA_MAX);
    iris_q16 amount = draw_int(0, 16 * IRIS_Q16_ONE);
    int fits = sigma >= IRIS_BLUR_SIGMA_MIN && sigma <= IRIS_KERNEL_GAUSSIAN_SIGMA_MAX;
    iris_kernel *kernel = result();
    int32_t *values = values_of(fits ? IRIS_KERNEL_GAUSSIAN_VALUES(sigma) : 0);
    CALL(iris_kernel_unsharp(kernel, values, sigma, amount));
}

const random_call calls_convolve[] = {
    {"iris_convolve", convolve},          {"iris_correlate", correlate},
    {"iris_kernel_roberts", roberts},     {"iris_kernel_sobel", sobel},
    {"iris_kernel_prewitt", prewitt},     {"iris_kernel_isotropic", isotropic},
    {"iris_kernel_laplacian", laplacian}, {"iris_kernel_box", box},
    {"iris_kernel_gaussian", gaussian},   {"iris_kernel_log", log_of_gaussian},
    {"iris_kernel_unsharp", unsharp},     {NULL, NULL},
};
