/* Osiris - a simulated robot in a world: a plan's drive and devices, without hardware.
 *
 * Its wheels do exactly what they are told, and its body is a disc that walls and things stop. Its sensors are those of the
 * plan, with their noise (of a seed: the same run again is the same, bit for bit), resolution, rate, and latency:
 *
 *     camera    the nearest thing within its field of view and reach that no wall hides
 *     range     the nearest wall or thing along rays in its cone; nothing nearer than its least
 *     line      the painted line that crosses under it, nearest to its middle
 *     bump      pressed when the body touches something on that side
 *     odometry  the movement, with an error of scale for way and turn that the seed draws (error_permil)
 *     heading   of the floor; battery: full at first, empty after endurance_s
 *
 * Without a word to its drive for OSIRIS_SIMULATED_HOLD_MS it stands still, as a good robot does.
 */
#ifndef IRIS_OSIRIS_SIMULATED_H
#define IRIS_OSIRIS_SIMULATED_H

#include "iris/osiris/plan.h"
#include "iris/osiris/world.h"

#ifdef __cplusplus
extern "C" {
#endif

#define OSIRIS_SIMULATED_HOLD_MS 500

/* Of one device: what was measured last, and is on its way or is there. Of an actuator: what it was told last (ready). */
typedef struct {
    osiris_raw pending, ready;
    uint32_t due_ms; /* of the next measurement */
    uint8_t is_pending, is_new;
} osiris_simulated_device;

/* Read track, velocity, touches, toward, way_mm, touched; endurance_s may be changed; the rest belongs to the functions. */
typedef struct {
    osiris_track track;       /* where it truly is */
    osiris_velocity velocity; /* how it moves */
    uint8_t touches;          /* 1: it stands against something */
    iris_angle toward;        /* which lies in this direction of the floor */
    int32_t touched;          /* times that it ran into something */
    int64_t way_q16;          /* mm that it has driven, ahead or back */
    int32_t endurance_s;      /* of the battery, 3600 at first */

    const osiris_plan *plan;
    const osiris_world *world;
    osiris_simulated_device *devices;
    osiris_wheels wheels;
    uint32_t now_ms, start_ms, told_ms;
    uint32_t noise;
    osiris_track odometry;
    int32_t way_permil, turn_permil; /* that odometry is wrong by */
    osiris_pose start;
} osiris_simulated;

/* Makes a robot that stands at `start`. Plan, world, and devices must outlive it.
 *   devices   plan->device_count of them, the caller's
 *   start     IRIS_ERR_RANGE: a place of OSIRIS_PLACE_MAX_MM or more
 *   seed      of the noise; any
 * IRIS_ERR_ARG: null pointer, a bad plan or world. *robot is untouched then. O(devices). */
iris_status osiris_simulated_init(osiris_simulated *robot, osiris_simulated_device *devices,
                                  const osiris_plan *plan, const osiris_world *world, osiris_pose start,
                                  uint32_t seed);

/* Its clock is now_ms, without any time passing: before the first step. Null is ignored. */
void osiris_simulated_begin(osiris_simulated *robot, uint32_t now_ms);

/* Time goes on to now_ms (at most 60 s; less than nothing is nothing), in steps of 10 ms or less: it moves, and measures.
 * IRIS_ERR_ARG: null pointer. O(steps (walls + things) rays). */
iris_status osiris_simulated_step(osiris_simulated *robot, uint32_t now_ms);

/* Its driver; the context is the osiris_simulated. Every device of the plan is served, whichever driver the plan names. */
extern const osiris_driver osiris_simulated_driver;

#ifdef __cplusplus
}
#endif

#endif
