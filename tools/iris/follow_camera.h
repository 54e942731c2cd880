/* `iris follow --camera`: frames as they come, until they end, or somebody ends the program. */
#ifndef IRIS_TOOL_FOLLOW_CAMERA_H
#define IRIS_TOOL_FOLLOW_CAMERA_H

#include "follow_session.h"

/* Opens the camera, which is to be closed by follow_camera_end. Complains; returns an exit code. */
int follow_camera_begin(const follow_options *options);

/* Answers frame after frame. While no frame comes, the robot is told to stand still. Complains; returns an exit code. */
int follow_camera_run(follow_session *s);

void follow_camera_end(void);

#endif
