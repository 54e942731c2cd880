/* What the operations on pictures of levels share. */
#ifndef IRIS_XT_TONE_PICTURE_H
#define IRIS_XT_TONE_PICTURE_H

#include "iris/image.h"

/* dst and src: IRIS_GRAY8, IRIS_RGB888, or IRIS_BGR888, both the same, of one size, the same picture or disjoint. */
iris_status iris_tone_check(const iris_image *dst, const iris_image *src);

/* Twice the level that a curve of 256 gives at l / 2, l from 0 to 510: half way between two entries, their mean. */
static inline int32_t iris_tone_twice_at(const uint8_t level[256], int32_t l)
{
    return level[l / 2] + level[(l + 1) / 2];
}

#endif
