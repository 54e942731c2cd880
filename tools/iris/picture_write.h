/* Writes pictures: the format is the one of the name's extension (.bmp, .pgm, .ppm, .pnm; BMP if there is none), and
 * the pixels are converted to what it holds: PGM gray, PPM color, .pnm either, BMP anything, a mask with 1 bit.
 * A file appears under its name only when all of it has been written.
 */
#ifndef IRIS_TOOL_PICTURE_WRITE_H
#define IRIS_TOOL_PICTURE_WRITE_H

#include "iris/image.h"

typedef enum {
    CONTAINER_UNKNOWN = 0, /* an extension of something else */
    CONTAINER_BMP,
    CONTAINER_PGM,
    CONTAINER_PPM,
    CONTAINER_PNM /* PGM or PPM, whichever fits the picture */
} picture_container;

/* Of the extension of a file name. "-" (standard output) is a BMP. */
picture_container picture_container_of(const char *path);

/* The extension that fits an image in a container, for example ".ppm". */
const char *picture_extension(picture_container container, iris_format format);

/* Writes an IRIS_GRAY8, IRIS_MASK1, IRIS_RGB888, or IRIS_BGR888 image; "-" is standard output. Complains; returns 1
 * when done, 0 when not: no new file is left then, and one that was there is as it was. */
int picture_write(const char *path, const iris_image *image);

#endif
