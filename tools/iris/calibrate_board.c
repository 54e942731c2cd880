/* iris calibrate board. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "args.h"
#include "board_points.h"
#include "calibrate.h"
#include "calibrate_json.h"
#include "complain.h"
#include "file_write.h"
#include "frame_reader.h"
#include "inputs.h"
#include "iris/3d/calib_board.h"
#include "iris/3d/camera_text.h"
#include "number_file.h"
#include "one_line.h"
#include "progress.h"

static const char help[] =
    "usage: iris calibrate board --board CxR [--circles|--shifted-circles] [--square SIZE]\n"
    "                            [--model TERMS] [--json] PICTURE... [-o CAMERA]\n"
    "       iris calibrate board (--board CxR [--square SIZE] | --points FILE) [--model TERMS]\n"
    "                            [--image-size WxH] [--json] --corners FILE... [-o CAMERA]\n\n"
    "From views of a board with known points, such as the inner corners of a chessboard, to the camera,\n"
    "its lens, and how well both are known. The views are pictures, in which the corners are found as by\n"
    "iris corners, or lists of corners. A picture in which the board is not seen is told, and the others\n"
    "go on.\n\n"
    "  --board CxR      inner corners in a row, and rows: 9x6\n"
    "  --circles        a grid of circles, of which the centers count\n"
    "  --shifted-circles  the same with every second row shifted to the right by half a step, and rows as "
    "far\n"
    "                   apart as that; the half step is the square\n"
    "  --square SIZE    of the board's squares: 25mm, 2.5cm, 0.025m, 1in, or 25 of no unit. Default: 1\n"
    "  --points FILE    any other board: a point per line, x y, in any unit\n"
    "  --corners        the files are lists of corners: x y in pixels, in the board's order, row by row;\n"
    "                   a file may have several, as iris corners writes of several pictures\n"
    "  --model TERMS    what is looked for beside focal lengths, principal point, k1, and k2: any of\n"
    "                   skew, k3, and tangential, with commas between, or none. Default: k3,tangential\n"
    "  --image-size WxH of the pictures behind lists of corners, to tell how much of them is covered\n"
    "  --json           one JSON object\n"
    "  -o CAMERA        writes a camera file: a text of the values; lists of corners need --image-size, "
    "too.\n"
    "                   -: to standard output, and nothing else\n\n"
    "Ten views that tilt the board by 30 degrees and more, this way and that, and together fill the\n"
    "picture, are good. JSON has fx, fy, skew, u0, v0, k1, k2, k3, p1, p2 (the lens's terms as OpenCV's),\n"
    "rms_px, deviations (the standard deviation of each, null where it was not looked for), verdict (a\n"
    "list of sentences; empty: nothing is to be said against it), and views: file, rms_px, turn (a vector\n"
    "in radians) and shift, which bring the board's points to the camera, and corners.\n\n"
    "example: iris calibrate board --board 9x6 --square 25mm left*.pgm -o left.camera\n"
    "         iris corners --board 9x6 left*.pgm > left_corners.txt\n"
    "         iris calibrate board --board 9x6 --square 25mm --corners left_corners.txt\n";

#define POINTS BOARD_OPTION_POINTS /* of a board */

typedef struct {
    char *files[IRIS_BOARD_VIEWS_MAX]; /* of the views */
    iris_board_view views[IRIS_BOARD_VIEWS_MAX];
    iris_board_place places[IRIS_BOARD_VIEWS_MAX];
    int32_t count;
    board_option looked_for; /* in pictures */
    iris_vec2 board[POINTS];
    int points;
    const char *unit;
    iris_board_config config;
    iris_board_fit fit;
} session;

typedef struct {
    const char *board, *square, *points, *model, *size, *output;
} texts;

static int read_model(uint32_t *model, const char *text)
{
    static const struct {
        const char *name;
        uint32_t bit;
    } terms[] = {{"skew", IRIS_BOARD_SHEAR}, {"k3", IRIS_BOARD_K3}, {"tangential", IRIS_BOARD_TANGENTIAL}};
    *model = 0;
    for (const char *at = strcmp(text, "none") == 0 ? "" : text; *at != '\0';) {
        size_t length = strcspn(at, ","), i = 0;
        while (i < 3 && (strlen(terms[i].name) != length || strncmp(terms[i].name, at, length) != 0)) {
            i++;
        }
        if (i == 3) {
            complain("--model", "any of skew, k3, and tangential, with commas between, or none, not '%s'",
                     text);
            return 0;
        }
        *model |= terms[i].bit;
        at += length + (at[length] == ',');
    }
    return 1;
}

static int read_size(iris_size *size, const char *text)
{
    int32_t sides[2];
    if (!args_numbers(sides, 2, 'x', text) || sides[0] < 1 || sides[0] > IRIS_SIDE_MAX || sides[1] < 1 ||
        sides[1] > IRIS_SIDE_MAX) {
        complain("--image-size", "WxH in pixels, not '%s'", text);
        return 0;
    }
    *size = (iris_size){sides[0], sides[1]};
    return 1;
}

/* Corners beside the board's points: one more view, of the file. */
static int add_view(session *s, char *file, const iris_vec2 *corners)
{
    iris_board_point *points = malloc(((size_t)s->points + 1) * sizeof *points);
    if (!points) {
        complain(file, "not enough memory");
        return 0;
    }
    for (int i = 0; i < s->points; i++) {
        points[i] = (iris_board_point){s->board[i], corners[i]};
    }
    s->files[s->count] = file;
    s->views[s->count++] = (iris_board_view){points, s->points};
    return 1;
}

/* No picture shows corners there; 0, and complains, when one is. */
static int check_list(const session *s, const char *name, const iris_vec2 *corners, const int *lines)
{
    const iris_size *size = &s->config.size;
    const int32_t w = size->w > 0 ? size->w : IRIS_SIDE_MAX, h = size->w > 0 ? size->h : IRIS_SIDE_MAX;
    for (int i = 0; i < s->points; i++) {
        const iris_vec2 at = corners[i];
        const int inside = at.x >= -IRIS_Q32_ONE && at.x <= w * IRIS_Q32_ONE && at.y >= -IRIS_Q32_ONE &&
                           at.y <= h * IRIS_Q32_ONE;
        if (!inside && (size->w > 0 || at.x < -w * IRIS_Q32_ONE || at.x > w * IRIS_Q32_ONE ||
                        at.y < -h * IRIS_Q32_ONE || at.y > h * IRIS_Q32_ONE)) {
            complain(
                name, "line %d: no corner of a picture%s is at %.6g %.6g: correct it, or leave this view out",
                lines[i], size->w > 0 ? " of --image-size" : "", calibrate_real(at.x), calibrate_real(at.y));
            return 0;
        }
    }
    return 1;
}

static int take_list(session *s, char *name, const iris_vec2 *corners, const int *lines)
{
    if (s->count == IRIS_BOARD_VIEWS_MAX) {
        complain(name, "more than %d views in all", IRIS_BOARD_VIEWS_MAX);
        return 0;
    }
    return check_list(s, name, corners, lines) && add_view(s, name, corners);
}

/* One list or several of a file, each of as many corners as the board has. */
static int read_list(session *s, char *file)
{
    static iris_vec2 corners[POINTS * IRIS_BOARD_VIEWS_MAX];
    static int lines[POINTS * IRIS_BOARD_VIEWS_MAX];
    number_table table = {&corners[0].x, lines, 0, POINTS * IRIS_BOARD_VIEWS_MAX, 2};
    if (!number_file_read(&table, file)) {
        return 0;
    }
    if (s->points == 0 || table.rows == 0 || table.rows % s->points != 0) {
        complain(file, "%d corners, but the board has %d", table.rows, s->points);
        return 0;
    }
    const int lists = table.rows / s->points;
    for (int i = 0; i < lists; i++) {
        const size_t bytes = strlen(file) + 32;
        char *name = lists > 1 ? malloc(bytes) : file; /* until the program ends */
        if (name && lists > 1) {
            snprintf(name, bytes, "%s, list %d", file, i + 1);
        }
        if (!name || !take_list(s, name, corners + i * s->points, lines + i * s->points)) {
            if (lists > 1) {
                free(name);
            }
            return 0;
        }
    }
    return 1;
}

/* Finds the board in a picture. */
static int find_board(session *s, char *file, const iris_image *gray)
{
    static iris_vec2 corners[POINTS];
    iris_scratch scratch;
    const iris_size size = {gray->w, gray->h};
    const size_t bytes = board_option_bytes(&s->looked_for, size);
    if (s->config.size.w == 0) {
        s->config.size = size;
    }
    if (s->config.size.w != size.w || s->config.size.h != size.h) {
        complain(file, "%dx%d pixels, but the first picture has %dx%d: one camera is needed", (int)size.w,
                 (int)size.h, (int)s->config.size.w, (int)s->config.size.h);
        return 0;
    }
    void *memory = malloc(bytes);
    if (!memory) {
        complain(file, "not enough memory");
        return 0;
    }
    int found = iris_scratch_init(&scratch, memory, bytes) == IRIS_OK &&
                board_option_find(corners, &s->looked_for, gray, &scratch, file) == EXIT_DONE &&
                add_view(s, file, corners);
    free(memory);
    return found;
}

static int read_picture(session *s, char *file)
{
    static frame_reader reader;
    picture_buffer picture = {0};
    iris_status status = frame_reader_open(&reader, file);
    status = status == IRIS_OK ? frame_reader_next(&reader, &picture, IRIS_GRAY8) : status;
    frame_reader_close(&reader);
    if (status != IRIS_OK) {
        complain(file, "%s", frame_reader_problem(&reader));
    }
    int found = status == IRIS_OK && find_board(s, file, &picture.image);
    picture_free(&picture);
    return found;
}

static void complain_flaw(const session *s)
{
    static const char *const said[] = {
        [IRIS_BOARD_FINE] = "",
        [IRIS_BOARD_TOO_FEW] = "too few views, or corners in them, for so many parameters",
        [IRIS_BOARD_IN_LINE] = "the corners are on one line, or at fewer than four places",
        [IRIS_BOARD_FACING] = "the board faces the camera in all views: tilt it, by 30 degrees or more",
        [IRIS_BOARD_BEHIND] = "no camera sees the corners so: are they in the board's order?"};
    if (s->fit.flaw == IRIS_BOARD_FACING && s->count == 1) {
        complain(s->files[0],
                 "one view, in which the board is tilted little, is too few: add views that tilt it by "
                 "30 degrees or more, this way and that");
        return;
    }
    complain(s->fit.flawed >= 0 ? s->files[s->fit.flawed] : NULL, "%s", said[s->fit.flaw]);
}

/* What is to be said against the result: sentences, one for each i from 0 on. 0: there are no more. */
static int verdict(char text[256], const session *s, int i)
{
    int n = 0;
    if (s->fit.remarks & IRIS_BOARD_COVERS_LITTLE && n++ == i) {
        snprintf(text, 256,
                 "the corners cover little of the picture (%d of 64 fields): the lens is a guess elsewhere",
                 (int)s->fit.fields);
        return 1;
    }
    if (s->fit.remarks & IRIS_BOARD_TURNS_LITTLE && n++ == i) {
        snprintf(text, 256, "the board is tilted alike in all views: add views tilted to other sides");
        return 1;
    }
    if (s->fit.remarks & IRIS_BOARD_LOOSE && n++ == i) {
        snprintf(text, 256, "the focal lengths are uncertain by %.2g %%: add views that tilt the board more",
                 100 * calibrate_real(s->fit.deviations[IRIS_BOARD_ALPHA_U]) /
                     calibrate_real(s->fit.intrinsics.alpha_u));
        return 1;
    }
    for (int32_t v = 0; v < s->count; v++) {
        if (s->places[v].rms > 3 * s->fit.rms && n++ == i) {
            snprintf(text, 256, "%.120s does not fit the other views: %.2f px", s->files[v],
                     calibrate_real(s->places[v].rms));
            return 1;
        }
    }
    return 0;
}

static const char *const NAMES[IRIS_BOARD_PARAMETERS] = {"fx", "fy", "skew", "u0", "v0",
                                                         "k1", "k2", "k3",   "p1", "p2"};

static void values_of(iris_q32 values[IRIS_BOARD_PARAMETERS], const iris_board_fit *fit)
{
    const iris_intrinsics *k = &fit->intrinsics;
    const iris_lens *l = &fit->lens;
    const iris_q32 all[IRIS_BOARD_PARAMETERS] = {k->alpha_u, k->alpha_v, k->shear, k->u0, k->v0,
                                                 l->k1,      l->k2,      l->k3,    l->p1, l->p2};
    memcpy(values, all, sizeof all);
}

static void print_view_json(json_writer *json, const session *s, int32_t v)
{
    const iris_pose *pose = &s->places[v].pose;
    const iris_vec3 turn = iris_rotation_to_vector(&pose->turn);
    const iris_vec3 shift = iris_pose_into(pose, (iris_vec3){0, 0, 0});
    json_open(json, '{');
    json_key(json, "file");
    json_string(json, s->files[v]);
    calibrate_number(json, "rms_px", s->places[v].rms);
    calibrate_numbers(json, "turn", (const iris_q32[3]){turn.x, turn.y, turn.z}, 1, 3);
    calibrate_numbers(json, "shift", (const iris_q32[3]){shift.x, shift.y, shift.z}, 1, 3);
    json_key(json, "corners");
    json_open(json, '[');
    for (int i = 0; i < s->points; i++) {
        json_open(json, '[');
        json_number(json, calibrate_real(s->views[v].points[i].image.x), 4);
        json_number(json, calibrate_real(s->views[v].points[i].image.y), 4);
        json_close(json, ']');
    }
    json_close(json, ']');
    json_close(json, '}');
}

static void print_json(const session *s)
{
    char text[256];
    iris_q32 values[IRIS_BOARD_PARAMETERS];
    json_writer json = json_to(stdout);
    values_of(values, &s->fit);
    json_open(&json, '{');
    for (int k = 0; k < IRIS_BOARD_PARAMETERS; k++) {
        calibrate_number(&json, NAMES[k], values[k]);
    }
    calibrate_number(&json, "rms_px", s->fit.rms);
    json_key(&json, "deviations");
    json_open(&json, '{');
    for (int k = 0; k < IRIS_BOARD_PARAMETERS; k++) {
        if (s->fit.deviations[k] > 0) {
            calibrate_number(&json, NAMES[k], s->fit.deviations[k]);
        } else {
            json_key(&json, NAMES[k]);
            json_null(&json);
        }
    }
    json_close(&json, '}');
    json_key(&json, "verdict");
    json_open(&json, '[');
    for (int i = 0; verdict(text, s, i); i++) {
        json_string(&json, text);
    }
    json_close(&json, ']');
    json_key(&json, "views");
    json_open(&json, '[');
    for (int32_t v = 0; v < s->count; v++) {
        print_view_json(&json, s, v);
    }
    json_close(&json, ']');
    json_close(&json, '}');
}

static void print_text(const session *s)
{
    char text[256];
    iris_q32 values[IRIS_BOARD_PARAMETERS];
    values_of(values, &s->fit);
    printf("%d views, off by %.4f pixels (root mean square)\n", (int)s->count, calibrate_real(s->fit.rms));
    for (int k = 0; k < IRIS_BOARD_PARAMETERS; k++) {
        if (s->fit.deviations[k] > 0) {
            printf("%-5s %12.6g  +- %.2g\n", NAMES[k], calibrate_real(values[k]),
                   calibrate_real(s->fit.deviations[k]));
        }
    }
    for (int32_t v = 0; v < s->count; v++) {
        one_line(stdout, s->files[v]);
        printf(": %.4f pixels, center %.1f %s away\n", calibrate_real(s->places[v].rms),
               calibrate_real(iris_vec3_length(
                   iris_vec3_sub(s->places[v].pose.place, (iris_vec3){s->board[0].x, s->board[0].y, 0}))),
               *s->unit ? s->unit : "units");
    }
    for (int i = 0; verdict(text, s, i); i++) {
        one_line(stdout, text);
        printf("\n");
    }
    if (!verdict(text, s, 0)) {
        printf("good: nothing is to be said against it\n");
    }
}

/* The camera file, with how good it is in its comments. */
static int write_camera(FILE *file, const void *user)
{
    const session *s = user;
    const iris_camera_model model = {s->config.size, s->fit.intrinsics, s->fit.lens};
    char text[IRIS_CAMERA_TEXT_BYTES], said[256];
    size_t length = 0;
    if (iris_camera_write_text(text, sizeof text, &length, &model) != IRIS_OK) {
        return 0;
    }
    fputs(text, file);
    fprintf(file, "\n# %d views, off by %.4f pixels (root mean square)\n", (int)s->count,
            calibrate_real(s->fit.rms));
    for (int i = 0; verdict(said, s, i); i++) {
        fputs("# ", file);
        one_line(file, said);
        fputs("\n", file);
    }
    return !ferror(file) && fflush(file) == 0;
}

static int print(const session *s, const char *output, int json)
{
    if (output && !file_write(output, write_camera, s)) {
        return EXIT_BAD_DATA;
    }
    if (json) {
        print_json(s);
    } else if (!output || strcmp(output, "-") != 0) {
        print_text(s);
    }
    return EXIT_DONE;
}

static int calibrate(session *s, const char *output, int json)
{
    static IRIS_SCRATCH_BUFFER(memory, IRIS_BOARD_SCRATCH_BYTES(IRIS_BOARD_VIEWS_MAX));
    iris_scratch scratch;
    (void)iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    if (iris_board_calibrate(&s->fit, s->places, s->views, s->count, &s->config, &scratch) != IRIS_OK) {
        complain_flaw(s);
        return EXIT_BAD_DATA;
    }
    return print(s, output, json);
}

/* Of lists of corners all must be good; pictures without the board are left out. */
static int run(session *s, input_list *inputs, int corners, const texts *given, int json)
{
    int bad = 0, exit_code = EXIT_BAD_DATA;
    s->count = 0;
    for (int i = 0; i < inputs->count && !(bad && corners); i++) {
        if (!corners) {
            progress_show("calibrate", i + 1, inputs->count, inputs->paths[i]);
        }
        bad |= !(corners ? read_list(s, inputs->paths[i]) : read_picture(s, inputs->paths[i]));
    }
    progress_clear();
    if (s->count > 0 && !(bad && corners)) {
        exit_code = calibrate(s, given->output, json);
    }
    for (int32_t v = 0; v < s->count; v++) {
        free((void *)(uintptr_t)s->views[v].points);
    }
    return bad ? EXIT_BAD_DATA : exit_code;
}

/* The board, and the inputs it is seen in. Returns an exit code. */
static int prepare(session *s, const texts *given, const arguments *args, int corners)
{
    if (given->output && corners && !given->size) {
        complain("-o", "the size of the pictures is needed, too: --image-size WxH");
        return EXIT_BAD_CALL;
    }
    if (!read_model(&s->config.model, given->model) ||
        (given->size && !read_size(&s->config.size, given->size))) {
        return EXIT_BAD_CALL;
    }
    if (args->operand_count < 1) {
        complain(
            NULL,
            "board takes pictures, or lists of corners behind --corners (see iris calibrate board --help)");
        return EXIT_BAD_CALL;
    }
    if (!corners && given->points) {
        complain("--points", "only with lists of corners: --corners FILE...");
        return EXIT_BAD_CALL;
    }
    if (!corners && given->board && !board_option_read(&s->looked_for, given->board)) {
        return EXIT_BAD_CALL;
    }
    const board_texts board = {given->board, given->square, given->points};
    return board_points_read(s->board, &s->points, &s->unit, &s->looked_for, &board);
}

int calibrate_board(int argc, char **argv)
{
    static session s;
    texts given = {.model = "k3,tangential"};
    int json = 0, corners = 0;
    const args_option options[] = {{"board", 0, NULL, &given.board},
                                   {"square", 0, NULL, &given.square},
                                   {"points", 0, NULL, &given.points},
                                   {"model", 0, NULL, &given.model},
                                   {"corners", 0, &corners, NULL},
                                   {"circles", 0, &s.looked_for.circles, NULL},
                                   {"shifted-circles", 0, &s.looked_for.shifted, NULL},
                                   {"image-size", 0, NULL, &given.size},
                                   {"output", 'o', NULL, &given.output},
                                   {"json", 0, &json, NULL}};
    arguments args = {help, options, sizeof options / sizeof options[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    if (given.output && json && strcmp(given.output, "-") == 0) {
        complain("-o", "not to standard output together with --json");
        return EXIT_BAD_CALL;
    }
    exit_code = prepare(&s, &given, &args, corners);
    if (exit_code != EXIT_DONE) {
        return exit_code;
    }
    input_list inputs;
    exit_code = inputs_expand(&inputs, args.operand_count, args.operands);
    if (inputs.count > IRIS_BOARD_VIEWS_MAX) {
        complain(NULL, "%d views: at most %d", inputs.count, IRIS_BOARD_VIEWS_MAX);
        exit_code = EXIT_BAD_CALL;
    } else {
        const int done = run(&s, &inputs, corners, &given, json);
        exit_code = done == EXIT_DONE ? exit_code : done;
    }
    inputs_free(&inputs);
    return exit_code;
}
