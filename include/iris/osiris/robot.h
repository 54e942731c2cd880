/* Osiris - a robot as behaviors see it: what is around it, where it is, and driving it; not which hardware does that.
 *
 *     osiris_robot robot;                                             a plan of robot_text.h, drivers for its devices
 *     osiris_robot_init(&robot, readings, &plan);
 *     osiris_robot_bind(&robot, 0, &osiris_simulated_driver, &simulated, now_ms);
 *     for (;;) {
 *         osiris_robot_sense(&robot, now_ms);
 *         if (osiris_robot_obstacle(&obstacle, &robot, 0) == IRIS_OK && obstacle.distance_mm < 200) ...
 *         osiris_robot_drive(&robot, 200, 0, now_ms);                 every 500 ms or sooner
 *     }
 *
 * The same calls drive a differential, an Ackermann, and an omni robot.
 */
#ifndef IRIS_OSIRIS_ROBOT_H
#define IRIS_OSIRIS_ROBOT_H

#include "iris/osiris/model.h"
#include "iris/osiris/plan.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A robot that is told nothing for so long has stopped by itself; a drive begins at a standstill then. */
#define OSIRIS_HOLD_MS 500

/* Read `plan`, `readings`, and drive.velocity; the rest belongs to the functions. */
typedef struct {
    const osiris_plan *plan;
    osiris_reading *readings; /* of the device of the same index */
    osiris_drive drive;
    const osiris_driver *drivers[OSIRIS_DRIVERS_MAX]; /* null: none is bound */
    void *contexts[OSIRIS_DRIVERS_MAX];
    osiris_pose origin;    /* of odometry, on the floor */
    osiris_track reckoned; /* from what the drive was told, where nothing measures it */
    uint32_t told_ms;
    int32_t is_told;
} osiris_robot;

/* Makes a robot of a plan, without drivers. The plan, its devices, and readings (plan->device_count of them) must outlive it.
 * IRIS_ERR_ARG: null pointer, or a bad plan; nothing is touched. O(devices^2). */
iris_status osiris_robot_init(osiris_robot *robot, osiris_reading *readings, const osiris_plan *plan);

/* The plan's driver of this index is `driver` from now on, and is opened. IRIS_ERR_ARG: null pointer, or no such driver in
 * the plan. What opening says otherwise: with IRIS_ERR_IO the driver stays, and goes on trying; with others it is not bound. */
iris_status osiris_robot_bind(osiris_robot *robot, int32_t index, const osiris_driver *driver, void *context,
                              uint32_t now_ms);

/* Closes all drivers. Null and a second call do nothing. */
void osiris_robot_close(osiris_robot *robot, uint32_t now_ms);

/* Takes what the sensors have new. IRIS_ERR_ARG: null pointer; IRIS_ERR_IO: a driver failed: its readings are OSIRIS_BROKEN, all
 * others are as they should be. A device without a driver has OSIRIS_NEVER. O(devices), and the drivers' time. */
iris_status osiris_robot_sense(osiris_robot *robot, uint32_t now_ms);

/* --- driving --- */

/* Drives on towards a speed ahead, mm/s, and a turn rate, angle units a second, positive to the right, within the drive's limits
 * and by its ramps. An Ackermann robot that is to turn on the spot shuffles (drive.h). To be called again and again.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_UNSUPPORTED: the plan has no drive, or no driver for it; else what the driver says. O(1). */
iris_status osiris_robot_drive(osiris_robot *robot, int32_t speed_mms, int32_t turn_rate, uint32_t now_ms);

/* The same, and to the left at left_mms, for robots that can; others do not. */
iris_status osiris_robot_glide(osiris_robot *robot, int32_t speed_mms, int32_t left_mms, int32_t turn_rate,
                               uint32_t now_ms);

/* Stands still at once, without a ramp. Errors as osiris_robot_drive. */
iris_status osiris_robot_stop(osiris_robot *robot, uint32_t now_ms);

/* Tells the actuator of this index, which is not a drive, its values (device.h), limited to what it does.
 * IRIS_ERR_ARG: null pointer, or no such actuator; IRIS_ERR_UNSUPPORTED: no driver; else what the driver says. */
iris_status osiris_robot_tell(osiris_robot *robot, int32_t device, const int32_t values[OSIRIS_VALUES],
                              uint32_t now_ms);

/* --- asking --- 
 *
 * Each answers by the readings of the last osiris_robot_sense. IRIS_ERR_ARG: null pointer; IRIS_ERR_UNSUPPORTED: the robot has no
 * device for that; IRIS_ERR_TIMEOUT: it has, but none that knows now. Outputs are written with IRIS_OK only, unless said. */

/* "The range sensors that look forward within 30 degrees, nearest first": {OSIRIS_RANGE, 0, 5461}. */
typedef struct {
    osiris_kind kind;
    iris_angle direction; /* on the robot, counterclockwise from ahead */
    int32_t within;       /* angle units to either side, 0..32768 */
} osiris_query;

/* The indices of these devices: first those that measure something, the nearest (of ranges and cameras) first; then those
 * that look nearest to the direction. *count: how many there are. IRIS_ERR_FULL: more than capacity: the first ones are
 * there. None at all is IRIS_OK with 0. O(devices^2). */
iris_status osiris_robot_find(int32_t *found, int32_t capacity, int32_t *count, const osiris_robot *robot,
                              const osiris_query *query);

/* What is nearest in the way of the body in a direction. */
typedef struct {
    int32_t
        distance_mm; /* from the body's edge; 0 or more. Without anything: so far it is known to be free */
    int32_t uncertainty_mm; /* one standard deviation; 0 without anything */
    int32_t device;         /* whose reading that is */
    int32_t seen;           /* 1: there is something */
} osiris_obstacle;

/* By the range sensors: "distance to the nearest obstacle ahead" with direction 0. What a sensor meets counts when it, or some
 * part of its cone there, lies in the lane that the body takes in this direction; what is free is known by sensors that
 * look there within 30 degrees, without which nobody knows. O(devices). */
iris_status osiris_robot_obstacle(osiris_obstacle *obstacle, const osiris_robot *robot, iris_angle direction);

/* Something that a camera sees: where it is on the floor, if the robot is where it thinks. */
typedef struct {
    int32_t x_mm, y_mm;
    int32_t distance_mm;    /* from the robot's reference point */
    iris_angle direction;   /* on the robot */
    int32_t uncertainty_mm; /* one standard deviation, seen from the robot */
    int32_t radius_mm;
    uint32_t color; /* 0xRRGGBB */
    int32_t device;
} osiris_sight;

/* The nearest thing that cameras see. IRIS_ERR_END: they see nothing. O(devices). */
iris_status osiris_robot_object(osiris_sight *sight, const osiris_robot *robot);

/* The line under it: how far it lies to the right of the robot, mm, how it leans, and how far before the reference point
 * that was seen. IRIS_ERR_END: there is no line. O(devices). */
typedef struct {
    int32_t offset_mm, ahead_mm;
    iris_angle angle;
} osiris_line;
iris_status osiris_robot_line(osiris_line *line, const osiris_robot *robot);

/* 1 when a bump sensor that looks there within so many angle units is pressed (within 32768: any), 0 when none. O(devices). */
iris_status osiris_robot_bumped(int32_t *bumped, const osiris_robot *robot, iris_angle direction,
                                int32_t within);

/* Where it is on the floor: by odometry; without such a sensor, by what the drive was told. Never IRIS_ERR_UNSUPPORTED. O(1). */
iris_status osiris_robot_pose(osiris_pose *pose, const osiris_robot *robot);

/* It is known to be at `pose` now. IRIS_ERR_TIMEOUT: its odometry has not said anything yet. */
iris_status osiris_robot_place(osiris_robot *robot, osiris_pose pose);

/* Its heading: by a heading sensor; without one, of its pose. */
iris_status osiris_robot_heading(iris_angle *heading, const osiris_robot *robot);

/* The charge of the emptiest battery, permil. O(devices). */
iris_status osiris_robot_battery(int32_t *permil, const osiris_robot *robot);

#ifdef __cplusplus
}
#endif

#endif
