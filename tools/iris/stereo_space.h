/* Where in space a pair of rectified pictures shows things: depths and points, into files. */
#ifndef IRIS_TOOL_STEREO_SPACE_H
#define IRIS_TOOL_STEREO_SPACE_H

#include "iris/3d/rectify.h"

typedef struct {
    const iris_rectified *rectified;
    const iris_image *disparity, *left; /* IRIS_GRAY_U16 (stereo.h), and the left view, IRIS_GRAY8 */
    double per_unit;                    /* depths are so many times larger in the file */
    int32_t beyond;                     /* how many places did not fit there */
} stereo_space;

/* Depths from the left camera's picture plane: a PGM of 16 bits, 0 where none is known or it does not fit, which
 * space->beyond counts. Complains; returns 1 when done, 0 when not. */
int stereo_depth_write(const char *path, stereo_space *space);

/* All places with a disparity as a PLY of points with gray levels, in the left camera's frame: x right, y down, z
 * forward. */
int stereo_points_write(const char *path, const stereo_space *space);

/* The least and the largest depth; 0 when there is none. */
int stereo_depth_range(double range[2], const stereo_space *space);

#endif
