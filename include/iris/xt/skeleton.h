/* IRIS-XT - skeletons: shapes thinned to lines of one pixel.
 *
 * From IRIS_MASK1 to IRIS_MASK1 of the same size. What lies outside the picture counts as not selected. Bits of the
 * mask past w are kept. dst may be src; any other overlap is refused. The eight pixels around a pixel are its neighbors;
 * selected pixels belong together when they touch by a side or a corner, pixels that are not selected when they
 * touch by a side.
 *
 * All return IRIS_ERR_ARG for a null pointer, the errors of iris_image_check for a view that is not valid,
 * IRIS_ERR_FORMAT for other formats, IRIS_ERR_RANGE when the sizes differ, IRIS_ERR_ALIAS, and IRIS_ERR_SCRATCH, besides
 * what their comments say. Report, section 2.2.
 */
#ifndef IRIS_XT_SKELETON_H
#define IRIS_XT_SKELETON_H

#include "iris/image.h"
#include "iris/scratch.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    /* One pixel wide, and connected exactly as the shape: dst has as many connected parts and as many holes as src. One
     * pixel wide means that every pixel that is left is needed: to take it away would tear or join something, or it
     * is an end, which has one neighbor, or it is alone. Every pass peels the shape by one pixel from the top, the
     * bottom, the right, and the left, in this order, each at once: pixels without a selected neighbor on that side, not
     * needed as above. Two of three passes spare what they lay bare themselves, so that slanting sides are
     * peeled as fast as upright ones and the skeleton keeps to the middle. Rosenfeld (1975) proves that a side may be
     * peeled at once. */
    IRIS_SKELETON_EXACT = 0,
    /* Zhang and Suen (1984), as published: stairs stay two pixels wide, a square of 2 by 2 vanishes, and a slanting line
     * of two pixels shrinks to almost nothing. A pass is two sub-iterations. */
    IRIS_SKELETON_ZHANG_SUEN
} iris_skeleton_method;

/* Working memory of iris_skeleton and iris_skeleton_prune: the mask twice with a margin, and one byte for 64 pixels. */
#define IRIS_SKELETON_SCRATCH_BYTES(w, h)                                                                    \
    IRIS_SCRATCH_ROUND(17u * (((size_t)(w) / 64u + 1u) * ((size_t)(h) + 2u) + 2u) +                          \
                       12u * ((size_t)(w) / 64u + 3u) + 7u)

/* Thins src into dst. *passes: how many were made, the last of which removed nothing; null when not wanted.
 * IRIS_ERR_ARG: unknown method. O(pixels); then every pass looks at one byte for 64 pixels, and at the 64 pixels that
 * lie around each one that the last pass has changed. The passes are about half as many as the thickest part has pixels across. */
iris_status iris_skeleton(int32_t *passes, const iris_image *dst, const iris_image *src,
                          iris_skeleton_method method, iris_scratch *scratch);

/* Thins src into dst by IRIS_SKELETON_EXACT and takes the short branches away. A branch is a row of pixels from an end up
 * to, but without, the branch point that it comes from (iris_skeleton_branches); those of fewer than `length` pixels go,
 * all at once. What they leave is thinned again, and short branches that this has made go too, until there are none. A
 * line without a branch point is no branch and stays as it is, however short. dst has as many connected parts and as many
 * holes as src.
 *
 * IRIS_ERR_RANGE: length below 0. O(iris_skeleton), and O(ends * length) for each round. */
iris_status iris_skeleton_prune(const iris_image *dst, const iris_image *src, int32_t length,
                                iris_scratch *scratch);

/* Working memory of iris_skeleton_ends and iris_skeleton_branches: three rows. */
#define IRIS_SKELETON_POINTS_SCRATCH_BYTES(w) IRIS_SCRATCH_ROUND(8u * (3u * ((size_t)(w) / 64u + 1u) + 2u))

/* The ends of lines: selected pixels with one selected neighbor, or with two that touch each other by a side (stairs end
 * like that). O(pixels). */
iris_status iris_skeleton_ends(const iris_image *dst, const iris_image *src, iris_scratch *scratch);

/* Where three or more lines meet: selected pixels whose selected neighbors are at least three groups (once around the
 * pixel, side by side), and the four of a square of 2 by 2 selected pixels, in which four slanting lines meet. Meant
 * for skeletons that are one pixel wide: everything is a branch point inside thicker shapes. O(pixels). */
iris_status iris_skeleton_branches(const iris_image *dst, const iris_image *src, iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
