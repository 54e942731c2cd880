/* IRIS-XT - histograms: how many pixels have each level, and what that says.
 *
 * A histogram is 256 counts in the caller's memory. Whole views, parts of them that a mask selects, and single rows as they
 * arrive are counted alike:
 *
 *     uint32_t histogram[256] = {0};
 *     ... iris_histogram_row(histogram, row, IRIS_GRAY8, 0, w, NULL) for each row ...
 *     iris_otsu_value(&threshold, histogram);      xt/threshold.h; for the next frame
 *
 * What is counted of a pixel is one channel, a number:
 *   IRIS_GRAY8                             0
 *   IRIS_MASK1                             0; histogram[0] counts the bits that are 0, histogram[1] those that are 1
 *   IRIS_RGB888, IRIS_BGR888, IRIS_HSL24   its byte, from 0 on: 0 is R of IRIS_RGB888, B of IRIS_BGR888, H of IRIS_HSL24
 *   IRIS_RGB888, IRIS_BGR888               IRIS_CHANNEL_LIGHTNESS: L of IRIS_HSL24, half of the sum of the largest and the
 *                                          smallest of R, G, and B, rounded
 * Report, sections 2.2 and 3.3.3.
 */
#ifndef IRIS_XT_HISTOGRAM_H
#define IRIS_XT_HISTOGRAM_H

#include "iris/fixed.h"
#include "iris/image.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_CHANNEL_LIGHTNESS (-1)

/* Counts src: all of it, or when mask is not null the pixels that it selects. mask: IRIS_MASK1 of the same size.
 * IRIS_ERR_ARG: null pointer, or no such channel; the errors of iris_image_check for a view that is not valid;
 * IRIS_ERR_FORMAT: other formats; IRIS_ERR_RANGE: sizes differ. O(pixels). */
iris_status iris_histogram(uint32_t histogram[256], const iris_image *src, int32_t channel,
                           const iris_image *mask);

/* ADDS the counts of a row of n pixels: begin with zeros. mask: null, or bit i of word i / 32 selects pixel i. A count wraps
 * at 2^32.
 * IRIS_ERR_ARG: null pointer other than mask, or no such channel; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: n outside
 * 1..IRIS_SIDE_MAX; IRIS_ERR_ALIGN: mask or a row of IRIS_MASK1 is not aligned to 4 bytes. O(n). */
iris_status iris_histogram_row(uint32_t histogram[256], const void *row, iris_format format, int32_t channel,
                               int32_t n, const uint32_t *mask);

typedef struct {
    uint32_t count;        /* of pixels, 1 to 2^30 */
    uint8_t min, max;      /* the darkest and the brightest level there is */
    uint8_t median;        /* iris_histogram_percentile of a half */
    iris_q16 mean_q16;     /* rounded */
    iris_q16 variance_q16; /* the mean of (p - mean)^2, at most 127.5^2; of the exact mean, rounded once */
} iris_histogram_statistics;

/* IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: no counts, or more than 2^30 in sum. O(256). */
iris_status iris_histogram_measure(iris_histogram_statistics *statistics, const uint32_t histogram[256]);

/* The least level that at least this share of the pixels does not exceed: 0 gives the darkest level there is, a half the
 * median (of an even count the lower of the two in the middle), IRIS_Q16_ONE the brightest. Exact.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: share_q16 outside 0..IRIS_Q16_ONE, or no counts. O(256). */
iris_status iris_histogram_percentile(uint8_t *level, const uint32_t histogram[256], iris_q16 share_q16);

/* The darkest and the brightest level of an IRIS_GRAY8 picture, which need no counting: what a stretch from black to white
 * begins with (iris_tone_levels).
 * IRIS_ERR_ARG: null pointer, and the errors of iris_image_check; IRIS_ERR_FORMAT: another format. O(pixels). */
iris_status iris_histogram_extremes(uint8_t *darkest, uint8_t *brightest, const iris_image *src);

#ifdef __cplusplus
}
#endif

#endif
