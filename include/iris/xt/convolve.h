/* IRIS-XT - convolution: each pixel becomes a weighted sum of its surroundings, with whole-number weights.
 *
 * An iris_kernel is the matrix of weights (KernelMatrix); the generators below make the well-known ones
 * (KernelGenerator). Everything is exact: sums are whole numbers that cannot overflow, and the one division at the
 * end is rounded half up. A matrix that is the product of a column and a row is found out, and costs two passes of
 * one dimension. Report, section 2.2.
 */
#ifndef IRIS_XT_CONVOLVE_H
#define IRIS_XT_CONVOLVE_H

#include "iris/border.h"
#include "iris/fixed.h"
#include "iris/image.h"
#include "iris/scratch.h"
#include "iris/xt/blur.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_KERNEL_SIDE_MAX    31
#define IRIS_KERNEL_DIVISOR_MAX 4194304 /* 2^22 */

typedef struct {
    const int32_t *values; /* rows * columns weights, row by row; the kernel does not own them */
    int32_t rows, columns; /* 1 to IRIS_KERNEL_SIDE_MAX each, odd or even */
    int32_t divisor;       /* 1 to IRIS_KERNEL_DIVISOR_MAX; powers of two are quickest */
    int32_t bias;          /* gray levels added after the division */
    int absolute; /* 1: the absolute value of quotient + bias is written; 0: negative values become 0 */
} iris_kernel;

/* Working memory of iris_convolve and iris_correlate: the rows around a row, the weights, and a row of sums. w pixels
 * of the channels that are worked on: 3 of IRIS_RGB888 and IRIS_BGR888, else 1. */
#define IRIS_CONVOLVE_SCRATCH_BYTES(w, channels, rows, columns)                                              \
    (IRIS_BORDER_ROWS_BYTES((size_t)(w) * (channels), ((size_t)(columns)-1u) / 2u * (channels),              \
                            (size_t)(columns) / 2u * (channels), (rows) / 2) +                               \
     IRIS_SCRATCH_ROUND(sizeof(int32_t) * (size_t)(rows) * (size_t)(columns)) +                              \
     IRIS_SCRATCH_ROUND(sizeof(int32_t) * (channels) * ((size_t)(w) + (size_t)(columns)-1u)))

/* dst = round(sum / divisor) + bias, where sum is over the rows x columns pixels around each pixel, times their
 * weights.
 *
 * The window begins (columns - 1) / 2 pixels to the left and (rows - 1) / 2 above, rounded down, so that one of even
 * size reaches one farther to the right and down. iris_correlate lays the matrix on it as it is written;
 * iris_convolve turns the matrix by 180 degrees first, and then does the same: the window is the same, and on
 * symmetric matrices so is the result.
 *
 *     src                          dst
 *     IRIS_GRAY8                   IRIS_GRAY8, limited to 0..255; or IRIS_GRAY_S16, limited to -32768..32767
 *     IRIS_RGB888, IRIS_BGR888     the same format, each channel by itself
 *     IRIS_HSL24                   the same format: its lightness; hue and saturation are copied
 *
 * dst may be src.
 * IRIS_ERR_ARG: a null pointer, invalid view, unknown border rule, or a side, divisor, or `absolute` outside its
 * range; IRIS_ERR_FORMAT: other formats; IRIS_ERR_RANGE: sizes differ, or the kernel could overflow:
 * 255 * (sum of |weights|) + divisor / 2 + |bias| * divisor must be below 2^31; IRIS_ERR_ALIAS: dst and src overlap
 * without being the same view; IRIS_ERR_SCRATCH. O(pixels * channels * weights that are not 0), or
 * O(pixels * channels * (rows + columns)) of a separable matrix. */
iris_status iris_convolve(const iris_image *dst, const iris_image *src, const iris_kernel *kernel,
                          iris_border border, iris_scratch *scratch);
iris_status iris_correlate(const iris_image *dst, const iris_image *src, const iris_kernel *kernel,
                           iris_border border, iris_scratch *scratch);

/* --- KernelGenerator ---
 *
 * Each sets all of *kernel, with bias 0 and absolute 0, and writes its weights to `values`, which must stay as long
 * as the kernel is used; how many there are is said with each. Matrices are written for iris_correlate: a difference
 * is positive where the picture gets brighter to the right or downwards (iris_convolve turns its sign). All return
 * IRIS_ERR_ARG for a null pointer or an unknown direction, and IRIS_ERR_RANGE for a size, sigma, or amount outside, and
 * write nothing then. O(values). */

typedef enum {
    IRIS_KERNEL_X = 0, /* the difference to the right */
    IRIS_KERNEL_Y      /* the difference downwards */
} iris_kernel_direction;

/* 4 values: X is lower right minus upper left, Y is lower left minus upper right. */
iris_status iris_kernel_roberts(iris_kernel *kernel, int32_t *values, iris_kernel_direction direction);

/* 9 values each; a column or row of 1 2 1, of 1 1 1, and of 1 r 1 minus the opposite one. r = 181 / 128 is the square
 * root of two to 1.2e-4 (Frei and Chen 1977). */
iris_status iris_kernel_sobel(iris_kernel *kernel, int32_t *values, iris_kernel_direction direction);
iris_status iris_kernel_prewitt(iris_kernel *kernel, int32_t *values, iris_kernel_direction direction);
iris_status iris_kernel_isotropic(iris_kernel *kernel, int32_t *values, iris_kernel_direction direction);

/* 9 values: the sum of the 4 or 8 neighbors minus as many times the pixel. IRIS_ERR_RANGE: other neighbors. */
iris_status iris_kernel_laplacian(iris_kernel *kernel, int32_t *values, int32_t neighbors);

/* rows * columns values, all 1, divided by their number: the mean. */
iris_status iris_kernel_box(iris_kernel *kernel, int32_t *values, int32_t rows, int32_t columns);

/* How many values a Gaussian has, and the largest sigma whose Gaussian fits. */
#define IRIS_KERNEL_GAUSSIAN_VALUES(sigma_q16)                                                               \
    ((2 * IRIS_BLUR_RADIUS(sigma_q16) + 1) * (2 * IRIS_BLUR_RADIUS(sigma_q16) + 1))
#define IRIS_KERNEL_GAUSSIAN_SIGMA_MAX ((iris_q16)308019) /* 4.7 pixels */

/* A Gaussian as far as iris_blur_gaussian reaches: the product of a column and a row of weights in 2048ths, so that
 * it is separable and sums to one. sigma_q16 is IRIS_BLUR_SIGMA_MIN to IRIS_KERNEL_GAUSSIAN_SIGMA_MAX.
 * iris_blur_gaussian is quicker and closer. */
iris_status iris_kernel_gaussian(iris_kernel *kernel, int32_t *values, iris_q16 sigma_q16);

/* How far the Laplacian of a Gaussian reaches, four sigma, and how many values it has. */
#define IRIS_KERNEL_LOG_RADIUS(sigma_q16) ((int32_t)((4 * (int64_t)(sigma_q16) + 65535) / 65536))
#define IRIS_KERNEL_LOG_VALUES(sigma_q16)                                                                    \
    ((2 * IRIS_KERNEL_LOG_RADIUS(sigma_q16) + 1) * (2 * IRIS_KERNEL_LOG_RADIUS(sigma_q16) + 1))
#define IRIS_KERNEL_LOG_SIGMA_MIN ((iris_q16)32768)  /* 0.5 pixel */
#define IRIS_KERNEL_LOG_SIGMA_MAX ((iris_q16)245760) /* 3.75 pixels */

/* The Laplacian of a Gaussian (Marr and Hildreth 1980): (r^2 / sigma^2 - 2) / sigma^2 times the Gaussian at distance r,
 * less its mean over the matrix, so that an even area gives exactly 0; with 22 fraction bits, and 19 below sigma 1.
 * sigma_q16 is IRIS_KERNEL_LOG_SIGMA_MIN to IRIS_KERNEL_LOG_SIGMA_MAX. */
iris_status iris_kernel_log(iris_kernel *kernel, int32_t *values, iris_q16 sigma_q16);

/* What takes a Gaussian blur away: 1 + amount at the center minus amount times the Gaussian of
 * IRIS_KERNEL_GAUSSIAN_VALUES values, with 16 fraction bits. amount_q16 is 0 to 16.0; sigma as of
 * iris_kernel_gaussian. unsharp.h does the same with a threshold. */
iris_status iris_kernel_unsharp(iris_kernel *kernel, int32_t *values, iris_q16 sigma_q16,
                                iris_q16 amount_q16);

#ifdef __cplusplus
}
#endif

#endif
