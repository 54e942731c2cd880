/* A robot from above: its body, wheels, and devices, each with what it sees. */
#ifndef IRIS_TOOL_ROBOT_PICTURE_H
#define IRIS_TOOL_ROBOT_PICTURE_H

#include "iris/osiris/plan.h"

/* As --help says. Complains; returns 1, or 0. */
int robot_picture_write(const char *path, const osiris_plan *plan);

#endif
