/* A curve of levels at lightness, which has twice as many steps. */
#ifndef IRIS_XT_TONE_LIGHTNESS_H
#define IRIS_XT_TONE_LIGHTNESS_H

#include <stdint.h>

/* Twice the level that a curve of 256 gives at l / 2, l from 0 to 510: half way between two entries, their mean. */
static inline int32_t iris_tone_twice_at(const uint8_t level[256], int32_t l)
{
    return level[l / 2] + level[(l + 1) / 2];
}

#endif
