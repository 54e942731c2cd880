/* What a simulated robot's sensors measure. */
#include <stddef.h>

#include "noise.h"
#include "rounded.h"
#include "simulated_parts.h"

enum { RAYS = 9 };

/* With the device's noise and steps. */
static int32_t noisy(osiris_simulated *robot, const osiris_device *device, int32_t value)
{
    const int32_t normal = osiris_noise_normal(&robot->noise);
    const int64_t deviation =
        device->deviation + (int64_t)osiris_size_of(value) * device->error_permil / 1000;
    const int64_t wrong = value + iris_round_shift(normal * deviation, 16);
    return iris_sat_s32(osiris_quotient(wrong, device->resolution) * device->resolution);
}

static osiris_pose place_of(const osiris_simulated *robot, const osiris_device *device)
{
    return osiris_pose_after(osiris_track_pose(&robot->track), device->place);
}

static void measure_range(osiris_simulated *robot, osiris_raw *raw, const osiris_device *device)
{
    const osiris_pose at = place_of(robot, device);
    const int32_t rays = device->width > 0 ? RAYS : 1;
    int32_t nearest = -1;
    for (int32_t i = 0; i < rays; i++) {
        osiris_pose ray = at;
        if (rays > 1) {
            ray.heading = iris_angle_wrap(at.heading - device->width / 2 + device->width * i / (rays - 1));
        }
        const int32_t range = osiris_world_range(robot->world, ray, device->most);
        if (range >= 0 && (nearest < 0 || range < nearest)) {
            nearest = range;
        }
    }
    if (nearest < 0) {
        raw->validity = OSIRIS_BEYOND;
        return;
    }
    nearest = nearest < device->least ? device->least : nearest;
    raw->values[0] = osiris_within(noisy(robot, device, nearest), device->least, device->most);
}

static void measure_camera(osiris_simulated *robot, osiris_raw *raw, const osiris_device *device)
{
    const osiris_pose at = place_of(robot, device);
    const osiris_object *seen = NULL;
    int32_t nearest = device->most;
    for (int32_t i = 0; i < robot->world->object_count; i++) {
        const osiris_object *o = &robot->world->objects[i];
        const osiris_pose there = {o->x_mm, o->y_mm, 0};
        const osiris_pose step = osiris_pose_step(at, there);
        const int32_t distance = iris_sat_s32(iris_hypot(step.x_mm, step.y_mm));
        const int32_t aside = osiris_size_of(iris_atan2_angle(step.y_mm, step.x_mm));
        if (distance <= nearest && distance >= device->least && aside <= device->width / 2 &&
            !osiris_world_is_hidden(robot->world, at, there)) {
            nearest = distance;
            seen = o;
        }
    }
    if (!seen) {
        raw->validity = OSIRIS_BEYOND;
        return;
    }
    const osiris_pose there = {seen->x_mm, seen->y_mm, 0};
    const osiris_pose step = osiris_pose_step(osiris_track_pose(&robot->track), there);
    raw->values[0] = noisy(robot, device, step.x_mm);
    raw->values[1] = noisy(robot, device, step.y_mm);
    raw->values[2] = (int32_t)(seen->color & 0xFFFFFFu);
    raw->values[3] = seen->radius_mm;
}

static void measure_line(osiris_simulated *robot, osiris_raw *raw, const osiris_device *device)
{
    int32_t offset = 0;
    iris_angle angle = 0;
    if (!osiris_world_line(robot->world, &offset, &angle, place_of(robot, device), device->most)) {
        raw->validity = OSIRIS_BEYOND;
        return;
    }
    raw->values[0] = noisy(robot, device, offset);
    raw->values[1] = angle;
}

static void measure_bump(const osiris_simulated *robot, osiris_raw *raw, const osiris_device *device)
{
    const osiris_pose at = place_of(robot, device);
    const int32_t aside = osiris_size_of(iris_angle_wrap(robot->toward - at.heading));
    raw->values[0] = robot->touches && aside <= device->width / 2;
}

static void measure_odometry(osiris_simulated *robot, osiris_raw *raw, const osiris_device *device)
{
    const osiris_pose pose = osiris_track_pose(&robot->odometry);
    raw->values[0] = (int32_t)osiris_quotient(pose.x_mm, device->resolution) * device->resolution;
    raw->values[1] = (int32_t)osiris_quotient(pose.y_mm, device->resolution) * device->resolution;
    raw->values[2] = pose.heading;
}

static void measure_battery(osiris_simulated *robot, osiris_raw *raw, const osiris_device *device)
{
    const uint32_t used_ms = robot->now_ms - robot->start_ms;
    const int64_t all_ms = (int64_t)osiris_within(robot->endurance_s, 1, 4000000) * 1000;
    const int64_t left_ms = used_ms < all_ms ? all_ms - used_ms : 0;
    const int32_t volts = (int32_t)(device->least + (device->most - device->least) * left_ms / all_ms);
    raw->values[0] = noisy(robot, device, volts);
}

void osiris_simulated_measure(osiris_simulated *robot, osiris_raw *raw, const osiris_device *device)
{
    const osiris_raw none = {device->kind, OSIRIS_VALID, 0, {0, 0, 0, 0}};
    *raw = none;
    switch (device->kind) {
    case OSIRIS_CAMERA:
        measure_camera(robot, raw, device);
        break;
    case OSIRIS_RANGE:
        measure_range(robot, raw, device);
        break;
    case OSIRIS_LINE:
        measure_line(robot, raw, device);
        break;
    case OSIRIS_BUMP:
        measure_bump(robot, raw, device);
        break;
    case OSIRIS_ODOMETRY:
        measure_odometry(robot, raw, device);
        break;
    case OSIRIS_HEADING:
        raw->values[0] = iris_angle_wrap(noisy(robot, device, osiris_track_pose(&robot->track).heading));
        break;
    default:
        measure_battery(robot, raw, device);
        break;
    }
    if (raw->validity == OSIRIS_VALID) {
        raw->values[0] = osiris_calibration_raw(&device->calibration, raw->values[0]);
    }
}
