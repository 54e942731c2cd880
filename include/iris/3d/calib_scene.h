/* IRIS-3D - a camera from a known scene: from six or more points, whose places in space are measured, and where a
 * picture shows them, to the camera: its intrinsic parameters and its pose. Report, section 2.7.
 *
 * The points must not lie on one plane, nor all but one of them. Lenses are not part of it: the picture's places
 * are those of straight rays (iris_lens_straighten, or a lens that bends little). Frames and signs are those of
 * camera.h: y down, z forward. Units of places in space are the user's; those of the picture pixels, or any other.
 *
 * Method: both sides are moved and scaled (Hartley, "In defense of the eight-point algorithm", 1997); each point gives
 * two of the 2 n equations in the twelve numbers of the projective matrix, which Givens rotations turn into a
 * triangle, whose smallest right singular vector is the linear solution (Hartley and Zisserman, Multiple View Geometry,
 * 7.1). From there the refined one: Levenberg and Marquardt's steps make the sum of squared distances in the picture
 * least, over all eleven parameters.
 *
 * With twelve points and more, wrong ones are left out, up to three of ten: of 128 sets of six, which are always the
 * same ones, that camera is chosen whose nearest half of the points is nearest (least median of squares), and points
 * are wrong that are eight times as far off as the good ones' noise. Errors below that count as noise.
 */
#ifndef IRIS_3D_CALIB_SCENE_H
#define IRIS_3D_CALIB_SCENE_H

#include "iris/3d/camera.h"
#include "iris/scratch.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_SCENE_POINTS_MIN 6
#define IRIS_SCENE_POINTS_MAX 1024

/* Coordinates within -2^28..2^28. */
typedef struct {
    iris_vec3 world;
    iris_vec2 image;
} iris_scene_point;

typedef enum {
    IRIS_SCENE_FINE = 0,
    IRIS_SCENE_TOO_FEW,      /* fewer than six different points, in space or in the picture */
    IRIS_SCENE_FLAT,         /* all but one of the points are on one plane, or nearly: 1/64 of their spread */
    IRIS_SCENE_UNDETERMINED, /* many cameras see the points so, or points of the picture are on one line, or all is
                                so far away that there is no perspective */
    IRIS_SCENE_BEHIND,       /* some points would be behind the camera: points may be interchanged */
    IRIS_SCENE_MIRRORED      /* no camera but a mirror's: axes point the wrong way, or are interchanged */
} iris_scene_flaw;

/* A camera, and how far the points are from where it shows them: of those that were not left out. */
typedef struct {
    iris_sensor sensor;  /* without a lens */
    iris_q32 total, rms; /* sum of distances in the picture, and root of the mean of their squares */
} iris_scene_camera;

typedef struct {
    iris_scene_flaw flaw;
    int32_t left_out;          /* how many points are wrong */
    iris_scene_camera linear;  /* algebraic errors are least */
    iris_scene_camera refined; /* the sum of squared distances is least */
} iris_scene_fit;

#define IRIS_SCENE_SCRATCH_BYTES(count)                                                                      \
    (IRIS_SCRATCH_ROUND((size_t)(count)*40) + IRIS_SCRATCH_ROUND((size_t)(count)*8) +                        \
     IRIS_SCRATCH_ROUND(90 * 8))

/* The camera that fits the points best. used: `count` bytes that become 1, or 0 for a point that was left out; it may
 * not overlap the points.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: count negative or above IRIS_SCENE_POINTS_MAX, a coordinate beyond 2^28;
 * IRIS_ERR_SCRATCH: too little; IRIS_ERR_DATA: the points do not determine a camera: fit->flaw says why, and nothing
 * else is valid. Less than 12 points: O(count), some 800 products of 128 bits for each; else 128 times 12000 of
 * them more, and 128 times 20 for each point. */
iris_status iris_scene_calibrate(iris_scene_fit *fit, uint8_t *used, const iris_scene_point *points,
                                 int32_t count, iris_scratch *scratch);

/* How far the point is from where the camera shows it; the largest number for what is not in front of it. */
iris_q32 iris_scene_distance(const iris_sensor *sensor, const iris_scene_point *point);

#ifdef __cplusplus
}
#endif

#endif
