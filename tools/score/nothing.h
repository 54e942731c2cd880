/* Pictures with nothing in them: what a detector finds there it has made up. */
#ifndef SCORE_NOTHING_H
#define SCORE_NOTHING_H

#include "iris/image.h"

#define NOTHING_PICTURES 32

/* Picture i, 0 to NOTHING_PICTURES - 1, IRIS_GRAY8 of 320x240: even levels, noise of several strengths, slopes of light,
 * darkened corners, clouds of several sizes; the last twelve mix them. Always the same. Given back with
 * free(image.data); data is null without memory. */
iris_image nothing_picture(int i);

#endif
