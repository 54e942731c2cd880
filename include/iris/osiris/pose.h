/* Osiris - where a robot is, and how it moves: the one place where both conventions are stated.
 *
 * The floor is in millimeters, x to the right (east) and y up the page (north), as maps of robots have it (and the poses of
 * iris/3d/map_pose.h). A heading is counterclockwise from x, 65536 to a turn. The robot's own frame has x ahead and y to its
 * left, with (0, 0) its reference point; directions on the robot are counterclockwise from ahead, so positive to the left.
 *
 *     y                    x ahead
 *     |                   /
 *     |        y left    /
 *     |            \    /  heading
 *     |             robot - - -
 *     +------------------------ x
 *
 * A turn rate is in angle units a second (65536: a turn a second) and positive to the right, as steering is: while a robot
 * turns to the right, its heading falls.
 */
#ifndef IRIS_OSIRIS_POSE_H
#define IRIS_OSIRIS_POSE_H

#include "iris/fixed.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Places in files and worlds are nearer to 0 than this in x and y: a kilometer. */
#define OSIRIS_PLACE_MAX_MM ((int32_t)1 << 20)

typedef struct {
    int32_t x_mm, y_mm;
    iris_angle heading;
} osiris_pose;

/* Where something is on the floor that is at `step` in the frame of a robot at `pose`. Places are rounded to a millimeter,
 * and saturate. Every input is taken. O(1). */
osiris_pose osiris_pose_after(osiris_pose pose, osiris_pose step);

/* The step that leads from one pose to the other: where `to` is in the frame of a robot at `from`. osiris_pose_after(from,
 * step) is `to`, within a millimeter, unless places saturate. Every input is taken. O(1). */
osiris_pose osiris_pose_step(osiris_pose from, osiris_pose to);

/* How a robot moves now, in its own frame, finer than anybody measures it. */
typedef struct {
    iris_q16 ahead_q16; /* mm/s; negative: backwards */
    iris_q16 left_q16;  /* mm/s to its left: omnidirectional drives only */
    int32_t turn_q8;    /* 256ths of an angle unit a second, positive to the right */
} osiris_velocity;

/* A pose that small steps of movement add up in: 16 fraction bits more. */
typedef struct {
    int64_t x_q16, y_q16;
    uint32_t heading_q16; /* wraps */
} osiris_track;

/* Between the two; a track's place is rounded, and saturates. O(1). */
osiris_track osiris_track_from(osiris_pose pose);
osiris_pose osiris_track_pose(const osiris_track *track);

/* Moves on for elapsed_ms, 0 to 60000 (less and more count as these), at a constant velocity: an arc, by chords of at most
 * 10 ms. Places beyond 2^31 mm wrap. Null is ignored. One sine and cosine for each 10 ms. */
void osiris_track_move(osiris_track *track, const osiris_velocity *velocity, int32_t elapsed_ms);

#ifdef __cplusplus
}
#endif

#endif
