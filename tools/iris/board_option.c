#include "board_option.h"

#include <stdio.h>

#include "args.h"
#include "complain.h"

int board_option_read(board_option *board, const char *text)
{
    int32_t sides[2];
    if (board->circles && board->shifted) {
        complain("--circles", "not together with --shifted-circles");
        return 0;
    }
    if (!text) {
        complain("--board", "missing: inner corners in a row, and rows, such as 9x6");
        return 0;
    }
    if (!args_numbers(sides, 2, 'x', text) || sides[0] < IRIS_BOARD_SIDE_MIN ||
        sides[0] > IRIS_BOARD_SIDE_MAX || sides[1] < IRIS_BOARD_SIDE_MIN || sides[1] > IRIS_BOARD_SIDE_MAX ||
        sides[0] * sides[1] > BOARD_OPTION_POINTS) {
        complain("--board", "CxR, inner corners in a row and rows, each %d to %d, %d in all, not '%s'",
                 IRIS_BOARD_SIDE_MIN, IRIS_BOARD_SIDE_MAX, BOARD_OPTION_POINTS, text);
        return 0;
    }
    board->grid = (iris_board_grid){sides[0], sides[1]};
    return 1;
}

void board_option_point(int32_t at[2], const board_option *board, int32_t k)
{
    const int32_t column = k % board->grid.columns, row = k / board->grid.columns;
    at[0] = board->shifted ? 2 * column + row % 2 : column;
    at[1] = row;
}

size_t board_option_bytes(const board_option *board, iris_size size)
{
    const size_t w = (size_t)size.w, h = (size_t)size.h;
    const int32_t columns = board->grid.columns, rows = board->grid.rows;
    return board->circles || board->shifted ? IRIS_BOARD_CIRCLES_SCRATCH_BYTES(w, h, columns, rows)
                                            : IRIS_BOARD_CORNERS_SCRATCH_BYTES(w, h, columns, rows);
}

int board_option_find(iris_vec2 *places, const board_option *board, const iris_image *gray,
                      iris_scratch *scratch, const char *file)
{
    static const char *const why[] = {[IRIS_BOARD_SEEN] = "",
                                      [IRIS_BOARD_UNSEEN] = "",
                                      [IRIS_BOARD_PARTLY] =
                                          "the rest is covered, out of focus, or lost in light or shade",
                                      [IRIS_BOARD_CUT] = "the rest is beyond the picture's edge",
                                      [IRIS_BOARD_LARGER] = "that board is larger"};
    iris_board_report report = {IRIS_BOARD_UNSEEN, 0, 0, 0};
    const iris_board_grid *grid = &board->grid;
    const char *what = board->circles || board->shifted ? "circles" : "corners";
    iris_status status =
        board->circles || board->shifted
            ? iris_board_circles(places, &report, gray, grid,
                                 board->shifted ? IRIS_BOARD_CIRCLES_SHIFTED : IRIS_BOARD_CIRCLES, scratch)
            : iris_board_corners(places, &report, gray, grid, scratch);
    char extent[40] = "";
    if (status == IRIS_OK) {
        return EXIT_DONE;
    }
    if (report.columns > 0) {
        snprintf(extent, sizeof extent, ", over %dx%d", (int)report.columns, (int)report.rows);
    }
    if (status != IRIS_ERR_DATA) {
        complain(file, "%s", iris_status_text(status));
    } else if (report.sight == IRIS_BOARD_UNSEEN) {
        complain(file, "no board is seen, of %dx%d or any other %s", (int)grid->columns, (int)grid->rows,
                 what);
    } else {
        complain(file, "no board of %dx%d %s: %d are seen%s; %s", (int)grid->columns, (int)grid->rows, what,
                 (int)report.seen, extent, why[report.sight]);
    }
    return EXIT_BAD_DATA;
}
