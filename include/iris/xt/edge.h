/* IRIS-XT - edges: where does the gray level change, how much, and in which direction?
 *
 * One call by operator gives the gradient itself, its magnitude as a picture, its direction, or a mask of the pixels
 * that are edges. From IRIS_GRAY8, by differences with the pixels around p (x to the right, y down):
 *
 *     SOBEL      dx = a + 2 b + c of the columns right minus left, dy of the rows below minus above; -1020..1020
 *     PREWITT    the same with 1 1 1; -765..765
 *     ISOTROPIC  the same with 1 r 1, r = 181/128, the square root of 2 to 1.1e-4 (Frei and Chen 1977): each of
 *                dx and dy is the sum of its three differences, and 53/128 of the middle one, rounded; -871..871
 *     ROBERTS    the two diagonals of the 2x2 pixels that p is the upper left one of: dx = lower right - p,
 *                dy = lower left - right neighbor; -255..255. Its axes are turned: dx points 45 degrees down.
 *     LAPLACIAN  the second derivative: the sum of the four neighbors minus 4 p; -1020..1020. No direction.
 *     LOG        32 times the Laplacian of src smoothed by a Gaussian, which is kept to 1/64 of a level; rounded;
 *                -32640..32640, on photographs of the order of the others. No direction. Marr and Hildreth 1980.
 *
 * The magnitude is |dx| + |dy| (of LAPLACIAN and LOG: the absolute value), as OpenCV's Canny counts it. Thin edges and
 * hysteresis: canny.h; edges at the least cost: automaton.h.
 *
 * Common to all: a null config means the defaults. border is what lies beyond the edge of src; by IRIS_BORDER_SKIP the
 * pixels whose window leaves the picture keep their value in dst: one row and column at each edge (ROBERTS: the last
 * ones alone; LOG: IRIS_BLUR_RADIUS(sigma_q16) more). LOG continues the smoothed picture by the same rule. Each call
 * returns IRIS_ERR_ARG for a null pointer, an unknown operator or border, or a config value outside its range; the
 * errors of iris_image_check; IRIS_ERR_FORMAT for other formats than said; IRIS_ERR_RANGE when sizes differ;
 * IRIS_ERR_ALIAS when views overlap in a way that is not allowed; IRIS_ERR_SCRATCH. O(pixels), of LOG O(pixels *
 * radius). Report, sections 2.2 and 3.3 (EdgeDetectorManager).
 */
#ifndef IRIS_XT_EDGE_H
#define IRIS_XT_EDGE_H

#include "iris/xt/blur.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    IRIS_EDGE_SOBEL = 0,
    IRIS_EDGE_PREWITT,
    IRIS_EDGE_ISOTROPIC,
    IRIS_EDGE_ROBERTS,
    IRIS_EDGE_LAPLACIAN,
    IRIS_EDGE_LOG
} iris_edge_operator;

/* Gain and threshold are below these. */
#define IRIS_EDGE_GAIN_END      ((iris_q16)16 * 65536)
#define IRIS_EDGE_THRESHOLD_END 32768

typedef struct {
    iris_edge_operator op; /* default SOBEL */
    iris_q16 gain_q16;     /* of iris_edge_magnitude: 0 up to below 16.0; default 1/4 */
    int32_t threshold;  /* of iris_edge_mask, in units of the magnitude: 0 up to below 32768; default 160 */
    iris_q16 sigma_q16; /* of LOG alone: IRIS_BLUR_SIGMA_MIN to IRIS_BLUR_SIGMA_MAX pixels; default 1.4 */
} iris_edge_config;

void iris_edge_defaults(iris_edge_config *config);

/* Working memory of every call here: the rows around a row, and five rows of differences. And of LOG: rows of the blur,
 * four rows of the smoothed picture, and five of its Laplacian. */
#define IRIS_EDGE_SCRATCH_BYTES(w)                                                                           \
    (IRIS_BORDER_ROWS_BYTES(w, 1, 1, 1) + 5u * IRIS_SCRATCH_ROUND(2u * ((size_t)(w) + 2u)))

#define IRIS_EDGE_LOG_SCRATCH_BYTES(w, sigma_q16)                                                            \
    (IRIS_BLUR_GAUSSIAN_SCRATCH_BYTES(w, 1, sigma_q16) + 9u * IRIS_SCRATCH_ROUND(2u * ((size_t)(w) + 2u)))

/* dx and dy, IRIS_GRAY_S16, of src. Either may be null when it is not wanted; of LAPLACIAN and LOG dy must be null, and
 * dx is the second derivative. dx, dy, and src are disjoint. */
iris_status iris_edge_gradient(const iris_image *dx, const iris_image *dy, const iris_image *src,
                               const iris_edge_config *config, iris_border border, iris_scratch *scratch);

/* dst, IRIS_GRAY8: the magnitude times the gain, rounded, at most 255. dst may be src. */
iris_status iris_edge_magnitude(const iris_image *dst, const iris_image *src, const iris_edge_config *config,
                                iris_border border, iris_scratch *scratch);

/* dst, IRIS_GRAY_U16: the direction in which src gets brighter, as the bits of an iris_angle: 0 right, 16384 down,
 * 49152 (-16384) up; the nearest angle or one beside it (iris_atan2_angle). 0 where there is no gradient. Not of
 * LAPLACIAN and LOG (IRIS_ERR_ARG). dst and src are disjoint. 18 steps of shifts and additions per pixel. */
iris_status iris_edge_direction(const iris_image *dst, const iris_image *src, const iris_edge_config *config,
                                iris_border border, iris_scratch *scratch);

/* mask, IRIS_MASK1: 1 where the magnitude is above the threshold. Of LAPLACIAN and LOG: 1 at zero crossings, where the
 * value goes from one sign to the other between two neighbors in a row or column that are more than the threshold
 * apart. That is the one of the two that is nearer to zero (the left or upper one of equals), or the pixel between the
 * two where it is zero. Pixels beyond the edge are no neighbors, and by IRIS_BORDER_SKIP one more row and column of the
 * mask at each edge keeps its value. mask and src are disjoint. Bits past w are kept. */
iris_status iris_edge_mask(const iris_image *mask, const iris_image *src, const iris_edge_config *config,
                           iris_border border, iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
