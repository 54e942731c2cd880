/* Does a camera see the box at all? */
#ifndef IRIS_TOOL_CARVE_SHOWS_H
#define IRIS_TOOL_CARVE_SHOWS_H

#include "iris/3d/voxel.h"
#include "iris/image.h"

/* 1 when a picture of that size shows the middle of a voxel of the world, solid or not; 1 also where there is no memory
 * to find out. */
int carve_shows(const iris_voxel_world *world, const iris_q32 m[12], iris_size size);

#endif
