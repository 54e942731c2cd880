#include "robot_senses.h"

#include <stdlib.h>
#include <string.h>

#define LOW_PERMIL 150
#define STEADY                                                                                               \
    100 /* angle units between two readings of odometry: it hardly turns, and a heading that is late is right */
#define HEADING_SHARE 8 /* of what a heading tells otherwise, this part is believed at once */

void robot_senses_init(robot_senses *senses, const osiris_plan *plan, osiris_pose start)
{
    memset(senses, 0, sizeof *senses);
    senses->plan = plan;
    senses->pose = start;
    senses->x_q16 = (int64_t)start.x_mm * 65536;
    senses->y_q16 = (int64_t)start.y_mm * 65536;
}

/* The way since the last reading. Returns how far it turned. */
static int32_t move_on(robot_senses *senses, osiris_pose odometry)
{
    const osiris_pose step = osiris_pose_step(senses->odometry, odometry);
    const iris_angle before = senses->pose.heading;
    const int64_t s = iris_sin_q30(before), c = iris_cos_q30(before);
    senses->x_q16 += (step.x_mm * c - step.y_mm * s) / 16384;
    senses->y_q16 += (step.x_mm * s + step.y_mm * c) / 16384;
    senses->pose.x_mm = (int32_t)iris_round_shift(senses->x_q16, 16);
    senses->pose.y_mm = (int32_t)iris_round_shift(senses->y_q16, 16);
    senses->pose.heading = iris_angle_wrap(before + step.heading);
    senses->odometry = odometry;
    return step.heading;
}

void robot_senses_take(robot_senses *senses, int32_t device, const osiris_raw *raw)
{
    const osiris_device *d = &senses->plan->devices[device];
    osiris_raw *reading = &senses->readings[device];
    *reading = *raw;
    reading->values[0] = osiris_calibration_value(&d->calibration, raw->values[0]);
    if (d->kind == OSIRIS_ODOMETRY && raw->validity == OSIRIS_VALID) {
        const osiris_pose odometry = {reading->values[0], reading->values[1],
                                      iris_angle_wrap(reading->values[2])};
        senses->is_steady = abs(move_on(senses, odometry)) < STEADY;
    } else if (d->kind == OSIRIS_HEADING && raw->validity == OSIRIS_VALID && senses->is_steady) {
        const int32_t off = iris_angle_wrap(reading->values[0] - senses->pose.heading);
        senses->pose.heading = iris_angle_wrap(senses->pose.heading + off / HEADING_SHARE);
    }
}

int32_t robot_free_mm(const robot_senses *senses, int32_t direction, int32_t half)
{
    int32_t nearest = ROBOT_FAR_MM;
    for (int32_t i = 0; i < senses->plan->device_count; i++) {
        const osiris_device *d = &senses->plan->devices[i];
        const osiris_raw *r = &senses->readings[i];
        if (d->kind == OSIRIS_RANGE && r->validity == OSIRIS_VALID && r->values[0] < nearest &&
            abs(iris_angle_wrap(d->place.heading - direction)) <= half) {
            nearest = r->values[0];
        }
    }
    return nearest;
}

/* The first device of a kind with a valid reading, or -1. */
static int32_t find_valid(const robot_senses *senses, osiris_kind kind)
{
    for (int32_t i = 0; i < senses->plan->device_count; i++) {
        if (senses->plan->devices[i].kind == kind && senses->readings[i].validity == OSIRIS_VALID) {
            return i;
        }
    }
    return -1;
}

int robot_sees_line(const robot_senses *senses, int32_t *offset_mm, int32_t *angle, int32_t *ahead_mm)
{
    const int32_t i = find_valid(senses, OSIRIS_LINE);
    if (i < 0) {
        return 0;
    }
    *offset_mm = senses->readings[i].values[0] - senses->plan->devices[i].place.y_mm;
    *angle = senses->readings[i].values[1];
    *ahead_mm = senses->plan->devices[i].place.x_mm;
    return 1;
}

int robot_sees_object(const robot_senses *senses, osiris_pose *place)
{
    const int32_t i = find_valid(senses, OSIRIS_CAMERA);
    if (i < 0) {
        return 0;
    }
    const osiris_pose step = {senses->readings[i].values[0], senses->readings[i].values[1], 0};
    *place = osiris_pose_after(senses->pose, step);
    return 1;
}

int robot_is_bumped(const robot_senses *senses)
{
    int bumped = 0;
    for (int32_t i = 0; i < senses->plan->device_count; i++) {
        bumped |= senses->plan->devices[i].kind == OSIRIS_BUMP &&
                  senses->readings[i].validity == OSIRIS_VALID && senses->readings[i].values[0];
    }
    return bumped;
}

int32_t robot_battery_permil(const robot_senses *senses)
{
    const int32_t i = find_valid(senses, OSIRIS_BATTERY);
    if (i < 0) {
        return 1000;
    }
    const osiris_device *d = &senses->plan->devices[i];
    const int64_t above = (int64_t)senses->readings[i].values[0] - d->least,
                  all = (int64_t)d->most - d->least;
    return all <= 0 || above >= all ? 1000 : above <= 0 ? 0 : (int32_t)(above * 1000 / all);
}

int robot_bumps_now(robot_senses *senses)
{
    const int before = senses->has_bumped;
    senses->has_bumped = (uint8_t)robot_is_bumped(senses);
    return senses->has_bumped && !before;
}

int robot_gets_low_now(robot_senses *senses)
{
    const int before = senses->was_low;
    senses->was_low = (uint8_t)(before || robot_battery_permil(senses) < LOW_PERMIL);
    return senses->was_low && !before;
}

int32_t robot_front_mm(const robot_senses *senses)
{
    return senses->plan->ahead_mm + senses->plan->length_mm / 2;
}

int32_t robot_radius_mm(const robot_senses *senses)
{
    const osiris_plan *plan = senses->plan;
    return (plan->length_mm > plan->width_mm ? plan->length_mm : plan->width_mm) / 2;
}

int32_t robot_cruise_mms(const robot_senses *senses)
{
    const int32_t half = senses->plan->drive.speed_max_mms / 2;
    return half < 1 ? 1 : half > 300 ? 300 : half;
}
