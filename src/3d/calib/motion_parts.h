/* What the parts of a calibration from motion share. */
#ifndef IRIS_MOTION_PARTS_H
#define IRIS_MOTION_PARTS_H

#include "../camera/null_vector.h"
#include "iris/3d/calib_motion.h"

/* Unknowns: those of a pair's own turn, or else none; then the intrinsic ones; then the mount's turn and place. */
enum {
    IRIS_MOTION_OWN = 3,
    IRIS_MOTION_MOUNT = IRIS_MOTION_INTRINSICS,
    IRIS_MOTION_PLACE = IRIS_MOTION_MOUNT + 3,
    IRIS_MOTION_SHARED = IRIS_MOTION_PLACE + 3,
    IRIS_MOTION_UNKNOWNS = IRIS_MOTION_SHARED /* at once: with turns of their own there is no mount */
};

/* The shared parameters: intrinsic ones in the frame, and the mount. */
typedef struct {
    iris_q32 k[IRIS_MOTION_INTRINSICS];
    iris_mat3 mount;
    iris_vec3 lever; /* of the optical center, in the frame */
} iris_motion_camera;

typedef struct {
    const iris_motion_pair *pairs;
    int32_t count;
    uint32_t model;
    iris_vec2 middle;     /* places are middle + reach times what is computed with */
    iris_q32 reach, span; /* span: of the robot's shifts */
    int known;            /* motions are */
    iris_motion_camera camera;
    iris_mat3 *turns, *trial;       /* of each pair, if they are not known */
    int active[IRIS_MOTION_SHARED]; /* which of the shared parameters are looked for */
    int active_count;
    iris_triangle pair, all; /* of a pair and the active ones; of the active ones */
} iris_motion_problem;

/* From a place before to one after: turn p + depth shift, depth inverse and unknown. */
typedef struct {
    iris_mat3 turn;
    iris_vec3 shift;
    iris_mat3 lever; /* how the shift changes with the lever */
} iris_motion_way;

/* The way of pair v for this camera. */
void iris_motion_way_of(iris_motion_way *way, const iris_motion_problem *of, const iris_motion_camera *camera,
                        const iris_mat3 *turns, int32_t v);

/* One or two equations of a match: the unknowns are a turn of its own (three), and all shared ones; to the right what is
 * missing. */
typedef struct {
    int count;
    iris_q32 row[2][IRIS_MOTION_OWN + IRIS_MOTION_SHARED + 1];
} iris_motion_rows;

/* A match on the picture plane, and what it becomes. */
typedef struct {
    iris_vec3 before, after; /* after: of no depth */
    iris_vec2 seen;          /* where it is */
    iris_q32 inverse;        /* of depth */
    int slides;              /* it may be anywhere along a line */
    iris_vec2 plane;         /* where it is to be */
} iris_motion_ray;

/* What moves `after` by `step` moves in the frame. */
iris_vec2 iris_motion_moved(const iris_motion_ray *at, const iris_q32 *k, iris_vec3 step);

/* Of the intrinsic parameters, in the second picture and in the ray of the first one; and of all turns and the lever. */
void iris_motion_slopes_of_intrinsics(iris_motion_rows *rows, const iris_motion_ray *at, const iris_q32 *k,
                                      const iris_motion_way *way);
void iris_motion_slopes_of_turns(iris_motion_rows *rows, const iris_motion_ray *at, const iris_q32 *k,
                                 const iris_motion_way *way);

/* Returns 0 when no camera shows the match so. With `slopes` also what changes, else what is missing alone. */
int iris_motion_show(iris_motion_rows *rows, const iris_motion_camera *camera, const iris_motion_way *way,
                     const iris_match *match, int slopes);

/* A match in the frame. */
iris_match iris_motion_scaled(const iris_motion_problem *of, const iris_match *match);

/* Checks the arguments' ranges. */
iris_status iris_motion_check(const iris_motion_pair *pairs, int32_t count, uint32_t models,
                              const iris_motion_config *config);

/* The frame, which parameters are looked for, and the camera to begin with but for its focal length. */
void iris_motion_begin(iris_motion_problem *of, const iris_motion_config *config);

/* Sets the focal length to begin with. */
void iris_motion_set_focal(iris_motion_camera *camera, iris_q32 alpha);

/* The sum of squares of a camera, of pair v or of all (-1). Returns of how many, or 0 if it does not show all. */
int32_t iris_motion_squares(iris_wide *sum, const iris_motion_problem *of, const iris_motion_camera *camera,
                            const iris_mat3 *turns, int32_t v);

#define IRIS_MOTION_ROUNDS 60 /* of refining to the end */

/* The focus of the one pair of a problem. */
iris_motion_flaw iris_motion_find_focus(iris_translation_fit *fit, const iris_motion_problem *of);

/* Levenberg and Marquardt's steps. Returns 0 when the start is none. */
int iris_motion_refine(iris_motion_problem *of, int rounds);

/* The root of a sum of squares divided by n. */
iris_q32 iris_motion_root_mean(iris_wide sum, int64_t n);

/* What was found, its figures, and whether it is determined. */
iris_motion_flaw iris_motion_take(iris_motion_fit *fit, iris_motion_problem *of);

#endif
