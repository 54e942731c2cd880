/* Pictures in memory, and the files they come from. */
#ifndef SCORE_PICTURE_H
#define SCORE_PICTURE_H

#include <stdio.h>

#include "iris/image.h"

/* A black picture of 64 megapixels at most; data is null otherwise. Given back with free(image.data). */
iris_image picture_make(int32_t w, int32_t h, iris_format format);

/* Opens a file of the shared data (the folder IRIS_DATA, or ../shared/data) for reading; null when it is not
 * there. */
FILE *data_open(const char *name);

/* Reads a BMP, PGM or PPM of the shared data as IRIS_GRAY8 (by luma) or IRIS_RGB888. image->data is null when
 * there is no picture; with an error it may hold a part of one. */
iris_status picture_load(iris_image *image, const char *name, iris_format format);

/* Writes a BMP; 0 when it cannot. */
int picture_save(const iris_image *image, const char *folder, const char *name);

#endif
