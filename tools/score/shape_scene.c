#include "shape_scene.h"

#include <math.h>
#include <stdlib.h>

#include "iris/xt/hough_shape.h"
#include "picture.h"

#define OUTLINE_MAX 8000
#define CLUTTER     16

static const double pi = 3.14159265358979;
static uint32_t seed;

static double next(double low, double high)
{
    seed = seed * 1664525 + 1013904223;
    return low + (high - low) * (seed >> 8) / 16777216.0;
}

static double next_gauss(void)
{
    double sum = 0;
    for (int i = 0; i < 12; i++) {
        sum += next(-0.5, 0.5);
    }
    return sum;
}

/* Something that is painted. */
typedef enum { ELLIPSE, STROKE, TRIANGLE, PIECE, WHOLE, RECTANGLE, HALF } kind;

typedef struct {
    kind of;
    double x, y, c, s;           /* its place, and its turn */
    double a, b;                 /* half axes; half length and width; size; of a piece: where it is cut */
    const scene_template *shape; /* of a piece or a whole */
    double scale;
} thing;

static int is_white(const iris_image *mask, double x, double y)
{
    int32_t column = (int32_t)floor(x + 0.5), row = (int32_t)floor(y + 0.5);
    if (column < 0 || row < 0 || column >= mask->w || row >= mask->h) {
        return 0;
    }
    const uint32_t *words = iris_image_row(mask, row);
    return words[column / 32] >> column % 32 & 1;
}

static int is_inside(const thing *t, double x, double y)
{
    double dx = x - t->x, dy = y - t->y, u = dx * t->c + dy * t->s, v = dy * t->c - dx * t->s;
    switch (t->of) {
    case ELLIPSE:
        return u * u / (t->a * t->a) + v * v / (t->b * t->b) < 1;
    case STROKE:
    case RECTANGLE:
        return fabs(u) < t->a && fabs(v) < t->b;
    case TRIANGLE:
        return v > -t->b && v < t->b && fabs(u) < t->a * (t->b - v) / (2 * t->b);
    case PIECE:
        u /= t->scale;
        v /= t->scale;
        return fabs(u) < t->shape->mask.w * 0.25 && fabs(v) < t->shape->mask.h * 0.25 &&
               is_white(&t->shape->mask, u + t->a, v + t->b);
    case WHOLE:
        return is_white(&t->shape->mask, u / t->scale + t->shape->x, v / t->scale + t->shape->y);
    default: /* HALF */
        return u > 0;
    }
}

/* Nothing of it is farther from its place. */
static double reach_of(const thing *t)
{
    return t->of == HALF                      ? SCENE_W + SCENE_H
           : t->of == PIECE || t->of == WHOLE ? t->scale * (t->shape->mask.w + t->shape->mask.h)
                                              : t->a + t->b;
}

/* With smooth edges, by 3x3 samples of a pixel. */
static void paint(double *plane, const thing *t, double level)
{
    double reach = reach_of(t) + 1;
    for (int32_t i = 0; i < SCENE_W * SCENE_H; i++) {
        int inside = 0;
        if (fabs(i % SCENE_W - t->x) > reach || fabs(i / SCENE_W - t->y) > reach) {
            continue;
        }
        for (int k = 0; k < 9; k++) {
            inside += is_inside(t, i % SCENE_W + (k % 3 - 1) / 3.0, i / SCENE_W + (k / 3 - 1) / 3.0);
        }
        plane[i] += (level - plane[i]) * inside / 9;
    }
}

static void paint_clutter(double *plane, double ground, const scene_template *others, int count)
{
    for (int i = 0; i < CLUTTER; i++) {
        double turn = next(-pi, pi), level = ground + next(25, 80) * (next(0, 1) < 0.5 ? -1 : 1);
        thing t = {.of = (kind)(int)next(ELLIPSE, PIECE + 1),
                   .x = next(0, SCENE_W),
                   .y = next(0, SCENE_H),
                   .c = cos(turn),
                   .s = sin(turn),
                   .a = next(12, 60),
                   .b = next(12, 60),
                   .shape = &others[(int)next(0, count)],
                   .scale = next(0.6, 1.4)};
        if (t.of == STROKE) {
            t.b = next(1.5, 8);
            t.a *= 1.5;
        }
        if (t.of == PIECE) {
            t.a = next(0.25, 0.75) * t.shape->mask.w;
            t.b = next(0.25, 0.75) * t.shape->mask.h;
        }
        paint(plane, &t, level);
    }
}

/* The outline in the scene: x, y. Returns the number of points. */
static int32_t outline_of(double (*at)[2], const thing *whole)
{
    static iris_edge_point points[OUTLINE_MAX];
    int32_t count = 0;
    (void)iris_hough_shape_silhouette(points, OUTLINE_MAX, &count, &whole->shape->mask);
    count = count < OUTLINE_MAX ? count : OUTLINE_MAX;
    for (int32_t i = 0; i < count; i++) {
        double u = (points[i].x / 2.0 - whole->shape->x) * whole->scale;
        double v = (points[i].y / 2.0 - whole->shape->y) * whole->scale;
        at[i][0] = whole->x + u * whole->c - v * whole->s;
        at[i][1] = whole->y + u * whole->s + v * whole->c;
    }
    return count;
}

static double hidden_share(const thing *patch, double (*at)[2], int32_t count)
{
    int32_t hidden = 0;
    for (int32_t i = 0; i < count; i++) {
        hidden += is_inside(patch, at[i][0], at[i][1]);
    }
    return (double)hidden / count;
}

/* A patch over a third of the outline, as near to it as 60 trials come. */
static thing patch_for(double (*at)[2], int32_t count)
{
    thing best = {.of = HALF};
    double least = 2;
    for (int i = 0; i < 60; i++) {
        double turn = next(-pi, pi);
        int32_t k = (int32_t)next(0, count);
        thing t = {.of = next(0, 1) < 0.5 ? HALF : RECTANGLE,
                   .x = at[k][0],
                   .y = at[k][1],
                   .c = cos(turn),
                   .s = sin(turn),
                   .a = next(10, 120),
                   .b = next(10, 120)};
        double off = fabs(hidden_share(&t, at, count) - 1 / 3.0);
        if (off < least) {
            least = off;
            best = t;
        }
    }
    return best;
}

/* A place for the shape where all of it is in the picture. */
static thing place(double (*at)[2], int32_t *count, const scene_template *shape)
{
    thing t = {.of = WHOLE, .shape = shape};
    for (int fits = 0; !fits;) {
        double turn = next(-pi, pi);
        t.c = cos(turn);
        t.s = sin(turn);
        t.scale = next(0.7, 1.4);
        t.x = next(30, SCENE_W - 30);
        t.y = next(30, SCENE_H - 30);
        *count = outline_of(at, &t);
        fits = 1;
        for (int32_t i = 0; i < *count && fits; i++) {
            fits = at[i][0] > 3 && at[i][1] > 3 && at[i][0] < SCENE_W - 4 && at[i][1] < SCENE_H - 4;
        }
    }
    return t;
}

iris_image scene_make(scene_truth *truth, const scene_template *shape, const scene_template *others,
                      int count, uint32_t number)
{
    static double plane[SCENE_W * SCENE_H], at[OUTLINE_MAX][2];
    iris_image image = picture_make(SCENE_W, SCENE_H, IRIS_GRAY8);
    seed = number * 7919 + 12345;
    double ground = next(90, 150), noise = next(10, 15);
    for (int32_t i = 0; i < SCENE_W * SCENE_H; i++) {
        plane[i] = ground;
    }
    paint_clutter(plane, ground, others, count);
    if (shape) {
        int32_t points;
        thing whole = place(at, &points, shape);
        paint(plane, &whole, ground + next(60, 100) * (next(0, 1) < 0.5 ? -1 : 1));
        thing patch = patch_for(at, points);
        paint(plane, &patch, ground + next(-60, 60));
        *truth = (scene_truth){whole.x, whole.y, atan2(whole.s, whole.c) * 180 / pi, whole.scale};
    }
    for (int32_t i = 0; image.data && i < SCENE_W * SCENE_H; i++) {
        double level = floor(plane[i] + noise * next_gauss() + 0.5);
        ((uint8_t *)image.data)[i] = (uint8_t)fmin(255, fmax(0, level));
    }
    return image;
}
