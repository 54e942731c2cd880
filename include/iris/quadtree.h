/* IRIS - quadtree: a picture as blocks, large where it is even and small where it is not.
 *
 * A block whose pixels differ too much (maximum - minimum > tolerance, in any channel) is divided into four, and each
 * of these again, until every block is even enough or cannot be divided. Each of the two sides is halved by itself: a
 * side of n pixels becomes n - n / 2 and n / 2 (left and right, top and bottom; the first is the larger one), if
 * the smaller is at least the least side; else it stays whole, and the block is divided into two along the other side.
 * So every picture can be divided, of any size, and no side of a block is below the least side, unless the picture's
 * is.
 *
 * The blocks that remain are the leaves. They cover the picture, each pixel once, and come depth first: top left, top
 * right, bottom left, bottom right, all of one quarter before the next. Hence of two leaves that share a column the
 * upper one comes first, and of two that share a row the left one. Report, sections 2.6.1 and 3.2.2
 * (QuadtreeSegmenter, Tree).
 */
#ifndef IRIS_QUADTREE_H
#define IRIS_QUADTREE_H

#include <stdint.h>

#include "iris/color.h"
#include "iris/image.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* 12 bytes. */
typedef struct {
    uint16_t x, y, w, h; /* pixels */
    iris_color mean;     /* of the pixels, rounded; of a gray picture r = g = b */
    uint8_t range;       /* maximum - minimum, of the channel where it is largest */
} iris_quadtree_leaf;

typedef struct {
    int32_t tolerance;  /* gray levels, 0..255; default 51, a fifth of the range */
    int32_t least_side; /* pixels, 1..IRIS_SIDE_MAX; default 1 */
} iris_quadtree_config;

/* Before the first call: leaves and capacity. */
typedef struct {
    iris_quadtree_leaf *leaves; /* the caller's */
    int32_t capacity;           /* how many leaves there is room for, 1 or more */

    int32_t count;      /* leaves of the tree */
    int32_t wanted;     /* leaves of the tree as it was asked for: the same, but for IRIS_ERR_FULL */
    int32_t tolerance;  /* that the tree was made with */
    int32_t least_side; /* the same; larger than asked for after IRIS_ERR_FULL */
    iris_size size;     /* of the picture */
    iris_format format; /* of the picture */
} iris_quadtree;

/* Sensible values, as given above. Null is ignored. */
void iris_quadtree_defaults(iris_quadtree_config *config);

/* The tree of a picture, IRIS_GRAY8, IRIS_RGB888, or IRIS_BGR888. config may be null for the defaults. With a least
 * side of 1 every pixel is within the tolerance of its leaf's mean; with a larger one, in every leaf whose range is.
 *
 * IRIS_ERR_FULL: the leaves that were asked for are more than capacity (wanted says how many). The tree is a coarser
 * one, and complete: the one of the least side doubled as often as it takes.
 * IRIS_ERR_ARG: null pointer, a capacity below 1, or a config value out of range; errors of iris_image_check;
 * IRIS_ERR_FORMAT.
 * O(pixels * log(longest side)) at worst. A block that is not even is left at the first row that shows it, so most
 * pixels of most pictures are looked at once or twice. Again, up to 15 times, for IRIS_ERR_FULL. */
iris_status iris_quadtree_segment(iris_quadtree *tree, const iris_image *image,
                                  const iris_quadtree_config *config);

/* Is this a tree that functions may work on: are its leaves inside of the picture, and their areas that of the
 * picture in sum? For trees that do not come from iris_quadtree_segment as they are.
 * IRIS_ERR_ARG: null pointer, or a count below 1; IRIS_ERR_FORMAT: none that iris_quadtree_segment takes;
 * IRIS_ERR_RANGE: a side of the picture outside 1..IRIS_SIDE_MAX, or leaves that do not fit. O(leaves). */
iris_status iris_quadtree_check(const iris_quadtree *tree);

/* The block mean picture: each leaf filled with its mean. dst has the size of the tree's picture; IRIS_GRAY8 for a gray
 * tree, IRIS_RGB888 or IRIS_BGR888 for any. It may be the picture that the tree is of.
 * Errors of iris_image_check and iris_quadtree_check; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: another size. O(pixels). */
iris_status iris_quadtree_means(const iris_image *dst, const iris_quadtree *tree);

#ifdef __cplusplus
}
#endif

#endif
