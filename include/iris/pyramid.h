/* IRIS - Gaussian pyramid: a picture at half its size, at half of that, and so on, in the caller's memory.
 *
 * Each level is the one before smoothed by the weights 1 4 6 4 1 (of 16) in both directions, of which every second
 * pixel of every second row is kept: pixel (x, y) of a level lies on pixel (2x, 2y) of the one before. Of n pixels (n
 * + 1) / 2 are left, rounded down. Values are the whole sum, rounded half up once; with IRIS_BORDER_REFLECT101 they
 * are what other libraries call pyrDown. IRIS_GRAY8, IRIS_RGB888, and IRIS_BGR888.
 *
 *     static uint8_t memory[IRIS_PYRAMID_BYTES(320, 240, 1, 4)];
 *     iris_pyramid_wrap(&pyramid, &camera, 4, memory, sizeof memory);      once
 *     iris_pyramid_build(&pyramid, border, &scratch);                      for every frame in camera's memory
 *
 * P. J. Burt and E. H. Adelson 1983.
 */
#ifndef IRIS_PYRAMID_H
#define IRIS_PYRAMID_H

#include "iris/border.h"
#include "iris/image.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_PYRAMID_LEVELS_MAX 16

typedef struct {
    iris_image level[IRIS_PYRAMID_LEVELS_MAX]; /* level[0] is the picture itself */
    int32_t levels;
} iris_pyramid;

/* A side of a level, of n pixels in level 0. Constant expression in size_t. */
#define IRIS_PYRAMID_SIDE(n, level) (((size_t)(n) + ((size_t)1 << (level)) - 1u) >> (level))

/* Bytes of the levels 1 to levels - 1 of w x h pixels of `channels` bytes (1 or 3). Constant expression in size_t. */
#define IRIS_PYRAMID_BYTES(w, h, channels, levels)                                                           \
    (IRIS_PYRAMID_LEVEL_(w, h, channels, levels, 1) + IRIS_PYRAMID_LEVEL_(w, h, channels, levels, 2) +       \
     IRIS_PYRAMID_LEVEL_(w, h, channels, levels, 3) + IRIS_PYRAMID_LEVEL_(w, h, channels, levels, 4) +       \
     IRIS_PYRAMID_LEVEL_(w, h, channels, levels, 5) + IRIS_PYRAMID_LEVEL_(w, h, channels, levels, 6) +       \
     IRIS_PYRAMID_LEVEL_(w, h, channels, levels, 7) + IRIS_PYRAMID_LEVEL_(w, h, channels, levels, 8) +       \
     IRIS_PYRAMID_LEVEL_(w, h, channels, levels, 9) + IRIS_PYRAMID_LEVEL_(w, h, channels, levels, 10) +      \
     IRIS_PYRAMID_LEVEL_(w, h, channels, levels, 11) + IRIS_PYRAMID_LEVEL_(w, h, channels, levels, 12) +     \
     IRIS_PYRAMID_LEVEL_(w, h, channels, levels, 13) + IRIS_PYRAMID_LEVEL_(w, h, channels, levels, 14) +     \
     IRIS_PYRAMID_LEVEL_(w, h, channels, levels, 15))
#define IRIS_PYRAMID_LEVEL_(w, h, channels, levels, level)                                                   \
    ((level) < (levels) ? IRIS_PYRAMID_SIDE(w, level) * IRIS_PYRAMID_SIDE(h, level) * (size_t)(channels) : 0u)

/* Working memory of iris_pyramid_down and iris_pyramid_build, and of iris_pyramid_up, for a source that is w pixels
 * wide: the rows around a row, and a row of sums. */
#define IRIS_PYRAMID_SCRATCH_BYTES(w, channels)                                                              \
    (IRIS_BORDER_ROWS_BYTES((size_t)(w) * (size_t)(channels), 2 * (channels), 2 * (channels), 2) +           \
     IRIS_SCRATCH_ROUND(sizeof(uint16_t) * ((size_t)(w) + 4u) * (size_t)(channels)))
#define IRIS_PYRAMID_UP_SCRATCH_BYTES(w, channels)                                                           \
    (IRIS_BORDER_ROWS_BYTES((size_t)(w) * (size_t)(channels), channels, channels, 1) +                       \
     IRIS_SCRATCH_ROUND(sizeof(uint16_t) * ((size_t)(w) + 2u) * (size_t)(channels)))

/* Makes the views: level 0 is *src, the others lie one after the other in `memory`, rows without padding. levels is 1
 * to IRIS_PYRAMID_LEVELS_MAX; a level of one pixel has one pixel below it. memory may be null for one level.
 * IRIS_ERR_ARG: null pointer, or the errors of iris_image_check; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: levels, or less
 * than IRIS_PYRAMID_BYTES; IRIS_ERR_ALIAS: memory overlaps src. O(levels). */
iris_status iris_pyramid_wrap(iris_pyramid *pyramid, const iris_image *src, int32_t levels, void *memory,
                              size_t bytes);

/* Makes each level from the one before. Any rule but IRIS_BORDER_SKIP, which would leave pixels without a value.
 * IRIS_ERR_ARG: null pointer, or the rule; IRIS_ERR_SCRATCH; and the errors of iris_pyramid_down for levels that did
 * not come from iris_pyramid_wrap. O(w h). */
iris_status iris_pyramid_build(const iris_pyramid *pyramid, iris_border border, iris_scratch *scratch);

/* One step down: dst has the sides (w + 1) / 2 and (h + 1) / 2, rounded down, and is disjoint from src. By
 * IRIS_BORDER_SKIP, pixels whose 5 x 5 pixels of src leave the picture are kept.
 * IRIS_ERR_ARG: null pointer, unknown rule, or the errors of iris_image_check; IRIS_ERR_FORMAT: another format, or
 * different ones; IRIS_ERR_RANGE: sizes; IRIS_ERR_ALIAS; IRIS_ERR_SCRATCH. O(w h). */
iris_status iris_pyramid_down(const iris_image *dst, const iris_image *src, iris_border border,
                              iris_scratch *scratch);

/* One step up, by the same weights: between the pixels of src lie new ones. A side of dst is 2 n or 2 n - 1 for n of
 * src. The weights are 1 6 1 (of 8) on a pixel of src and 4 4 between two; the sum is rounded half up once. By
 * IRIS_BORDER_SKIP, the four pixels that belong to a pixel of src whose 3 x 3 leave the picture are kept. Errors and
 * aliasing as above. O(w h). */
iris_status iris_pyramid_up(const iris_image *dst, const iris_image *src, iris_border border,
                            iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
