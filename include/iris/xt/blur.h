/* IRIS-XT - blurs: each pixel becomes a weighted mean of its surroundings.
 *
 * All take IRIS_GRAY8, or each channel of IRIS_RGB888 and IRIS_BGR888, and any iris_border. dst may be src. Report,
 * section 2.2.
 *
 * All return IRIS_ERR_ARG for a null pointer or an unknown border rule, the errors of iris_image_check for a view
 * that is not valid, IRIS_ERR_FORMAT for other or different formats, IRIS_ERR_RANGE when the sizes differ, and
 * IRIS_ERR_ALIAS when dst and src overlap without being the same view, besides what their comments say.
 */
#ifndef IRIS_XT_BLUR_H
#define IRIS_XT_BLUR_H

#include "iris/border.h"
#include "iris/fixed.h"
#include "iris/image.h"
#include "iris/scratch.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_BLUR_SIGMA_MIN ((iris_q16)6554)    /* 0.1 pixel */
#define IRIS_BLUR_SIGMA_MAX ((iris_q16)2621440) /* 40 pixels */

/* How far the Gaussian of this sigma reaches, in pixels: (10 sigma - 2) / 3, rounded up; 0 to 133. It has 3 taps up to
 * sigma 0.5, 5 up to 0.8, 7 up to 1.1. What is cut off weighs about a thousandth. */
#define IRIS_BLUR_RADIUS(sigma_q16) ((int32_t)((10 * (int64_t)(sigma_q16) + 65535) / 196608))

/* Working memory of iris_blur_gaussian: the rows around a row, one of sums, the weights, and where rows are when they
 * are more than 11. w pixels of 1 or 3 channels; sigma_q16 within its limits. */
#define IRIS_BLUR_GAUSSIAN_SCRATCH_BYTES(w, channels, sigma_q16)                                             \
    (IRIS_BORDER_ROWS_BYTES((size_t)(w) * (channels), (size_t)IRIS_BLUR_RADIUS(sigma_q16) * (channels),      \
                            (size_t)IRIS_BLUR_RADIUS(sigma_q16) * (channels), IRIS_BLUR_RADIUS(sigma_q16)) + \
     IRIS_SCRATCH_ROUND(sizeof(int16_t) * (channels) *                                                       \
                        ((size_t)(w) + 2u * (size_t)IRIS_BLUR_RADIUS(sigma_q16))) +                          \
     IRIS_SCRATCH_ROUND(sizeof(int16_t) * ((size_t)IRIS_BLUR_RADIUS(sigma_q16) + 1u)) +                      \
     IRIS_SCRATCH_ROUND(sizeof(int32_t) * (IRIS_BLUR_RADIUS(sigma_q16) > 5                                   \
                                               ? 2u * (size_t)IRIS_BLUR_RADIUS(sigma_q16) + 1u               \
                                               : 0u)))

/* dst = src weighted by exp(-(x^2 + y^2) / (2 sigma^2)) around each pixel. Of any picture, no pixel is more than 1
 * from the rounded value of the real Gaussian, which reaches without end; an even area stays what it is. sigma_q16 is
 * IRIS_BLUR_SIGMA_MIN to IRIS_BLUR_SIGMA_MAX, in pixels. Border: IRIS_BLUR_RADIUS pixels around.
 * IRIS_ERR_RANGE: sigma outside; IRIS_ERR_SCRATCH. O(pixels * channels * radius). */
iris_status iris_blur_gaussian(const iris_image *dst, const iris_image *src, iris_q16 sigma_q16,
                               iris_border border, iris_scratch *scratch);

/* The largest side of iris_blur_box. */
#define IRIS_BLUR_SIDE_MAX 255

/* Working memory of iris_blur_box: the rows around a row, and the sums of columns. */
#define IRIS_BLUR_BOX_SCRATCH_BYTES(w, channels, side)                                                       \
    (IRIS_BORDER_ROWS_BYTES((size_t)(w) * (channels), ((size_t)(side)-1u) / 2u * (channels),                 \
                            (size_t)(side) / 2u * (channels), ((size_t)(side) + 1u) / 2u) +                  \
     IRIS_SCRATCH_ROUND(sizeof(uint16_t) * (channels) * ((size_t)(w) + (size_t)(side)-1u)))

/* dst = the mean of side x side pixels of src, exact, rounded half up. side is 1 to IRIS_BLUR_SIDE_MAX pixels, odd or
 * even: the window begins (side - 1) / 2 pixels, rounded down, to the left of and above each pixel, so that an even
 * side reaches one farther to the right and down. The same as iris_convolve with iris_kernel_box, at a cost that does
 * not depend on side.
 * IRIS_ERR_RANGE: side outside; IRIS_ERR_SCRATCH. O((w + side) * (h + side) * channels). */
iris_status iris_blur_box(const iris_image *dst, const iris_image *src, int32_t side, iris_border border,
                          iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
