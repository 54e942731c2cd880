/* What the parts of a calibration of two cameras share. */
#ifndef IRIS_PAIR_PARTS_H
#define IRIS_PAIR_PARTS_H

#include "board_parts.h"
#include "iris/3d/calib_pair.h"

#define IRIS_PAIR_PARAMETERS                                                                                 \
    6 /* shared: a turn about the right camera's axes, and its place in the left one's frame */

/* Of a point: where straight rays show it, and what a miss there is in pixels, by the reference focal length: (right by
 * x, right by y, down by x, down by y). Index 0 is the left camera. */
typedef struct {
    iris_vec2 straight[2];
    iris_q32 weights[2][4];
} iris_pair_seen;

typedef struct {
    const iris_pair_view *views;
    const int32_t *first;       /* index of each view's first point */
    const iris_pair_seen *seen; /* of all points */
    iris_mat3 start;            /* from the left to the right camera, without the shared turn */
    iris_mat3 turn;             /* with this one */
    iris_q32 turned[3];
} iris_pair_data;

/* A point in both cameras; iris_board_source needs views whose `user` is an iris_pair_data: of one camera, whose picture
 * is the picture plane; and of both, the left one's points first. */
extern const iris_board_source iris_pair_left, iris_pair_right, iris_pair_both;

/* Makes `seen` of a point. ref: the reference focal length. Returns 0: a camera cannot show it so. */
int iris_pair_see(iris_pair_seen *seen, const iris_pair_point *point, const iris_sensor cameras[2],
                  iris_q32 ref);

/* What is missing of a point, as iris_board_show has it. */
int iris_pair_show(iris_vec2 *missing, iris_board_rows *rows, const iris_board_problem *of,
                   const iris_q32 shared[IRIS_BOARD_PARAMETERS], const iris_board_motion *motion,
                   const iris_board_seen *seen);

/* The memory of a calibration, and what it computes with. */
typedef struct {
    iris_board_problem of;
    iris_pair_data data;
    iris_board_motion *motions[2]; /* the board's before each camera */
    iris_q32 *sorted;              /* room for a number a view */
    iris_pair_seen *seen;
    int32_t *first;
    iris_q32 ref; /* focal length that distances in the pictures are shares of */
} iris_pair_work;

/* The frame, what the cameras see, the board's poses, and the pair to begin with. */
iris_pair_flaw iris_pair_start(int32_t *flawed, iris_pair_work *w, const iris_sensor cameras[2]);

/* What the refined problem says: places, distances that are left, deviations, and remarks. */
void iris_pair_figures(iris_pair_fit *fit, iris_pair_place *places, iris_pair_work *w);

#endif
