/* IRIS-XT - unsharp mask: makes edges steeper by what a blur takes away from them.
 *
 * The threshold is its smoothing: differences that small are noise, and are left as they are. Report, section 2.2.
 */
#ifndef IRIS_XT_UNSHARP_H
#define IRIS_XT_UNSHARP_H

#include "iris/border.h"
#include "iris/fixed.h"
#include "iris/image.h"
#include "iris/scratch.h"
#include "iris/xt/blur.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_UNSHARP_AMOUNT_MAX ((iris_q16)1048576) /* 16.0 */

typedef struct {
    iris_q16 sigma_q16;  /* of the blur, IRIS_BLUR_SIGMA_MIN to IRIS_BLUR_SIGMA_MAX pixels; default 1.0 */
    iris_q16 amount_q16; /* 0 (nothing changes) to IRIS_UNSHARP_AMOUNT_MAX; default 1.0 */
    int32_t threshold;   /* 0 to 255 gray levels: differences up to this change nothing; default 0 */
} iris_unsharp_config;

void iris_unsharp_defaults(iris_unsharp_config *config);

/* Working memory of iris_unsharp: that of the blur, and a blurred row. w pixels of 1 or 3 channels. */
#define IRIS_UNSHARP_SCRATCH_BYTES(w, channels, sigma_q16)                                                   \
    (IRIS_BLUR_GAUSSIAN_SCRATCH_BYTES(w, channels, sigma_q16) + IRIS_SCRATCH_ROUND((size_t)(w) * (channels)))

/* dst = src + amount * (src - blurred), rounded, 0 to 255, where |src - blurred| is above the threshold, else src.
 * blurred is what iris_blur_gaussian gives. IRIS_GRAY8, or each channel of IRIS_RGB888 and IRIS_BGR888. dst may be
 * src. A null config means the defaults.
 * IRIS_ERR_ARG: null pointer, invalid view, unknown border rule, or a config value outside; IRIS_ERR_FORMAT: other or
 * different formats; IRIS_ERR_RANGE: sizes differ; IRIS_ERR_ALIAS: dst and src overlap without being the same view;
 * IRIS_ERR_SCRATCH. O(pixels * channels * radius of the blur). */
iris_status iris_unsharp(const iris_image *dst, const iris_image *src, const iris_unsharp_config *config,
                         iris_border border, iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
