/* Maps in files as map servers of robots have them: a text, and a picture beside it. */
#ifndef IRIS_TOOL_MAP_FILE_H
#define IRIS_TOOL_MAP_FILE_H

#include "iris/3d/grid.h"

/* Writes NAME.yaml and NAME.pgm; path is the first of them, and ends with .yaml. Complains; returns 1, or 0. */
int map_file_write(const char *path, const iris_grid *grid);

/* Reads a map; its picture lies beside the text. grid->odds is for free(). Complains; returns 1, or 0. */
int map_file_read(iris_grid *grid, const char *path);

#endif
