/* IRIS - integral images: the sum over any box in four readings, whatever its size.
 *
 * The integral image of a picture of w x h pixels is IRIS_GRAY_U32 of (w + 1) x (h + 1): pixel (x, y) is the sum of
 * the x * y source pixels that are above and to the left of the corner (x, y), so that the first row and the first
 * column are 0. A second one with the squares gives the variance of any box.
 *
 * Sums are modulo 2^32. A large bright picture's integral image wraps around, and the sum over a box is exact all the
 * same as long as the box's own true sum is below 2^32. Whatever its pixels, that is so for IRIS_INTEGRAL_SUM_PIXELS
 * (a square of 4104) and for IRIS_INTEGRAL_SQUARES_PIXELS of squares (a square of 257).
 * F. C. Crow 1984 (summed-area tables); P. Viola and M. Jones 2001.
 */
#ifndef IRIS_INTEGRAL_H
#define IRIS_INTEGRAL_H

#include "iris/fixed.h"
#include "iris/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The most pixels of a box whose sum cannot pass 2^32 - 1: of values, and of squares of values up to 255. */
#define IRIS_INTEGRAL_SUM_PIXELS     16843009
#define IRIS_INTEGRAL_SQUARES_PIXELS 66051

/* integral = the integral image of src, which is IRIS_GRAY8, or IRIS_MASK1, whose selected pixels count 1. They are
 * disjoint; a side of src is at most IRIS_SIDE_MAX - 1.
 * IRIS_ERR_ARG: null pointer or invalid view; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: integral is not one wider and one
 * higher than src; IRIS_ERR_ALIAS. O(w h). */
iris_status iris_integral(const iris_image *integral, const iris_image *src);

/* The same of the squares of the pixels of an IRIS_GRAY8 picture. */
iris_status iris_integral_squares(const iris_image *squares, const iris_image *src);

/* *sum = the sum over the box, modulo 2^32. The box counts pixels of the source and lies wholly inside it.
 * IRIS_ERR_ARG: null pointer or invalid view; IRIS_ERR_FORMAT: not IRIS_GRAY_U32; IRIS_ERR_RANGE: the box is empty or
 * not wholly inside. O(1). */
iris_status iris_integral_sum(uint32_t *sum, const iris_image *integral, iris_rect box);

/* *mean_q16 = the mean of the box, rounded half up. Errors as above; also IRIS_ERR_RANGE for a box of more than
 * IRIS_INTEGRAL_SUM_PIXELS. O(1), one division. */
iris_status iris_integral_mean(iris_q16 *mean_q16, const iris_image *integral, iris_rect box);

/* *variance_q16 = the mean of (pixel - mean)^2 in the box, at most 127.5^2, computed exactly and rounded half up; its
 * square root is the standard deviation. Errors as above; also IRIS_ERR_RANGE for integral images of different sizes,
 * and for a box of more than IRIS_INTEGRAL_SQUARES_PIXELS. O(1), two divisions. */
iris_status iris_integral_variance(iris_q16 *variance_q16, const iris_image *integral,
                                   const iris_image *squares, iris_rect box);

#ifdef __cplusplus
}
#endif

#endif
