/* IRIS-3D - maps: where a robot is on the floor of its map, and how it got there.
 *
 * A map's floor is in millimeters, x to the right (east) and y up the page (north), as map servers of robots have it.
 * A heading is counterclockwise from x, 65536 to a turn. The robot's own frame has x ahead and y to its left, with (0, 0)
 * its reference point: a pose of (0, 0, 0) makes the two the same. Heights are above the floor.
 *
 *     y                    x ahead
 *     |                   /
 *     |        y left    /
 *     |            \    /  heading
 *     |             robot - - -
 *     +------------------------ x
 */
#ifndef IRIS_3D_MAP_POSE_H
#define IRIS_3D_MAP_POSE_H

#include "iris/fixed.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Places on a map are nearer to 0 than this in x and y: 268 km. */
#define IRIS_MAP_PLACE_MAX_MM ((int32_t)1 << 28)

typedef struct {
    int32_t x_mm, y_mm;
    iris_angle heading;
} iris_map_pose;

/* Where the robot is after `step`, which is in its own frame at `pose`: what odometry says since then. Places are rounded
 * to a millimeter, and saturate. Every input is taken. O(1). */
iris_map_pose iris_map_pose_after(iris_map_pose pose, iris_map_pose step);

/* The step that leads from one pose to the other: iris_map_pose_after(from, step) is `to`, within a millimeter, where
 * the two are within IRIS_MAP_PLACE_MAX_MM. Every input is taken. O(1). */
iris_map_pose iris_map_pose_step(iris_map_pose from, iris_map_pose to);

#ifdef __cplusplus
}
#endif

#endif
