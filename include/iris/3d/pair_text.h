/* IRIS-3D - two cameras that are mounted together, as a text that people can read, to keep in a file:
 *
 *     iris pair 1
 *     left
 *     size 640 480                                  this camera's lines are those of camera_text.h
 *     ...
 *     decentering 0.0000000000 0.0000000000
 *     right
 *     size 640 480
 *     ...
 *     decentering 0.0000000000 0.0000000000
 *     turn 0.0000000000 0.0523598776 0.0000000000   from the left camera's frame to the right one's: its vector
 *     place 120.0000000000 0.0000000000 3.5000000000   where the right camera is in the left one's frame
 *     check 09AF31C7                                over all numbers
 *
 * The turn's vector is as iris_rotation_from_vector takes it: the axis, as long as the angle in radians. The place has
 * the unit of the board that the pair was calibrated with; the t of R X + t, which leads from the left camera's frame
 * to the right one's, is -R times it. Numbers are read again bit by bit.
 * A text that is written by hand goes without the line of the check, as a camera's.
 */
#ifndef IRIS_3D_PAIR_TEXT_H
#define IRIS_3D_PAIR_TEXT_H

#include "iris/3d/camera_text.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Index 0 is the left camera, 1 the right one. */
typedef struct {
    iris_camera_model cameras[2];
    iris_vec3 turn, place;
} iris_pair;

/* The two as sensors in the left camera's frame, which is the world then. Null pointers are not allowed. O(1). */
void iris_pair_sensors(iris_sensor sensors[2], const iris_pair *pair);

#define IRIS_PAIR_TEXT_BYTES 1152 /* enough for every pair, with the 0 at the end */

/* *length: without the 0. IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: a capacity below IRIS_PAIR_TEXT_BYTES, a camera
 * that iris_camera_write_text refuses, or a number of a thousand million or more; *text is untouched. O(1). */
iris_status iris_pair_write_text(char *text, size_t capacity, size_t *length, const iris_pair *pair);

/* As iris_camera_read_text: with an error *line is set, and nothing else. O(bytes). */
iris_status iris_pair_read_text(iris_pair *pair, int32_t *line, const char *text, size_t bytes);

#ifdef __cplusplus
}
#endif

#endif
