/* iris calibrate pair. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "args.h"
#include "board_points.h"
#include "calibrate.h"
#include "calibrate_json.h"
#include "camera_file.h"
#include "complain.h"
#include "iris/3d/calib_pair.h"
#include "number_file.h"
#include "one_line.h"
#include "system.h"

static const char help[] =
    "usage: iris calibrate pair (--board CxR [--square SIZE] | --points FILE)\n"
    "                           (--left CAMERA --right CAMERA | --image-size WxH) [--json] [-o PAIR]\n"
    "                           --corners-left FILE... --corners-right FILE...\n\n"
    "How two cameras stand to each other, from views of a board that both see at the same time: the right\n"
    "camera's turn and place, as the left one has them, and how well they are known.\n\n"
    "  --board CxR      inner corners in a row, and rows: 9x6\n"
    "  --square SIZE    of the board's squares: 25mm, 2.5cm, 0.025m, 1in, or 25 of no unit. Default: "
    "1\n" BOARD_OPTION_HELP "  --points FILE    any other board: a point per line, x y, in any unit\n"
    "  --corners-left FILE...\n"
    "  --corners-right FILE...\n"
    "                   lists of corners (iris corners), a list for each view in the same order: x y in\n"
    "                   pixels, in the board's order, row by row\n"
    "  --left CAMERA    the cameras: files of iris calibrate board\n"
    "  --right CAMERA\n"
    "  --image-size WxH of the pictures of both: without camera files each is calibrated first, from the\n"
    "                   same lists\n"
    "  --json           one JSON object\n"
    "  -o PAIR          writes a pair file, for iris rectify and iris stereo. -: to standard output, and\n"
    "                   nothing else\n\n"
    "JSON has R (3 x 3) and t, with which a place X before the left camera is R X + t before the right one;\n"
    "turn (the vector of R, radians), place (of the right camera), baseline (their distance), rms_px,\n"
    "deviations (standard ones, of turn and place), verdict (a list of sentences; empty: nothing is to be\n"
    "said against it), and views: left, right, left_px and right_px, how far off they are.\n\n"
    "example: iris calibrate pair --board 9x6 --square 25mm --left left.camera --right right.camera\n"
    "                 --corners-left left*_corners.txt --corners-right right*_corners.txt -o rig.pair\n";

#define POINTS BOARD_OPTION_POINTS

typedef struct {
    char *files[2][IRIS_BOARD_VIEWS_MAX];
    int32_t counts[2];
    iris_pair_view views[IRIS_BOARD_VIEWS_MAX];
    iris_pair_place places[IRIS_BOARD_VIEWS_MAX];
    board_option looked_for;
    iris_vec2 board[POINTS];
    int points;
    const char *unit;
    iris_camera_model cameras[2];
    int doubtful[2]; /* has been calibrated here, and something is to be said against it */
    iris_pair_fit fit;
} session;

typedef struct {
    board_texts board;
    const char *cameras[2], *size, *output;
} texts;

/* --- the call --- */

/* Takes the lists of files out of the words; the others stay, *argc of them. */
static int take_lists(session *s, int *argc, char **argv)
{
    static const char *const names[2] = {"--corners-left", "--corners-right"};
    int side = -1, kept = 1;
    for (int i = 1; i < *argc; i++) {
        const int is_option = argv[i][0] == '-' && argv[i][1] != '\0';
        if (is_option) {
            side = strcmp(argv[i], names[0]) == 0 ? 0 : strcmp(argv[i], names[1]) == 0 ? 1 : -1;
        }
        if (side < 0) {
            argv[kept++] = argv[i];
        } else if (!is_option) {
            if (s->counts[side] == IRIS_BOARD_VIEWS_MAX) {
                complain(names[side], "%d lists of corners at most", IRIS_BOARD_VIEWS_MAX);
                return 0;
            }
            s->files[side][s->counts[side]++] = argv[i];
        }
    }
    *argc = kept;
    return 1;
}

static int check_call(const session *s, const texts *given, int operands, int json)
{
    if (operands > 0 || s->counts[0] < 1 || s->counts[1] != s->counts[0]) {
        complain(NULL,
                 "a list of corners is needed for each view of each camera: --corners-left FILE... "
                 "--corners-right FILE..., not %d and %d",
                 (int)s->counts[0], (int)s->counts[1]);
        return 0;
    }
    if (!given->cameras[0] != !given->cameras[1] || !given->cameras[0] == !given->size) {
        complain(NULL, "the cameras are needed once: --left CAMERA --right CAMERA, or --image-size WxH");
        return 0;
    }
    if (json && given->output && strcmp(given->output, "-") == 0) {
        complain("-o", "not to standard output together with --json");
        return 0;
    }
    return 1;
}

/* --- what is read --- */

static int read_list(iris_vec2 *corners, const session *s, const char *file)
{
    number_table table = {&corners[0].x, NULL, 0, POINTS, 2};
    if (!number_file_read(&table, file)) {
        return 0;
    }
    if (table.rows != s->points) {
        complain(file, "%d corners, but the board has %d", table.rows, s->points);
        return 0;
    }
    return 1;
}

static int read_views(session *s)
{
    static iris_vec2 corners[2][POINTS];
    for (int32_t v = 0; v < s->counts[0]; v++) {
        iris_pair_point *points = malloc(((size_t)s->points + 1) * sizeof *points);
        s->views[v] = (iris_pair_view){points, s->points};
        if (!points) {
            complain(s->files[0][v], "not enough memory");
            return 0;
        }
        if (!read_list(corners[0], s, s->files[0][v]) || !read_list(corners[1], s, s->files[1][v])) {
            return 0;
        }
        for (int i = 0; i < s->points; i++) {
            points[i] = (iris_pair_point){s->board[i], corners[0][i], corners[1][i]};
        }
    }
    return 1;
}

static void free_points(session *s)
{
    for (int32_t v = 0; v < s->counts[0]; v++) {
        free((void *)(uintptr_t)s->views[v].points);
    }
}

/* One camera from the same lists. */
static int find_camera(session *s, int side, iris_board_view *views)
{
    static IRIS_SCRATCH_BUFFER(memory, IRIS_BOARD_SCRATCH_BYTES(IRIS_BOARD_VIEWS_MAX));
    static iris_board_place places[IRIS_BOARD_VIEWS_MAX];
    static const char *const names[2] = {"left", "right"};
    const iris_board_config config = {IRIS_BOARD_K3 | IRIS_BOARD_TANGENTIAL, s->cameras[side].size};
    iris_scratch scratch;
    iris_board_fit fit;
    (void)iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    if (iris_board_calibrate(&fit, places, views, s->counts[0], &config, &scratch) != IRIS_OK) {
        complain(fit.flawed >= 0 ? s->files[side][fit.flawed] : NULL,
                 "the %s camera is not determined by its lists (see iris calibrate board --help)",
                 names[side]);
        return 0;
    }
    s->cameras[side].intrinsics = fit.intrinsics;
    s->cameras[side].lens = fit.lens;
    s->doubtful[side] = fit.remarks != 0;
    return 1;
}

static int find_cameras(session *s, const char *size)
{
    static iris_board_view views[IRIS_BOARD_VIEWS_MAX];
    const int32_t count = s->counts[0];
    int32_t sides[2];
    if (!args_numbers(sides, 2, 'x', size) || sides[0] < 1 || sides[0] > IRIS_SIDE_MAX || sides[1] < 1 ||
        sides[1] > IRIS_SIDE_MAX) {
        complain("--image-size", "WxH in pixels, not '%s'", size);
        return EXIT_BAD_CALL;
    }
    iris_board_point *all = malloc(((size_t)count * (size_t)s->points + 1) * sizeof *all);
    int found = all != NULL;
    if (!found) {
        complain(NULL, "not enough memory");
    }
    for (int side = 0; side < 2 && found; side++) {
        for (int32_t v = 0; v < count; v++) {
            iris_board_point *points = all + (size_t)v * (size_t)s->points;
            for (int i = 0; i < s->points; i++) {
                const iris_pair_point *p = &s->views[v].points[i];
                points[i] = (iris_board_point){p->board, side ? p->right : p->left};
            }
            views[v] = (iris_board_view){points, s->points};
        }
        s->cameras[side].size = (iris_size){sides[0], sides[1]};
        found = find_camera(s, side, views);
    }
    free(all);
    return found ? EXIT_DONE : EXIT_BAD_DATA;
}

/* --- what is told --- */

static void complain_flaw(const session *s)
{
    static const char *const said[] = {
        [IRIS_PAIR_FINE] = "",
        [IRIS_PAIR_TOO_FEW] = "four corners are needed at least",
        [IRIS_PAIR_NO_RAY] = "a corner where the camera, by its file, cannot show one: is it of this camera?",
        [IRIS_PAIR_IN_LINE] = "the corners are on one line, or at fewer than four places",
        [IRIS_PAIR_BEHIND] = "no such cameras see the corners so: are they in the board's order?"};
    complain(s->fit.flawed >= 0 ? s->files[0][s->fit.flawed] : NULL, "%s", said[s->fit.flaw]);
}

static int compare(const void *a, const void *b)
{
    const double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

static double off_of(const session *s, int32_t v)
{
    const double left = calibrate_real(s->places[v].rms[0]), right = calibrate_real(s->places[v].rms[1]);
    return left > right ? left : right;
}

/* The median of the views' larger distances. */
static double usual_off(const session *s)
{
    static double sorted[IRIS_BOARD_VIEWS_MAX];
    for (int32_t v = 0; v < s->counts[0]; v++) {
        sorted[v] = off_of(s, v);
    }
    qsort(sorted, (size_t)s->counts[0], sizeof sorted[0], compare);
    return sorted[s->counts[0] / 2];
}

/* Sentences, one for each i from 0 on. 0: there are no more. */
static int verdict(char text[320], const session *s, int i)
{
    static const char *const names[2] = {"left", "right"};
    int n = 0;
    for (int k = 0; k < 2; k++) {
        if (s->doubtful[k] && n++ == i) {
            snprintf(
                text, 320,
                "the %s camera is not well known from these lists: iris calibrate board says of them why",
                names[k]);
            return 1;
        }
    }
    const iris_vec3 place = s->fit.right.place;
    if (place.x <= 0 && n++ == i) {
        snprintf(text, 320, "the left camera is on the right: iris rectify wants them interchanged");
        return 1;
    }
    if (place.x > 0 && (place.z > place.x || place.z < -place.x) && n++ == i) {
        snprintf(text, 320,
                 "one camera is rather before the other than beside it: iris rectify wants them beside");
        return 1;
    }
    if (s->fit.remarks & IRIS_PAIR_LOOSE && n++ == i) {
        snprintf(text, 320,
                 "the right camera's place is uncertain by more than 1 %% of its distance: add views");
        return 1;
    }
    if (s->fit.remarks & IRIS_PAIR_FAR_OFF && n++ == i) {
        snprintf(
            text, 320,
            "corners are off by more than a pixel: are these lists of the same moments, in the same order, "
            "and the cameras' files theirs?");
        return 1;
    }
    for (int32_t v = 0; v < s->counts[0]; v++) {
        if (off_of(s, v) > 3 * usual_off(s) && off_of(s, v) > 0.01 && n++ == i) {
            snprintf(text, 320, "%.120s and %.120s do not fit the other views: %.2f px", s->files[0][v],
                     s->files[1][v], off_of(s, v));
            return 1;
        }
    }
    return 0;
}

static void print_json(const session *s)
{
    char text[320];
    const iris_pair_fit *fit = &s->fit;
    const iris_vec3 turn = iris_rotation_to_vector(&fit->right.turn), place = fit->right.place;
    const iris_vec3 t = iris_pose_into(&fit->right, (iris_vec3){0, 0, 0});
    json_writer json = json_to(stdout);
    json_open(&json, '{');
    calibrate_numbers(&json, "R", fit->right.turn.m, 3, 3);
    calibrate_numbers(&json, "t", (const iris_q32[3]){t.x, t.y, t.z}, 1, 3);
    calibrate_numbers(&json, "turn", (const iris_q32[3]){turn.x, turn.y, turn.z}, 1, 3);
    calibrate_numbers(&json, "place", (const iris_q32[3]){place.x, place.y, place.z}, 1, 3);
    calibrate_number(&json, "baseline", fit->baseline);
    calibrate_number(&json, "rms_px", fit->rms);
    json_key(&json, "deviations");
    json_open(&json, '{');
    calibrate_numbers(&json, "turn", fit->deviations, 1, 3);
    calibrate_numbers(&json, "place", fit->deviations + 3, 1, 3);
    json_close(&json, '}');
    json_key(&json, "verdict");
    json_open(&json, '[');
    for (int i = 0; verdict(text, s, i); i++) {
        json_string(&json, text);
    }
    json_close(&json, ']');
    json_key(&json, "views");
    json_open(&json, '[');
    for (int32_t v = 0; v < s->counts[0]; v++) {
        json_open(&json, '{');
        json_key(&json, "left");
        json_string(&json, s->files[0][v]);
        json_key(&json, "right");
        json_string(&json, s->files[1][v]);
        calibrate_number(&json, "left_px", s->places[v].rms[0]);
        calibrate_number(&json, "right_px", s->places[v].rms[1]);
        json_close(&json, '}');
    }
    json_close(&json, ']');
    json_close(&json, '}');
}

static void print_text(const session *s)
{
    static const char *const names[6] = {"turn x", "turn y", "turn z", "place x", "place y", "place z"};
    const iris_pair_fit *fit = &s->fit;
    const iris_vec3 turn = iris_rotation_to_vector(&fit->right.turn), place = fit->right.place;
    const iris_q32 values[6] = {turn.x, turn.y, turn.z, place.x, place.y, place.z};
    const char *unit = *s->unit ? s->unit : "units";
    char text[320];
    printf("%d views, off by %.4f pixels (root mean square)\n", (int)s->counts[0], calibrate_real(fit->rms));
    for (int k = 0; k < 6; k++) {
        const double scale = k < 3 ? 57.295779513 : 1;
        printf("%-8s %12.6g  +- %.2g %s\n", names[k], scale * calibrate_real(values[k]),
               scale * calibrate_real(fit->deviations[k]), k < 3 ? "degrees" : unit);
    }
    printf("the cameras are %.6g %s apart\n", calibrate_real(fit->baseline), unit);
    for (int32_t v = 0; v < s->counts[0]; v++) {
        one_line(stdout, s->files[0][v]);
        printf(", ");
        one_line(stdout, s->files[1][v]);
        printf(": %.4f and %.4f pixels\n", calibrate_real(s->places[v].rms[0]),
               calibrate_real(s->places[v].rms[1]));
    }
    for (int i = 0; verdict(text, s, i); i++) {
        one_line(stdout, text);
        printf("\n");
    }
    if (!verdict(text, s, 0)) {
        printf("good: nothing is to be said against it\n");
    }
}

static int tell(const session *s, const char *output, int json)
{
    const iris_pair pair = {
        {s->cameras[0], s->cameras[1]}, iris_rotation_to_vector(&s->fit.right.turn), s->fit.right.place};
    if (output && !pair_file_write(output, &pair)) {
        return EXIT_BAD_DATA;
    }
    if (json) {
        print_json(s);
    } else if (!output || strcmp(output, "-") != 0) {
        print_text(s);
    }
    return EXIT_DONE;
}

static int run(session *s, const char *output, int json)
{
    const size_t points = (size_t)s->counts[0] * (size_t)s->points;
    const size_t bytes = IRIS_PAIR_SCRATCH_BYTES(s->counts[0], points);
    void *memory = system_scratch(bytes);
    iris_sensor cameras[2];
    iris_scratch scratch;
    for (int k = 0; k < 2; k++) {
        cameras[k] = (iris_sensor){.intrinsics = s->cameras[k].intrinsics, .lens = s->cameras[k].lens};
    }
    iris_status status = memory ? iris_scratch_init(&scratch, memory, bytes) : IRIS_ERR_SCRATCH;
    if (status == IRIS_OK) {
        status = iris_pair_calibrate(&s->fit, s->places, s->views, s->counts[0], cameras, &scratch);
    }
    free(memory);
    if (status == IRIS_ERR_DATA) {
        complain_flaw(s);
    } else if (status != IRIS_OK) {
        complain(NULL, "%s", iris_status_text(status));
    } else if (s->fit.remarks & IRIS_PAIR_ONE_PLACE) {
        complain(NULL, "the cameras are at one place, as far as can be told: set them apart to see depth");
        status = IRIS_ERR_DATA;
    }
    return status == IRIS_OK ? tell(s, output, json) : EXIT_BAD_DATA;
}

int calibrate_pair(int argc, char **argv)
{
    static session s;
    texts given = {.size = NULL};
    int json = 0;
    const args_option options[] = {
        {"board", 0, NULL, &given.board.board},      {"square", 0, NULL, &given.board.square},
        {"points", 0, NULL, &given.board.points},    {"left", 0, NULL, &given.cameras[0]},
        {"right", 0, NULL, &given.cameras[1]},       {"image-size", 0, NULL, &given.size},
        {"output", 'o', NULL, &given.output},        {"json", 0, &json, NULL},
        {"circles", 0, &s.looked_for.circles, NULL}, {"shifted-circles", 0, &s.looked_for.shifted, NULL}};
    if (!take_lists(&s, &argc, argv)) {
        return EXIT_BAD_CALL;
    }
    arguments args = {help, options, sizeof options / sizeof options[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    exit_code = check_call(&s, &given, args.operand_count, json) ? EXIT_DONE : EXIT_BAD_CALL;
    if (exit_code == EXIT_DONE) {
        exit_code = board_points_read(s.board, &s.points, &s.unit, &s.looked_for, &given.board);
    }
    for (int k = 0; k < 2 && exit_code == EXIT_DONE && given.cameras[0]; k++) {
        exit_code = camera_file_read(&s.cameras[k], given.cameras[k]) ? EXIT_DONE : EXIT_BAD_DATA;
    }
    if (exit_code == EXIT_DONE) {
        exit_code = read_views(&s) ? EXIT_DONE : EXIT_BAD_DATA;
    }
    if (exit_code == EXIT_DONE && !given.cameras[0]) {
        exit_code = find_cameras(&s, given.size);
    }
    if (exit_code == EXIT_DONE) {
        exit_code = run(&s, given.output, json);
    }
    free_points(&s);
    return exit_code;
}
