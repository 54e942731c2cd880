/* iris shape teach: the table of a shape from a picture of it. */
#ifndef IRIS_TOOL_SHAPE_TEACH_H
#define IRIS_TOOL_SHAPE_TEACH_H

/* argv[0] is "teach"; returns an exit code. */
int shape_teach(int argc, char **argv);

#endif
