/* IRIS-3D - how two cameras stand to each other: from views of a flat board that both see at the same time, such as the
 * corners of a chessboard, with cameras that are calibrated already (calib_board.h), to the right camera's turn and
 * place in the left one's frame.
 *
 * Two or three views that fill both pictures and tilt the board are good; one is the least. Frames and signs are those
 * of camera.h, so that its place is not the t of R X + t (which is -R times the place); the unit is that of the board.
 *
 * Method: the board's pose before each camera by the homography of straightened places, and what these say of the pair,
 * the median of all views; from there Levenberg and Marquardt's steps (as calib_board.h) over the pair's six numbers
 * and the board's pose in each view, which make the sum of squared distances in both pictures least. Distances are
 * those of straightened places, multiplied by what the lens makes of small ones there, so that a pixel counts as one.
 */
#ifndef IRIS_3D_CALIB_PAIR_H
#define IRIS_3D_CALIB_PAIR_H

#include "iris/3d/calib_board.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where a point is on the board, in any unit, and where the two pictures show it, in pixels. Within -2^28..2^28. */
typedef struct {
    iris_vec2 board, left, right;
} iris_pair_point;

typedef struct {
    const iris_pair_point *points;
    int32_t count; /* IRIS_BOARD_POINTS_MIN to IRIS_BOARD_POINTS_MAX */
} iris_pair_view;

typedef enum {
    IRIS_PAIR_FINE = 0,
    IRIS_PAIR_TOO_FEW, /* no view, or a view of fewer than four points */
    IRIS_PAIR_NO_RAY,  /* a place that the camera cannot show: its lens turns back before it */
    IRIS_PAIR_IN_LINE, /* the points of a view are on one line, or at fewer than four places */
    IRIS_PAIR_BEHIND /* no such cameras see a view so: points may be interchanged, or these are other cameras */
} iris_pair_flaw;

/* What is to be said against a calibration that was found. */
enum {
    /* The distance of the cameras is less than three of its standard deviations, or 1/2048 of the board's longer side. */
    IRIS_PAIR_ONE_PLACE = 1,
    IRIS_PAIR_LOOSE = 2,  /* one of these is above 1/100 of the distance */
    IRIS_PAIR_FAR_OFF = 4 /* rms is above a pixel */
};

typedef struct {
    iris_pair_flaw flaw;
    int32_t flawed;    /* index of the view with the flaw; -1: all together */
    iris_pose right;   /* the right camera in the left one's frame */
    iris_q32 baseline; /* the distance of the two */
    iris_q32 rms;      /* root of the mean of squared distances in both pictures, pixels */
    iris_q32 deviations
        [6]; /* standard deviations by the noise that rms shows: of turns about the right camera's x, y,
                                and z axis, in radians; of its place's x, y, and z */
    uint32_t remarks; /* IRIS_PAIR_ONE_PLACE and so on */
} iris_pair_fit;

/* Of a view. */
typedef struct {
    iris_pose left;  /* the left camera in the board's frame */
    iris_q32 rms[2]; /* left and right, pixels */
} iris_pair_place;

/* points: of all views together. */
#define IRIS_PAIR_SCRATCH_BYTES(views, points)                                                               \
    (3 * IRIS_SCRATCH_ROUND((size_t)(views)*96) + IRIS_SCRATCH_ROUND((size_t)(views)*4) +                    \
     IRIS_SCRATCH_ROUND((size_t)(views)*8) + IRIS_SCRATCH_ROUND((size_t)(points)*96) +                       \
     IRIS_SCRATCH_ROUND(152 * 8) + IRIS_SCRATCH_ROUND(65 * 8))

/* The pair, and the left camera's place in each of `count` views.
 *   cameras  left and right: intrinsics and lens; their poses do not matter
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: more views or points than IRIS_BOARD_VIEWS_MAX and IRIS_BOARD_POINTS_MAX,
 * a coordinate beyond 2^28, or an alpha outside 2^-8..2^20; IRIS_ERR_SCRATCH: too little; IRIS_ERR_DATA: the views do
 * not determine a pair: fit->flaw and fit->flawed say why, and nothing else is valid. For each point and each of some
 * 10 steps about 1500 products of 128 bits. */
iris_status iris_pair_calibrate(iris_pair_fit *fit, iris_pair_place *places, const iris_pair_view *views,
                                int32_t count, const iris_sensor cameras[2], iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
