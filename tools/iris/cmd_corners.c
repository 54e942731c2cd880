#include <string.h>

#include "board_option.h"
#include "canvas.h"
#include "commands.h"
#include "one_line.h"
#include "operation.h"

static const char help[] =
    "usage: iris corners --board CxR [--circles|--shifted-circles] [--roi x,y,w,h] [--json] IN...\n"
    "                    [-o OUT]\n\n"
    "The inner corners of a chessboard to a fraction of a pixel, row by row: a line for each, x y, as\n"
    "iris calibrate board --corners reads them. 0 0 is the middle of the first pixel. Color counts by its\n"
    "luma. Along a row and then down the rows is a turn as from right to down in the picture. The first\n"
    "row begins where the square between the first four corners is dark, or else more to the left. With\n"
    "several pictures, a line with # and the file's name comes first; calibrate takes all in one file.\n\n"
    "  --board CxR       inner corners in a row, and rows: 9x6. Each is 3 at least\n" BOARD_OPTION_HELP
        OPERATION_OPTIONS "\n"
    "A picture in which the board is not seen as a whole is told with the reason. JSON has corners: [x,y]\n"
    "of each. With -o they are drawn in color: the first row, and where it begins, stand out.\n\n"
    "example: iris corners --board 9x6 left*.pgm > left_corners.txt\n"
    "         iris calibrate board --board 9x6 --square 25mm --corners left_corners.txt\n";

typedef struct {
    board_option board;
    const char *alone; /* the only input; null: there are several */
} settings;

/* What apply leaves for report, at the front of the room. */
typedef struct {
    int32_t count;
    iris_vec2 corners[BOARD_OPTION_POINTS];
} finding;

static double place_in_pixels(iris_q32 number)
{
    return (double)number / 4294967296.0;
}

static const iris_image *overlay(const iris_image *input, const finding *found, operation_stage *stage)
{
    const settings *by = stage->settings;
    const iris_image *color = stage_color(stage, input);
    color = color ? stage_copy(stage, color) : NULL;
    if (color) {
        canvas on = canvas_plain(color);
        canvas_point last = {0, 0};
        for (int32_t i = 0; i < found->count; i++) {
            const canvas_point at = {place_in_pixels(found->corners[i].x),
                                     place_in_pixels(found->corners[i].y)};
            const int32_t row = i / by->board.grid.columns;
            if (i > 0) {
                canvas_line(&on, last, at, canvas_color((i - 1) / by->board.grid.columns));
            }
            canvas_circle(&on, at, i == 0 ? 9 : row == 0 ? 6 : 4, canvas_color(row));
            last = at;
        }
    }
    return color;
}

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const settings *by = stage->settings;
    const iris_image *gray = stage_gray(stage, input);
    finding *found = gray ? stage_room(stage, sizeof *found) : NULL;
    iris_scratch *scratch =
        found ? stage_scratch(stage, board_option_bytes(&by->board, (iris_size){gray->w, gray->h})) : NULL;
    if (!scratch) {
        return EXIT_BAD_DATA;
    }
    int exit_code = board_option_find(found->corners, &by->board, gray, scratch, stage->file);
    if (exit_code != EXIT_DONE) {
        return exit_code;
    }
    found->count = by->board.grid.columns * by->board.grid.rows;
    const iris_image *drawn = overlay(input, found, stage);
    if (!drawn) {
        return EXIT_BAD_DATA;
    }
    stage->finding = found;
    *result = *drawn;
    return EXIT_DONE;
}

static void report(json_writer *json, const operation_stage *stage)
{
    const finding *found = stage->finding;
    int32_t x, y;
    stage_origin(&x, &y, stage);
    json_key(json, "corners");
    json_open(json, '[');
    for (int32_t i = 0; i < found->count; i++) {
        json_open(json, '[');
        json_number(json, x + place_in_pixels(found->corners[i].x), 4);
        json_number(json, y + place_in_pixels(found->corners[i].y), 4);
        json_close(json, ']');
    }
    json_close(json, ']');
}

static void print(FILE *out, const operation_stage *stage)
{
    const settings *by = stage->settings;
    const finding *found = stage->finding;
    int32_t x, y;
    stage_origin(&x, &y, stage);
    if (!by->alone || strcmp(by->alone, stage->file) != 0) {
        fputs("# ", out);
        one_line(out, stage->file);
        fputs("\n", out);
    }
    for (int32_t i = 0; i < found->count; i++) {
        fprintf(out, "%.4f %.4f\n", x + place_in_pixels(found->corners[i].x),
                y + place_in_pixels(found->corners[i].y));
    }
}

static int parse(void *memory, operation_words *words)
{
    settings *by = memory;
    const char *board = NULL;
    const args_option options[] = {{"board", 0, NULL, &board},
                                   {"circles", 0, &by->board.circles, NULL},
                                   {"shifted-circles", 0, &by->board.shifted, NULL}};
    if (!operation_options(words, options, sizeof options / sizeof options[0])) {
        return 0;
    }
    by->alone = words->arguments.operand_count == 1 ? words->arguments.operands[0] : NULL;
    return board_option_read(&by->board, board);
}

const operation operation_corners = {
    .name = "corners",
    .summary = "the inner corners of a chessboard, or circles, to calibrate a camera",
    .help = help,
    .parse = parse,
    .apply = apply,
    .report = report,
    .print = print,
    .reports_alone = 1};
