/* IRIS - stereo: how far things are, from two cameras side by side. Report, sections 2.8 and 3.4.4.
 *
 * The pictures are rectified: what is at (x, y) in the left one is at (x - d, y) in the right one, and the disparity d
 * >= 0 is the larger, the nearer it is: z = b f / d. Every method takes the same two views and writes the same picture
 * of disparities, those of the left picture: IRIS_GRAY_U16, 256 to a pixel, 0 where no match was found. A match without
 * any disparity, at infinity, is 1.
 *
 * Rows and columns of the pictures are taken to go on beyond their edges as they are there. A place whose match would
 * be left of the right picture's edge has only the disparities that are inside: so there is an answer up to the left
 * edge, and what is nearer there is not seen.
 */
#ifndef IRIS_3D_STEREO_H
#define IRIS_3D_STEREO_H

#include "iris/image.h"
#include "iris/pyramid.h"
#include "iris/scratch.h"
#include "iris/status.h"
#include "iris/wide.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The largest max_disparity. */
#define IRIS_STEREO_DISPARITY_MAX 255

/* What tells two places from each other, pixel by pixel. */
typedef enum {
    /* Which of the 24 pixels around are darker, in how many of these the two differ: a camera that is brighter than
     * the other one does not matter. */
    IRIS_STEREO_CENSUS = 0,
    IRIS_STEREO_SAD, /* gray levels between the two, 32 at most: the report's correlation */
    IRIS_STEREO_BOTH /* the sum of the two */
} iris_stereo_cost;

/* What all methods have in common. */
typedef struct {
    int32_t max_disparity; /* pixels, 1..IRIS_STEREO_DISPARITY_MAX; default 63 */
    iris_stereo_cost cost;
    /* The match of the right picture's place may be so many pixels elsewhere, 0..255 (255: not checked); else there
     * is none: what one camera alone sees has no match. Default 1. */
    int32_t check_px;
    /* The second best match (not beside the best one) must be worse by so many percent, or there is none. 0..99,
     * default 0. */
    int32_t uniqueness_percent;
    /* Not 0: a place without a match takes the smaller disparity of the matches left and right of it in its row, that
     * is the one farther away, for what one camera alone sees lies behind something. Default 1. */
    int32_t fill;
    /* Not 0: then iris_stereo_smooth. Default 1. */
    int32_t smooth;
} iris_stereo_config;

/* --- fixed windows --- */

typedef struct {
    iris_stereo_config stereo; /* default cost: IRIS_STEREO_CENSUS */
    int32_t side;              /* of the square window: odd, 1..IRIS_STEREO_SIDE_MAX; default 13 */
} iris_stereo_block_config;

#define IRIS_STEREO_SIDE_MAX 31

/* Sensible values, as given above. Null is ignored. */
void iris_stereo_block_defaults(iris_stereo_block_config *config);

/* So many pixels of a row are worked on at a time. */
#define IRIS_STEREO_PIECE 32

/* Working memory: some rows, each with all disparities. */
#define IRIS_STEREO_ROW_BYTES(w, max_disparity, bytes)                                                       \
    IRIS_SCRATCH_ROUND((size_t)(bytes) * (size_t)(w) * ((size_t)(max_disparity) + 1u))
#define IRIS_STEREO_PAIR_SCRATCH_BYTES(w, max_disparity)                                                     \
    (4u * IRIS_SCRATCH_ROUND((size_t)(w) + (size_t)(max_disparity)) + 3u * IRIS_SCRATCH_ROUND((size_t)(w)))
#define IRIS_STEREO_COSTS_SCRATCH_BYTES(w, max_disparity)                                                    \
    (IRIS_STEREO_ROW_BYTES(w, max_disparity, 1) + IRIS_STEREO_PAIR_SCRATCH_BYTES(w, max_disparity))
#define IRIS_STEREO_WINDOWS_SCRATCH_BYTES(w, max_disparity)                                                  \
    (IRIS_STEREO_ROW_BYTES(w, max_disparity, 2) +                                                            \
     IRIS_STEREO_ROW_BYTES(IRIS_STEREO_PIECE + 1, max_disparity, 2) +                                        \
     IRIS_STEREO_ROW_BYTES(1, max_disparity, 2) + 2u * IRIS_STEREO_PAIR_SCRATCH_BYTES(w, max_disparity))
#define IRIS_STEREO_PICK_SCRATCH_BYTES(w, max_disparity)                                                     \
    (2u * IRIS_SCRATCH_ROUND(2u * ((size_t)(w) + (size_t)(max_disparity))))
#define IRIS_STEREO_SMOOTH_SCRATCH_BYTES(w) (3u * IRIS_SCRATCH_ROUND(2u * (size_t)(w)))
#define IRIS_STEREO_BLOCK_SCRATCH_BYTES(w, max_disparity)                                                    \
    (IRIS_STEREO_WINDOWS_SCRATCH_BYTES(w, max_disparity) +                                                   \
     IRIS_STEREO_PICK_SCRATCH_BYTES(w, max_disparity) + IRIS_STEREO_SMOOTH_SCRATCH_BYTES(w))

/* Block matching: for each place the disparity at which a square window around it differs least, with a parabola
 * through the three costs there for the fraction of a pixel. At the edge of a near thing windows see both this and
 * what is behind, and the near thing seems wider: the report's corona.
 *
 * left and right: IRIS_GRAY8 of one size; disparity: IRIS_GRAY_U16 of that size, disjoint from both. config may be
 * null for the defaults.
 * IRIS_ERR_ARG: null pointer, or a config value out of range; errors of iris_image_check; IRIS_ERR_FORMAT;
 * IRIS_ERR_RANGE: sizes that differ; IRIS_ERR_ALIAS; IRIS_ERR_SCRATCH: less than
 * IRIS_STEREO_BLOCK_SCRATCH_BYTES(w, max_disparity). O(w h max_disparity), whatever the side. */
iris_status iris_stereo_block(const iris_image *disparity, const iris_image *left, const iris_image *right,
                              const iris_stereo_block_config *config, iris_scratch *scratch);

/* --- semi-global --- */

typedef struct {
    iris_stereo_config stereo; /* default cost: IRIS_STEREO_BOTH */
    int32_t p1; /* what a step of one disparity from a pixel to the next costs, 0..p2; default 24 */
    int32_t p2; /* what a larger step costs, p1..IRIS_STEREO_P2_MAX; default 200 */
} iris_stereo_semiglobal_config;

#define IRIS_STEREO_P2_MAX 10000

/* So many rows are worked on at a time, and so many below are looked at. */
#define IRIS_STEREO_BAND 16

/* Sensible values, as given above. Null is ignored. */
void iris_stereo_semiglobal_defaults(iris_stereo_semiglobal_config *config);

#define IRIS_STEREO_SEMIGLOBAL_SCRATCH_BYTES(w, max_disparity)                                               \
    (IRIS_STEREO_COSTS_SCRATCH_BYTES(w, max_disparity) +                                                     \
     IRIS_STEREO_ROW_BYTES(w, max_disparity, 2 * IRIS_STEREO_BAND) +                                         \
     IRIS_STEREO_ROW_BYTES(w, max_disparity, IRIS_STEREO_BAND) +                                             \
     2u * IRIS_STEREO_ROW_BYTES(w, max_disparity, 2) + IRIS_STEREO_ROW_BYTES(1, max_disparity, 4) +          \
     IRIS_SCRATCH_ROUND(2u * (size_t)(w) + 2u) + IRIS_STEREO_PICK_SCRATCH_BYTES(w, max_disparity) +          \
     IRIS_STEREO_SMOOTH_SCRATCH_BYTES(w))

/* Semi-global matching after Hirschmueller (2008), in bands of rows: the costs of single pixels are summed along the
 * best paths that come from the left, the right, above, and below, on which each change of disparity costs, a large
 * one a quarter of p2 (or p1, if that is more) where neighbors differ by more than 4 gray levels. No window, hence no
 * corona to speak of; surfaces without texture are bridged. Paths from below begin at most 2 IRIS_STEREO_BAND rows
 * below.
 *
 * Parameters and errors as iris_stereo_block, with IRIS_STEREO_SEMIGLOBAL_SCRATCH_BYTES(w, max_disparity).
 * O(w h max_disparity), about twice the time of iris_stereo_block. */
iris_status iris_stereo_semiglobal(const iris_image *disparity, const iris_image *left,
                                   const iris_image *right, const iris_stereo_semiglobal_config *config,
                                   iris_scratch *scratch);

/* --- a quadtree's windows --- */

typedef enum { IRIS_STEREO_LEFT = 0, IRIS_STEREO_RIGHT } iris_stereo_side;

typedef struct {
    int32_t max_disparity; /* pixels, 1..IRIS_STEREO_DISPARITY_MAX; default 63 */
    iris_stereo_cost cost; /* default IRIS_STEREO_CENSUS */
    int32_t tolerance;     /* of the quadtree, gray levels, 0..255; default 20 */
    /* The picture that is divided, and whose disparities the maps have: what is at x in the right one is at x + d in the
     * left one. Default IRIS_STEREO_LEFT. */
    iris_stereo_side divided;
    /* Not 0: a plane for a block where that explains it better, else one disparity. Default 0. */
    int32_t planes;
    int32_t levels; /* resolutions, 1..IRIS_STEREO_LEVELS_MAX: 1, 1/2, 1/4 and so on; default 3 */
} iris_stereo_quadtree_config;

#define IRIS_STEREO_LEVELS_MAX 5

/* Sensible values, as given above. Null is ignored. */
void iris_stereo_quadtree_defaults(iris_stereo_quadtree_config *config);

/* How many tiles of 4 x 4 pixels there are. */
#define IRIS_STEREO_TILES(w, h) ((((size_t)(w) + 3u) / 4u) * (((size_t)(h) + 3u) / 4u))

/* Working memory: both pictures at half the size and so on; the blocks of each resolution; of one the costs of all tiles. */
#define IRIS_STEREO_QUADTREE_SCRATCH_BYTES(w, h, max_disparity, levels)                                      \
    (IRIS_STEREO_LEVEL_BYTES_(w, h, levels, 0) + IRIS_STEREO_LEVEL_BYTES_(w, h, levels, 1) +                 \
     IRIS_STEREO_LEVEL_BYTES_(w, h, levels, 2) + IRIS_STEREO_LEVEL_BYTES_(w, h, levels, 3) +                 \
     IRIS_STEREO_LEVEL_BYTES_(w, h, levels, 4) +                                                             \
     IRIS_STEREO_ROW_BYTES(IRIS_STEREO_TILES(w, h), IRIS_STEREO_WHOLE_(max_disparity), 2) +                  \
     IRIS_SCRATCH_ROUND(IRIS_STEREO_TILES(w, h)) + IRIS_SCRATCH_ROUND(IRIS_STEREO_WINDOW_BYTES) +            \
     IRIS_STEREO_ROW_BYTES(1, IRIS_STEREO_WHOLE_(max_disparity), 2) +                                        \
     2u * IRIS_SCRATCH_ROUND(2u * (size_t)(w)) + IRIS_SCRATCH_ROUND(((size_t)(w) + 3u) / 4u) +               \
     IRIS_SCRATCH_ROUND(12u * IRIS_STEREO_TILES(w, h)) +                                                     \
     IRIS_STEREO_COSTS_SCRATCH_BYTES(w, IRIS_STEREO_WHOLE_(max_disparity)))
/* Disparities are looked at 16 at a time. */
#define IRIS_STEREO_WHOLE_(max_disparity) ((int32_t)(max_disparity) / 16 * 16 + 15)
#define IRIS_STEREO_LEVEL_BYTES_(w, h, levels, level)                                                        \
    ((level) < (levels)                                                                                      \
         ? 2u * IRIS_SCRATCH_ROUND((level) > 0 ? IRIS_PYRAMID_SIDE(w, level) * IRIS_PYRAMID_SIDE(h, level)   \
                                               : 0u) +                                                       \
               IRIS_SCRATCH_ROUND(24u * IRIS_STEREO_LEVEL_TILES_(w, h, level)) +                             \
               IRIS_SCRATCH_ROUND(4u * IRIS_STEREO_LEVEL_TILES_(w, h, level))                                \
         : 0u)
#define IRIS_STEREO_LEVEL_TILES_(w, h, level)                                                                \
    IRIS_STEREO_TILES(IRIS_PYRAMID_SIDE(w, level), IRIS_PYRAMID_SIDE(h, level))
#define IRIS_STEREO_WINDOW_BYTES 600u

/* And so much more for IRIS_STEREO_RIGHT. */
#define IRIS_STEREO_MIRROR_BYTES(w, h) (2u * IRIS_SCRATCH_ROUND((size_t)(w) * (size_t)(h)))

/* The report's variable windows (section 3.5): a picture is divided by a quadtree (quadtree.h, least side 4; leaves of
 * more than 16 pixels into blocks of at most 16), and each block gets one disparity, or a plane of them.
 *
 * The disparity is that at which the tiles of 4 x 4 pixels in the block and beside it differ least. Its own tiles weigh
 * 3, those beside it that are as bright (within 10 gray levels of the leaf's mean) 2, and others, which may lie
 * elsewhere in depth, nothing. Of the rows every other one is compared. A plane is fitted to the blocks around by least squares; it, and
 * then the planes of the blocks around, replace what the block has where the tiles differ less by it.
 * From coarse to fine: first the smallest pictures of the pyramid (pyramid.h), then each twice as large; disparities
 * that are at most a pixel outside of those found there around a tile cost a little less.
 * Two blocks cannot have the same place of the other picture: what matches it worse, what lies outside of it, and hence
 * what one camera alone sees goes on as the block left or right of it does, the one farther away. So every place has a
 * disparity.
 *
 * Parameters and errors as iris_stereo_block, with IRIS_STEREO_QUADTREE_SCRATCH_BYTES(w, h, max_disparity, levels);
 * IRIS_ERR_RANGE also where that does not fit a size_t. O(w h max_disparity): plain C takes a
 * quarter to a third of iris_stereo_block's time, AVX2, which block matching gains more from, a third to a half. With
 * planes half as much again. */
iris_status iris_stereo_quadtree(const iris_image *disparity, const iris_image *left, const iris_image *right,
                                 const iris_stereo_quadtree_config *config, iris_scratch *scratch);

/* The same at several resolutions, 1 to `count` (at most the config's levels): maps[k] is that of 1/2^k, its sides
 * IRIS_PYRAMID_SIDE(w, k) and IRIS_PYRAMID_SIDE(h, k), its disparities those of the whole picture: (x, y) in it lies on
 * (2^k x, 2^k y). A map whose data is null is not wanted, and the finest ones that are not wanted cost nothing. A map
 * is the same whichever others are wanted. */
iris_status iris_stereo_quadtree_maps(const iris_image *maps, int32_t count, const iris_image *left,
                                      const iris_image *right, const iris_stereo_quadtree_config *config,
                                      iris_scratch *scratch);

/* --- what is done to disparities --- */

/* Each match becomes the median of the matches in the 5 x 5 pixels around it (of an even number the lower one of the
 * two in the middle); places without a match stay so. In place.
 * IRIS_ERR_ARG: null pointer; errors of iris_image_check; IRIS_ERR_FORMAT: not IRIS_GRAY_U16; IRIS_ERR_SCRATCH: less
 * than IRIS_STEREO_SMOOTH_SCRATCH_BYTES(w). O(w h). */
iris_status iris_stereo_smooth(const iris_image *disparity, iris_scratch *scratch);

#define IRIS_STEREO_SPECKLE_SCRATCH_BYTES(w, h) IRIS_SCRATCH_ROUND(4u * (size_t)(w) * (size_t)(h))

/* Takes away small specks: of matches that hang together (4 neighbors, which differ by at most `difference`, in 256ths
 * of a pixel) those fewer than least_area pixels become places without a match. In place.
 * IRIS_ERR_ARG: null pointer, a difference outside 0..65535, or a negative least_area; errors of iris_image_check;
 * IRIS_ERR_FORMAT: not IRIS_GRAY_U16; IRIS_ERR_SCRATCH: less than IRIS_STEREO_SPECKLE_SCRATCH_BYTES(w, h). O(w h). */
iris_status iris_stereo_speckle(const iris_image *disparity, int32_t least_area, int32_t difference,
                                iris_scratch *scratch);

/* --- depth --- */

/* No disparity: infinitely far. */
#define IRIS_STEREO_INFINITY INT64_MAX

/* z = b f / d, in the unit of the baseline b, which the report calls 2h; focal: f in pixels; disparity: 256 to a pixel.
 * Rounded to the nearest iris_q32. IRIS_STEREO_INFINITY for 0, and for what does not fit. O(1). */
iris_q32 iris_stereo_depth(uint16_t disparity, iris_q32 baseline, iris_q32 focal);

#ifdef __cplusplus
}
#endif

#endif
