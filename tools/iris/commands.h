/* The commands of main.c: programs of their own, and picture operations (operation.h), by name. */
#ifndef IRIS_TOOL_COMMANDS_H
#define IRIS_TOOL_COMMANDS_H

#include "operation.h"

/* argv[0] is the command's name; each returns an exit code and has complained unless it is EXIT_DONE. */
int cmd_borg(int argc, char **argv);
int cmd_calibrate(int argc, char **argv);
int cmd_cameras(int argc, char **argv);
int cmd_capture(int argc, char **argv);
int cmd_carve(int argc, char **argv);
int cmd_controls(int argc, char **argv);
int cmd_info(int argc, char **argv);
int cmd_follow(int argc, char **argv);
int cmd_floor(int argc, char **argv);
int cmd_lock(int argc, char **argv);
int cmd_map(int argc, char **argv);
int cmd_pipe(int argc, char **argv);
int cmd_rectify(int argc, char **argv);
int cmd_robot(int argc, char **argv);
int cmd_run(int argc, char **argv);
int cmd_shape(int argc, char **argv);
int cmd_stereo(int argc, char **argv);
int cmd_swarm(int argc, char **argv);

/* operation_<name> of each. */
#define OPERATION(name) extern const operation operation_##name;
#include "operations.def"
#undef OPERATION

/* All of them, in the order of iris --help; ends with null. */
extern const operation *const operations[];

/* Null when there is none of that name. */
const operation *operation_find(const char *name);

#endif
