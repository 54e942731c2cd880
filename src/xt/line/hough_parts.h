/* What the files of the Hough transform share. */
#ifndef IRIS_XT_HOUGH_PARTS_H
#define IRIS_XT_HOUGH_PARTS_H

#include "iris/xt/hough.h"

#define HOUGH_HALF_TURN 32768 /* in units of iris_angle */
#define HOUGH_VOTES_MAX 65535

static inline int hough_outside(int32_t value, int32_t low, int32_t high)
{
    return value < low || value > high;
}

static inline int hough_size_is_bad(iris_size size)
{
    return hough_outside(size.w, 1, IRIS_SIDE_MAX) || hough_outside(size.h, 1, IRIS_SIDE_MAX);
}

/* After so much, theta stands for the same lines again. */
static inline int32_t hough_turn(const iris_hough *hough)
{
    return HOUGH_HALF_TURN << hough->config.full_circle;
}

/* The angle of a theta bin: -180 up to below 540 degrees. */
static inline int32_t hough_bin_angle(const iris_hough *hough, int32_t theta)
{
    int32_t bins = hough->config.theta_bins;
    return hough->config.angle_min + (theta * hough->span + bins / 2) / bins;
}

static inline int hough_edges_fit(const iris_edge_point *points, int32_t count, iris_size size)
{
    int32_t i = 0;
    while (i < count && !hough_outside(points[i].x, 0, size.w - 1) &&
           !hough_outside(points[i].y, 0, size.h - 1)) {
        i++;
    }
    return i == count;
}

/* A line in an image: a = start + slope * b, where b is the axis that it follows more closely: y if it is upright. */
typedef struct {
    int is_upright;
    int32_t a_side, b_side; /* of the image along a and b */
    int64_t start_q16;
    iris_q30 slope;
    iris_q30 straightness; /* a step along b is 1 / straightness pixels of the line */
} hough_walk;

hough_walk hough_walk_along(const iris_hough_line *line, iris_size size);

/* The pixel a of the line at b, wherever. */
int64_t hough_walk_at(const hough_walk *path, int32_t b);

/* From b = first to last; pixels outside the image are moved to its edge. */
iris_hough_ends hough_walk_ends(const hough_walk *path, int32_t first, int32_t last);

#endif
