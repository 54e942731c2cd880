#include "crossing.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

/* The camera is one unit above the floor, whose x is to the right and y ahead. */
typedef struct {
    double focal, tilt, w, h;
    double x, y;                     /* of the junction on the floor */
    double direction[CROSSING_ARMS]; /* of the arms there, clockwise from ahead */
    double width;                    /* of the line */
    double floor, line, noise;       /* gray levels */
    double light_x, light_y;         /* how the light changes over the picture */
    int arms;
} scene;

typedef struct {
    uint32_t state;
} dice;

static double roll(dice *d, double low, double high)
{
    d->state ^= d->state << 13;
    d->state ^= d->state >> 17;
    d->state ^= d->state << 5;
    return low + (high - low) * (d->state / 4294967296.0);
}

static double normal(dice *d)
{
    return sqrt(-2 * log(roll(d, 1e-9, 1))) * cos(2 * PI * roll(d, 0, 1));
}

/* Where the picture's (px, py) meets the floor; 0 above the horizon. */
static int to_floor(double *x, double *y, const scene *s, double px, double py)
{
    double right = (px - (s->w - 1) / 2) / s->focal, down = (py - (s->h - 1) / 2) / s->focal;
    double drop = sin(s->tilt) + down * cos(s->tilt);
    if (drop < 0.01) {
        return 0;
    }
    *x = right / drop;
    *y = (cos(s->tilt) - down * sin(s->tilt)) / drop;
    return 1;
}

static void to_picture(double *px, double *py, const scene *s, double x, double y)
{
    double depth = y * cos(s->tilt) + sin(s->tilt), down = cos(s->tilt) - y * sin(s->tilt);
    *px = (s->w - 1) / 2 + s->focal * x / depth;
    *py = (s->h - 1) / 2 + s->focal * down / depth;
}

/* Is this point of the floor on the tape? Arms are cut square at the junction, and corners filled. */
static int on_tape(const scene *s, double x, double y)
{
    for (int i = 0; i < s->arms; i++) {
        double c = cos(s->direction[i]), sn = sin(s->direction[i]);
        double along = (x - s->x) * sn + (y - s->y) * c, across = (x - s->x) * c - (y - s->y) * sn;
        double behind = s->arms > 1 ? -s->width / 2 : 0;
        if (along >= behind && fabs(across) <= s->width / 2) {
            return 1;
        }
    }
    return 0;
}

static const double DEGREE = PI / 180;

static void lay(scene *s, dice *d, crossing_kind kind)
{
    double side = roll(d, 0, 1) < 0.5 ? -1 : 1, turn = roll(d, -20, 20) * DEGREE;
    s->direction[0] = PI; /* the way back */
    s->arms = kind == CROSSING_END ? 1 : kind == CROSSING_CORNER || kind == CROSSING_STRAIGHT ? 2 : 3;
    if (kind == CROSSING_CORNER) {
        s->direction[1] = side * roll(d, 60, 120) * DEGREE;
    } else if (kind == CROSSING_STRAIGHT) {
        s->direction[1] = 0;
    } else if (kind == CROSSING_T) {
        s->direction[1] = side * 90 * DEGREE;
        s->direction[2] = roll(d, 0, 3) < 1 ? -side * 90 * DEGREE : 0;
    } else if (kind == CROSSING_Y) {
        double half = roll(d, 30, 60) * DEGREE;
        s->direction[1] = -half;
        s->direction[2] = half;
    } else if (kind == CROSSING_PLUS) {
        s->arms = 4;
        s->direction[1] = -90 * DEGREE;
        s->direction[2] = 0;
        s->direction[3] = 90 * DEGREE;
    } else if (kind == CROSSING_EMPTY) {
        s->arms = 0;
    }
    for (int i = 0; i < s->arms; i++) {
        s->direction[i] += turn;
    }
}

static void place(scene *s, dice *d, crossing_truth *truth)
{
    truth->x = s->w * roll(d, 0.3, 0.7);
    truth->y = s->h * roll(d, 0.3, 0.65);
    to_floor(&s->x, &s->y, s, truth->x, truth->y);
    double depth = s->y * cos(s->tilt) + sin(s->tilt);
    truth->width = s->w * roll(d, 0.045, 0.13);
    s->width = truth->width * depth / s->focal;
    truth->arms = s->arms;
    for (int i = 0; i < s->arms; i++) {
        double x, y, step = 0.01;
        to_picture(&x, &y, s, s->x + step * sin(s->direction[i]), s->y + step * cos(s->direction[i]));
        truth->angle_deg[i] = atan2(x - truth->x, truth->y - y) / DEGREE;
    }
}

static double gray_at(const scene *s, double px, double py)
{
    enum { SAMPLES = 3 };
    double sum = 0;
    for (int k = 0; k < SAMPLES * SAMPLES; k++) {
        double x, y, dx = (k % SAMPLES - 1) / 3.0, dy = (k / SAMPLES - 1) / 3.0;
        int on = to_floor(&x, &y, s, px + dx, py + dy) && on_tape(s, x, y);
        sum += on ? s->line : s->floor;
    }
    double light = 1 + s->light_x * (px / s->w - 0.5) + s->light_y * (py / s->h - 0.5);
    return sum / (SAMPLES * SAMPLES) * light;
}

void crossing_paint(crossing_truth *truth, const iris_image *gray, crossing_kind kind, int bright,
                    uint32_t seed)
{
    dice d = {(seed + 1) * 2654435761u ^ ((uint32_t)kind + 1) * 0x9e3779b9u};
    scene s = {.w = gray->w, .h = gray->h};
    roll(&d, 0, 1);
    s.tilt = roll(&d, 30, 60) * DEGREE;
    s.focal = s.w / 2 / tan(roll(&d, 48, 70) / 2 * DEGREE);
    s.floor = bright ? roll(&d, 30, 110) : roll(&d, 110, 230);
    s.line = bright ? s.floor + roll(&d, 80, 130) : s.floor * roll(&d, 0.12, 0.5);
    s.noise = roll(&d, 0, 10);
    s.light_x = roll(&d, -0.5, 0.5);
    s.light_y = roll(&d, -0.5, 0.5);
    *truth = (crossing_truth){.kind = kind};
    lay(&s, &d, kind);
    place(&s, &d, truth);
    for (int32_t y = 0; y < gray->h; y++) {
        uint8_t *row = iris_image_row(gray, y);
        for (int32_t x = 0; x < gray->w; x++) {
            double level = gray_at(&s, x, y) + s.noise * normal(&d);
            row[x] = (uint8_t)(level < 0 ? 0 : level > 255 ? 255 : level + 0.5);
        }
    }
}
