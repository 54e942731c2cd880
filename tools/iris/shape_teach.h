/* iris shape teach: the table of a shape from a picture of it. */
#ifndef IRIS_TOOL_SHAPE_TEACH_H
#define IRIS_TOOL_SHAPE_TEACH_H

#include "iris/xt/canny.h"

/* argv[0] is "teach"; returns an exit code. */
int shape_teach(int argc, char **argv);

/* --sigma, --low, --high as texts, null when not given, into *canny. Complains and returns 0 when they are wrong. */
int shape_read_canny(iris_canny_config *canny, const char *sigma, const char *low, const char *high);

#endif
