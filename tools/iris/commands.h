/* The commands of main.c: programs of their own, and picture operations (operation.h), by name. */
#ifndef IRIS_TOOL_COMMANDS_H
#define IRIS_TOOL_COMMANDS_H

#include "operation.h"

/* argv[0] is the command's name; each returns an exit code and has complained unless it is EXIT_DONE. */
int cmd_info(int argc, char **argv);
int cmd_follow(int argc, char **argv);
int cmd_pipe(int argc, char **argv);

/* One line each, and its place in operations.c. */
extern const operation operation_convert;
extern const operation operation_gray;
extern const operation operation_pyramid;
extern const operation operation_threshold;
extern const operation operation_negative;
extern const operation operation_adjust;
extern const operation operation_compress;
extern const operation operation_stretch;
extern const operation operation_gamma;
extern const operation operation_histogram;
extern const operation operation_equalize;
extern const operation operation_edge;
extern const operation operation_dilate;
extern const operation operation_erode;
extern const operation operation_open;
extern const operation operation_close;
extern const operation operation_gradient;
extern const operation operation_tophat;
extern const operation operation_blackhat;
extern const operation operation_hitmiss;
extern const operation operation_distance;
extern const operation operation_skeleton;
extern const operation operation_quadtree;
extern const operation operation_blur;
extern const operation operation_median;
extern const operation operation_unsharp;
extern const operation operation_convolve;

/* All of them, in the order of iris --help; ends with null. */
extern const operation *const operations[];

/* Null when there is none of that name. */
const operation *operation_find(const char *name);

#endif
