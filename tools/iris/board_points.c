#include "board_points.h"

#include <stdio.h>
#include <string.h>

#include "args.h"
#include "complain.h"
#include "number_file.h"

/* A number and its unit. */
static int read_square(iris_q32 *side, const char **unit, const char *text)
{
    static const char *const units[] = {"mm", "cm", "m", "in"};
    char number[32];
    size_t length = strspn(text, "0123456789.");
    *unit = text + length;
    int known = **unit == '\0';
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
        known |= strcmp(*unit, units[i]) == 0;
    }
    snprintf(number, sizeof number, "%.*s", (int)length, text);
    if (!known || length >= sizeof number || !number_text_read(side, number) ||
        *side < IRIS_Q32_ONE / 1000000 || *side > 1000000 * IRIS_Q32_ONE) {
        complain("--square", "a length such as 25mm, 2.5cm, 0.025m, 1in, or 25, not '%s'", text);
        return 0;
    }
    return 1;
}

int board_points_read(iris_vec2 *places, int *count, const char **unit, board_option *looked_for,
                      const board_texts *given)
{
    int32_t sides[2] = {0, 0};
    iris_q32 side = IRIS_Q32_ONE;
    *unit = "";
    if (!given->board == !given->points) {
        complain(NULL, "the board is needed once: --board CxR or --points FILE");
        return EXIT_BAD_CALL;
    }
    if (given->points) {
        number_table table = {&places[0].x, NULL, 0, BOARD_OPTION_POINTS, 2};
        int read = number_file_read(&table, given->points);
        *count = table.rows;
        return read ? EXIT_DONE : EXIT_BAD_DATA;
    }
    if (given->square && !read_square(&side, unit, given->square)) {
        return EXIT_BAD_CALL;
    }
    if (!args_numbers(sides, 2, 'x', given->board) || sides[0] < 2 || sides[1] < 2 || sides[0] > 512 ||
        sides[1] > BOARD_OPTION_POINTS / sides[0]) {
        complain("--board", "CxR, inner corners in a row and rows, each 2 at least, %d in all, not '%s'",
                 BOARD_OPTION_POINTS, given->board);
        return EXIT_BAD_CALL;
    }
    *count = sides[0] * sides[1];
    looked_for->grid = (iris_board_grid){sides[0], sides[1]};
    for (int i = 0; i < *count; i++) {
        int32_t at[2];
        board_option_point(at, looked_for, i);
        places[i] = (iris_vec2){at[0] * side, at[1] * side};
    }
    return EXIT_DONE;
}
