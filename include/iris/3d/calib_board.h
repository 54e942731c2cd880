/* IRIS-3D - a camera from a flat pattern: from views of a board with points whose places on it are known, such as the
 * corners of a chessboard, to the camera's intrinsic parameters, its lens, and its pose in each view.
 *
 * Ten views that tilt the board by 30 degrees and more, this way and that, and together fill the picture, are good; one
 * that is tilted is the least. Frames and signs are those of camera.h; the board is the plane z = 0 of the world.
 *
 * Method: Zhang, "A flexible new technique for camera calibration", 2000: the homography of each view, and the focal
 * lengths from all of them in closed form, here with the principal point in the middle of the picture; from there
 * Levenberg and Marquardt's steps over all parameters, which make the sum of squared distances in the picture least.
 * Givens rotations take a view's equations into a triangle and leave in it what they say of the shared parameters
 * alone, so that one view and the shared ones are all that is in memory (Golub and Van Loan, 5.2.5; Triggs and others,
 * "Bundle adjustment", 2000).
 */
#ifndef IRIS_3D_CALIB_BOARD_H
#define IRIS_3D_CALIB_BOARD_H

#include "iris/3d/camera.h"
#include "iris/image.h"
#include "iris/scratch.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_BOARD_POINTS_MIN 4
#define IRIS_BOARD_POINTS_MAX 4096 /* of a view */
#define IRIS_BOARD_VIEWS_MAX  256

/* Where a point is on the board, in any unit, and where the picture shows it, in pixels. Within -2^28..2^28. */
typedef struct {
    iris_vec2 board, image;
} iris_board_point;

typedef struct {
    const iris_board_point *points;
    int32_t count;
} iris_board_view;

/* What is looked for beside the focal lengths, the principal point, k1, and k2: any of these together. */
enum { IRIS_BOARD_SHEAR = 1, IRIS_BOARD_K3 = 2, IRIS_BOARD_TANGENTIAL = 4 };

typedef struct {
    uint32_t model; /* bits as above */
    iris_size size; /* of the pictures; 0, 0: unknown */
} iris_board_config;

typedef enum {
    IRIS_BOARD_FINE = 0,
    IRIS_BOARD_TOO_FEW, /* no view, a view of fewer than four points, or fewer equations than parameters */
    IRIS_BOARD_IN_LINE, /* the points of a view are on one line, or at fewer than four places */
    IRIS_BOARD_FACING,  /* the board faces the camera in all views: they tell nothing of the focal length */
    IRIS_BOARD_BEHIND   /* no camera sees a view so: points may be interchanged */
} iris_board_flaw;

/* The parameters, in the order of their standard deviations. */
enum {
    IRIS_BOARD_ALPHA_U,
    IRIS_BOARD_ALPHA_V,
    IRIS_BOARD_SKEW,
    IRIS_BOARD_U0,
    IRIS_BOARD_V0,
    IRIS_BOARD_LENS_K1,
    IRIS_BOARD_LENS_K2,
    IRIS_BOARD_LENS_K3,
    IRIS_BOARD_LENS_P1,
    IRIS_BOARD_LENS_P2,
    IRIS_BOARD_PARAMETERS
};

/* What is to be said against a calibration that was found. */
enum {
    IRIS_BOARD_COVERS_LITTLE =
        1, /* points in less than a half of 8 x 8 fields of the picture, whose size is known */
    IRIS_BOARD_TURNS_LITTLE =
        2,               /* no two views between which the board turns by 15 degrees out of its plane */
    IRIS_BOARD_LOOSE = 4 /* a focal length has a standard deviation above 1/200 of it */
};

typedef struct {
    iris_board_flaw flaw;
    int32_t flawed; /* index of the view with the flaw; -1: all together */
    iris_intrinsics intrinsics;
    iris_lens lens;
    iris_q32 rms; /* root of the mean of the squares of all points' distances in the picture */
    iris_q32 deviations
        [IRIS_BOARD_PARAMETERS]; /* standard deviations, by the noise that rms shows; 0: not looked for */
    uint32_t remarks;            /* IRIS_BOARD_COVERS_LITTLE and so on */
    int32_t fields;              /* how many of the 64 fields have points; -1: unknown */
} iris_board_fit;

/* Of a view. */
typedef struct {
    iris_pose pose;
    iris_q32 rms;
} iris_board_place;

#define IRIS_BOARD_SCRATCH_BYTES(views)                                                                      \
    (2 * IRIS_SCRATCH_ROUND((size_t)(views)*96) + IRIS_SCRATCH_ROUND(152 * 8) + IRIS_SCRATCH_ROUND(65 * 8))

/* The camera, and its place in each of `count` views. config null: no shear, k1 and k2, size unknown.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: more views or points than the limits, a coordinate beyond 2^28, a model
 * or size that is none; IRIS_ERR_SCRATCH: too little; IRIS_ERR_DATA: the views do not determine a camera: fit->flaw and
 * fit->flawed say why, and nothing else is valid. For each point and each of some 10 to 30 steps about 2000 products of
 * 128 bits. */
iris_status iris_board_calibrate(iris_board_fit *fit, iris_board_place *places, const iris_board_view *views,
                                 int32_t count, const iris_board_config *config, iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
