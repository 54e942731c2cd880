/* IRIS-XT - thresholds for Canny's edges, from the picture: low where light is even and noise low, so that faint edges
 * are found, and not lower than noise and texture allow.
 *
 * Most of a picture is no edge. So the median of the gradient says how much there is of noise and texture: of Gaussian
 * noise alone, two pixels in a thousand are above three times the median, and none of a frame above six times. An
 * estimate of noise by the median is that of P. J. Rousseeuw and C. Croux, 1993.
 */
#ifndef IRIS_XT_CANNY_ADAPT_H
#define IRIS_XT_CANNY_ADAPT_H

#include "iris/xt/canny.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_CANNY_ADAPT_HIGH_MIN 24  /* a step of about 11 levels at the default sigma */
#define IRIS_CANNY_ADAPT_HIGH_MAX 100 /* the default of iris_canny_config */

/* Working memory: rows of the blur and of the blurred picture, and a row of gradients. 640 at sigma 1.4: 20 KB. */
#define IRIS_CANNY_ADAPT_SCRATCH_BYTES(w, sigma_q16)                                                         \
    (((sigma_q16) > 0 ? IRIS_BLUR_GAUSSIAN_SCRATCH_BYTES(w, 1, sigma_q16) : 0u) +                            \
     IRIS_BORDER_ROWS_BYTES(w, 1, 1, 1) + 3u * IRIS_SCRATCH_ROUND(2u * (size_t)(w)))

/* Sets config's high to six times the median of |dx| + |dy| of the 3x3 Sobel operator over src, IRIS_GRAY8, smoothed by
 * config's sigma_q16, but at least IRIS_CANNY_ADAPT_HIGH_MIN and at most IRIS_CANNY_ADAPT_HIGH_MAX; and low to two
 * fifths of it. Beyond the picture its edge goes on.
 *
 * IRIS_ERR_ARG: null pointer, or sigma_q16 neither 0 nor within its limits; the errors of iris_image_check;
 * IRIS_ERR_FORMAT; IRIS_ERR_SCRATCH. config is untouched then. O(pixels * radius). */
iris_status iris_canny_adapt(iris_canny_config *config, const iris_image *src, iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
