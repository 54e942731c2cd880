#include "board_option.h"

#include "args.h"
#include "complain.h"

int board_option_read(iris_board_grid *grid, const char *text)
{
    int32_t sides[2];
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
    *grid = (iris_board_grid){sides[0], sides[1]};
    return 1;
}

size_t board_option_bytes(const iris_board_grid *grid, iris_size size)
{
    return IRIS_BOARD_CORNERS_SCRATCH_BYTES((size_t)size.w, (size_t)size.h, grid->columns, grid->rows);
}

int board_option_find(iris_vec2 *places, const iris_board_grid *grid, const iris_image *gray,
                      iris_scratch *scratch, const char *file)
{
    static const char *const why[] = {[IRIS_BOARD_SEEN] = "",
                                      [IRIS_BOARD_UNSEEN] = "",
                                      [IRIS_BOARD_PARTLY] =
                                          "the rest is covered, out of focus, or lost in light or shade",
                                      [IRIS_BOARD_CUT] = "the rest is beyond the picture's edge",
                                      [IRIS_BOARD_LARGER] = "that board is larger"};
    iris_board_report report;
    iris_status status = iris_board_corners(places, &report, gray, grid, scratch);
    if (status == IRIS_OK) {
        return EXIT_DONE;
    }
    if (status != IRIS_ERR_DATA) {
        complain(file, "%s", iris_status_text(status));
    } else if (report.sight == IRIS_BOARD_UNSEEN) {
        complain(file, "no board is seen, of %dx%d or any other corners", (int)grid->columns,
                 (int)grid->rows);
    } else {
        complain(file, "no board of %dx%d corners: %d are seen, over %dx%d; %s", (int)grid->columns,
                 (int)grid->rows, (int)report.seen, (int)report.columns, (int)report.rows, why[report.sight]);
    }
    return EXIT_BAD_DATA;
}
