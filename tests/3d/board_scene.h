/* Boards as a camera with a lens sees them, in double precision: pictures, and where their points are. */
#ifndef IRIS_TEST_BOARD_SCENE_H
#define IRIS_TEST_BOARD_SCENE_H

#include <math.h>

#include "iris/image.h"
#include "random_number.h"

enum { SCENE_CHESS, SCENE_CIRCLES, SCENE_SHIFTED };

/* The board is the plane z = 0 with points 1 apart from 0, 0 on; turn and shift bring it to the camera, whose picture
 * has its middle in the middle. Places in the picture, from there and divided by focal, are (1 + bend r^2) times
 * shorter than the lens shows them: so a pixel's place on the board is a formula. */
typedef struct {
    int kind, columns, rows;
    double turn[9], shift[3], focal, bend, middle[2];
    double radius;       /* of circles */
    double dark, bright; /* levels */
    double border;       /* width of the bright rim around the squares */
    int w, h;            /* of the picture */
    int clutter;         /* what is around the board: 0 gray, 1 stripes, squares, and dots */
} board_scene;

static inline double scene_random(double low, double high)
{
    return low + (high - low) * (double)(random_u64() >> 11) / 9007199254740992.0;
}

static inline void scene_multiply(double out[9], const double a[9], const double b[9])
{
    for (int i = 0; i < 9; i++) {
        out[i] = a[i / 3 * 3] * b[i % 3] + a[i / 3 * 3 + 1] * b[i % 3 + 3] + a[i / 3 * 3 + 2] * b[i % 3 + 6];
    }
}

/* The board turned in its plane by `roll`, then tilted by `tilt` about an axis in the picture plane. */
static inline void scene_turn(board_scene *s, double roll, double tilt, double axis)
{
    const double a[9] = {
        cos(roll - axis), -sin(roll - axis), 0, sin(roll - axis), cos(roll - axis), 0, 0, 0, 1};
    const double t[9] = {1, 0, 0, 0, cos(tilt), -sin(tilt), 0, sin(tilt), cos(tilt)};
    const double b[9] = {cos(axis), -sin(axis), 0, sin(axis), cos(axis), 0, 0, 0, 1};
    double half[9];
    scene_multiply(half, t, a);
    scene_multiply(s->turn, b, half);
}

/* Puts the board's middle on a ray through (x, y) pixels beside the picture's middle, `away` squares away. */
static inline void scene_place(board_scene *s, double x, double y, double away)
{
    const double mx = ((s->kind == SCENE_SHIFTED) * s->columns + s->columns - 1) / 2.0,
                 my = (s->rows - 1) / 2.0;
    const double at[3] = {x / s->focal * away, y / s->focal * away, away};
    for (int k = 0; k < 3; k++) {
        s->shift[k] = at[k] - s->turn[3 * k] * mx - s->turn[3 * k + 1] * my;
    }
}

/* Where a place of the board is in the picture. */
static inline void scene_show(double at[2], const board_scene *s, double x, double y)
{
    double c[3];
    for (int k = 0; k < 3; k++) {
        c[k] = s->turn[3 * k] * x + s->turn[3 * k + 1] * y + s->shift[k];
    }
    const double u = c[0] / c[2], v = c[1] / c[2], straight = sqrt(u * u + v * v);
    double r = straight;
    for (int k = 0; k < 50; k++) { /* r (1 + bend r^2) = straight */
        r -= (r * (1 + s->bend * r * r) - straight) / (1 + 3 * s->bend * r * r);
    }
    const double scale = straight > 0 ? r / straight : 1;
    at[0] = s->middle[0] + s->focal * u * scale;
    at[1] = s->middle[1] + s->focal * v * scale;
}

/* The place on the board of point k, row by row. */
static inline void scene_point(double at[2], const board_scene *s, int k)
{
    const int column = k % s->columns, row = k / s->columns;
    at[0] = s->kind == SCENE_SHIFTED ? 2 * column + (row & 1) : column;
    at[1] = row;
}

static inline board_scene scene_of(int kind, int columns, int rows, int w, int h)
{
    board_scene s = {.kind = kind,
                     .columns = columns,
                     .rows = rows,
                     .focal = 300,
                     .middle = {(w - 1) / 2.0, (h - 1) / 2.0},
                     .radius = 0.3,
                     .dark = 30,
                     .bright = 220,
                     .border = 0.7,
                     .w = w,
                     .h = h};
    return s;
}

/* Where all points are. */
static inline void scene_know(double (*truth)[2], const board_scene *s)
{
    for (int k = 0; k < s->columns * s->rows; k++) {
        double at[2];
        scene_point(at, s, k);
        scene_show(truth[k], s, at[0], at[1]);
    }
}

/* The least distance between lines of points next to each other, and from the picture's edge. */
static inline double scene_room(double (*truth)[2], const board_scene *s)
{
    double least = 1e9;
    for (int k = 0; k < s->columns * s->rows; k++) {
        const int right = k % s->columns < s->columns - 1 ? k + 1 : k - 1,
                  down = k / s->columns < s->rows - 1 ? k + s->columns : k - s->columns;
        const double ax = truth[right][0] - truth[k][0], ay = truth[right][1] - truth[k][1];
        const double bx = truth[down][0] - truth[k][0], by = truth[down][1] - truth[k][1];
        least = fmin(least, fabs(ax * by - ay * bx) / fmax(hypot(ax, ay), hypot(bx, by)));
        least = fmin(least, fmin(truth[k][0], s->w - 1 - truth[k][0]));
        least = fmin(least, fmin(truth[k][1], s->h - 1 - truth[k][1]));
    }
    return least;
}

/* Any pose, tilted by `tilt` at most, in which lines are `least` pixels apart. */
static inline void scene_pose(double (*truth)[2], board_scene *s, double tilt, double least)
{
    do {
        s->bend = scene_random(-0.1, 0.3);
        scene_turn(s, scene_random(-3.1416, 3.1416), scene_random(0, tilt), scene_random(0, 6.2832));
        scene_place(s, scene_random(-60, 60), scene_random(-40, 40), scene_random(6, 30));
        scene_know(truth, s);
    } while (!(s->shift[2] > 1 && scene_room(truth, s) > least));
}

/* Which point is in place k when the board is turned by quarters. */
static inline int scene_turned(const board_scene *s, int turn, int k)
{
    const int c = s->columns, r = s->rows;
    const int x = k % c, y = k / c;
    return turn == 0 ? k : turn == 2 ? c * r - 1 - k : turn == 1 ? x * c + (c - 1 - y) : (c - 1 - x) * c + y;
}

static inline double scene_level(const board_scene *s, double px, double py)
{
    const double x = (px - s->middle[0]) / s->focal, y = (py - s->middle[1]) / s->focal;
    const double scale = 1 + s->bend * (x * x + y * y), u = x * scale, v = y * scale;
    /* the ray (u, v, 1) meets turn (a, b, 0) + shift */
    const double *t = s->turn, *d = s->shift;
    const double e[2][3] = {{t[0] - u * t[6], t[1] - u * t[7], u * d[2] - d[0]},
                            {t[3] - v * t[6], t[4] - v * t[7], v * d[2] - d[1]}};
    const double det = e[0][0] * e[1][1] - e[0][1] * e[1][0];
    const double a = (e[0][2] * e[1][1] - e[0][1] * e[1][2]) / det,
                 b = (e[0][0] * e[1][2] - e[0][2] * e[1][0]) / det;
    const double wide = s->kind == SCENE_SHIFTED ? 2 * s->columns - 1 : s->columns - 1, high = s->rows - 1;
    const double rim = s->kind == SCENE_CHESS ? 1 : 0.75, all = rim + s->border;
    if (fabs(det) < 1e-9 || !(a > -all && b > -all && a < wide + all && b < high + all)) {
        const int stripes = ((int)floor(px / 7) + (int)floor(py / 60)) & 1,
                  dots = ((int)px / 9 * 7 + (int)py / 5) % 3;
        return !s->clutter ? 110 : (int)(px / 50) % 2 ? (stripes ? 20 : 230) : 60 + 60 * dots;
    }
    if (s->kind == SCENE_CHESS) {
        const int inside = a > -rim && b > -rim && a < wide + rim && b < high + rim;
        return inside && (((int)floor(a) + (int)floor(b)) & 1) == 0 ? s->dark : s->bright;
    }
    double column = s->kind == SCENE_SHIFTED ? 0 : floor(a + 0.5), row = floor(b + 0.5);
    if (s->kind == SCENE_SHIFTED) {
        const double odd = fabs(fmod(row, 2));
        column = 2 * floor((a - odd) / 2 + 0.5) + odd;
    }
    const int there = column >= 0 && row >= 0 && column <= wide && row <= high;
    return there && (a - column) * (a - column) + (b - row) * (b - row) < s->radius * s->radius ? s->dark
                                                                                                : s->bright;
}

#define SCENE_SAMPLES 6

/* A picture, each pixel the mean of 36 places of it unless the outermost are alike, blurred `blur` times by 1 2 1 in
 * both directions, with noise of that standard deviation. work: doubles, two of each pixel. */
static inline void scene_render(const iris_image *image, double *work, const board_scene *s, int blur,
                                double noise)
{
    const int w = image->w, h = image->h;
    double *from = work, *to = work + (size_t)w * (size_t)h;
    for (int i = 0; i < w * h; i++) {
        double sum = 0, outer[4];
        for (int k = 0; k < 4; k++) {
            const double most = 0.5 - 0.5 / SCENE_SAMPLES;
            outer[k] = scene_level(s, i % w + (k & 1 ? most : -most), i / w + (k & 2 ? most : -most));
        }
        if (outer[0] == outer[1] && outer[0] == outer[2] && outer[0] == outer[3]) {
            from[i] = outer[0];
            continue;
        }
        for (int k = 0; k < SCENE_SAMPLES * SCENE_SAMPLES; k++) {
            sum += scene_level(s, i % w + (k % SCENE_SAMPLES + 0.5) / SCENE_SAMPLES - 0.5,
                               i / w + (k / SCENE_SAMPLES + 0.5) / SCENE_SAMPLES - 0.5);
        }
        from[i] = sum / (SCENE_SAMPLES * SCENE_SAMPLES);
    }
    for (int round = 0; round < 2 * blur; round++) {
        const int step = round & 1 ? w : 1;
        for (int i = 0; i < w * h; i++) {
            const int at = round & 1 ? i / w : i % w, last = (round & 1 ? h : w) - 1;
            to[i] = (from[i - (at > 0 ? step : 0)] + 2 * from[i] + from[i + (at < last ? step : 0)]) / 4;
        }
        double *swap = from;
        from = to;
        to = swap;
    }
    for (int i = 0; i < w * h; i++) {
        double more = 0;
        for (int k = 0; noise > 0 && k < 12; k++) { /* of twelve the sum is normally distributed, nearly */
            more += scene_random(-0.5, 0.5);
        }
        const double level = from[i] + noise * more;
        ((uint8_t *)iris_image_row(image, i / w))[i % w] = (uint8_t)(level < 0     ? 0
                                                                     : level > 255 ? 255
                                                                                   : level + 0.5);
    }
}

#endif
