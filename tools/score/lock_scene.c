#include "lock_scene.h"

#include <math.h>
#include <stdint.h>

const char *const scene_names[SCENE_KINDS] = {
    "moves",  "light changes", "hidden for 5 frames", "similar ball crosses",
    "leaves", "jumps",         "smeared by speed",    "half in the dark"};

typedef struct {
    double r, g, b;
} color;

typedef struct {
    scene_kind kind;
    unsigned seed;
    color ball, other, room[3];
    double r, speed, heading, x0, y0;
} scene;

/* 0 up to below 1, of any whole numbers. */
static double random_at(unsigned seed, int32_t a, int32_t b)
{
    uint32_t n = seed * 0x9E3779B9u + (uint32_t)a * 0x85EBCA6Bu + (uint32_t)b * 0xC2B2AE35u;
    n = (n ^ n >> 15) * 0x2C1B3C6Du;
    n = (n ^ n >> 12) * 0x297A2D39u;
    return (n ^ n >> 15) / 4294967296.0;
}

/* Hue in turns. */
static color color_of(double hue, double saturation, double lightness)
{
    double chroma = saturation * (1 - fabs(2 * lightness - 1)), channels[3];
    for (int i = 0; i < 3; i++) {
        double away = fabs(fmod(hue + 1 - i / 3.0 + 0.5, 1.0) - 0.5) * 6; /* from this primary */
        double share = away <= 1 ? 1 : away >= 2 ? 0 : 2 - away;
        channels[i] = 255 * (lightness + chroma * (share - 0.5));
    }
    return (color){channels[0], channels[1], channels[2]};
}

static scene scene_of(scene_kind kind, unsigned seed)
{
    scene s = {.kind = kind, .seed = seed};
    const double hue = random_at(seed, 1, 0), away = random_at(seed, 8, 0) < 0.5 ? -1 : 1;
    s.ball = color_of(hue, 0.55 + 0.4 * random_at(seed, 2, 0), 0.35 + 0.25 * random_at(seed, 3, 0));
    s.other = color_of(hue + 1 + away * 0.03, 0.7, 0.45);
    for (int i = 0; i < 3; i++) {
        s.room[i] =
            color_of(random_at(seed, 4, i), 0.3 * random_at(seed, 5, i), 0.2 + 0.6 * random_at(seed, 6, i));
    }
    s.r = 6 + 8 * random_at(seed, 7, 0);
    s.speed = kind == SCENE_BLURRED ? 16 : 3 + 8 * random_at(seed, 9, 0);
    s.heading = 6.2832 * random_at(seed, 10, 0);
    s.x0 = 40 + 160 * random_at(seed, 11, 0);
    s.y0 = 40 + 100 * random_at(seed, 12, 0);
    if (kind == SCENE_DISTRACTOR || kind == SCENE_HIDDEN) { /* through the middle, level */
        s.heading = random_at(seed, 10, 0) < 0.5 ? 0 : 3.1416;
        s.speed = 4 + 3 * random_at(seed, 9, 0);
        s.x0 = s.heading == 0 ? 20 : SCENE_W - 20;
    }
    return s;
}

/* As light between two mirrors: there and back. */
static double folded(double at, double low, double high)
{
    double span = high - low, phase = fmod(fmod(at - low, 2 * span) + 2 * span, 2 * span);
    return low + (phase <= span ? phase : 2 * span - phase);
}

static void ball_at(double *x, double *y, const scene *s, double time)
{
    double dx = s->speed * cos(s->heading), dy = s->speed * sin(s->heading);
    *x = s->x0 + dx * time;
    *y = s->y0 + dy * time;
    if (s->kind == SCENE_JUMPS) {
        const int frame = (int)time;
        *x = s->x0;
        *y = s->y0;
        for (int i = 1; i <= frame; i++) {
            *x = folded(*x + 160 * (random_at(s->seed, 20, i) - 0.5), 20, SCENE_W - 20);
            *y = folded(*y + 120 * (random_at(s->seed, 21, i) - 0.5), 20, SCENE_H - 20);
        }
    } else if (s->kind == SCENE_LEAVES) {
        *x = s->x0 + (cos(s->heading) < 0 ? -1 : 1) * fmax(0.0, time - 5) * (s->speed + 6);
        *y = s->y0 + 6 * sin(time / 3);
    } else {
        *x = folded(*x, s->r + 2, SCENE_W - 3 - s->r);
        *y = folded(*y, s->r + 2, SCENE_H - 3 - s->r);
    }
}

static void other_at(double *x, double *y, const scene *s, double time)
{
    double bx, by;
    ball_at(&bx, &by, s, 15);
    *x = folded(bx + (time - 15) * 3, 15, SCENE_W - 15);
    *y = folded(by + (time - 15) * 5, 15, SCENE_H - 15);
}

/* Soft clouds of three colors, and boxes with edges. */
static color room_at(const scene *s, int x, int y)
{
    double weight[3], sum = 0;
    color c = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        double gx = x / 37.0, gy = y / 31.0;
        int ix = (int)gx, iy = (int)gy;
        double fx = gx - ix, fy = gy - iy;
        double top = random_at(s->seed + 77, ix + 100 * i, iy) * (1 - fx) +
                     random_at(s->seed + 77, ix + 1 + 100 * i, iy) * fx;
        double low = random_at(s->seed + 77, ix + 100 * i, iy + 1) * (1 - fx) +
                     random_at(s->seed + 77, ix + 1 + 100 * i, iy + 1) * fx;
        weight[i] = pow(top * (1 - fy) + low * fy, 3) + 0.01;
        sum += weight[i];
    }
    for (int i = 0; i < 3; i++) {
        c.r += s->room[i].r * weight[i] / sum;
        c.g += s->room[i].g * weight[i] / sum;
        c.b += s->room[i].b * weight[i] / sum;
    }
    double tile = 0.75 + 0.4 * random_at(s->seed + 5, x / 24, y / 20);
    return (color){c.r * tile, c.g * tile, c.b * tile};
}

static color mixed(color a, color b, double share_of_b)
{
    return (color){a.r + (b.r - a.r) * share_of_b, a.g + (b.g - a.g) * share_of_b,
                   a.b + (b.b - a.b) * share_of_b};
}

/* The room of the sequence that is being rendered. */
static color room[SCENE_H][SCENE_W];

static void make_room(const scene *s)
{
    static scene of;
    static int is_made;
    if (!is_made || of.seed != s->seed) {
        for (int i = 0; i < SCENE_W * SCENE_H; i++) {
            room[i / SCENE_W][i % SCENE_W] = room_at(s, i % SCENE_W, i / SCENE_W);
        }
    }
    of = *s;
    is_made = 1;
}

/* A ball lit from above left, with a soft edge. */
static color with_ball(color behind, color its, const double at[3], int x, int y)
{
    if (fabs(x - at[0]) > at[2] + 1 || fabs(y - at[1]) > at[2] + 1) {
        return behind;
    }
    double dx = (x - at[0]) / at[2], dy = (y - at[1]) / at[2], d = sqrt(dx * dx + dy * dy);
    double inside = fmin(1.0, fmax(0.0, (1 - d) * at[2] + 0.5));
    double light = 1.1 - 0.35 * (dx * 0.5 + dy) - 0.15 * d * d;
    return mixed(behind, (color){its.r * light, its.g * light, its.b * light}, inside);
}

static uint8_t level(double value)
{
    return (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : value + 0.5);
}

/* The columns of the post that hides the ball for 5 frames from frame 14 on. */
static void post_of(double *from, double *to, const scene *s)
{
    double a, b, y;
    ball_at(&a, &y, s, 14);
    ball_at(&b, &y, s, 18);
    *from = fmin(a, b) - s->r - 0.5;
    *to = fmax(a, b) + s->r + 0.5;
}

static color light_of(const scene *s, int frame)
{
    if (s->kind != SCENE_LIGHT) {
        return (color){1, 1, 1};
    }
    double gain = 0.75 + 0.35 * cos(frame * 6.2832 / 26), warm = 0.10 * frame / SCENE_FRAMES;
    return (color){gain * (1 + warm), gain, gain * (1 - warm)};
}

#define EXPOSURES 6 /* of a frame in which the ball is smeared */

/* Where everything is in a frame. */
typedef struct {
    const scene *s;
    int exposures;
    double ball[EXPOSURES][3], other[3], post[2];
} moment;

static moment moment_of(const scene *s, int frame)
{
    moment m = {.s = s, .exposures = s->kind == SCENE_BLURRED ? EXPOSURES : 1};
    for (int i = 0; i < m.exposures; i++) {
        double since = m.exposures > 1 ? (i + 0.5) / EXPOSURES * 0.6 - 0.3 : 0;
        ball_at(&m.ball[i][0], &m.ball[i][1], s, frame + since);
        m.ball[i][2] = s->r;
    }
    other_at(&m.other[0], &m.other[1], s, frame);
    m.other[2] = s->r;
    post_of(&m.post[0], &m.post[1], s);
    return m;
}

static color pixel_of(const moment *m, int x, int y)
{
    const scene *s = m->s;
    color c = room[y][x], sum = {0, 0, 0};
    if (s->kind == SCENE_HIDDEN && x >= m->post[0] && x <= m->post[1]) {
        return room[(y + 30) % SCENE_H][(x + 60) % SCENE_W];
    }
    if (s->kind == SCENE_DISTRACTOR) {
        c = with_ball(c, s->other, m->other, x, y);
    }
    for (int i = 0; i < m->exposures; i++) {
        const double *at = m->ball[i];
        color one = with_ball(c, s->ball, at, x, y);
        if (s->kind == SCENE_SHADED && y > at[1] + 0.15 * s->r) {
            one = mixed(one, (color){0, 0, 0}, hypot(x - at[0], y - at[1]) <= s->r ? 0.7 : 0);
        }
        sum =
            (color){sum.r + one.r / m->exposures, sum.g + one.g / m->exposures, sum.b + one.b / m->exposures};
    }
    return sum;
}

static double visible_of(const scene *s, int frame, double x, double y)
{
    double in_frame = x > -s->r && x < SCENE_W + s->r ? 1 : 0, post[2];
    if (in_frame > 0) {
        in_frame = fmin(1.0, fmax(0.0, (fmin(x + s->r, SCENE_W) - fmax(x - s->r, 0)) / (2 * s->r)));
    }
    if (s->kind == SCENE_HIDDEN) {
        post_of(&post[0], &post[1], s);
        double hidden = fmin(x + s->r, post[1]) - fmax(x - s->r, post[0]);
        in_frame *= 1 - fmin(1.0, fmax(0.0, hidden / (2 * s->r)));
    }
    if (s->kind == SCENE_DISTRACTOR) {
        double ox, oy;
        other_at(&ox, &oy, s, frame);
        in_frame *= hypot(ox - x, oy - y) < 2 * s->r + 2 ? 0.75 : 1; /* they touch */
    }
    return in_frame;
}

scene_truth scene_frame(const iris_image *image, scene_kind kind, unsigned seed, int frame)
{
    const scene s = scene_of(kind, seed);
    const color light = light_of(&s, frame);
    const moment now = moment_of(&s, frame);
    scene_truth truth = {0, 0, s.r, 0};
    ball_at(&truth.x, &truth.y, &s, frame);
    make_room(&s);
    truth.visible = visible_of(&s, frame, truth.x, truth.y);
    for (int y = 0; y < SCENE_H; y++) {
        uint8_t *row = iris_image_row(image, y);
        for (int x = 0; x < SCENE_W; x++) {
            color c = pixel_of(&now, x, y);
            double noise[3];
            for (int i = 0; i < 3; i++) {
                noise[i] = 14 * (random_at(seed + 1000u * (unsigned)frame, x, 3 * y + i) - 0.5);
            }
            row[3 * x] = level(c.r * light.r + noise[0]);
            row[3 * x + 1] = level(c.g * light.g + noise[1]);
            row[3 * x + 2] = level(c.b * light.b + noise[2]);
        }
    }
    return truth;
}
