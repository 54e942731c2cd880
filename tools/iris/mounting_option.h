/* --height, --tilt, and so on: how a calibrated camera is mounted above the floor. */
#ifndef IRIS_TOOL_MOUNTING_OPTION_H
#define IRIS_TOOL_MOUNTING_OPTION_H

#include "args.h"
#include "iris/3d/mounting.h"

#define MOUNTING_OPTION_HELP                                                                                 \
    "  --calib CAMERA    a camera file, of iris calibrate\n"                                                 \
    "  --height MM       of the camera's lens above the floor, millimeters\n"                                \
    "  --tilt DEG        of what it looks at below the horizon: 90 is straight down\n"                       \
    "  --pan DEG, --roll DEG\n"                                                                              \
    "                    how far it looks to the right, and how far its right side is lower\n"               \
    "                    than its left one (the default: 0)\n"                                               \
    "  --ahead MM, --right MM\n"                                                                             \
    "                    where the lens is beside the place that is 0,0 on the floor (the default: 0)\n"

/* The options' values, null where not given. */
typedef struct {
    const char *calib, *height, *tilt, *pan, *roll, *ahead, *right;
} mounting_texts;

#define MOUNTING_PLACE_OPTIONS(texts)                                                                        \
    {"height", 0, NULL, &(texts).height}, {"tilt", 0, NULL, &(texts).tilt}, {"pan", 0, NULL, &(texts).pan},  \
        {"roll", 0, NULL, &(texts).roll}, {"ahead", 0, NULL, &(texts).ahead},                                \
    {                                                                                                        \
        "right", 0, NULL, &(texts).right                                                                     \
    }
#define MOUNTING_OPTIONS(texts) {"calib", 0, NULL, &(texts).calib}, MOUNTING_PLACE_OPTIONS(texts)

/* Is any of them given? */
int mounting_is_given(const mounting_texts *texts);

/* The mounting; the camera's file is not looked at. Complains about what is missing or wrong; returns 1, or 0. */
int mounting_option_read(iris_mounting *mounting, const mounting_texts *texts);

#endif
