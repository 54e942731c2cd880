/* Pictures of two cameras, rectified by what a pair file says of them. */
#ifndef IRIS_TOOL_RECTIFIED_PAIR_H
#define IRIS_TOOL_RECTIFIED_PAIR_H

#include "iris/3d/rectify.h"
#include "picture.h"

/* The option --keep, as texts. */
#define RECTIFIED_KEEPS "valid or all"

/* valid or all. Complains; returns 1, or 0. */
int rectified_keep_read(iris_rectify_keep *keep, const char *text);

/* Reads the pair file, and makes each picture (of names[0], the left one, and names[1]) the rectified view of itself.
 * Complains; returns an exit code. */
int rectified_pair_make(iris_rectified *made, picture_buffer pictures[2], const char *const names[2],
                        const char *calib, iris_rectify_keep keep);

#endif
