/* A folder of pictures, one for each frame of a sequence: where each goes, and that none replaces another. */
#ifndef IRIS_TOOL_OVERLAY_FOLDER_H
#define IRIS_TOOL_OVERLAY_FOLDER_H

#include <stdint.h>

#include "inputs.h"
#include "iris/image.h"

/* Makes the folder if it is missing, and sees to it that every input has a name of its own there and that none would be
 * overwritten. A folder with the name of a picture is refused. Complains; returns an exit code. */
int overlay_folder_begin(const char *folder, const input_list *inputs);

/* Writes the picture under the input's name as a BMP; a frame of standard input is frame_00001.bmp, after its number.
 * Complains; returns an exit code. */
int overlay_folder_write(const char *folder, const char *file, int64_t frame, const iris_image *picture);

#endif
