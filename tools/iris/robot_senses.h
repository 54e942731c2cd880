/* What a robot's behaviors know of it: the newest reading of each of its devices, and what follows from them.
 */
#ifndef IRIS_TOOL_ROBOT_SENSES_H
#define IRIS_TOOL_ROBOT_SENSES_H

#include "iris/osiris/plan.h"

#define ROBOT_FAR_MM 1000000 /* nothing is near, as far as anybody can tell */

/* Read plan and pose; the rest belongs to the functions. */
typedef struct {
    const osiris_plan *plan;
    osiris_pose pose;                        /* where it takes itself to be on the floor */
    osiris_raw readings[OSIRIS_DEVICES_MAX]; /* in the devices' units */
    osiris_pose odometry;                    /* the newest of its readings */
    int64_t x_q16, y_q16;                    /* the pose's place, finer */
    uint8_t has_bumped, was_low, is_steady;
} robot_senses;

/* Nothing is known but where it begins. The plan must outlive it. */
void robot_senses_init(robot_senses *senses, const osiris_plan *plan, osiris_pose start);

/* A device's new raw value. */
void robot_senses_take(robot_senses *senses, int32_t device, const osiris_raw *raw);

/* The nearest thing that range sensors looking within `half` of a direction (counterclockwise from ahead) tell, from
 * the sensor; and that of any kind nearer than ROBOT_FAR_MM. */
int32_t robot_free_mm(const robot_senses *senses, int32_t direction, int32_t half);

/* 1: it is so now, and what it is like. The object's place is on the floor. */
int robot_sees_line(const robot_senses *senses, int32_t *offset_mm, int32_t *angle, int32_t *ahead_mm);
int robot_sees_object(const robot_senses *senses, osiris_pose *place);
int robot_is_bumped(const robot_senses *senses);

/* 1000: full, or it has no battery that tells. */
int32_t robot_battery_permil(const robot_senses *senses);

/* Did it run into something, or is its battery low, since the last call? Once each time. */
int robot_bumps_now(robot_senses *senses);
int robot_gets_low_now(robot_senses *senses);

/* From its reference point to its front; and half of its larger side, with what wheels and sensors need. */
int32_t robot_front_mm(const robot_senses *senses);
int32_t robot_radius_mm(const robot_senses *senses);

/* What it drives where nobody names a speed, mm/s. */
int32_t robot_cruise_mms(const robot_senses *senses);

#endif
