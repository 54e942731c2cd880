/* A robot's drivers, its readings, and its drive. */
#include "iris/osiris/robot.h"

#include <string.h>

#include "rounded.h"

iris_status osiris_robot_init(osiris_robot *robot, osiris_reading *readings, const osiris_plan *plan)
{
    if (!robot || osiris_plan_check(plan) != IRIS_OK || (!readings && plan->device_count > 0)) {
        return IRIS_ERR_ARG;
    }
    memset(robot, 0, sizeof *robot);
    robot->plan = plan;
    robot->readings = readings;
    for (int32_t i = 0; i < plan->device_count; i++) {
        memset(&readings[i], 0, sizeof readings[i]);
        readings[i].kind = plan->devices[i].kind;
    }
    return osiris_drive_init(&robot->drive, &plan->drive);
}

iris_status osiris_robot_bind(osiris_robot *robot, int32_t index, const osiris_driver *driver, void *context,
                              uint32_t now_ms)
{
    if (!robot || !driver || !driver->open || !driver->read || !driver->write || !driver->close ||
        index < 0 || index >= robot->plan->driver_count) {
        return IRIS_ERR_ARG;
    }
    const iris_status status = driver->open(context, now_ms);
    const int stays = status == IRIS_OK || status == IRIS_ERR_IO;
    robot->drivers[index] = stays ? driver : NULL;
    robot->contexts[index] = context;
    return status;
}

void osiris_robot_close(osiris_robot *robot, uint32_t now_ms)
{
    for (int32_t i = 0; robot && i < OSIRIS_DRIVERS_MAX; i++) {
        if (robot->drivers[i]) {
            robot->drivers[i]->close(robot->contexts[i], now_ms);
            robot->drivers[i] = NULL;
        }
    }
}

static iris_status sense_one(osiris_robot *robot, int32_t i, uint32_t now_ms)
{
    const osiris_device *device = &robot->plan->devices[i];
    const osiris_driver *driver = robot->drivers[device->driver];
    osiris_reading *reading = &robot->readings[i];
    osiris_raw raw;
    if (!osiris_kind_is_sensor(device->kind) || !driver) {
        return IRIS_OK;
    }
    const iris_status status = driver->read(robot->contexts[device->driver], &raw, device, now_ms);
    if (status == IRIS_OK) {
        return osiris_model_read(reading, device, &raw);
    }
    if (status == IRIS_ERR_TIMEOUT) {
        osiris_model_age(reading, device, now_ms);
        return IRIS_OK;
    }
    reading->validity = OSIRIS_BROKEN;
    return IRIS_ERR_IO;
}

iris_status osiris_robot_sense(osiris_robot *robot, uint32_t now_ms)
{
    iris_status status = IRIS_OK;
    if (!robot) {
        return IRIS_ERR_ARG;
    }
    for (int32_t i = 0; i < robot->plan->device_count; i++) {
        const iris_status one = sense_one(robot, i, now_ms);
        status = one != IRIS_OK ? one : status;
    }
    return status;
}

/* --- driving --- */

static iris_status tell_drive(osiris_robot *robot, uint32_t now_ms)
{
    const osiris_velocity *v = &robot->drive.velocity;
    const int32_t values[OSIRIS_VALUES] = {v->ahead_q16, v->left_q16, v->turn_q8, robot->drive.steering};
    for (int32_t i = 0; i < robot->plan->device_count; i++) {
        const osiris_device *device = &robot->plan->devices[i];
        const osiris_driver *driver = robot->drivers[device->driver];
        osiris_raw raw;
        if (device->kind == OSIRIS_DRIVE && driver) {
            const iris_status status = osiris_model_write(&raw, device, values, now_ms);
            return status == IRIS_OK ? driver->write(robot->contexts[device->driver], device, &raw, now_ms)
                                     : status;
        }
    }
    return IRIS_ERR_UNSUPPORTED;
}

/* The time since the drive was told last, which it has driven meanwhile. */
static int32_t go_on(osiris_robot *robot, uint32_t now_ms)
{
    const int32_t gone = (int32_t)(now_ms - robot->told_ms);
    int32_t ms = robot->is_told ? osiris_within(gone, 0, OSIRIS_HOLD_MS) : 0;
    osiris_track_move(&robot->reckoned, &robot->drive.velocity, ms);
    if (gone > OSIRIS_HOLD_MS || gone < 0) {
        osiris_drive_halt(&robot->drive);
        ms = 0;
    }
    robot->told_ms = now_ms;
    robot->is_told = 1;
    return ms;
}

iris_status osiris_robot_glide(osiris_robot *robot, int32_t speed_mms, int32_t left_mms, int32_t turn_rate,
                               uint32_t now_ms)
{
    if (!robot) {
        return IRIS_ERR_ARG;
    }
    const int32_t fastest = OSIRIS_SPEED_MAX_MMS;
    const osiris_velocity wanted = {osiris_within(speed_mms, -fastest, fastest) * 65536,
                                    osiris_within(left_mms, -fastest, fastest) * 65536,
                                    osiris_within(turn_rate, -OSIRIS_TURN_RATE_MAX, OSIRIS_TURN_RATE_MAX) *
                                        256};
    const int32_t ms = go_on(robot, now_ms);
    const iris_status status = osiris_drive_step(&robot->drive, &wanted, ms);
    return status == IRIS_OK ? tell_drive(robot, now_ms) : status;
}

iris_status osiris_robot_drive(osiris_robot *robot, int32_t speed_mms, int32_t turn_rate, uint32_t now_ms)
{
    return osiris_robot_glide(robot, speed_mms, 0, turn_rate, now_ms);
}

iris_status osiris_robot_stop(osiris_robot *robot, uint32_t now_ms)
{
    if (!robot) {
        return IRIS_ERR_ARG;
    }
    (void)go_on(robot, now_ms);
    osiris_drive_halt(&robot->drive);
    return tell_drive(robot, now_ms);
}

iris_status osiris_robot_tell(osiris_robot *robot, int32_t device, const int32_t values[OSIRIS_VALUES],
                              uint32_t now_ms)
{
    if (!robot || !values || device < 0 || device >= robot->plan->device_count) {
        return IRIS_ERR_ARG;
    }
    const osiris_device *d = &robot->plan->devices[device];
    const osiris_driver *driver = robot->drivers[d->driver];
    osiris_raw raw;
    if (d->kind == OSIRIS_DRIVE || osiris_model_write(&raw, d, values, now_ms) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    return driver ? driver->write(robot->contexts[d->driver], d, &raw, now_ms) : IRIS_ERR_UNSUPPORTED;
}
