/* Robot files and world files: iris/osiris/robot_text.h and world_text.h. */
#ifndef IRIS_TOOL_ROBOT_FILE_H
#define IRIS_TOOL_ROBOT_FILE_H

#include "iris/osiris/robot_text.h"
#include "iris/osiris/world_text.h"

/* devices: OSIRIS_DEVICES_MAX of them. Complains with file and line; returns 1, or 0. */
int robot_file_read(osiris_plan *plan, osiris_device *devices, const char *path);
int world_file_read(osiris_world *world, osiris_world_memory *memory, const char *path);

#endif
