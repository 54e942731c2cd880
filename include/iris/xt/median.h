/* IRIS-XT - median: each pixel becomes the middle one of its surroundings.
 *
 * Takes away single wrong pixels and thin lines, and keeps edges where they are. Report, section 2.2.
 */
#ifndef IRIS_XT_MEDIAN_H
#define IRIS_XT_MEDIAN_H

#include "iris/border.h"
#include "iris/image.h"
#include "iris/scratch.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Working memory of iris_median: the rows around a row, and for side 5 as many sorted ones. w pixels of 1 or 3
 * channels. */
#define IRIS_MEDIAN_SCRATCH_BYTES(w, channels, side)                                                         \
    (IRIS_BORDER_ROWS_BYTES((size_t)(w) * (channels), (size_t)(side) / 2u * (channels),                      \
                            (size_t)(side) / 2u * (channels), (side) / 2) +                                  \
     ((side) == 5 ? 5u * IRIS_SCRATCH_ROUND((size_t)(channels) * ((size_t)(w) + 4u)) : (size_t)0))

/* dst = the median of side x side pixels of src, side 3 or 5, exact: as many pixels are not above it as are not below
 * it. IRIS_GRAY8, or each channel of IRIS_RGB888 and IRIS_BGR888. dst may be src. Border: side / 2 pixels around.
 * IRIS_ERR_ARG: null pointer, invalid view, or unknown border rule; IRIS_ERR_FORMAT: other or different formats;
 * IRIS_ERR_RANGE: sizes differ, or another side; IRIS_ERR_ALIAS: dst and src overlap without being the same view;
 * IRIS_ERR_SCRATCH. O(pixels * channels): a sorting network of 28 or 69 comparisons, whatever the pixels are. */
iris_status iris_median(const iris_image *dst, const iris_image *src, int32_t side, iris_border border,
                        iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
