/* IRIS-3D - rectification: from two cameras that stand and look as they like to a pair of pictures in which what is in
 * one row of the left one is in the same row of the right one, as stereo.h wants them. Report, section 2.8.
 *
 *     left                right                 Both views are those of cameras without a lens that stand where the
 *      C ------- b ------- C'                   real ones do and look in one direction: across the baseline b, and
 *      | \               / |                    as near as can be to where both real ones look. They have one focal
 *      |  \             /  |                    length f and one principal point, so that what is infinitely far is
 *      v    view    view   v                    at the same place in both, and z = b f / d.
 *
 * Method: the baseline is the x axis of the views; Fusiello, Trucco, and Verri, "A compact algorithm for
 * rectification of stereo pairs", 2000. How much of the pictures the views show is found on their outlines.
 */
#ifndef IRIS_3D_RECTIFY_H
#define IRIS_3D_RECTIFY_H

#include "iris/3d/remap.h"
#include "iris/scratch.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How much the views show. */
typedef enum {
    IRIS_RECTIFY_VALID = 0, /* as much as both cameras see wholly: every pixel of both views is valid */
    IRIS_RECTIFY_ALL        /* all that either camera sees, and what neither sees is filled */
} iris_rectify_keep;

typedef struct {
    iris_size size; /* of the views: 16..IRIS_SIDE_MAX each, or 0, 0: that of the left camera's pictures */
    iris_rectify_keep keep; /* default IRIS_RECTIFY_VALID */
} iris_rectify_config;

typedef enum {
    IRIS_RECTIFY_FINE = 0,
    IRIS_RECTIFY_ONE_PLACE, /* the cameras are nearer to each other than 2^-16 units */
    IRIS_RECTIFY_SWAPPED,   /* the left camera is on the right */
    IRIS_RECTIFY_ALONG,     /* a camera looks along the baseline: by 30 degrees or less beside it */
    IRIS_RECTIFY_APART      /* the cameras look apart, by more than 90 degrees, or see nothing in common */
} iris_rectify_flaw;

/* Index 0 is the left camera, 1 the right one. */
typedef struct {
    iris_rectify_flaw flaw;
    iris_remap_view views[2]; /* for iris_remap_init with the camera: a place every 8 pixels, black outside */
    iris_sensor cameras[2];   /* those that would take the views: in the world, without lenses */
    iris_q32 baseline, focal; /* b in the cameras' unit, f in pixels */
} iris_rectified;

/* Working memory: the outlines of the two pictures. */
#define IRIS_RECTIFY_SAMPLES       128 /* of an outline */
#define IRIS_RECTIFY_SCRATCH_BYTES (2u * IRIS_SCRATCH_ROUND(8u * IRIS_RECTIFY_SAMPLES))

/* The views of two calibrated cameras, in one world.
 *   cameras  left and right. Any geometry: turned towards each other, rolled, one higher or further ahead than the
 *            other. Where the right one is above or below the left one the views are turned by a right angle.
 *   sizes    of their pictures: 2..IRIS_REMAP_SOURCE_MAX
 *   config   may be null for the defaults
 * A point that both cameras see is in the same row of both views to 2^-12 pixels by their numbers (with a baseline of
 * 2^-8 units or more), and to 0.15 pixels by a map with a place every 8 pixels (remap.h says of what lenses).
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: a size, keep, or an alpha out of range; IRIS_ERR_SCRATCH: less than
 * IRIS_RECTIFY_SCRATCH_BYTES; these leave *made untouched. IRIS_ERR_DATA: made->flaw says why, and nothing else is
 * valid. Some 500 places through the lens, and 400 comparisons with the outlines. */
iris_status iris_rectify(iris_rectified *made, const iris_sensor cameras[2], const iris_size sizes[2],
                         const iris_rectify_config *config, iris_scratch *scratch);

/* Where in the world a place of the left view is: disparity in 256ths of a pixel, as stereo.h has them.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: a disparity of 0 or 1 (no match, or infinitely far), or a depth or a
 * place beyond what numbers can be; *world is untouched. O(1). */
iris_status iris_rectify_point(iris_vec3 *world, const iris_rectified *rectified, iris_vec2 pixel,
                               uint16_t disparity);

#ifdef __cplusplus
}
#endif

#endif
