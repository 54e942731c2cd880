/* iris floor from how a calibrated camera is mounted. */
#ifndef IRIS_TOOL_FLOOR_MOUNTING_H
#define IRIS_TOOL_FLOOR_MOUNTING_H

#include "mounting_option.h"

/* Makes the floor and writes it to `output`, if that is not null. Complains about what is wrong; returns an exit code. */
int floor_from_mounting(const mounting_texts *texts, const char *output, int json);

#endif
