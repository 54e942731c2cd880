/* IRIS-3D - a camera's calibration as a text that people can read, to keep in a file:
 *
 *     iris camera 1
 *     size 640 480                                  of the pictures that it is for
 *     focal 532.8273216470 532.9461147310           alpha_u, alpha_v
 *     skew 0.0000000000
 *     center 342.4867933600 233.8557685700          u0, v0
 *     lens bends                                    or corrects
 *     radial -0.2808823890 0.0251785052 0.1634397870
 *     tangential 0.0012164549 -0.0001355407         p1, p2
 *     decentering 0.0000000000 0.0000000000
 *     check 09AF31C7                                over all numbers
 *
 * Numbers have ten digits behind the point, by which they are read again bit by bit. Empty lines, spaces, and what
 * stands behind a # do not count. A text that is written by hand, from a data sheet or another program's calibration, goes
 * without the line of the check: its last line ends with a line break then, so that one that was cut is known. OpenCV's
 * terms are these: focal fx fy, center cx cy, lens bends, radial k1 k2 k3, tangential p1 p2, and 0 for the others.
 */
#ifndef IRIS_3D_CAMERA_TEXT_H
#define IRIS_3D_CAMERA_TEXT_H

#include <stddef.h>

#include "iris/3d/camera.h"
#include "iris/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What stays the same wherever the camera is. */
typedef struct {
    iris_size size; /* of the pictures */
    iris_intrinsics intrinsics;
    iris_lens lens;
} iris_camera_model;

#define IRIS_CAMERA_TEXT_BYTES 448 /* enough for every model, with the 0 at the end */

/* *length: without the 0. IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: more than `capacity` bytes, a side outside
 * 1..IRIS_SIDE_MAX, a focal length not above 0, a number of a thousand million or more, or a direction that is none;
 * *text is untouched. O(1). */
iris_status iris_camera_write_text(char *text, size_t capacity, size_t *length,
                                   const iris_camera_model *model);

/* Reads `bytes` bytes of any content; a 0 at their end is no part of the text.
 * IRIS_ERR_ARG: null pointer. The others set *line, the line that is wrong, from 1, and nothing else:
 * IRIS_ERR_UNSUPPORTED: a later version; IRIS_ERR_TRUNCATED: the text ends early; IRIS_ERR_DATA: anything else, a
 * wrong check among them. A text without the line of the check is good. O(bytes). */
iris_status iris_camera_read_text(iris_camera_model *model, int32_t *line, const char *text, size_t bytes);

#ifdef __cplusplus
}
#endif

#endif
