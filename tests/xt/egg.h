/* For the tests of the generalized Hough transform: a shape by formula, and its table. */
#ifndef IRIS_TEST_EGG_H
#define IRIS_TEST_EGG_H

#include <math.h>

#include "../picture.h"
#include "iris/xt/hough_shape.h"

#define OUTLINE_MAX 2000

static const double pi = 3.14159265358979;
static uint8_t table[IRIS_HOUGH_SHAPE_TABLE_BYTES(IRIS_HOUGH_SHAPE_ENTRIES_MAX)];
static size_t table_bytes;
static iris_edge_point outline[OUTLINE_MAX];
static int32_t outline_count;

/* An egg with a bite: one direction, one size. Seen from its middle, at the share t of the way around. */
static inline void egg(double *x, double *y, double t)
{
    double a = 2 * pi * t, r = 40 + 8 * cos(a) - 14 * exp(-16 * (t - 0.2) * (t - 0.2) * 25);
    *x = r * cos(a);
    *y = 0.7 * r * sin(a);
}

/* The egg's edge points; it is bright. Middle at 50, 50. */
static inline void draw_template(void)
{
    outline_count = 0;
    for (int i = 0; i < 400; i++) {
        double x, y, x1, y1;
        egg(&x, &y, i / 400.0);
        egg(&x1, &y1, (i + 1) / 400.0);
        double inside = atan2(x1 - x, -(y1 - y)); /* a quarter turn right of the way */
        outline[outline_count++] =
            (iris_edge_point){(int16_t)lrint(16 * (50 + x)), (int16_t)lrint(16 * (50 + y)),
                              iris_angle_wrap((int32_t)lrint(inside / pi * 32768))};
    }
}

static inline void teach(int32_t entries)
{
    const iris_hough_shape_teaching by = {4, entries, 1, 50 * 65536, 50 * 65536};
    draw_template();
    assert_int_equal(iris_hough_shape_teach(table, sizeof table, &table_bytes, outline, outline_count, &by),
                     IRIS_OK);
}

#endif
