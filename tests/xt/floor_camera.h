/* A camera above a floor, in double precision: what the floor's tests hold their answers against. */
#ifndef IRIS_TEST_FLOOR_CAMERA_H
#define IRIS_TEST_FLOOR_CAMERA_H

#include <math.h>

#include "iris/xt/floor.h"
#include "test.h"

typedef struct {
    int w, h;
    double focal, cx, cy;                  /* pixels */
    double height, ahead, tilt, roll, pan; /* mm above the floor, mm ahead of the origin, radians */
} test_camera;

static uint64_t camera_random_state = 88172645463325252u;

static inline double uniform(double low, double high)
{
    camera_random_state ^= camera_random_state << 13;
    camera_random_state ^= camera_random_state >> 7;
    camera_random_state ^= camera_random_state << 17;
    return low + (high - low) * (double)(camera_random_state >> 11) / 9007199254740992.0;
}

static inline double normal(double sigma)
{
    double u = uniform(1e-12, 1), v = uniform(0, 6.283185307179586);
    return sigma * sqrt(-2 * log(u)) * cos(v);
}

/* Height 100 to 400 mm, tilt 20 to 70 degrees below the horizon, a little roll and pan. */
static inline test_camera any_camera(void)
{
    static const int sizes[3][2] = {{160, 120}, {320, 240}, {640, 480}};
    const int *size = sizes[(int)uniform(0, 2.999)];
    const double degree = 3.14159265358979323846 / 180;
    test_camera c = {.w = size[0], .h = size[1], .cx = (size[0] - 1) / 2.0, .cy = (size[1] - 1) / 2.0};
    c.focal = size[0] / 2.0 / tan(uniform(45, 80) / 2 * degree);
    c.height = uniform(100, 400);
    c.ahead = uniform(-50, 150);
    c.tilt = uniform(20, 70) * degree;
    c.roll = uniform(-5, 5) * degree;
    c.pan = uniform(-10, 10) * degree;
    return c;
}

/* The floor (x right, y ahead) to the picture; returns the depth in mm, not above 0 behind the camera. */
static inline double camera_sees(double *u, double *v, const test_camera *c, double x, double y)
{
    double px = x * cos(c->pan) - (y - c->ahead) * sin(c->pan);
    double py = x * sin(c->pan) + (y - c->ahead) * cos(c->pan);
    double down = c->height * cos(c->tilt) - py * sin(c->tilt);
    double depth = c->height * sin(c->tilt) + py * cos(c->tilt);
    double right = px * cos(c->roll) - down * sin(c->roll);
    double below = px * sin(c->roll) + down * cos(c->roll);
    *u = c->cx + c->focal * right / depth;
    *v = c->cy + c->focal * below / depth;
    return depth;
}

/* The picture to the floor; returns 0 on and above the horizon. */
static inline int camera_floor(double *x, double *y, const test_camera *c, double u, double v)
{
    double right = (u - c->cx) / c->focal, below = (v - c->cy) / c->focal;
    double px = right * cos(c->roll) + below * sin(c->roll);
    double down = -right * sin(c->roll) + below * cos(c->roll);
    double drop = sin(c->tilt) + down * cos(c->tilt), reach = cos(c->tilt) - down * sin(c->tilt);
    *x = *y = 0;
    if (drop <= 0) {
        return 0;
    }
    px *= c->height / drop;
    double py = reach * c->height / drop;
    *x = px * cos(c->pan) + py * sin(c->pan);
    *y = -px * sin(c->pan) + py * cos(c->pan) + c->ahead;
    return 1;
}

/* The nine numbers of the camera, 1 at (0, 0)'s depth; exact but for double precision. */
static inline void camera_numbers(double m[9], const test_camera *c)
{
    double u[4], v[4], w[4];
    const double at[4][2] = {{0, 1000}, {1, 1000}, {0, 1001}, {0, 0}};
    for (int i = 0; i < 3; i++) {
        w[i] = camera_sees(&u[i], &v[i], c, at[i][0], at[i][1]);
    }
    for (int r = 0; r < 3; r++) {
        double base = r == 0 ? u[0] * w[0] : r == 1 ? v[0] * w[0] : w[0];
        double right = (r == 0 ? u[1] * w[1] : r == 1 ? v[1] * w[1] : w[1]) - base;
        double ahead = (r == 0 ? u[2] * w[2] : r == 1 ? v[2] * w[2] : w[2]) - base;
        m[3 * r] = right;
        m[3 * r + 1] = ahead;
        m[3 * r + 2] = base - 1000 * ahead;
    }
}

static inline iris_q16 q16_of(double value)
{
    return (iris_q16)floor(value * 65536 + 0.5);
}

static inline iris_place place_at(double x, double y)
{
    return (iris_place){q16_of(x), q16_of(y)};
}

/* The floor of the camera as it is: the nine numbers rounded, depth 1 at 300 mm. */
static inline iris_floor true_floor(const test_camera *c)
{
    double m[9];
    iris_q32 numbers[9];
    iris_floor floor;
    camera_numbers(m, c);
    double scale = 4294967296.0 / (m[7] * (c->ahead + 300) + m[8]);
    for (int i = 0; i < 9; i++) {
        numbers[i] = (iris_q32)llround(m[i] * scale);
    }
    assert_int_equal(iris_floor_init(&floor, (iris_size){c->w, c->h}, numbers), IRIS_OK);
    return floor;
}

/* `count` marks on the floor in sight, none within 60 mm of each other's millimeters being needed: spread over the lower
 * two thirds of the picture, with noise in pixels. */
static inline void draw_marks(iris_floor_mark *marks, int count, const test_camera *c, double noise)
{
    for (int i = 0; i < count; i++) {
        double x, y, u, v;
        do { /* the first four near the corners */
            double a = i < 4 ? 0.1 + 0.8 * (i & 1) : uniform(0.05, 0.95);
            double b = i < 4 ? 0.4 + 0.55 * (i >> 1) : uniform(0.35, 0.98);
            u = (a + (i < 4 ? uniform(-0.05, 0.05) : 0)) * c->w;
            v = (b + (i < 4 ? uniform(-0.03, 0.03) : 0)) * c->h;
        } while (!camera_floor(&x, &y, c, u, v) || fabs(x) > 5000 || fabs(y) > 5000);
        x = floor(x + 0.5); /* measured with a ruler */
        y = floor(y + 0.5);
        camera_sees(&u, &v, c, x, y);
        marks[i].floor = place_at(x, y);
        marks[i].image = place_at(u + normal(noise), v + normal(noise));
    }
}

#endif
