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

#endif
