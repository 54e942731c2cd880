/* The driven path, seen from above, on the world and what the robot has mapped of it.
 */
#ifndef IRIS_TOOL_RUN_PICTURE_H
#define IRIS_TOOL_RUN_PICTURE_H

#include "run_session.h"

/* Complains; returns 1, or 0. */
int run_picture_write(const char *path, const run_session *session);

#endif
