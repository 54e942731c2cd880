/* Pictures of depths or disparities in files: PGM of 16 bits, as `iris stereo -o` writes them. */
#ifndef IRIS_TOOL_DEPTH_FILE_H
#define IRIS_TOOL_DEPTH_FILE_H

#include "picture.h"

/* Reads the picture of a file into *picture, IRIS_GRAY_U16. Complains; returns 1, or 0. */
int depth_file_read(picture_buffer *picture, const char *path);

#endif
