/* The window of a patch: the tiles in it and around it, each with a weight; those of weight 0 only lie beside it. */
#ifndef IRIS_3D_STEREO_WINDOW_H
#define IRIS_3D_STEREO_WINDOW_H

#include "stereo_level.h"

/* A patch of 16 pixels touches 5 tiles, and there is one more at each end. */
#define IRIS_STEREO_WINDOW_TILES 49

typedef struct {
    struct {
        int32_t tile;
        int16_t dx, dy; /* from the middle of the patch to that of the tile, in half pixels */
        uint32_t weight;
    } member[IRIS_STEREO_WINDOW_TILES];
    int32_t count, across; /* row by row, so many in each */
    uint32_t weight;       /* of all */
} iris_stereo_window;

void iris_stereo_window_gather(iris_stereo_window *window, const iris_stereo_level *level,
                               const iris_stereo_patch *patch);

/* The cost of a plane that has disparity d in the middle of the patch: of a tile on average, 64 to one. A tile has the
 * whole disparity next to that in its middle. */
uint32_t iris_stereo_window_cost(const iris_stereo_window *window, const iris_stereo_level *level, int32_t d,
                                 int32_t a, int32_t b);

#endif
