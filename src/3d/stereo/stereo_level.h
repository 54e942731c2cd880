/* One resolution of the quadtree's method: the costs of a picture's tiles of 4 x 4 pixels for every disparity, and the
 * patches that the picture is divided into.
 */
#ifndef IRIS_3D_STEREO_LEVEL_H
#define IRIS_3D_STEREO_LEVEL_H

#include "iris/3d/stereo.h"
#include "iris/quadtree.h"
#include "stereo_costs.h"

#define IRIS_STEREO_TILE  4  /* pixels: a tile's side, and the least one of a leaf */
#define IRIS_STEREO_PATCH 16 /* pixels: a larger leaf is cut into patches of at most that */

/* A fraction of a disparity: 65536 to a pixel. */
#define IRIS_STEREO_FRACTION 16

/* A part of the picture and its plane: the disparity is d + a (x - mx) + b (y - my) at pixel (x, y), (mx, my) being the
 * middle of the patch. 24 bytes. */
typedef struct {
    uint16_t x, y, w, h;
    int32_t d, a, b;  /* 65536 to a pixel */
    uint16_t cost;    /* of a tile of its window, on average; 64 to one */
    uint8_t mean;     /* gray level of its leaf */
    uint8_t reserved; /* 0 */
} iris_stereo_patch;

typedef struct {
    const iris_image *left, *right; /* the picture that is divided is called the left one */
    int32_t columns, rows;          /* of tiles */
    int32_t most;                   /* the largest disparity */
    int32_t steps;                  /* a multiple of 16, above that: so many costs has a tile */
    iris_stereo_patch *patches;     /* as many as there are tiles, at most */
    int32_t count;                  /* of patches */
    int32_t *owner;                 /* of each tile the patch that has its middle */
    uint16_t *costs;                /* rows times columns times steps */
    uint8_t *means;                 /* of the tiles, gray levels */
} iris_stereo_level;

/* The disparity of a patch's plane at a place that is given in half pixels; 65536 to a pixel, from 0 to `most` pixels. */
int32_t iris_stereo_plane_at(const iris_stereo_patch *patch, int32_t x2, int32_t y2, int32_t most);

/* The same in the middle of a tile. */
int32_t iris_stereo_tile_at(const iris_stereo_level *level, const iris_stereo_patch *patch, int32_t column,
                            int32_t row);

/* The costs and the means of all tiles. With a coarser level (half the size, done; null: none), disparities near those
 * found there cost less. */
iris_status iris_stereo_level_fill(const iris_stereo_level *level, const iris_stereo_level *coarser,
                                   iris_stereo_cost cost, iris_scratch *scratch);

/* The leaves of the picture's quadtree (room for as many as there are tiles), cut into patches; without disparities. */
iris_status iris_stereo_level_divide(iris_stereo_level *level, iris_quadtree_leaf *leaves, int32_t tolerance);

/* The patch's disparities go into the map of this level, 256 to a pixel of level 0 (2^shift pixels), from 1 to most. */
void iris_stereo_patch_draw(const iris_image *map, const iris_stereo_patch *patch, const iris_rect *where,
                            int32_t shift, int32_t most);

#endif
