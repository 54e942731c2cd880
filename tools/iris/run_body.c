#include "run_body.h"

#include <stdio.h>
#include <string.h>

#include "complain.h"
#include "floor_file.h"

static char text[TEXT_FILE_BYTES];

static int complain_line(const char *path, const osiris_problem *problem)
{
    char place[1200];
    snprintf(place, sizeof place, "%.1150s:%d", path, (int)problem->line);
    complain(place, "%s", problem->expected);
    return 0;
}

/* FNV-1a. */
static uint32_t check_of(const char *at, size_t bytes)
{
    uint32_t check = 2166136261u;
    for (size_t i = 0; i < bytes; i++) {
        check = (check ^ (uint8_t)at[i]) * 16777619u;
    }
    return check;
}

int run_body_read(run_body *body, const char *robot)
{
    size_t bytes = 0;
    osiris_problem problem = {0, NULL};
    if (!text_file_read(text, sizeof text, &bytes, robot)) {
        return 0;
    }
    body->check = check_of(text, bytes);
    if (osiris_robot_read_text(&body->plan, body->devices, OSIRIS_DEVICES_MAX, &problem, text, bytes) !=
        IRIS_OK) {
        return complain_line(robot, &problem);
    }
    body->drive_device = (osiris_device){.kind = OSIRIS_DRIVE};
    for (int32_t i = 0; i < body->plan.device_count; i++) {
        if (body->devices[i].kind == OSIRIS_DRIVE) {
            body->drive_device = body->devices[i];
        }
    }
    return 1;
}

osiris_pose run_body_start(const run_body *body)
{
    const osiris_pose middle = {0, 0, 0};
    return body->world.start_count > 0 ? body->world.starts[0] : middle;
}

int run_body_place(run_body *body, const char *world, uint32_t seed)
{
    size_t bytes = 0;
    osiris_problem problem = {0, NULL};
    if (world && !text_file_read(text, sizeof text, &bytes, world)) {
        return 0;
    }
    if (osiris_world_read_text(&body->world, &body->memory, &problem, text, bytes) != IRIS_OK) {
        return complain_line(world, &problem);
    }
    if (osiris_simulated_init(&body->simulated, body->measured, &body->plan, &body->world,
                              run_body_start(body), seed) != IRIS_OK ||
        osiris_drive_init(&body->drive, &body->plan.drive) != IRIS_OK) {
        complain(world, "the robot cannot be put into this world");
        return 0;
    }
    osiris_simulated_begin(&body->simulated, 0);
    for (int32_t i = 0; i < body->plan.driver_count; i++) {
        body->drivers.drivers[i] = &osiris_simulated_driver;
        body->drivers.contexts[i] = &body->simulated;
    }
    return 1;
}

int run_body_open(run_body *body)
{
    body->is_real = 1;
    return osiris_drive_init(&body->drive, &body->plan.drive) == IRIS_OK &&
           real_robot_open(&body->drivers, &body->plan, 0);
}

void run_body_close(run_body *body, uint32_t now_ms)
{
    if (body->is_real) {
        real_robot_close(now_ms);
    }
}

void run_body_pass(run_body *body, uint32_t now_ms)
{
    if (!body->is_real) {
        (void)osiris_simulated_step(&body->simulated, now_ms);
    }
}

int run_body_sense(run_body *body, osiris_raw *raw, int32_t device, uint32_t now_ms)
{
    const osiris_device *d = &body->plan.devices[device];
    const osiris_driver *driver = body->drivers.drivers[d->driver];
    return osiris_kind_is_sensor(d->kind) && driver &&
           driver->read(body->drivers.contexts[d->driver], raw, d, now_ms) == IRIS_OK;
}

int run_body_pose(const run_body *body, osiris_pose *pose)
{
    if (!body->is_real) {
        *pose = osiris_track_pose(&body->simulated.track);
    }
    return !body->is_real;
}

static void tell(run_body *body, uint32_t now_ms)
{
    const osiris_raw raw = {OSIRIS_DRIVE,
                            OSIRIS_VALID,
                            now_ms,
                            {body->drive.velocity.ahead_q16, body->drive.velocity.left_q16,
                             body->drive.velocity.turn_q8, body->drive.steering}};
    const int32_t by = body->drive_device.driver;
    if (body->drivers.drivers[by]) {
        (void)body->drivers.drivers[by]->write(body->drivers.contexts[by], &body->drive_device, &raw, now_ms);
    }
}

void run_body_drive(run_body *body, int32_t speed_mms, int32_t turn_rate, int32_t elapsed_ms, uint32_t now_ms)
{
    const osiris_velocity wanted = {iris_sat_s32((int64_t)speed_mms * 65536), 0,
                                    iris_sat_s32((int64_t)turn_rate * 256)};
    (void)osiris_drive_step(&body->drive, &wanted, elapsed_ms);
    tell(body, now_ms);
}

void run_body_halt(run_body *body, uint32_t now_ms)
{
    osiris_drive_halt(&body->drive);
    tell(body, now_ms);
}
