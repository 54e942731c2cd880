/* Osiris - a world to simulate robots in: walls, lines painted on the floor, colored things. And what can be seen in it.
 *
 * Places are in millimeters on the floor (pose.h), nearer to 0 than OSIRIS_PLACE_MAX_MM. The arrays are the caller's.
 */
#ifndef IRIS_OSIRIS_WORLD_H
#define IRIS_OSIRIS_WORLD_H

#include "iris/osiris/device.h"

#ifdef __cplusplus
extern "C" {
#endif

#define OSIRIS_LINE_REACH_MAX_MM 4096

/* A straight piece of a wall or of a painted line. */
typedef struct {
    int32_t x0_mm, y0_mm, x1_mm, y1_mm;
} osiris_segment;

/* A round thing that stands on the floor: cameras see its color, range sensors and wheels meet it. */
typedef struct {
    int32_t x_mm, y_mm, radius_mm; /* radius: 1..10000 */
    uint32_t color;                /* 0xRRGGBB */
} osiris_object;

typedef struct {
    const osiris_segment *walls;
    const osiris_segment *lines; /* pieces of polylines, in order */
    const osiris_object *objects;
    const osiris_pose *starts; /* where robots begin: the first one at the first */
    int32_t wall_count, line_count, object_count, start_count;
} osiris_world;

/* IRIS_ERR_ARG: null pointer (of an array of none it is allowed), a negative count, a place or radius outside its range.
 * O(counts). */
iris_status osiris_world_check(const osiris_world *world);

/* The functions below take a world that osiris_world_check accepts, and no null pointers; other numbers
 * outside their ranges count as the nearest within. Each is O(counts), a 64-bit
 * division for what is met. */

/* How far the first wall or thing is from a place in a direction: mm, or -1 when none is nearer than most_mm
 * (0..OSIRIS_PLACE_MAX_MM). From inside a thing: 0. */
int32_t osiris_world_range(const osiris_world *world, osiris_pose from, int32_t most_mm);

/* Is there a wall between two places? Touching it with an end counts. */
int osiris_world_is_hidden(const osiris_world *world, osiris_pose from, osiris_pose to);

/* Where a disc of this radius touches a wall or thing: 1, and *toward is the direction from the disc's middle to the nearest
 * of these (counterclockwise from x); 0 when it touches none. */
int osiris_world_touches(const osiris_world *world, iris_angle *toward, osiris_pose middle,
                         int32_t radius_mm);

/* Where painted lines cross the segment that reaches half_mm (0..OSIRIS_LINE_REACH_MAX_MM) to both sides of a place, across its
 * heading: 1, and the crossing that is nearest to the place: how far it lies to the right, mm, and the line's angle,
 * -90 to 90 degrees, positive when it leans right of the heading; 0 when there is none. */
int osiris_world_line(const osiris_world *world, int32_t *offset_mm, iris_angle *angle, osiris_pose at,
                      int32_t half_mm);

#ifdef __cplusplus
}
#endif

#endif
