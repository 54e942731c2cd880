/* Numbers, vectors, rotations, and cameras for the operations in space. */
#ifndef IRIS_TEST_CALLS_SPACE_H
#define IRIS_TEST_CALLS_SPACE_H

#include "iris/3d/camera.h"
#include "iris/image.h"

/* Low to high, mostly with a fraction; and anything, sometimes extreme. */
iris_q32 draw_q32(int32_t low, int32_t high);
iris_q32 draw_any_q32(void);

/* Some of the numbers become anything, one time in so many. */
void draw_spoiled(iris_q32 *numbers, int count, uint32_t one_in);

/* Within -limit..limit; of length 1, along an axis or any; a rotation, and a place. */
iris_vec3 draw_vec3(int32_t limit);
iris_vec3 draw_direction(void);
iris_mat3 draw_turn(void);

/* A camera for pictures of this size, with a lens or without, not farther from (0, 0, 0) than `limit` along each axis. */
iris_sensor draw_sensor(iris_size size, int32_t limit);

/* The same, of which some numbers may be anything, in memory that the call may only read. */
const iris_sensor *draw_any_sensor(iris_size size, int32_t limit);

/* What the camera has in front of it, at so many units. */
iris_vec3 draw_seen(const iris_sensor *sensor, int32_t near, int32_t far);

#endif
