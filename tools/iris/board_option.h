/* The board of a command: --board CxR, and how it is found in pictures. */
#ifndef IRIS_TOOL_BOARD_OPTION_H
#define IRIS_TOOL_BOARD_OPTION_H

#include "iris/3d/board_find.h"

#define BOARD_OPTION_POINTS 1024 /* at most, of a board */

typedef struct {
    iris_board_grid grid;
    int circles, shifted; /* of --circles and --shifted-circles */
} board_option;

#define BOARD_OPTION_HELP                                                                                    \
    "  --circles         of a grid of circles, dark on bright or bright on dark: their centers\n"            \
    "  --shifted-circles the same with every second row shifted to the right by half a step\n"

/* 1, or 0 after complaining. null: not given. board->circles and shifted are set before. */
int board_option_read(board_option *board, const char *text);

/* Where point k is on the board, in steps: of shifted circles in half steps along a row. */
void board_option_point(int32_t at[2], const board_option *board, int32_t k);

/* Working memory for a picture of this size. */
size_t board_option_bytes(const board_option *board, iris_size size);

/* The board's places in a picture, IRIS_GRAY8. Returns an exit code; complains about `file` when it is not seen. */
int board_option_find(iris_vec2 *places, const board_option *board, const iris_image *gray,
                      iris_scratch *scratch, const char *file);

#endif
