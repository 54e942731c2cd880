/* Camera files: what `iris calibrate board -o` writes, and what other commands take by --calib. */
#ifndef IRIS_TOOL_CAMERA_FILE_H
#define IRIS_TOOL_CAMERA_FILE_H

#include "iris/3d/pair_text.h"

/* The camera in a file. Complains, with the line; returns 1, or 0. */
int camera_file_read(iris_camera_model *camera, const char *path);

/* The same of two cameras that are mounted together: what `iris calibrate pair -o` writes. */
int pair_file_read(iris_pair *pair, const char *path);
int pair_file_write(const char *path, const iris_pair *pair);

/* The camera of pictures without lens, in a camera file, or the left one of a pair file that iris rectify -o wrote;
 * *baseline: as in the pair, or 0. Complains, also of a lens or of a pair that is not rectified; returns 1, or 0. */
int flat_camera_read(iris_camera_model *camera, iris_q32 *baseline, const char *path);

/* Are pictures of this size those that the camera was calibrated with? Complains about `file` if not. */
int camera_fits(const iris_camera_model *camera, const char *file, iris_size size);

#endif
