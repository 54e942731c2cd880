/* IRIS-3D - a calibrated camera on a robot: from how it is mounted to the floor it sees, in millimeters.
 *
 * The world is the floor of floor.h, with its height: x to the right, y ahead of the robot, z up, in millimeters. The
 * floor is flat, and is z = 0.
 *
 *     z ^        camera              tilt: the optical axis, below the horizon
 *       |       C---___  tilt
 *       |       |      ---___ axis   pan:  to the right, as seen from above
 *       |       | height     ---     roll: the camera's right side is lower than its left one
 *       +---------------------------> y
 *       |<----->| ahead
 *
 * Four marks on the floor say the same without any of this, and include how exactly it is mounted (iris_floor_fit): half a
 * degree of tilt is 2 % of the distance at three heights. Report, section 2.7. Null pointers are IRIS_ERR_ARG.
 */
#ifndef IRIS_3D_MOUNTING_H
#define IRIS_3D_MOUNTING_H

#include "iris/3d/camera_text.h"
#include "iris/3d/remap.h"
#include "iris/xt/birdseye.h"
#include "iris/xt/floor.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_MOUNTING_HEIGHT_MIN ((iris_q32)1 << 32)     /* 1 mm */
#define IRIS_MOUNTING_FAR        ((iris_q32)32000 << 32) /* of every length, mm */

/* Lengths in millimeters, angles in radians, both with 32 fraction bits. */
typedef struct {
    iris_q32 height;          /* of the optical center, IRIS_MOUNTING_HEIGHT_MIN..IRIS_MOUNTING_FAR */
    iris_q32 tilt, pan, roll; /* in this order, from a level camera that looks ahead */
    iris_q32 right, ahead;    /* of the optical center beside the floor's (0, 0), within IRIS_MOUNTING_FAR */
} iris_mounting;

/* Where the camera is in the world. The rotation is within 4 units. IRIS_ERR_RANGE: a length out of range. O(1). */
iris_status iris_mounting_pose(iris_pose *pose, const iris_mounting *mounting);

/* The floor of pictures without the lens's bends, as iris_remap makes them of the camera's with the view of
 * iris_remap_view_defaults; of the camera's own, if its lens is none. The floor's numbers put a place within 2 m within
 * 1/1000 of a pixel of where it is, for heights from 20 mm and focal lengths up to 2000 pixels.
 * IRIS_ERR_RANGE: a length out of range, a focal length not above 0, or numbers that do not fit. O(1). */
iris_status iris_mounting_floor(iris_floor *floor, const iris_mounting *mounting,
                                const iris_camera_model *camera);

/* The bird's-eye view of the floor, straight from the camera's own pictures, lens and all: what another camera at the same
 * place sees that looks straight down. Give it to iris_remap_init, with the camera's intrinsics and lens. What is at or
 * above the horizon, or more than 8 focal lengths beside the optical axis, is filled. The view has a place every 4 pixels.
 * IRIS_ERR_ARG also: a scale out of range; IRIS_ERR_RANGE: a length out of range, or a side outside 1..IRIS_SIDE_MAX. O(1). */
iris_status iris_mounting_view(iris_remap_view *view, const iris_mounting *mounting,
                               const iris_birdseye_window *window);

#ifdef __cplusplus
}
#endif

#endif
