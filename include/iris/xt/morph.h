/* IRIS-XT - morphology: pictures grown and shrunk by the neighbors of a pixel, and patterns found in masks.
 *
 * An element is a set of neighbors. Dilation takes the largest of the pixels that the element covers, erosion the
 * smallest; on a mask these are "any" and "all". Everything else is made of the two. Report, section 2.2; the reduction
 * of large elements to repeated maxima of shifted rows is known as logarithmic decomposition.
 *
 * IRIS_GRAY8, IRIS_RGB888 and IRIS_BGR888 (each channel by itself), and IRIS_MASK1 (a word of 32 pixels at a time; bits
 * past w are kept). dst and src have the same format and size; dst may be src, else they are disjoint.
 *
 * Every function returns IRIS_ERR_ARG for a null pointer (element may be null: 3x3 square) and for an unknown shape or
 * border rule, the errors of iris_image_check for a view that is not valid, IRIS_ERR_FORMAT for other or different
 * formats, IRIS_ERR_RANGE when sizes differ or a side of the element is out of range, IRIS_ERR_ALIAS for a partial
 * overlap, and IRIS_ERR_SCRATCH.
 */
#ifndef IRIS_XT_MORPH_H
#define IRIS_XT_MORPH_H

#include "iris/border.h"
#include "iris/image.h"
#include "iris/scratch.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_MORPH_SIDE_MAX 1023

typedef enum {
    IRIS_MORPH_SQUARE = 0, /* all w * h pixels */
    IRIS_MORPH_CROSS       /* the anchor's row of w pixels and its column of h pixels */
} iris_morph_shape;

/* Pixel ((w - 1) / 2, (h - 1) / 2) of the element is its anchor: the middle, of an even side the left or upper one of two.
 * Erosion looks at the pixels that the element covers when its anchor lies on the pixel; dilation at those of the
 * element turned by 180 degrees, so that of an even side it looks one farther to the left or up. So the two are each
 * other's negative under a turn, and the one after the other moves nothing. */
typedef struct {
    int32_t w, h; /* pixels, 1 to IRIS_MORPH_SIDE_MAX; need not fit into the picture */
    iris_morph_shape shape;
    int exclude_center; /* 1: the anchor is not in the element (the report's eight neighbors). Not of one pixel alone */
} iris_morph_element;

/* 3x3, square, with its center. */
void iris_morph_element_defaults(iris_morph_element *element);

/* Rows of a decomposed column of h pixels. */
#define IRIS_MORPH_COLUMN_ROWS(h)                                                                            \
    ((size_t)(h) +                                                                                           \
     ((h) < 7 ? 0u : (size_t)(h) / 2u - 1u + ((h) >= 19) + ((h) >= 55) + ((h) >= 163) + ((h) >= 487)))

/* Bytes of n pixels of a row. */
#define IRIS_MORPH_ROW_BYTES(format, n)                                                                      \
    ((format) == IRIS_MASK1 ? ((size_t)(n) + 31u) / 32u * 4u                                                 \
                            : (size_t)(n) * ((format) == IRIS_GRAY8 ? 1u : 3u))

/* Working memory of iris_morph_dilate and iris_morph_erode, of a picture w pixels wide and an element of
 * element_w * element_h. The functions of two steps (all others) take twice as much. */
#define IRIS_MORPH_SCRATCH_BYTES(format, w, element_w, element_h)                                            \
    (IRIS_BORDER_ROWS_BYTES(IRIS_MORPH_ROW_BYTES(format, (w) + (element_w) / 2),                             \
                            (format) == IRIS_MASK1 ? ((element_w) / 2u + 7u) / 8u                            \
                                                   : IRIS_MORPH_ROW_BYTES(format, (element_w) / 2),          \
                            0, (element_h) / 2) +                                                            \
     IRIS_SCRATCH_ROUND(IRIS_MORPH_ROW_BYTES(format, w)) * IRIS_MORPH_COLUMN_ROWS(element_h) +               \
     IRIS_SCRATCH_ROUND(IRIS_MORPH_ROW_BYTES(format, (w) + (element_w)-1) +                                  \
                        ((format) == IRIS_MASK1 ? 4u : 0u)))

/* Largest and smallest pixel of the element. Beyond the edge the border rule's pixels count; with IRIS_BORDER_REPLICATE
 * that is the same as if nothing were there (but for exclude_center: a pixel at the edge is its own neighbor then). By
 * IRIS_BORDER_SKIP pixels whose element leaves the picture are not written. A border value that is not 0 is 1 in a mask.
 * O(pixels * log(element_w * element_h)), in one pass. */
iris_status iris_morph_dilate(const iris_image *dst, const iris_image *src, const iris_morph_element *element,
                              iris_border border, iris_scratch *scratch);
iris_status iris_morph_erode(const iris_image *dst, const iris_image *src, const iris_morph_element *element,
                             iris_border border, iris_scratch *scratch);

/* Erosion, then dilation: removes what is bright (set) and smaller than the element. Close is dilation, then erosion:
 * fills what is dark (clear) and smaller.
 * Opened pixels are never brighter, closed ones never darker than before, and a second time changes nothing: this holds
 * up to the edge with IRIS_BORDER_REPLICATE, without exclude_center. The border rule counts in both steps: what the
 * first makes is continued by it for the second. By IRIS_BORDER_SKIP a pixel is written when everything that both steps
 * look at lies in the picture: all but element_w - 1 columns and element_h - 1 rows at each side.
 * Twice the working memory. Two steps' cost, in one pass. */
iris_status iris_morph_open(const iris_image *dst, const iris_image *src, const iris_morph_element *element,
                            iris_border border, iris_scratch *scratch);
iris_status iris_morph_close(const iris_image *dst, const iris_image *src, const iris_morph_element *element,
                             iris_border border, iris_scratch *scratch);

/* Dilation minus erosion, 0 where that is negative (exclude_center): how much the pixels of the element differ; of a
 * mask its outline, both sides. By IRIS_BORDER_SKIP element_w / 2 columns and element_h / 2 rows at each side are not
 * written. Twice the working memory. */
iris_status iris_morph_gradient(const iris_image *dst, const iris_image *src,
                                const iris_morph_element *element, iris_border border, iris_scratch *scratch);

/* What opening removed (src - open) and what closing filled (close - src), 0 where that is negative: small bright, and
 * small dark things under uneven light. Border and working memory as of the two. */
iris_status iris_morph_tophat(const iris_image *dst, const iris_image *src, const iris_morph_element *element,
                              iris_border border, iris_scratch *scratch);
iris_status iris_morph_blackhat(const iris_image *dst, const iris_image *src,
                                const iris_morph_element *element, iris_border border, iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
