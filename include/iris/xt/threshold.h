/* IRIS-XT - thresholds: which pixels are what was looked for?
 *
 * From IRIS_GRAY8 to IRIS_MASK1 of the same size, by a fixed value, by one value for the whole image that separates its
 * two kinds of pixels best (Otsu), or by the mean of each pixel's surroundings, which uneven light does not disturb. 1
 * means selected, so that either side can be asked for. Bits of the mask past w are kept.
 *
 * All three return IRIS_ERR_ARG for a null pointer or an unknown side, the errors of iris_image_check for a view that
 * is not valid, IRIS_ERR_FORMAT for other formats, IRIS_ERR_RANGE when the sizes differ, and IRIS_ERR_ALIAS when mask
 * and gray overlap, besides what their comments say. Report, section 2.1.
 */
#ifndef IRIS_XT_THRESHOLD_H
#define IRIS_XT_THRESHOLD_H

#include "iris/image.h"
#include "iris/scratch.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    IRIS_SELECT_BRIGHT = 0, /* 1 where the pixel is above the threshold */
    IRIS_SELECT_DARK        /* 1 where it is not */
} iris_select;

/* Fixed: bright is p > value. O(pixels). */
iris_status iris_threshold(const iris_image *mask, const iris_image *gray, uint8_t value, iris_select select);

/* Working memory of iris_threshold_otsu: a histogram. */
#define IRIS_THRESHOLD_OTSU_SCRATCH_BYTES ((size_t)1024)

/* Otsu's threshold (1979) of the image, then iris_threshold. *value is the threshold found; null when not wanted.
 * IRIS_ERR_SCRATCH. O(pixels). */
iris_status iris_threshold_otsu(uint8_t *value, const iris_image *mask, const iris_image *gray,
                                iris_select select, iris_scratch *scratch);

/* Otsu's threshold from a histogram: what lies in p <= value and in p > value has the greatest variance between the
 * two, compared exactly. Of several values that divide the pixels alike (empty bins between two hills) the middle one,
 * rounded down; of different divisions that are equally good the darkest. A histogram of one gray level has no
 * division: *value is that level. Rows that arrive one by one are divided by the value of the previous frame.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: no counts, or more than 2^30 in sum. O(256). */
iris_status iris_otsu_value(uint8_t *value, const uint32_t histogram[256]);

#define IRIS_THRESHOLD_RADIUS_MAX 1023

/* Working memory of iris_threshold_adaptive: one row of column sums. */
#define IRIS_THRESHOLD_SCRATCH_BYTES(w, radius)                                                              \
    IRIS_SCRATCH_ROUND(sizeof(uint32_t) * ((size_t)(w) + 2u * (size_t)(radius)))

/* Adaptive: bright is p > mean - c, where mean is the exact mean of the (2 radius + 1)^2 pixels around p; beyond the
 * edge the nearest pixel counts (replicated border).
 *
 * radius is 0 to IRIS_THRESHOLD_RADIUS_MAX pixels, c is -255 to 255 gray levels. A dark line is found with
 * IRIS_SELECT_DARK and c > 0, a bright one with IRIS_SELECT_BRIGHT and c < 0; |c| is the least difference from the
 * mean, and a line wider than radius gets hollow.
 *
 * IRIS_ERR_RANGE: radius or c outside; IRIS_ERR_SCRATCH. O((w + radius) * (h + radius)). */
iris_status iris_threshold_adaptive(const iris_image *mask, const iris_image *gray, int32_t radius, int32_t c,
                                    iris_select select, iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
