/* IRIS-XT - moments of what is selected in a mask, to the third order, and Hu's seven numbers, which stay the same when
 * a shape is moved, turned, or scaled: a second opinion on what a shape is, from its area rather than from its outline.
 *
 * With sums over all selected pixels (x, y):
 *
 *     raw          m_pq   = sum x^p y^q                        about the middle of the mask's first pixel, exact
 *     central      mu_pq  = sum (x - m10/m00)^p (y - m01/m00)^q
 *     normalized   eta_pq = mu_pq / m00^(1 + (p + q) / 2)
 *
 * M.-K. Hu, "Visual pattern recognition by moment invariants", 1962. regress.h and blob.h have the moments to the
 * second order, for lines and ellipses.
 */
#ifndef IRIS_XT_MOMENTS_H
#define IRIS_XT_MOMENTS_H

#include "iris/fixed.h"
#include "iris/image.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The longest side of a mask: no sum overflows. */
#define IRIS_MOMENTS_SIDE_MAX 4096

typedef struct {
    int64_t m00, m10, m01, m20, m11, m02, m30, m21, m12, m03;
} iris_mask_moments;

/* 6 and 40 are fraction bits. hu_q40[0] to [5] are the same for a shape's mirror image, [6] changes its sign. Long
 * thin lines saturate: normalized moments at +-1024, Hu's numbers beyond +-2^18. */
typedef struct {
    iris_q16 x_q16, y_q16; /* center of gravity, pixels */
    int64_t mu20_q6, mu11_q6, mu02_q6, mu30_q6, mu21_q6, mu12_q6, mu03_q6;
    int64_t eta20_q40, eta11_q40, eta02_q40, eta30_q40, eta21_q40, eta12_q40, eta03_q40;
    int64_t hu_q40[7];
} iris_invariants;

/* The raw moments of mask, IRIS_MASK1; all 0 when nothing is selected.
 * IRIS_ERR_ARG: null pointer; the errors of iris_image_check; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: a side above
 * IRIS_MOMENTS_SIDE_MAX. O(pixels / 32 + runs). */
iris_status iris_mask_moments_sum(iris_mask_moments *moments, const iris_image *mask);

/* What follows from raw moments.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: sums that no mask has, or those of an empty one. O(1), some 20 divisions
 * of 128 bits. */
iris_status iris_moments_invariants(iris_invariants *invariants, const iris_mask_moments *moments);

#ifdef __cplusplus
}
#endif

#endif
