/* A simulated robot moves, and its driver. */
#include "iris/osiris/simulated.h"

#include <string.h>

#include "noise.h"
#include "rounded.h"
#include "simulated_parts.h"

enum { STEP_MS = 10, LONGEST_MS = 60000 };

/* Permil, with a standard deviation of error_permil; never so much that a speed no longer fits. */
static int32_t draw_scale(osiris_simulated *robot, int32_t error_permil)
{
    const int64_t drawn = osiris_noise_normal(&robot->noise) * (int64_t)error_permil / 65536;
    return osiris_within((int32_t)drawn, -500, 500);
}

static void draw_scales(osiris_simulated *robot)
{
    for (int32_t i = 0; i < robot->plan->device_count; i++) {
        const osiris_device *device = &robot->plan->devices[i];
        if (device->kind == OSIRIS_ODOMETRY) {
            robot->way_permil = draw_scale(robot, device->error_permil);
            robot->turn_permil = draw_scale(robot, device->error_permil);
            return;
        }
    }
}

iris_status osiris_simulated_init(osiris_simulated *robot, osiris_simulated_device *devices,
                                  const osiris_plan *plan, const osiris_world *world, osiris_pose start,
                                  uint32_t seed)
{
    if (!robot || osiris_plan_check(plan) != IRIS_OK || (!devices && plan->device_count > 0) ||
        osiris_world_check(world) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    if (osiris_size_of(start.x_mm) >= OSIRIS_PLACE_MAX_MM ||
        osiris_size_of(start.y_mm) >= OSIRIS_PLACE_MAX_MM) {
        return IRIS_ERR_RANGE;
    }
    memset(robot, 0, sizeof *robot);
    robot->plan = plan;
    robot->world = world;
    robot->devices = devices;
    robot->start = start;
    robot->track = osiris_track_from(start);
    robot->noise = seed * 2654435761u + 1;
    robot->endurance_s = 3600;
    robot->wheels.count = plan->drive.kind == OSIRIS_OMNI ? plan->drive.wheels : 2;
    draw_scales(robot);
    osiris_simulated_begin(robot, 0);
    return IRIS_OK;
}

void osiris_simulated_begin(osiris_simulated *robot, uint32_t now_ms)
{
    if (robot) {
        robot->now_ms = robot->start_ms = robot->told_ms = now_ms;
        for (int32_t i = 0; i < robot->plan->device_count; i++) {
            memset(&robot->devices[i], 0, sizeof robot->devices[i]);
            robot->devices[i].due_ms = now_ms;
        }
    }
}

/* The middle of the body, which is a disc. */
static osiris_pose middle_of(const osiris_simulated *robot, osiris_pose pose)
{
    const osiris_pose middle = {robot->plan->ahead_mm, 0, 0};
    return osiris_pose_after(pose, middle);
}

static int32_t radius_of(const osiris_plan *plan)
{
    return (plan->length_mm > plan->width_mm ? plan->length_mm : plan->width_mm) / 2;
}

/* Does the way from one place to the other lead towards something in this direction? */
static int leads_toward(const osiris_track *before, const osiris_track *after, iris_angle toward)
{
    const int64_t x = after->x_q16 - before->x_q16, y = after->y_q16 - before->y_q16;
    return x * (iris_cos_q30(toward) >> 14) + y * (iris_sin_q30(toward) >> 14) > 0;
}

static int is_outside(const osiris_track *track)
{
    const osiris_pose pose = osiris_track_pose(track);
    return osiris_size_of(pose.x_mm) >= OSIRIS_PLACE_MAX_MM ||
           osiris_size_of(pose.y_mm) >= OSIRIS_PLACE_MAX_MM;
}

static void move(osiris_simulated *robot, int32_t ms)
{
    osiris_track after = robot->track, *track = &robot->track;
    osiris_velocity felt = robot->velocity;
    iris_angle toward = 0;
    osiris_track_move(&after, &felt, ms);
    const osiris_pose there = middle_of(robot, osiris_track_pose(&after));
    const int stopped =
        is_outside(&after) || (osiris_world_touches(robot->world, &toward, there, radius_of(robot->plan)) &&
                               leads_toward(track, &after, toward));
    if (stopped) {
        track->heading_q16 = after.heading_q16;
        robot->touched += !robot->touches;
        robot->touches = 1;
        robot->toward = toward;
        felt.ahead_q16 = felt.left_q16 = 0;
    } else {
        if (track->x_q16 != after.x_q16 || track->y_q16 != after.y_q16) {
            robot->touches = 0;
        }
        *track = after;
        robot->way_q16 += osiris_quotient((int64_t)osiris_size_of(felt.ahead_q16) * ms, 1000);
    }
    felt.ahead_q16 += (int32_t)((int64_t)felt.ahead_q16 * robot->way_permil / 1000);
    felt.left_q16 += (int32_t)((int64_t)felt.left_q16 * robot->way_permil / 1000);
    felt.turn_q8 += (int32_t)((int64_t)felt.turn_q8 * robot->turn_permil / 1000);
    osiris_track_move(&robot->odometry, &felt, ms);
}

static void measure(osiris_simulated *robot)
{
    for (int32_t i = 0; i < robot->plan->device_count; i++) {
        const osiris_device *device = &robot->plan->devices[i];
        osiris_simulated_device *d = &robot->devices[i];
        if (!osiris_kind_is_sensor(device->kind)) {
            continue;
        }
        if (!d->is_pending && (int32_t)(robot->now_ms - d->due_ms) >= 0) {
            osiris_simulated_measure(robot, &d->pending, device);
            d->pending.kind = device->kind;
            d->pending.time_ms = robot->now_ms + (uint32_t)device->latency_ms;
            d->due_ms = robot->now_ms + (uint32_t)device->period_ms;
            d->is_pending = 1;
        }
        if (d->is_pending && (int32_t)(robot->now_ms - d->pending.time_ms) >= 0) {
            d->ready = d->pending;
            d->is_pending = 0;
            d->is_new = 1;
        }
    }
}

iris_status osiris_simulated_step(osiris_simulated *robot, uint32_t now_ms)
{
    if (!robot) {
        return IRIS_ERR_ARG;
    }
    int32_t left = osiris_within((int32_t)(now_ms - robot->now_ms), 0, LONGEST_MS);
    measure(robot);
    while (left > 0) {
        const int32_t ms = left < STEP_MS ? left : STEP_MS;
        if ((int32_t)(robot->now_ms - robot->told_ms) >= OSIRIS_SIMULATED_HOLD_MS) {
            const osiris_velocity none = {0, 0, 0};
            robot->velocity = none;
        }
        move(robot, ms);
        robot->now_ms += (uint32_t)ms;
        left -= ms;
        measure(robot);
    }
    return IRIS_OK;
}

/* --- driver --- */

static osiris_simulated_device *device_of(const osiris_simulated *robot, const osiris_device *device)
{
    for (int32_t i = 0; i < robot->plan->device_count; i++) {
        const osiris_device *d = &robot->plan->devices[i];
        if (d->kind == device->kind && d->channel == device->channel && d->driver == device->driver) {
            return &robot->devices[i];
        }
    }
    return NULL;
}

static iris_status open_robot(void *context, uint32_t now_ms)
{
    osiris_simulated_begin(context, now_ms);
    return IRIS_OK;
}

static iris_status read_device(void *context, osiris_raw *raw, const osiris_device *device, uint32_t now_ms)
{
    osiris_simulated_device *found = device_of(context, device);
    (void)now_ms;
    if (!found || !osiris_kind_is_sensor(device->kind)) {
        return IRIS_ERR_UNSUPPORTED;
    }
    if (!found->is_new) {
        return IRIS_ERR_TIMEOUT;
    }
    found->is_new = 0;
    *raw = found->ready;
    return IRIS_OK;
}

static void tell_drive(osiris_simulated *robot, const osiris_raw *raw, uint32_t now_ms)
{
    osiris_velocity velocity = {raw->values[0], raw->values[1], raw->values[2]};
    (void)osiris_drive_limit(&velocity, &robot->plan->drive);
    (void)osiris_drive_wheels(&robot->wheels, &robot->plan->drive, &velocity);
    (void)osiris_drive_velocity(&robot->velocity, &robot->plan->drive, &robot->wheels);
    robot->told_ms = now_ms;
}

static iris_status write_device(void *context, const osiris_device *device, const osiris_raw *raw,
                                uint32_t now_ms)
{
    osiris_simulated *robot = context;
    osiris_simulated_device *found = device_of(robot, device);
    if (device->kind == OSIRIS_DRIVE) {
        tell_drive(robot, raw, now_ms);
    } else if (!found || osiris_kind_is_sensor(device->kind)) {
        return IRIS_ERR_UNSUPPORTED;
    }
    if (found) {
        found->ready = *raw;
    }
    return IRIS_OK;
}

static void close_robot(void *context, uint32_t now_ms)
{
    const osiris_velocity none = {0, 0, 0};
    ((osiris_simulated *)context)->velocity = none;
    (void)now_ms;
}

const osiris_driver osiris_simulated_driver = {open_robot, read_device, write_device, close_robot};
