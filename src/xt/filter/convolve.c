#include "iris/xt/convolve.h"

#include "../../foundation/views.h"
#include "convolve_rows.h"
#include "rank_one.h"

/* Rounded division by a constant: a sum starts so that what is left to do is to round down. The excess of factor *
 * divisor over 2^shift is below divisor (0 for powers of two), and the quotient is exact while n times the excess is
 * below 2^shift (Granlund and Montgomery, 1994): of a divisor up to 2^22, while n is at most 255 * divisor. */
static iris_row_quotient quotient_for(const iris_kernel *kernel)
{
    iris_row_quotient q = {kernel->divisor / 2 + kernel->bias * kernel->divisor, kernel->divisor, 0, 31,
                           kernel->absolute};
    while (q.divisor >> (q.shift - 30) != 0) {
        q.shift++;
    }
    q.factor = (uint32_t)((((uint64_t)1 << q.shift) + (uint32_t)q.divisor - 1) / (uint32_t)q.divisor);
    return q;
}

static int32_t nonzero(const int32_t *values, int32_t n)
{
    int32_t count = 0;
    for (int32_t i = 0; i < n; i++) {
        count += values[i] != 0;
    }
    return count;
}

static iris_status begin(iris_convolution *work, const iris_image *src, const iris_kernel *kernel, int turned,
                         iris_border border, iris_scratch *scratch)
{
    int32_t count = kernel->rows * kernel->columns;
    iris_rows_window window = {(kernel->columns - 1) / 2, kernel->columns / 2, (kernel->rows - 1) / 2,
                               kernel->rows / 2};
    iris_status status = iris_rows_begin(&work->rows, src, window, border, scratch);
    if (status != IRIS_OK) {
        return status;
    }
    int32_t channels = work->rows.channels;
    size_t samples = ((size_t)src->w + (size_t)kernel->columns - 1) * (size_t)channels;
    int32_t *weights = (int32_t *)iris_scratch_take(scratch, sizeof(int32_t) * (size_t)count);
    int32_t *middle = (int32_t *)iris_scratch_take(scratch, sizeof(int32_t) * samples);
    if (!weights || !middle) {
        return IRIS_ERR_SCRATCH;
    }
    for (int32_t i = 0; i < count; i++) {
        weights[i] = kernel->values[turned ? count - 1 - i : i];
    }
    work->weights = weights;
    work->h = kernel->rows;
    work->w = kernel->columns;
    work->middle = middle + window.left * channels;
    work->separable = iris_rank_one(work->down, work->across, weights, work->h, work->w) &&
                      nonzero(work->down, work->h) + nonzero(work->across, work->w) < nonzero(weights, count);
    return IRIS_OK;
}

static iris_status check_kernel(const iris_kernel *kernel)
{
    if (!kernel || !kernel->values || kernel->rows < 1 || kernel->rows > IRIS_KERNEL_SIDE_MAX ||
        kernel->columns < 1 || kernel->columns > IRIS_KERNEL_SIDE_MAX || kernel->divisor < 1 ||
        kernel->divisor > IRIS_KERNEL_DIVISOR_MAX || (kernel->absolute != 0 && kernel->absolute != 1)) {
        return IRIS_ERR_ARG;
    }
    int64_t sum = 0, bias = kernel->bias;
    for (int32_t i = 0; i < kernel->rows * kernel->columns; i++) {
        int64_t value = kernel->values[i];
        sum += value < 0 ? -value : value;
    }
    sum = 255 * sum + kernel->divisor / 2 + (bias < 0 ? -bias : bias) * kernel->divisor;
    return sum <= INT32_MAX ? IRIS_OK : IRIS_ERR_RANGE;
}

static iris_status check(const iris_image *dst, const iris_image *src, const iris_kernel *kernel,
                         iris_border border)
{
    iris_status status = iris_views_check(dst, src, border);
    if (status == IRIS_ERR_ARG) {
        return status;
    }
    int to_s16 = src->format == IRIS_GRAY8 && dst->format == IRIS_GRAY_S16;
    int lightness = src->format == IRIS_HSL24 && dst->format == IRIS_HSL24;
    if (!to_s16 && !lightness) {
        status = iris_views_check_levels(dst, src, border);
    }
    return status != IRIS_OK ? status : check_kernel(kernel);
}

static iris_status correlate(const iris_image *dst, const iris_image *src, const iris_kernel *kernel,
                             int turned, iris_border border, iris_scratch *scratch)
{
    iris_status status = check(dst, src, kernel, border);
    if (status != IRIS_OK || !scratch) {
        return status != IRIS_OK ? status : IRIS_ERR_ARG;
    }
    size_t mark = iris_scratch_mark(scratch);
    iris_convolution work = {0};
    work.dst = dst;
    work.quotient = quotient_for(kernel);
    status = begin(&work, src, kernel, turned, border, scratch);
    for (; status == IRIS_OK && work.rows.y < src->h; iris_rows_next(&work.rows)) {
        int32_t first, end, channels = work.rows.channels;
        if (iris_rows_span(&first, &end, &work.rows)) {
            iris_convolve_row(&work, first * channels, end * channels);
        }
    }
    iris_scratch_release(scratch, mark);
    return status;
}

iris_status iris_correlate(const iris_image *dst, const iris_image *src, const iris_kernel *kernel,
                           iris_border border, iris_scratch *scratch)
{
    return correlate(dst, src, kernel, 0, border, scratch);
}

iris_status iris_convolve(const iris_image *dst, const iris_image *src, const iris_kernel *kernel,
                          iris_border border, iris_scratch *scratch)
{
    return correlate(dst, src, kernel, 1, border, scratch);
}
