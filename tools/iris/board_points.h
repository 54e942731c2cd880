/* The points of a flat board: in rows, by --board CxR and --square SIZE, or any, by --points FILE. */
#ifndef IRIS_TOOL_BOARD_POINTS_H
#define IRIS_TOOL_BOARD_POINTS_H

#include "board_option.h"

/* Null where not given. */
typedef struct {
    const char *board, *square, *points;
} board_texts;

/* Room for BOARD_OPTION_POINTS places; *unit is the text of one, empty when there is none. looked_for's circles and
 * shifted are set before; its grid is set. Returns an exit code; complains. */
int board_points_read(iris_vec2 *places, int *count, const char **unit, board_option *looked_for,
                      const board_texts *given);

#endif
