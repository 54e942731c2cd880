/* What a behavior asks a robot. */
#include <stddef.h>

#include "iris/osiris/robot.h"
#include "rounded.h"

/* How far a device looks past a direction, angle units. */
static int32_t aside(const osiris_device *device, iris_angle direction)
{
    return osiris_size_of(iris_angle_wrap(device->place.heading - direction));
}

/* How far what it measures is; INT32_MAX when that is nothing. */
static int32_t distance_of(const osiris_reading *reading)
{
    if (reading->validity != OSIRIS_VALID) {
        return INT32_MAX;
    }
    return reading->kind == OSIRIS_CAMERA  ? iris_sat_s32(iris_hypot(reading->values[0], reading->values[1]))
           : reading->kind == OSIRIS_RANGE ? reading->values[0]
                                           : 0;
}

static int is_before(const osiris_robot *robot, int32_t a, int32_t b, iris_angle direction)
{
    const int32_t far_a = distance_of(&robot->readings[a]), far_b = distance_of(&robot->readings[b]);
    const int32_t aside_a = aside(&robot->plan->devices[a], direction);
    const int32_t aside_b = aside(&robot->plan->devices[b], direction);
    return far_a != far_b ? far_a < far_b : aside_a < aside_b;
}

iris_status osiris_robot_find(int32_t *found, int32_t capacity, int32_t *count, const osiris_robot *robot,
                              const osiris_query *query)
{
    int32_t taken = 0, all = 0;
    if (!count || !robot || !query || capacity < 0 || (!found && capacity > 0)) {
        return IRIS_ERR_ARG;
    }
    for (int32_t i = 0; i < robot->plan->device_count; i++) {
        const osiris_device *device = &robot->plan->devices[i];
        if (device->kind != query->kind || aside(device, query->direction) > query->within) {
            continue;
        }
        all++;
        int32_t at = taken;
        while (at > 0 && is_before(robot, i, found[at - 1], query->direction)) {
            at--;
        }
        taken += taken < capacity;
        for (int32_t k = taken - 1; k > at; k--) {
            found[k] = found[k - 1];
        }
        if (at < capacity) {
            found[at] = i;
        }
    }
    *count = all;
    return all > capacity ? IRIS_ERR_FULL : IRIS_OK;
}

/* --- obstacles --- */

enum { STRAIGHT = 5461 }; /* 30 degrees */

/* The body's half sides along a direction and across it. */
static osiris_pose half_body(const osiris_plan *plan, iris_angle direction)
{
    const int32_t cosine = osiris_size_of(iris_cos_q30(direction)),
                  sine = osiris_size_of(iris_sin_q30(direction));
    osiris_pose half = {(iris_q30_mul(plan->length_mm, cosine) + iris_q30_mul(plan->width_mm, sine)) / 2,
                        (iris_q30_mul(plan->length_mm, sine) + iris_q30_mul(plan->width_mm, cosine)) / 2, 0};
    return half;
}

/* Where a device's reading would be `reach` away, seen from the body's middle: x in the direction, y across. */
static osiris_pose met_at(const osiris_plan *plan, const osiris_device *device, int32_t reach,
                          iris_angle direction)
{
    const osiris_pose middle = {plan->ahead_mm, 0, direction}, out = {reach, 0, 0};
    return osiris_pose_step(middle, osiris_pose_after(device->place, out));
}

/* What one sensor says of the way: something in it, or that it is free so far. */
static void add_range(osiris_obstacle *nearest, int32_t *knows, const osiris_robot *robot, int32_t i,
                      iris_angle direction)
{
    const osiris_device *device = &robot->plan->devices[i];
    const osiris_reading *reading = &robot->readings[i];
    const osiris_pose half = half_body(robot->plan, direction);
    const int32_t reach = reading->validity == OSIRIS_VALID ? reading->values[0] : device->most;
    const osiris_pose at = met_at(robot->plan, device, reach, direction);
    const int32_t spread =
        iris_q30_mul(reach, iris_sin_q30((iris_angle)osiris_within(device->width / 2, 0, 16384)));
    const int32_t distance = osiris_within(iris_sub_sat(at.x_mm, half.x_mm), 0, INT32_MAX);
    const int in_lane = at.x_mm > 0 && iris_sub_sat(osiris_size_of(at.y_mm), spread) <= half.y_mm;
    if (reading->validity == OSIRIS_VALID && in_lane && (!nearest->seen || distance < nearest->distance_mm)) {
        const osiris_obstacle found = {distance, reading->uncertainty[0], i, 1};
        *nearest = found;
    }
    if (aside(device, direction) <= STRAIGHT) {
        if (!nearest->seen && (!*knows || distance < nearest->distance_mm)) {
            const osiris_obstacle none = {distance, 0, i, 0};
            *nearest = none;
        }
        *knows = 1;
    }
}

iris_status osiris_robot_obstacle(osiris_obstacle *obstacle, const osiris_robot *robot, iris_angle direction)
{
    osiris_obstacle nearest = {0, 0, 0, 0};
    int32_t knows = 0, looks = 0;
    if (!obstacle || !robot) {
        return IRIS_ERR_ARG;
    }
    for (int32_t i = 0; i < robot->plan->device_count; i++) {
        const osiris_validity validity = robot->readings[i].validity;
        if (robot->plan->devices[i].kind == OSIRIS_RANGE) {
            looks |= aside(&robot->plan->devices[i], direction) <= STRAIGHT;
            if (validity == OSIRIS_VALID || validity == OSIRIS_BEYOND) {
                add_range(&nearest, &knows, robot, i, direction);
            }
        }
    }
    if (!nearest.seen && !knows) {
        return looks ? IRIS_ERR_TIMEOUT : IRIS_ERR_UNSUPPORTED;
    }
    *obstacle = nearest;
    return IRIS_OK;
}

/* --- what else is to be known --- */

/* The device of this kind whose reading is worth most: a valid one that is nearest, else one that works. -1: none works;
 * -2: there is none. */
static int32_t best_of(const osiris_robot *robot, osiris_kind kind)
{
    int32_t best = -2;
    for (int32_t i = 0; i < robot->plan->device_count; i++) {
        const osiris_validity validity = robot->readings[i].validity;
        if (robot->plan->devices[i].kind != kind) {
            continue;
        }
        if (validity != OSIRIS_VALID && validity != OSIRIS_BEYOND) {
            best = best == -2 ? -1 : best;
        } else if (best < 0 || distance_of(&robot->readings[i]) < distance_of(&robot->readings[best])) {
            best = i;
        }
    }
    return best;
}

static iris_status no_answer(int32_t best)
{
    return best == -2 ? IRIS_ERR_UNSUPPORTED : IRIS_ERR_TIMEOUT;
}

iris_status osiris_robot_object(osiris_sight *sight, const osiris_robot *robot)
{
    osiris_pose pose;
    if (!sight || !robot) {
        return IRIS_ERR_ARG;
    }
    const int32_t best = best_of(robot, OSIRIS_CAMERA);
    const iris_status status = best < 0 ? no_answer(best) : osiris_robot_pose(&pose, robot);
    if (status != IRIS_OK) {
        return status;
    }
    const osiris_reading *reading = &robot->readings[best];
    if (reading->validity != OSIRIS_VALID) {
        return IRIS_ERR_END;
    }
    const osiris_pose step = {reading->values[0], reading->values[1], 0};
    const osiris_pose there = osiris_pose_after(pose, step);
    const osiris_sight made = {there.x_mm,
                               there.y_mm,
                               distance_of(reading),
                               iris_atan2_angle(step.y_mm, step.x_mm),
                               reading->uncertainty[0],
                               reading->values[3],
                               (uint32_t)reading->values[2],
                               best};
    *sight = made;
    return IRIS_OK;
}

iris_status osiris_robot_line(osiris_line *line, const osiris_robot *robot)
{
    if (!line || !robot) {
        return IRIS_ERR_ARG;
    }
    const int32_t best = best_of(robot, OSIRIS_LINE);
    if (best < 0) {
        return no_answer(best);
    }
    const osiris_reading *reading = &robot->readings[best];
    const osiris_device *device = &robot->plan->devices[best];
    if (reading->validity != OSIRIS_VALID) {
        return IRIS_ERR_END;
    }
    const osiris_pose aside_of_it = {0, iris_sub_sat(0, reading->values[0]), 0};
    const osiris_pose at = osiris_pose_after(device->place, aside_of_it);
    line->offset_mm = iris_sub_sat(0, at.y_mm);
    line->ahead_mm = at.x_mm;
    line->angle = iris_angle_wrap(iris_angle_wrap(reading->values[1]) - device->place.heading);
    return IRIS_OK;
}

iris_status osiris_robot_bumped(int32_t *bumped, const osiris_robot *robot, iris_angle direction,
                                int32_t within)
{
    int32_t pressed = 0, knows = 0, has = 0;
    if (!bumped || !robot) {
        return IRIS_ERR_ARG;
    }
    for (int32_t i = 0; i < robot->plan->device_count; i++) {
        const osiris_device *device = &robot->plan->devices[i];
        if (device->kind == OSIRIS_BUMP && aside(device, direction) <= within) {
            const int valid = robot->readings[i].validity == OSIRIS_VALID;
            has = 1;
            knows |= valid;
            pressed |= valid && robot->readings[i].values[0] != 0;
        }
    }
    if (!knows) {
        return has ? IRIS_ERR_TIMEOUT : IRIS_ERR_UNSUPPORTED;
    }
    *bumped = pressed;
    return IRIS_OK;
}

/* What odometry says, from where it began. */
static iris_status odometry(osiris_pose *moved, const osiris_robot *robot)
{
    const int32_t best = best_of(robot, OSIRIS_ODOMETRY);
    if (best == -2) {
        *moved = osiris_track_pose(&robot->reckoned);
        return IRIS_OK;
    }
    if (best == -1) {
        return IRIS_ERR_TIMEOUT;
    }
    const int32_t *values = robot->readings[best].values;
    const osiris_pose pose = {values[0], values[1], iris_angle_wrap(values[2])};
    *moved = pose;
    return IRIS_OK;
}

iris_status osiris_robot_pose(osiris_pose *pose, const osiris_robot *robot)
{
    osiris_pose moved;
    if (!pose || !robot) {
        return IRIS_ERR_ARG;
    }
    const iris_status status = odometry(&moved, robot);
    if (status == IRIS_OK) {
        *pose = osiris_pose_after(robot->origin, moved);
    }
    return status;
}

iris_status osiris_robot_place(osiris_robot *robot, osiris_pose pose)
{
    const osiris_pose none = {0, 0, 0};
    osiris_pose moved;
    if (!robot) {
        return IRIS_ERR_ARG;
    }
    const iris_status status = odometry(&moved, robot);
    if (status == IRIS_OK) {
        robot->origin = osiris_pose_after(pose, osiris_pose_step(moved, none));
    }
    return status;
}

iris_status osiris_robot_heading(iris_angle *heading, const osiris_robot *robot)
{
    osiris_pose pose;
    if (!heading || !robot) {
        return IRIS_ERR_ARG;
    }
    const int32_t best = best_of(robot, OSIRIS_HEADING);
    if (best >= 0 && robot->readings[best].validity == OSIRIS_VALID) {
        *heading = iris_angle_wrap(robot->readings[best].values[0]);
        return IRIS_OK;
    }
    const iris_status status = best == -2 ? osiris_robot_pose(&pose, robot) : IRIS_ERR_TIMEOUT;
    if (status == IRIS_OK) {
        *heading = pose.heading;
    }
    return status;
}

iris_status osiris_robot_battery(int32_t *permil, const osiris_robot *robot)
{
    int32_t least = -1, has = 0;
    if (!permil || !robot) {
        return IRIS_ERR_ARG;
    }
    for (int32_t i = 0; i < robot->plan->device_count; i++) {
        const osiris_reading *reading = &robot->readings[i];
        if (robot->plan->devices[i].kind == OSIRIS_BATTERY) {
            has = 1;
            if (reading->validity == OSIRIS_VALID && (least < 0 || reading->values[1] < least)) {
                least = reading->values[1];
            }
        }
    }
    if (least < 0) {
        return has ? IRIS_ERR_TIMEOUT : IRIS_ERR_UNSUPPORTED;
    }
    *permil = least;
    return IRIS_OK;
}
