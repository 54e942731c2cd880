/* IRIS - Bayer: the bare pixels of a color sensor to colors.
 *
 * Each pixel of IRIS_BAYER8_... saw one color; the other two are the means of the nearest pixels that saw them
 * (bilinear demosaic), rounded half up: two or four for each. At the edge the picture is mirrored at its outermost
 * pixel, which keeps the pattern's step; where a side is one pixel long its pixel stands for both neighbors. A region
 * at any offset has the right colors, since iris_image_crop gives it its own order. Report, section 3.2.2
 * (ColorSpaceConvertor).
 */
#ifndef IRIS_BAYER_H
#define IRIS_BAYER_H

#include "iris/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* dst: IRIS_RGB888, IRIS_BGR888, or IRIS_GRAY8, which is the luma of these colors as in color.h. src: one of the four
 * orders. Of the same size, and disjoint.
 * IRIS_ERR_ARG: null pointer or invalid view; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: sizes differ; IRIS_ERR_ALIAS. O(w h).
 * */
iris_status iris_bayer_convert(const iris_image *dst, const iris_image *src);

/* The same for one row of n pixels, for sensors whose rows come one by one: the row above it, the row itself, and the
 * row below; at the top and bottom, give the one that exists twice. order: of the row itself and the one below. The
 * three may be the same; dst is disjoint from them. IRIS_ERR_ARG: null pointer; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: n
 * outside 1..IRIS_SIDE_MAX; IRIS_ERR_ALIAS. O(n). */
iris_status iris_bayer_row(uint8_t *dst, iris_format dst_format, const uint8_t *const rows[3],
                           iris_format order, int32_t n);

#ifdef __cplusplus
}
#endif

#endif
