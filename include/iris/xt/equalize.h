/* IRIS-XT - equalization: contrast from the picture's own histogram, over the whole of it or tile by tile.
 *
 * On IRIS_GRAY8, and on the lightness of IRIS_RGB888 and IRIS_BGR888 (of HSL as color.h defines it; hue and saturation are
 * kept). dst and src have the same size and format; dst may be src (the same data and stride), else they are disjoint.
 *
 * Both return IRIS_ERR_ARG for a null pointer, the errors of iris_image_check for a view that is not valid, IRIS_ERR_FORMAT
 * for other or different formats, IRIS_ERR_RANGE when the sizes differ, IRIS_ERR_ALIAS, and IRIS_ERR_SCRATCH, besides
 * what their comments say. Report, sections 2.2, 2.4, and 3.3.3.
 */
#ifndef IRIS_XT_EQUALIZE_H
#define IRIS_XT_EQUALIZE_H

#include "iris/fixed.h"
#include "iris/image.h"
#include "iris/scratch.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Working memory of iris_equalize: a histogram. */
#define IRIS_EQUALIZE_SCRATCH_BYTES ((size_t)1024)

/* Equalization: iris_tone_equalize (xt/tone.h) by the picture's histogram, of color by IRIS_CHANNEL_LIGHTNESS
 * (xt/histogram.h) through iris_tone_apply_lightness. O(pixels), read twice. */
iris_status iris_equalize(const iris_image *dst, const iris_image *src, iris_scratch *scratch);

#define IRIS_EQUALIZE_TILES_MAX 64

typedef struct {
    /* In each direction: 1 to IRIS_EQUALIZE_TILES_MAX, and at most the picture's shorter side. */
    int32_t tiles;
    /* How many times its even share of the pixels a level may have; at most 256 times, 0: any. */
    iris_q16 limit_q16;
} iris_equalize_local_config;

/* 8 tiles in each direction, limit 3. */
void iris_equalize_local_defaults(iris_equalize_local_config *config);

/* Working memory of iris_equalize_local: a histogram, and a curve for each tile. */
#define IRIS_EQUALIZE_LOCAL_SCRATCH_BYTES(tiles)                                                             \
    ((size_t)1024 + (size_t)256 * (size_t)(tiles) * (size_t)(tiles))

/* Local equalization with a contrast limit, for uneven light (CLAHE: S. M. Pizer and others 1987, K. Zuiderveld 1994). Every
 * tile of the picture has a curve from its own histogram, and a pixel goes through the four curves around it, mixed
 * bilinearly by its distances. Exactly:
 *
 *   Tile i of a row of t tiles takes the pixels from floor(i w / t) up to below floor((i + 1) w / t); rows alike. Tiles may
 *   differ by one pixel.
 *   A level may have at most max(1, floor(limit area / 256)) pixels of a tile. What is above that, e in sum, is given back
 *   to all levels: floor(e / 256) to each, and one more to the levels floor(256 j / r), j from 0 up to below r, the rest.
 *   The curve of a tile is round(255 cdf(p) / area).
 *   The weight of the right one of two curves is round(2048 d / D), D from the center of the left tile to that of the right
 *   one, d to the pixel; beyond the outermost centers the outermost curve holds alone. Weights downwards alike. The sum
 *   of the four products is divided by 2048^2, rounded. Half way between two levels, where the lightness of a color may
 *   lie, a curve is the mean of both.
 *
 * config: null for the defaults. A limit of 1 changes little, 2 to 4 is usual; without a limit noise in even areas is raised
 * to full contrast.
 * IRIS_ERR_ARG: tiles or limit outside; IRIS_ERR_RANGE: more tiles than the picture has rows or columns.
 * O(pixels + 256 tiles^2). */
iris_status iris_equalize_local(const iris_image *dst, const iris_image *src,
                                const iris_equalize_local_config *config, iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
