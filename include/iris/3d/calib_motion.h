/* IRIS-3D - a camera from its own motion, with a scene that nobody has measured: only which points of two pictures show the
 * same thing has to be known. Report, section 2.7 (calibration from an unknown scene).
 *
 * A camera that only turns: iris_rotation_calibrate. How it turned need not be known. The two pictures of a pair are
 * connected by the homography K R K^-1, whatever the distances are; that it is a rotation in between tells K (Hartley,
 * "Self-calibration of stationary cameras", 1997). A turn about the optical axis alone tells nothing of the focal length.
 *
 * A camera that only moves, without turning: iris_translation_focus. Where it moves to is the point of the picture from
 * which everything comes, the focus of expansion, K t. Of K alone it says nothing: the same pictures come from any focal
 * length with another direction. With known directions it does:
 *
 * A camera on a robot whose motions are known: iris_motion_calibrate. K, and how the camera is mounted (hand and eye):
 * each motion is the robot's turn and shift in its own frame.
 *
 * Method: places are moved and scaled; homographies by Givens rotations and their smallest singular vector; from the best
 * of some focal lengths Levenberg and Marquardt's steps make the sum of squared distances in the second pictures
 * least - those to the places, or where depth is unknown, to the lines on which they can be. Lenses are not part of it:
 * places are those of straight rays (iris_lens_straighten, or iris undistort). Frames and signs are those of camera.h.
 */
#ifndef IRIS_3D_CALIB_MOTION_H
#define IRIS_3D_CALIB_MOTION_H

#include "iris/3d/camera.h"
#include "iris/image.h"
#include "iris/scratch.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_MOTION_PAIRS_MAX   64
#define IRIS_MOTION_MATCHES_MIN 4
#define IRIS_MOTION_MATCHES_MAX 4096 /* of a pair */

/* The same thing in two pictures, pixels, within -2^28..2^28. */
typedef struct {
    iris_vec2 from, to;
} iris_match;

/* Two pictures, before and after a motion. */
typedef struct {
    const iris_match *matches;
    int32_t count;
    /* Known motions alone: the robot after the motion in its frame before it. A point x of the frame after is
     * turn x + shift before. */
    iris_mat3 turn;
    iris_vec3 shift;
} iris_motion_pair;

/* What is looked for beside one focal length: any of these together. Without IRIS_MOTION_CENTER the principal point is the
 * middle of the picture, without IRIS_MOTION_ASPECT pixels are square. */
enum { IRIS_MOTION_CENTER = 1, IRIS_MOTION_ASPECT = 2, IRIS_MOTION_SHEAR = 4, IRIS_MOTION_LEVER = 8 };

typedef struct {
    uint32_t model;
    iris_size size; /* of the pictures; 0, 0: unknown, their middle is that of all places then */
    /* Known motions alone: how the camera is mounted, roughly (within 20 degrees). turn: from the robot's frame to the
     * camera's; place: of the optical center, which is looked for with IRIS_MOTION_LEVER, or else is so. */
    iris_pose mount;
} iris_motion_config;

typedef enum {
    IRIS_MOTION_FINE = 0,
    IRIS_MOTION_TOO_FEW, /* no pair, a pair of too few matches, or fewer equations than parameters */
    IRIS_MOTION_IN_LINE, /* the matches of a pair are on one line, or at fewer than four places */
    IRIS_MOTION_STILL,   /* the camera hardly moves: less than a degree, or by less than matches are off */
    IRIS_MOTION_ROLLS,   /* it turns about its optical axis alone: that tells nothing of the focal length */
    IRIS_MOTION_UNDETERMINED, /* these motions leave some of what is looked for open */
    IRIS_MOTION_OTHER         /* no such motion: matches may be wrong, or the camera moved otherwise */
} iris_motion_flaw;

/* The parameters, in the order of their standard deviations. */
enum {
    IRIS_MOTION_ALPHA_U,
    IRIS_MOTION_ALPHA_V,
    IRIS_MOTION_SKEW,
    IRIS_MOTION_U0,
    IRIS_MOTION_V0,
    IRIS_MOTION_INTRINSICS
};

typedef struct {
    iris_motion_flaw flaw;
    int32_t flawed; /* index of the pair with the flaw; -1: all together */
    iris_intrinsics intrinsics;
    iris_q32 deviations
        [IRIS_MOTION_INTRINSICS]; /* standard deviations, by the noise that rms shows; 0: not looked for */
    iris_q32 rms;                 /* root of the mean of the squares of distances in the second pictures */
    iris_pose mount;              /* known motions alone */
    /* Of its turn, radians about the camera's axes; and of its place, where that is looked for: what no motion tells of it,
     * such as the height on a robot that turns about an upright axis, stays as it was, and has a deviation beyond all sense. */
    iris_vec3 mount_deviation, lever_deviation;
} iris_motion_fit;

/* Of a pair: how the camera turned, from its frame before to that after, and what is left over. */
typedef struct {
    iris_mat3 turn;
    iris_q32 rms;
} iris_motion_turn;

#define IRIS_ROTATION_SCRATCH_BYTES(pairs)                                                                   \
    (2 * IRIS_SCRATCH_ROUND((size_t)(pairs)*72) + IRIS_SCRATCH_ROUND(77 * 8) + IRIS_SCRATCH_ROUND(77 * 8))
#define IRIS_MOTION_SCRATCH_BYTES (IRIS_SCRATCH_ROUND(77 * 8) + IRIS_SCRATCH_ROUND(77 * 8))

/* The camera, and its turn between the pictures of each pair. config null: one focal length alone, size unknown; mount and
 * IRIS_MOTION_LEVER are not looked at. One pair of 20 degrees will do for the focal length: 600 pixels within 3
 * (root mean square) at 0.3 pixels of noise and 50 matches all over a picture of 640 x 480; six pairs about both axes give it
 * within 2, and the center within 3.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: more pairs or matches than the limits, a coordinate beyond 2^28, a model or
 * size that is none; IRIS_ERR_SCRATCH: too little; IRIS_ERR_DATA: fit->flaw and fit->flawed say why the matches do not
 * determine the camera, and nothing else is valid. For each match and each of some 10 to 30 steps about 600 products of
 * 128 bits. */
iris_status iris_rotation_calibrate(iris_motion_fit *fit, iris_motion_turn *turns,
                                    const iris_motion_pair *pairs, int32_t count,
                                    const iris_motion_config *config, iris_scratch *scratch);

/* The camera and its mount from known motions. config must not be null. Motions of a robot on wheels do: it turns, and
 * drives straight ahead. Matches of a pair may be at any depths. Six such motions give a focal length of 600
 * pixels within 2, and the mount's turn within 0.2 degrees, at the same noise.
 * Errors and cost as above. */
iris_status iris_motion_calibrate(iris_motion_fit *fit, const iris_motion_pair *pairs, int32_t count,
                                  const iris_motion_config *config, iris_scratch *scratch);

/* Where a camera moves to. */
typedef struct {
    iris_motion_flaw flaw;
    int ahead;           /* 1: the camera comes nearer to what is there, 0: it moves away from it */
    iris_vec3 focus;     /* K t of length 1, t the way the camera moved in its own frame */
    iris_vec2 pixel;     /* the same in pixels, (x / z, y / z); the largest numbers where z is 0 */
    iris_vec2 deviation; /* standard deviations of pixel, by the noise that rms shows */
    iris_q32 rms;        /* root of the mean of the squares of distances from the lines through it */
} iris_translation_fit;

/* The focus of expansion of a camera that moves without turning. size: of the pictures; 0, 0: unknown. Four matches that move
 * are the least. IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: as above; IRIS_ERR_DATA: fit->flaw: too few matches, or hardly
 * any that move (IRIS_MOTION_STILL), or all on one line through it (IRIS_MOTION_IN_LINE), or not such a motion. O(count): some
 * 600 products of 128 bits for each. */
iris_status iris_translation_focus(iris_translation_fit *fit, const iris_match *matches, int32_t count,
                                   iris_size size);

#ifdef __cplusplus
}
#endif

#endif
