/* The histogram of gray pixels: all that Otsu's threshold needs. */
#ifndef IRIS_XT_HISTOGRAM_GRAY_H
#define IRIS_XT_HISTOGRAM_GRAY_H

#include "iris/image.h"

/* Adds the pixels of a checked IRIS_GRAY8 to the counts. */
void iris_histogram_count_gray(uint32_t histogram[256], const iris_image *src);

#endif
