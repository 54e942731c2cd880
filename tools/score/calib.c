/* Calibration: cameras from known points, beside what others found in the same data. */
#include <math.h>
#include <stdlib.h>

#include "iris/3d/board_find.h"
#include "iris/3d/calib_board.h"
#include "iris/3d/calib_scene.h"
#include "picture.h"
#include "score.h"

static double real(iris_q32 a)
{
    return (double)a / 4294967296.0;
}

/* At most `room` numbers of a file, those behind a # left out. -1: there is none. */
static int read_numbers(iris_q32 *numbers, int room, const char *name)
{
    FILE *file = data_open(name);
    char word[64];
    int count = 0;
    while (file && count < room && fscanf(file, "%63s", word) == 1) {
        if (word[0] == '#') {
            (void)fscanf(file, "%*[^\n]");
        } else {
            numbers[count++] = (iris_q32)llround(strtod(word, NULL) * 4294967296.0);
        }
    }
    if (file) {
        fclose(file);
    }
    return file ? count : -1;
}

static double away(const iris_scene_camera *camera, const iris_q32 place[3])
{
    iris_vec3 truth = {place[0], place[1], place[2]};
    return real(iris_vec3_length(iris_vec3_sub(camera->sensor.pose.place, truth)));
}

static void score_scene(score *s)
{
    static const char what[] = "camera from 20 known points, linear: sum of distances";
    static IRIS_SCRATCH_BUFFER(memory, IRIS_SCENE_SCRATCH_BYTES(20));
    iris_q32 space[60], image[40], truth[15];
    iris_scene_point points[20];
    uint8_t used[20];
    iris_scene_fit fit;
    iris_scratch scratch;
    if (read_numbers(space, 60, "calib/scene3d/pts3d-norm.txt") != 60 ||
        read_numbers(image, 40, "calib/scene3d/pts2d-norm-pic_a.txt") != 40 ||
        read_numbers(truth, 15, "calib/scene3d/expected.txt") != 15) {
        score_row(s, what, "at most 0.0446", SCORE_SKIPPED, "no data (IRIS_DATA)");
        return;
    }
    for (int i = 0; i < 20; i++) {
        points[i] = (iris_scene_point){{space[3 * i], space[3 * i + 1], space[3 * i + 2]},
                                       {image[2 * i], image[2 * i + 1]}};
    }
    (void)iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    int good = iris_scene_calibrate(&fit, used, points, 20, &scratch) == IRIS_OK && fit.left_out == 0;
    if (!good) {
        score_row(s, what, "at most 0.0446", SCORE_MISSED, "flaw %d, %d points left out", (int)fit.flaw,
                  (int)fit.left_out);
        return;
    }
    score_row(s, what, "at most 0.0446", score_if(real(fit.linear.total) <= 0.0446), "%.6f; refined %.6f",
              real(fit.linear.total), real(fit.refined.total));
    score_row(s, "the same: its center", "within 0.001", score_if(away(&fit.linear, truth + 12) <= 0.001),
              "%.6f off; refined, by other errors, %.6f", away(&fit.linear, truth + 12),
              away(&fit.refined, truth + 12));
}

#define VIEWS  13
#define POINTS 256

/* The board's points, and those of the views' files: how many views there are. */
static int read_views(iris_board_view *views, const iris_q32 *board, int points, const char *format, int most)
{
    static iris_board_point all[VIEWS][POINTS];
    static iris_q32 numbers[2 * POINTS];
    int count = 0;
    for (int i = 1; i <= most && count < VIEWS; i++) {
        char name[64];
        snprintf(name, sizeof name, format, i);
        if (read_numbers(numbers, 2 * points, name) == 2 * points) {
            for (int k = 0; k < points; k++) {
                all[count][k] = (iris_board_point){{board[2 * k], board[2 * k + 1]},
                                                   {numbers[2 * k], numbers[2 * k + 1]}};
            }
            views[count] = (iris_board_view){all[count], points};
            count++;
        }
    }
    return count;
}

static int fit_board(iris_board_fit *fit, const iris_board_view *views, int count, uint32_t model)
{
    static IRIS_SCRATCH_BUFFER(memory, IRIS_BOARD_SCRATCH_BYTES(VIEWS));
    static iris_board_place places[VIEWS];
    const iris_board_config config = {model, {640, 480}};
    iris_scratch scratch;
    (void)iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    return iris_board_calibrate(fit, places, views, count, &config, &scratch) == IRIS_OK;
}

static int is_near(iris_q32 found, double wanted, double most)
{
    return fabs(real(found) - wanted) <= most;
}

static void score_zhang(score *s)
{
    static const char what[] = "Zhang's five views: focal lengths, published 832.5 and 832.53";
    static iris_q32 board[2 * POINTS];
    iris_board_view views[VIEWS];
    iris_board_fit fit;
    if (read_numbers(board, 2 * POINTS, "calib/zhang/Model.txt") != 2 * POINTS ||
        read_views(views, board, POINTS, "calib/zhang/data%d.txt", 5) != 5) {
        score_row(s, what, "within 0.1 %", SCORE_SKIPPED, "no data (IRIS_DATA)");
        return;
    }
    int good = fit_board(&fit, views, 5, IRIS_BOARD_SHEAR);
    const iris_intrinsics k = fit.intrinsics;
    score_row(s, what, "within 0.1 %",
              score_if(good && is_near(k.alpha_u, 832.5, 0.8325) && is_near(k.alpha_v, 832.53, 0.8325)),
              "%.3f, %.3f", real(k.alpha_u), real(k.alpha_v));
    score_row(s, "the same: principal point, published 303.959, 206.585", "within 0.5 px",
              score_if(good && is_near(k.u0, 303.959, 0.5) && is_near(k.v0, 206.585, 0.5)),
              "%.3f, %.3f; k1 %.5f, k2 %.5f (published -0.22860, 0.19035)", real(k.u0), real(k.v0),
              real(fit.lens.k1), real(fit.lens.k2));
    good = fit_board(&fit, views, 5, 0);
    score_row(s, "the same without skew: rms; 0.3369 px in double precision", "within 0.1 %",
              score_if(good && is_near(fit.rms, 0.3369, 0.0003369)), "%.5f px", real(fit.rms));
}

static void score_chessboard(score *s)
{
    static const char what[] = "chessboard, 13 lists of corners: rms; OpenCV's 0.1954 px";
    iris_q32 board[108];
    iris_board_view views[VIEWS];
    iris_board_fit fit;
    for (int i = 0; i < 54; i++) {
        board[2 * i] = i % 9 * 25 * IRIS_Q32_ONE;
        board[2 * i + 1] = i / 9 * 25 * IRIS_Q32_ONE;
    }
    if (read_views(views, board, 54, "calib/chessboard/left%02d_corners.txt", 14) != VIEWS) {
        score_row(s, what, "within 1 %", SCORE_SKIPPED, "no data (IRIS_DATA)");
        return;
    }
    int good = fit_board(&fit, views, VIEWS, IRIS_BOARD_K3 | IRIS_BOARD_TANGENTIAL);
    score_row(s, what, "within 1 %", score_if(good && is_near(fit.rms, 0.195419, 0.00195)),
              "%.6f px; focal length %.3f (OpenCV 532.827)", real(fit.rms), real(fit.intrinsics.alpha_u));
}

#define SEEN 4 /* of the chessboard's pictures are there */

static const int seen_numbers[SEEN] = {1, 5, 8, 14};
static IRIS_SCRATCH_BUFFER(finder, IRIS_BOARD_CORNERS_SCRATCH_BYTES(640, 640, 9, 6));

/* Finds the 9x6 corners; 0 when they are not seen. */
static int find_corners(iris_vec2 corners[54], const iris_image *gray)
{
    const iris_board_grid grid = {9, 6};
    iris_board_report report;
    iris_scratch scratch;
    (void)iris_scratch_init(&scratch, finder.memory, sizeof finder.memory);
    return iris_board_corners(corners, &report, gray, &grid, &scratch) == IRIS_OK;
}

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* How far corners are from a list of them, from either end: the median. *most: the largest. */
static double median_off(double *most, const iris_vec2 corners[54], const iris_q32 list[108])
{
    double best = 1e9;
    for (int turn = 0; turn < 2; turn++) {
        double off[54];
        for (int k = 0; k < 54; k++) {
            const int at = turn ? 53 - k : k;
            off[k] = hypot(real(corners[k].x - list[2 * at]), real(corners[k].y - list[2 * at + 1]));
        }
        qsort(off, 54, sizeof off[0], compare_doubles);
        if (off[27] < best) {
            best = off[27];
            *most = off[53];
        }
    }
    return best;
}

/* All corners of the pictures that are there; what they are off the lists; and the camera they make. */
static void score_seen(score *s)
{
    static const char what[] = "chessboard, 4 pictures: corners found; median off OpenCV's lists";
    static const char needed[] = "all 54; at most 0.3 px";
    static iris_board_point points[SEEN][54];
    iris_vec2 corners[54];
    iris_q32 list[108];
    iris_board_view views[SEEN];
    int seen = 0;
    double median = 0, most = 0;
    for (int n = 0; n < SEEN; n++) {
        char name[64], list_name[64];
        iris_image gray;
        snprintf(name, sizeof name, "calib/chessboard/left%02d.pgm", seen_numbers[n]);
        snprintf(list_name, sizeof list_name, "calib/chessboard/left%02d_corners.txt", seen_numbers[n]);
        if (picture_load(&gray, name, IRIS_GRAY8) != IRIS_OK || read_numbers(list, 108, list_name) != 108) {
            free(gray.data);
            score_row(s, what, needed, SCORE_SKIPPED, "no data (IRIS_DATA)");
            return;
        }
        if (find_corners(corners, &gray)) {
            double largest = 0;
            median = fmax(median, median_off(&largest, corners, list));
            most = fmax(most, largest);
            for (int k = 0; k < 54; k++) {
                const iris_vec2 place = {k % 9 * 25 * IRIS_Q32_ONE, k / 9 * 25 * IRIS_Q32_ONE};
                points[seen][k] = (iris_board_point){place, corners[k]};
            }
            views[seen] = (iris_board_view){points[seen], 54};
            seen++;
        }
        free(gray.data);
    }
    score_row(s, what, needed, score_if(seen == SEEN && median <= 0.3),
              "in %d of 4; %.3f px in the worst picture, one corner %.3f", seen, median, most);
    iris_board_fit fit;
    int good = seen == SEEN && fit_board(&fit, views, seen, IRIS_BOARD_K3 | IRIS_BOARD_TANGENTIAL);
    score_row(s, "the same: the camera; OpenCV's lists of the 4 give rms 0.2016 px, focal length 534.7",
              "focal length within 1 %", score_if(good && is_near(fit.intrinsics.alpha_u, 534.718, 5.347)),
              "rms %.4f px, focal length %.3f", real(fit.rms), real(fit.intrinsics.alpha_u));
}

/* What a picture becomes: the noise of 20 levels is the sum of twelve random numbers. */
enum { HALVED, NOISY, DARK, BLURRED, TURNED, WORSE };

static double worse_level(const iris_image *from, int how, int x, int y)
{
    static uint32_t random = 1;
    double sum = 0;
    const int reach = how == BLURRED ? 4 : 0;
    for (int k = 0; k < (2 * reach + 1) * (2 * reach + 1); k++) {
        const int u = x + k % (2 * reach + 1) - reach, v = y + k / (2 * reach + 1) - reach;
        const uint8_t *row = iris_image_row(from, v < 0 ? 0 : v >= from->h ? from->h - 1 : v);
        sum += row[u < 0 ? 0 : u >= from->w ? from->w - 1 : u];
    }
    sum /= (2 * reach + 1) * (2 * reach + 1);
    for (int k = 0; how == NOISY && k < 12; k++) {
        random = random * 1664525u + 1013904223u;
        sum += 20 * (random / 4294967296.0 - 0.5);
    }
    return how == DARK ? sum / 5 : sum < 0 ? 0 : sum > 255 ? 255 : sum;
}

static iris_image made_worse(const iris_image *from, int how)
{
    const iris_size size = how == HALVED   ? (iris_size){from->w / 2, from->h / 2}
                           : how == TURNED ? (iris_size){from->h, from->w}
                                           : (iris_size){from->w, from->h};
    iris_image to = picture_make(size.w, size.h, IRIS_GRAY8);
    for (int y = 0; to.data && y < size.h; y++) {
        uint8_t *row = iris_image_row(&to, y);
        for (int x = 0; x < size.w; x++) {
            if (how == HALVED) {
                const uint8_t *a = iris_image_row(from, 2 * y), *b = iris_image_row(from, 2 * y + 1);
                row[x] = (uint8_t)((a[2 * x] + a[2 * x + 1] + b[2 * x] + b[2 * x + 1] + 2) / 4);
            } else {
                row[x] = (uint8_t)(how == TURNED ? worse_level(from, how, y, from->h - 1 - x)
                                                 : worse_level(from, how, x, y));
            }
        }
    }
    return to;
}

/* Where a corner of the picture goes. */
static void move_worse(iris_q32 list[108], int how, int32_t h)
{
    for (int k = 0; k < 54; k++) {
        const iris_q32 x = list[2 * k], y = list[2 * k + 1];
        list[2 * k] = how == HALVED   ? (x - IRIS_Q32_ONE / 2) / 2
                      : how == TURNED ? (h - 1) * IRIS_Q32_ONE - y
                                      : x;
        list[2 * k + 1] = how == HALVED ? (y - IRIS_Q32_ONE / 2) / 2 : how == TURNED ? x : y;
    }
}

/* The same pictures at half their size, with noise, darker, out of focus, and turned. */
static void score_worse(score *s)
{
    static const char what[] =
        "the same at half size, noise of 20, a fifth of the light, blurred 9x9, turned: found; off";
    int seen = 0, there = 0;
    double medians[WORSE] = {0};
    for (int n = 0; n < SEEN; n++) {
        char name[64], list_name[64];
        iris_vec2 corners[54];
        iris_q32 list[108];
        iris_image gray;
        snprintf(name, sizeof name, "calib/chessboard/left%02d.pgm", seen_numbers[n]);
        snprintf(list_name, sizeof list_name, "calib/chessboard/left%02d_corners.txt", seen_numbers[n]);
        int loaded = picture_load(&gray, name, IRIS_GRAY8) == IRIS_OK;
        for (int how = 0; loaded && how < WORSE && read_numbers(list, 108, list_name) == 108; how++) {
            iris_image worse = made_worse(&gray, how);
            double most = 0;
            there++;
            move_worse(list, how, gray.h);
            if (worse.data && find_corners(corners, &worse)) {
                seen++;
                medians[how] = fmax(medians[how], median_off(&most, corners, list));
            }
            free(worse.data);
        }
        free(gray.data);
    }
    if (there == 0) {
        score_row(s, what, "20 of 20", SCORE_SKIPPED, "no data (IRIS_DATA)");
        return;
    }
    score_row(s, what, "20 of 20", score_if(seen == there), "%d; medians %.2f, %.2f, %.2f, %.2f, %.2f px",
              seen, medians[HALVED], medians[NOISY], medians[DARK], medians[BLURRED], medians[TURNED]);
}

void score_calib(score *s)
{
    score_scene(s);
    score_zhang(s);
    score_chessboard(s);
    score_seen(s);
    score_worse(s);
}
