/* IRIS-XT - color signatures: which pixels have the color of something, for up to eight things at once.
 *
 * A table of 4 KB has a byte for each of 3969 cells of the color space, and bit k of it says that colors of this cell
 * belong to signature k. A pixel then costs a look-up, whatever its signature looks like: a range of hue, saturation,
 * and lightness, or anything that was learned from a picture. The cells are of YUV (BT.601, limited range, as in
 * color.h), so that pixels of YUYV are looked up as they are, and those of RGB after nine multiplications: 21 steps
 * each of U and V, narrow near gray, where the colors of real scenes are, and 9 of Y.
 *
 * A cell is all or nothing: compared with the exact test of color.h (iris_hsl_range_has) pixels at the range's border
 * may be on the wrong side. Report, section 2.6.
 */
#ifndef IRIS_XT_SIGNATURE_H
#define IRIS_XT_SIGNATURE_H

#include "iris/color.h"
#include "iris/image.h"
#include "iris/scratch.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_SIGNATURES      8
#define IRIS_SIGNATURE_CELLS 3969

/* Bit k of cells[i]: the colors of cell i belong to signature k. All zero: no signatures. */
typedef struct {
    uint8_t cells[IRIS_SIGNATURE_CELLS];
} iris_signatures;

/* What a taught signature is. Chroma is the distance of U and V from gray, 0 to 158: of dark and of very bright
 * pixels the saturation says little, so a color is in the range and has its chroma, too. A gray, black, or white object
 * has every hue and saturation, chroma0 = 0, and is told by its lightness alone. */
typedef struct {
    iris_hsl_range range;
    int32_t chroma0, chroma1;
    iris_color color; /* mean of the object's pixels */
    /* of the object's pixels, that have the signature; low: it looks like its surroundings */
    int32_t share_permil;
    int32_t elsewhere_permil; /* of the pixels around, that have it all the same */
} iris_signature_lesson;

/* Signature `which` (0 to 7) has no colors any more. IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: which. O(cells). */
iris_status iris_signature_clear(iris_signatures *signatures, int32_t which);

/* Signature `which` becomes this range: the cells of which at least half is in it, as far as eight points of each tell.
 * IRIS_ERR_ARG: null pointer, or a bound outside its range; IRIS_ERR_RANGE: which. O(cells): nine million
 * instructions on a Cortex-M4. */
iris_status iris_signature_from_range(iris_signatures *signatures, int32_t which,
                                      const iris_hsl_range *range);

/* Signature `which` becomes the color of the object within `rect` of image, which is of any format that
 * iris_color_takes. The rectangle may be a few pixels off: what is learned lies in the ellipse that fits in it.
 *   1. Each cell's evidence is the share of the object's pixels in it, less the share of those in a ring around the
 *      rectangle, less that of all of the picture beyond it.
 *   2. The range is that of the object's pixels with evidence for it: percentiles (5 and 95, hue counted by chroma, and
 *      around its circle), widened so that the object may stand in other light: hue by 10 degrees, saturation and
 *      chroma down to half, lightness to 0.4 and 1.8 times. Where U and V are nearer to gray than 6 on average
 *      the object is gray, and has its lightness, within 8 percent, and its chroma alone.
 *   3. The signature has the cells in the range without evidence against them, and cells outside with a fiftieth of
 *      the object each. When less than a fifth of the object stands out from what is around it, evidence is not asked.
 * lesson may be null.
 * IRIS_ERR_ARG: null pointer or invalid image; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: which, or rect is empty or not wholly
 * inside; IRIS_ERR_SCRATCH: IRIS_SIGNATURE_SCRATCH_BYTES. O(w h + cells): seven million instructions on a
 * Cortex-M4 for 160x120. */
#define IRIS_SIGNATURE_SCRATCH_BYTES                                                                         \
    (IRIS_SCRATCH_ROUND(2 * IRIS_SIGNATURE_CELLS) + IRIS_SCRATCH_ROUND(4 * 542) +                            \
     IRIS_SCRATCH_ROUND(IRIS_SIGNATURE_CELLS / 8 + 1))
iris_status iris_signature_teach(iris_signature_lesson *lesson, iris_signatures *signatures, int32_t which,
                                 const iris_image *image, iris_rect rect, iris_scratch *scratch);

/* All signatures in one pass: a byte for each pixel, bit k set when it has the color of signature k. dst is
 * IRIS_GRAY8, src of any format that iris_color_takes, and they are disjoint, or the same when src is IRIS_GRAY8, too.
 * IRIS_ERR_ARG: null pointer or invalid view; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: sizes differ; IRIS_ERR_ALIAS.
 * O(w h): per pixel 43 instructions on a Cortex-M4 for RGB888, 23 for YUYV. */
iris_status iris_signature_classify(const iris_image *dst, const iris_image *src,
                                    const iris_signatures *signatures);

/* The mask (IRIS_MASK1) of pixels that have at least one of the signatures whose bits are in `selected`, 0 to 255. Bits
 * past w are kept. Errors as above, and IRIS_ERR_RANGE: selected. O(w h). */
iris_status iris_signature_mask(const iris_image *mask, const iris_image *src,
                                const iris_signatures *signatures, uint32_t selected);

/* One row of n pixels, as it comes from the sensor: the bytes of iris_signature_classify.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: n outside 1..IRIS_SIDE_MAX, or odd for YUYV and UYVY;
 * IRIS_ERR_ALIGN; IRIS_ERR_ALIAS: the rows overlap. O(n). */
iris_status iris_signature_row(uint8_t *dst, const void *src, iris_format src_format, int32_t n,
                               const iris_signatures *signatures);

#ifdef __cplusplus
}
#endif

#endif
