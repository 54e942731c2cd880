/* IRIS-XT - Canny's edges: lines one pixel thin, and faint parts of them where they continue clear ones.
 *
 * Smoothing by a Gaussian, the gradient of Sobel, then only the pixels whose gradient is greatest across the edge
 * (non-maximum suppression), then only the lines that are clear somewhere (hysteresis). In integers, and with the
 * rules that OpenCV made common, so that without smoothing the two give the same pixels:
 *   - the gradient is |dx| + |dy| of the 3x3 Sobel operator, 0 to 2040; beyond the picture it is 0;
 *   - with t = |dx| * 13573 / 32768, rounded down (the tangent of 22.5 degrees): the neighbors across the edge are the
 *     left and the right one when |dy| <= t, the upper and the lower one when |dy| > 2 |dx| + t, else those on the
 *     gradient's diagonal;
 *   - the gradient must be above the left and not below the right neighbor's; above the upper and not below the lower
 *     one's; on a diagonal above both;
 *   - a pixel that has passed and is above `high` is an edge; one that is above `low` is one when an edge is among its
 *     eight neighbors.
 * J. Canny 1986. Report, section 2.2.
 */
#ifndef IRIS_XT_CANNY_H
#define IRIS_XT_CANNY_H

#include "iris/xt/blur.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_CANNY_THRESHOLD_END 32768

typedef struct {
    iris_q16 sigma_q16; /* of the Gaussian, in pixels, as in blur.h, or 0: none; default 1.4 */
    int32_t low, high;  /* of the gradient, 0 up to below 32768, low <= high; default 40 and 100 */
} iris_canny_config;

void iris_canny_defaults(iris_canny_config *config);

/* Working memory: rows of the blur, of the blurred picture, of gradients, and of masks; and for the whole picture one
 * bit per pixel, and one per 32 pixels. sigma_q16 is 0 or within its limits. 640x480 at sigma 1.4: 60 KB. */
#define IRIS_CANNY_SCRATCH_BYTES(w, h, sigma_q16)                                                            \
    (((sigma_q16) > 0 ? IRIS_BLUR_GAUSSIAN_SCRATCH_BYTES(w, 1, sigma_q16) : 0u) +                            \
     IRIS_BORDER_ROWS_BYTES(w, 1, 1, 1) + 8u * IRIS_SCRATCH_ROUND(2u * ((size_t)(w) + 2u)) +                 \
     2u * IRIS_SCRATCH_ROUND(4u * IRIS_CANNY_WORDS(w)) +                                                     \
     IRIS_SCRATCH_ROUND(4u * IRIS_CANNY_WORDS(w) * (size_t)(h)) +                                            \
     IRIS_SCRATCH_ROUND(4u * IRIS_CANNY_WORDS(IRIS_CANNY_WORDS(w)) * (size_t)(h)))
#define IRIS_CANNY_WORDS(w) (((size_t)(w) + 31u) / 32u)

/* mask, IRIS_MASK1, of src, IRIS_GRAY8: 1 on edges. config null: the defaults. border is what lies beyond the edge of
 * src and, by the same rule, of the blurred picture. By IRIS_BORDER_SKIP the pixels nearer to the edge than
 * IRIS_BLUR_RADIUS(sigma_q16) + 2 keep their value and make no edges. mask and src are disjoint. Bits past w are kept.
 *
 * Any picture is done in bounded time without recursion: edges grow 32 pixels at a time, and what lies next to a
 * word that has changed is looked at again. A word changes at most 32 times.
 *
 * IRIS_ERR_ARG: null pointer, unknown border, low > high, or a config value outside its range; the errors of
 * iris_image_check; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: sizes differ; IRIS_ERR_ALIAS; IRIS_ERR_SCRATCH.
 * O(pixels * radius); a maze of faint lines takes up to 9 looks at a word for each of its pixels more. */
iris_status iris_canny(const iris_image *mask, const iris_image *src, const iris_canny_config *config,
                       iris_border border, iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
