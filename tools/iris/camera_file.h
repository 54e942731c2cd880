/* Camera files: what `iris calibrate board -o` writes, and what other commands take by --calib. */
#ifndef IRIS_TOOL_CAMERA_FILE_H
#define IRIS_TOOL_CAMERA_FILE_H

#include "iris/3d/camera_text.h"

/* The camera in a file. Complains, with the line; returns 1, or 0. */
int camera_file_read(iris_camera_model *camera, const char *path);

/* Are pictures of this size those that the camera was calibrated with? Complains about `file` if not. */
int camera_fits(const iris_camera_model *camera, const char *file, iris_size size);

#endif
