/* IRIS-XT - line masks: which pixels are line, and which are floor?
 *
 * From IRIS_GRAY8 to IRIS_MASK1 of the same size, for everything that looks at the shape of lines on a floor: junctions
 * (junction.h), several lines (paths.h), skeletons. The light may be uneven, lines may lie in any direction and cross
 * the whole picture, and how dark they are need not be known.
 *
 * How: the floor is the mean of each block of pixels (a fifteenth of the shorter side), with dark valleys narrower than
 * seven blocks filled (closing; at the sides of the picture narrower than two, so that the light may fall off), and
 * drawn straight between the blocks. Pixels that differ from the floor by the least contrast tell how dark the line
 * is, and half of that is the threshold. Pixels are smoothed over 3x3. Report, section 2.4 ("tolerance").
 */
#ifndef IRIS_XT_LINE_MASK_H
#define IRIS_XT_LINE_MASK_H

#include "iris/image.h"
#include "iris/scratch.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Contrast: of a dark line (floor - line) / floor; of a bright one (line - floor) / line, or (line - floor) / (white -
 * floor) where that is more.  In gray levels it is 16 or more, however dark the picture, and more where
 * neighboring pixels differ by noise. */
typedef struct {
    int32_t bright;          /* 1: lines brighter than the floor; default 0: darker */
    int32_t contrast_permil; /* 100..900: of a line, at least; default 300 */
} iris_line_mask_config;

/* Pixels along a side of a block, and blocks along a side of a picture. */
#define IRIS_LINE_MASK_BLOCK(w, h)                                                                           \
    (((w) < (h) ? (size_t)(w) : (size_t)(h)) < 60 ? (size_t)4 : ((w) < (h) ? (size_t)(w) : (size_t)(h)) / 15)
#define IRIS_LINE_MASK_BLOCKS(side, block) (((size_t)(side) + (block)-1) / (block))

/* Blocks beyond each side from where a dark valley may be filled. */
#define IRIS_LINE_MASK_BEYOND 2

/* Working memory: 2.2 KB for 160x120. */
#define IRIS_LINE_MASK_PLANE(across, down)                                                                   \
    (((across) + 2 * IRIS_LINE_MASK_BEYOND) * ((down) + 2 * IRIS_LINE_MASK_BEYOND))
#define IRIS_LINE_MASK_SCRATCH_BYTES(w, h)                                                                   \
    IRIS_SCRATCH_ROUND((2 * IRIS_LINE_MASK_PLANE(IRIS_LINE_MASK_BLOCKS(w, IRIS_LINE_MASK_BLOCK(w, h)),       \
                                                 IRIS_LINE_MASK_BLOCKS(h, IRIS_LINE_MASK_BLOCK(w, h))) +     \
                        IRIS_LINE_MASK_BLOCKS(w, IRIS_LINE_MASK_BLOCK(w, h)) + (size_t)(w) + 2) *            \
                       2)

/* Sensible values, as given above. Null is ignored. */
void iris_line_mask_defaults(iris_line_mask_config *config);

/* The line's pixels. *found is 1 when there are any: when at least one pixel in 500 stands out; else the mask is empty.
 * Null when not wanted. config may be null for the defaults. Bits of the mask past w are kept.
 *
 * IRIS_ERR_ARG: null pointer, or a config value out of range; errors of iris_image_check; IRIS_ERR_FORMAT;
 * IRIS_ERR_RANGE: the sizes differ; IRIS_ERR_ALIAS: mask and gray overlap; IRIS_ERR_SCRATCH. O(pixels). */
iris_status iris_line_mask(int32_t *found, const iris_image *mask, const iris_image *gray,
                           const iris_line_mask_config *config, iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
