/* The well-known matrices. */
#include <string.h>

#include "gauss.h"
#include "iris/xt/convolve.h"

static void set(iris_kernel *kernel, const int32_t *values, int32_t rows, int32_t columns, int32_t divisor)
{
    *kernel = (iris_kernel){values, rows, columns, divisor, 0, 0};
}

static iris_status check(const iris_kernel *kernel, const int32_t *values, iris_kernel_direction direction)
{
    return kernel && values && (direction == IRIS_KERNEL_X || direction == IRIS_KERNEL_Y) ? IRIS_OK
                                                                                          : IRIS_ERR_ARG;
}

/* A side of 1 middle 1 minus the opposite one. */
static iris_status difference(iris_kernel *kernel, int32_t *values, iris_kernel_direction direction,
                              int32_t one, int32_t middle)
{
    iris_status status = check(kernel, values, direction);
    if (status != IRIS_OK) {
        return status;
    }
    for (int32_t along = -1; along <= 1; along++) {
        for (int32_t across = -1; across <= 1; across++) {
            int32_t at = direction == IRIS_KERNEL_X ? 4 + 3 * across + along : 4 + 3 * along + across;
            values[at] = along * (across == 0 ? middle : one);
        }
    }
    set(kernel, values, 3, 3, one);
    return IRIS_OK;
}

iris_status iris_kernel_roberts(iris_kernel *kernel, int32_t *values, iris_kernel_direction direction)
{
    static const int32_t diagonal[2][4] = {{-1, 0, 0, 1}, {0, -1, 1, 0}};
    iris_status status = check(kernel, values, direction);
    if (status == IRIS_OK) {
        memcpy(values, diagonal[direction], sizeof diagonal[0]);
        set(kernel, values, 2, 2, 1);
    }
    return status;
}

iris_status iris_kernel_sobel(iris_kernel *kernel, int32_t *values, iris_kernel_direction direction)
{
    return difference(kernel, values, direction, 1, 2);
}

iris_status iris_kernel_prewitt(iris_kernel *kernel, int32_t *values, iris_kernel_direction direction)
{
    return difference(kernel, values, direction, 1, 1);
}

iris_status iris_kernel_isotropic(iris_kernel *kernel, int32_t *values, iris_kernel_direction direction)
{
    return difference(kernel, values, direction, 128, 181);
}

iris_status iris_kernel_laplacian(iris_kernel *kernel, int32_t *values, int32_t neighbors)
{
    if (!kernel || !values) {
        return IRIS_ERR_ARG;
    }
    if (neighbors != 4 && neighbors != 8) {
        return IRIS_ERR_RANGE;
    }
    for (int32_t i = 0; i < 9; i++) {
        values[i] = i == 4 ? -neighbors : i % 2 != 0 || neighbors == 8;
    }
    set(kernel, values, 3, 3, 1);
    return IRIS_OK;
}

iris_status iris_kernel_box(iris_kernel *kernel, int32_t *values, int32_t rows, int32_t columns)
{
    if (!kernel || !values) {
        return IRIS_ERR_ARG;
    }
    if (rows < 1 || rows > IRIS_KERNEL_SIDE_MAX || columns < 1 || columns > IRIS_KERNEL_SIDE_MAX) {
        return IRIS_ERR_RANGE;
    }
    for (int32_t i = 0; i < rows * columns; i++) {
        values[i] = 1;
    }
    set(kernel, values, rows, columns, rows * columns);
    return IRIS_OK;
}

#define GAUSSIAN_BITS   11
#define GAUSSIAN_RADIUS 15

/* The weights of the distances 0 to radius, which sum to 2^GAUSSIAN_BITS, each side counted. */
static void bell(int32_t weights[GAUSSIAN_RADIUS + 1], int32_t radius, iris_q16 sigma_q16)
{
    uint64_t sum = iris_gauss_q31(0, sigma_q16);
    for (int32_t k = 1; k <= radius; k++) {
        sum += 2 * (uint64_t)iris_gauss_q31(k * k, sigma_q16);
    }
    weights[0] = 1 << GAUSSIAN_BITS;
    for (int32_t k = 1; k <= radius; k++) {
        uint64_t scaled = (uint64_t)iris_gauss_q31(k * k, sigma_q16) << GAUSSIAN_BITS;
        weights[k] = (int32_t)((scaled + sum / 2) / sum);
        weights[0] -= 2 * weights[k];
    }
}

static int32_t distance(int32_t i, int32_t radius)
{
    return i < radius ? radius - i : i - radius;
}

iris_status iris_kernel_gaussian(iris_kernel *kernel, int32_t *values, iris_q16 sigma_q16)
{
    if (!kernel || !values) {
        return IRIS_ERR_ARG;
    }
    if (sigma_q16 < IRIS_BLUR_SIGMA_MIN || sigma_q16 > IRIS_KERNEL_GAUSSIAN_SIGMA_MAX) {
        return IRIS_ERR_RANGE;
    }
    int32_t radius = IRIS_BLUR_RADIUS(sigma_q16), side = 2 * radius + 1, weights[GAUSSIAN_RADIUS + 1];
    bell(weights, radius, sigma_q16);
    for (int32_t i = 0; i < side * side; i++) {
        values[i] = weights[distance(i / side, radius)] * weights[distance(i % side, radius)];
    }
    set(kernel, values, side, side, 1 << (2 * GAUSSIAN_BITS));
    return IRIS_OK;
}

iris_status iris_kernel_unsharp(iris_kernel *kernel, int32_t *values, iris_q16 sigma_q16, iris_q16 amount_q16)
{
    if (kernel && values && (amount_q16 < 0 || amount_q16 > 16 * IRIS_Q16_ONE)) {
        return IRIS_ERR_RANGE;
    }
    iris_status status = iris_kernel_gaussian(kernel, values, sigma_q16);
    if (status != IRIS_OK) {
        return status;
    }
    int32_t count = kernel->rows * kernel->columns, rest = IRIS_Q16_ONE;
    for (int32_t i = 0; i < count; i++) {
        values[i] = (int32_t)-iris_round_shift((int64_t)values[i] * amount_q16, 2 * GAUSSIAN_BITS);
        rest -= i == count / 2 ? 0 : values[i];
    }
    values[count / 2] = rest;
    kernel->divisor = IRIS_Q16_ONE;
    return IRIS_OK;
}

#define WORK_BITS  28         /* fraction bits until what is left of the sum is spread */
#define TURN_Q31   341782638u /* 1 / (2 pi) */
#define INVERSE_Q  28
#define RELATIVE_Q 22

/* (r^2 / sigma^2 - 2) / (2 pi sigma^4) exp(-r^2 / (2 sigma^2)) with WORK_BITS fraction bits: less than 2^31. */
static int32_t log_value(int32_t squared, iris_q16 sigma_q16)
{
    uint64_t variance_q32 = (uint64_t)sigma_q16 * (uint64_t)sigma_q16; /* 1/4 to 14.1 */
    uint64_t inverse = ((uint64_t)1 << (32 + INVERSE_Q)) / variance_q32;
    int64_t scale = (int64_t)((inverse * inverse >> INVERSE_Q) * TURN_Q31 >> 31);
    int64_t relative = (int64_t)(((uint64_t)squared << (32 + RELATIVE_Q)) / variance_q32);
    int64_t shape = (relative - (2 << RELATIVE_Q)) * iris_gauss_q31(squared, sigma_q16) >> RELATIVE_Q;
    return (int32_t)iris_round_shift(shape * scale, 31 + INVERSE_Q - WORK_BITS);
}

iris_status iris_kernel_log(iris_kernel *kernel, int32_t *values, iris_q16 sigma_q16)
{
    if (!kernel || !values) {
        return IRIS_ERR_ARG;
    }
    if (sigma_q16 < IRIS_KERNEL_LOG_SIGMA_MIN || sigma_q16 > IRIS_KERNEL_LOG_SIGMA_MAX) {
        return IRIS_ERR_RANGE;
    }
    int32_t radius = IRIS_KERNEL_LOG_RADIUS(sigma_q16), side = 2 * radius + 1, rest = 0;
    int bits = sigma_q16 < IRIS_Q16_ONE ? 19 : 22;
    int64_t sum = 0;
    for (int32_t i = 0; i < side * side; i++) {
        int32_t dx = distance(i % side, radius), dy = distance(i / side, radius);
        values[i] = log_value(dx * dx + dy * dy, sigma_q16);
        sum += values[i];
    }
    int64_t share = sum / (side * side);
    for (int32_t i = 0; i < side * side; i++) {
        values[i] = (int32_t)iris_round_shift(values[i] - share, WORK_BITS - bits);
        rest -= values[i];
    }
    values[side * side / 2] += rest;
    set(kernel, values, side, side, 1 << bits);
    return IRIS_OK;
}
