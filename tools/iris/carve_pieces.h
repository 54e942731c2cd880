/* Pieces of a world of voxels: those that are connected by their sides. */
#ifndef IRIS_TOOL_CARVE_PIECES_H
#define IRIS_TOOL_CARVE_PIECES_H

#include "iris/3d/voxel.h"

typedef struct {
    int32_t pieces;
    int32_t largest;        /* how many voxels it has; 0: there are none */
    iris_voxel first, last; /* of the largest, along each axis */
} carve_pieces;

/* 0: not enough memory. */
int carve_pieces_find(carve_pieces *pieces, const iris_voxel_world *world);

#endif
