/* The board of a command: --board CxR, and how it is found in pictures. */
#ifndef IRIS_TOOL_BOARD_OPTION_H
#define IRIS_TOOL_BOARD_OPTION_H

#include "iris/3d/board_find.h"

#define BOARD_OPTION_POINTS 1024 /* at most, of a board */

/* 1, or 0 after complaining. null: not given. */
int board_option_read(iris_board_grid *grid, const char *text);

/* Working memory for a picture of this size. */
size_t board_option_bytes(const iris_board_grid *grid, iris_size size);

/* The board's places in a picture, IRIS_GRAY8. Returns an exit code; complains about `file` when it is not seen. */
int board_option_find(iris_vec2 *places, const iris_board_grid *grid, const iris_image *gray,
                      iris_scratch *scratch, const char *file);

#endif
