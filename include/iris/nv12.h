/* IRIS - NV12: what most camera stacks deliver, as two views of one frame.
 *
 * luma is IRIS_GRAY8 of w x h pixels and serves as a gray picture as it is. chroma is IRIS_UV88 with one pixel for
 * each square of two by two, (w + 1) / 2 x (h + 1) / 2 of them, rounded down: at an odd side the last ones stand for
 * less. The numbers mean what color.h says of YUV. All pixels of a square have its color, nothing is interpolated:
 * the same colors as those of IRIS_YUYV. Report, section 3.2.2 (ColorSpaceConvertor).
 *
 *     iris_image_wrap(&luma, frame, bytes, (iris_size){w, h}, stride, IRIS_GRAY8);
 *     iris_image_wrap(&chroma, frame + stride * h, bytes - stride * h, (iris_size){w / 2, h / 2}, stride, IRIS_UV88);
 *     iris_nv12_convert(&rgb, &luma, &chroma);
 */
#ifndef IRIS_NV12_H
#define IRIS_NV12_H

#include "iris/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* dst = the frame's colors, in the size of luma: IRIS_RGB888, IRIS_BGR888, or IRIS_GRAY8, which is luma as it came.
 * dst and both views are disjoint, but an IRIS_GRAY8 dst may be luma (nothing to do). IRIS_ERR_ARG: null pointer or
 * invalid view; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: sizes that do not belong together; IRIS_ERR_ALIAS: dst overlaps luma
 * or chroma. O(w h). */
iris_status iris_nv12_convert(const iris_image *dst, const iris_image *luma, const iris_image *chroma);

/* The same for one row of n pixels: row y of luma, and row y / 2, rounded down, of chroma.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: n outside 1..IRIS_SIDE_MAX; IRIS_ERR_ALIAS. O(n). */
iris_status iris_nv12_row(uint8_t *dst, iris_format dst_format, const uint8_t *luma, const uint8_t *chroma,
                          int32_t n);

/* The part `rect` of a frame, as two views again. rect.x and rect.y are even, its sides any. The results may be the
 * sources.
 * IRIS_ERR_ARG: null pointer or invalid view; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: sizes that do not belong together, or
 * rect empty or not wholly inside; IRIS_ERR_ALIGN: x or y is odd. O(1). */
iris_status iris_nv12_crop(iris_image *luma_view, iris_image *chroma_view, const iris_image *luma,
                           const iris_image *chroma, iris_rect rect);

#ifdef __cplusplus
}
#endif

#endif
