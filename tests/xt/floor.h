/* Floors with lines on them, painted from formulas: what the follower's tests hold its answers against. */
#ifndef IRIS_TEST_FLOOR_H
#define IRIS_TEST_FLOOR_H

#include <math.h>

#include "iris/xt/follow.h"
#include "test.h"

#define FLOOR_W 160
#define FLOOR_H 120

typedef struct {
    uint8_t pixels[FLOOR_H][FLOOR_W];
    uint32_t random;
} floor_picture;

static int noise(floor_picture *picture, int amplitude)
{
    picture->random = picture->random * 1664525u + 1013904223u;
    return (int)(picture->random >> 16) % (2 * amplitude + 1) - amplitude;
}

static uint8_t clamped(double level)
{
    return (uint8_t)(level < 0 ? 0 : level > 255 ? 255 : level + 0.5);
}

/* A floor of the given level and noise; the light falls off from 1 at the left to `right` at the right. */
static void paint_floor(floor_picture *picture, double level, int amplitude, double right)
{
    picture->random = 12345;
    for (int y = 0; y < FLOOR_H; y++) {
        for (int x = 0; x < FLOOR_W; x++) {
            double light = 1 + (right - 1) * x / (FLOOR_W - 1);
            picture->pixels[y][x] = clamped(level * light + (amplitude ? noise(picture, amplitude) : 0));
        }
    }
}

/* Multiplies the columns left to right (inclusive) of a row, as tape on the floor does. */
static void paint_run(floor_picture *picture, int y, double left, double right, double factor)
{
    for (int x = (int)ceil(left); x <= (int)floor(right); x++) {
        if (y >= 0 && y < FLOOR_H && x >= 0 && x < FLOOR_W) {
            picture->pixels[y][x] = clamped(picture->pixels[y][x] * factor);
        }
    }
}

/* A straight tape through (x, bottom row) that leans by `degrees` to the right, `width` columns wide, rows y0 to y1. */
static inline void paint_tape(floor_picture *picture, double x, double degrees, double width, int y0, int y1)
{
    for (int y = y0; y <= y1; y++) {
        double center = x + (FLOOR_H - 1 - y) * tan(degrees * 3.14159265358979 / 180);
        paint_run(picture, y, center - width / 2, center + width / 2, 0.2);
    }
}

static inline void mirror(floor_picture *picture)
{
    for (int y = 0; y < FLOOR_H; y++) {
        for (int x = 0; x < FLOOR_W / 2; x++) {
            uint8_t kept = picture->pixels[y][x];
            picture->pixels[y][x] = picture->pixels[y][FLOOR_W - 1 - x];
            picture->pixels[y][FLOOR_W - 1 - x] = kept;
        }
    }
}

/* A follower with its memory. */
typedef struct {
    iris_follow follow;
    IRIS_SCRATCH_BUFFER(memory, IRIS_FOLLOW_FULL_SCRATCH_BYTES(FLOOR_W, FLOOR_H));
} test_follower;

static void start(test_follower *follower, const iris_follow_config *config)
{
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, follower->memory.memory, sizeof follower->memory.memory),
                     IRIS_OK);
    assert_int_equal(
        iris_follow_init_full(&follower->follow, (iris_size){FLOOR_W, FLOOR_H}, config, &scratch), IRIS_OK);
}

static void feed(iris_follow_result *result, test_follower *follower, floor_picture *picture, uint32_t now_ms)
{
    iris_image frame;
    assert_int_equal(iris_image_wrap(&frame, picture->pixels, sizeof picture->pixels,
                                     (iris_size){FLOOR_W, FLOOR_H}, 0, IRIS_GRAY8),
                     IRIS_OK);
    assert_int_equal(iris_follow_frame(result, &follower->follow, &frame, now_ms), IRIS_OK);
}

/* A fresh follower's answer. The result's rows stay valid until the next call. */
static inline void look(iris_follow_result *result, floor_picture *picture, const iris_follow_config *config)
{
    static test_follower follower;
    start(&follower, config);
    feed(result, &follower, picture, 0);
}

static inline double degrees(iris_angle angle)
{
    return angle * 360.0 / 65536;
}

static inline double fraction(iris_q16 value)
{
    return value / 65536.0;
}

static inline void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance)) {
        print_error("%g is not within %g of %g\n", value, tolerance, expected);
        fail();
    }
}

#endif
