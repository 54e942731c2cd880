/* What the parts of a calibration from a board share. */
#ifndef IRIS_BOARD_PARTS_H
#define IRIS_BOARD_PARTS_H

#include "../camera/null_vector.h"
#include "iris/3d/calib_board.h"

#define IRIS_BOARD_POSE     6 /* unknowns of a view */
#define IRIS_BOARD_UNKNOWNS (IRIS_BOARD_POSE + IRIS_BOARD_PARAMETERS)

/* From the board to the camera: turn X + shift. */
typedef struct {
    iris_mat3 turn;
    iris_vec3 shift;
} iris_board_motion;

/* Places are middle + reach times what is computed with: on the board, and in the picture. */
typedef struct {
    iris_vec2 board, image;
    iris_q32 board_reach, image_reach;
} iris_board_frame;

typedef struct iris_board_problem iris_board_problem;

/* A point of a view, in the frame; and of a pair of cameras which one sees it, and what its misses weigh. */
typedef struct {
    iris_board_point at;
    const iris_q32 *weights;
    int is_right;
} iris_board_seen;

/* The two equations of a point: the unknowns are a turn (three), a shift (three), and the shared parameters; to the
 * right what is missing to the place in the picture. */
typedef struct {
    iris_q32 right[IRIS_BOARD_UNKNOWNS + 1], down[IRIS_BOARD_UNKNOWNS + 1];
} iris_board_rows;

/* Where a problem has its points from, and what cameras make of them. */
typedef struct {
    int32_t (*count)(const iris_board_problem *of, int32_t v); /* points of a view */
    iris_board_seen (*point)(const iris_board_problem *of, int32_t v, int32_t i);
    /* As iris_board_show. */
    int (*show)(iris_vec2 *missing, iris_board_rows *rows, const iris_board_problem *of,
                const iris_q32 shared[IRIS_BOARD_PARAMETERS], const iris_board_motion *motion,
                const iris_board_seen *seen);
} iris_board_source;

struct iris_board_problem {
    const iris_board_source *source;
    void *user; /* the source's */
    const iris_board_view *views;
    int32_t count;
    iris_board_frame frame;
    iris_board_motion *motions, *trial; /* of each view */
    iris_q32 shared[IRIS_BOARD_PARAMETERS];
    int active[IRIS_BOARD_PARAMETERS]; /* which of them are looked for */
    int active_count;
    iris_triangle view, all; /* of a view and the active ones; of the active ones */
};

/* A point of a view in the frame: on the board, and in the picture. */
iris_board_point iris_board_scaled(const iris_board_problem *of, const iris_board_point *point);

/* What is missing of a point, in the frame, and with `rows` also the equations. Returns 0 behind the camera, and far
 * off the picture. */
int iris_board_show(iris_vec2 *missing, iris_board_rows *rows, const iris_q32 shared[IRIS_BOARD_PARAMETERS],
                    const iris_board_motion *motion, const iris_board_point *point);

/* The pose's six numbers of a row: by how much a coordinate changes with the place in the camera, and where the point
 * is from the board's middle, both in the camera's frame. */
void iris_board_pose_row(iris_q32 row[IRIS_BOARD_POSE], iris_vec3 by, iris_vec3 arm);

/* By how much a coordinate changes with the place in the camera when it changes by (by_x, by_y) with a place on the
 * picture plane. */
iris_vec3 iris_board_by_place(iris_q32 by_x, iris_q32 by_y, iris_vec2 plane, iris_q32 depth);

/* The motions to begin with, by the shared parameters. */
iris_board_flaw iris_board_poses(iris_board_problem *of, int32_t *flawed);

/* The frame, the focal lengths, and the motions to begin with. */
iris_board_flaw iris_board_start(iris_board_problem *of, int32_t *flawed, iris_size size);

/* The best parameters and motions from there. Returns 0 when some point is behind the camera at the start. */
int iris_board_refine(iris_board_problem *of);

/* Standard deviations of the parameters in the frame, if noise is 1. */
void iris_board_deviations(iris_q32 deviations[IRIS_BOARD_PARAMETERS], iris_board_problem *of);

/* One of them by the noise that there is, times `reach` (0: times 1). */
iris_q32 iris_board_deviation(iris_q32 deviation, iris_q32 noise, iris_q32 reach);

/* The root of a sum of squares divided by n. */
iris_q32 iris_board_root_mean(iris_wide sum, int64_t n);

#endif
