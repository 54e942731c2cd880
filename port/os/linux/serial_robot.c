#include "iris/serial_robot.h"

#include <string.h>

enum { AWAY_MS = 250, CHUNK = 256, CHUNKS = 8 }; /* 2 KB in one look: more than a fast line brings in 10 ms */

iris_status osiris_serial_robot_init(osiris_serial_robot *robot, osiris_remote_device *devices,
                                     const osiris_plan *plan, int32_t driver)
{
    osiris_remote remote;
    const iris_status status = robot ? osiris_remote_init(&remote, devices, plan, driver) : IRIS_ERR_ARG;
    if (status != IRIS_OK || plan->drivers[driver].kind != OSIRIS_DRIVER_SERIAL) {
        return IRIS_ERR_ARG;
    }
    memset(robot, 0, sizeof *robot);
    robot->remote = remote;
    return IRIS_OK;
}

static iris_status open_port(void *context, uint32_t now_ms)
{
    osiris_serial_robot *robot = context;
    const osiris_driver_plan *plan = &robot->remote.plan->drivers[robot->remote.driver];
    robot->state = iris_serial_open(&robot->port, plan->path, plan->rate, AWAY_MS, now_ms);
    robot->is_open = robot->state == IRIS_OK || robot->state == IRIS_ERR_IO;
    robot->took_ms = now_ms - 1;
    return robot->state;
}

/* Once for each time that there is: a robot has many devices on one line. */
static void look(osiris_serial_robot *robot, uint32_t now_ms)
{
    if (now_ms == robot->took_ms) {
        return;
    }
    robot->took_ms = now_ms;
    for (int i = 0; i < CHUNKS; i++) {
        char bytes[CHUNK];
        size_t count = 0;
        robot->state = iris_serial_receive(bytes, &count, &robot->port, sizeof bytes, now_ms);
        (void)osiris_remote_take(&robot->remote, bytes, count, now_ms);
        if (robot->state != IRIS_OK || count < sizeof bytes) {
            return;
        }
    }
}

static iris_status read_device(void *context, osiris_raw *raw, const osiris_device *device, uint32_t now_ms)
{
    osiris_serial_robot *robot = context;
    look(robot, now_ms);
    const iris_status status = osiris_remote_read(&robot->remote, raw, device);
    return status == IRIS_ERR_TIMEOUT && robot->state != IRIS_OK ? robot->state : status;
}

static iris_status write_device(void *context, const osiris_device *device, const osiris_raw *raw,
                                uint32_t now_ms)
{
    osiris_serial_robot *robot = context;
    char sentences[OSIRIS_REMOTE_BYTES];
    size_t length = 0;
    const iris_status status = osiris_remote_tell(sentences, &length, &robot->remote, device, raw);
    if (status != IRIS_OK) {
        return status;
    }
    const iris_status sent = iris_serial_send(&robot->port, sentences, length, now_ms);
    return sent == IRIS_ERR_FULL ? IRIS_OK : sent; /* it waits, and is replaced by what is newer */
}

static void close_port(void *context, uint32_t now_ms)
{
    osiris_serial_robot *robot = context;
    const osiris_plan *plan = robot->remote.plan;
    const osiris_raw stop = {OSIRIS_DRIVE, OSIRIS_VALID, now_ms, {0, 0, 0, 0}};
    for (int32_t i = 0; robot->is_open && i < plan->device_count; i++) {
        if (plan->devices[i].kind == OSIRIS_DRIVE) {
            (void)write_device(robot, &plan->devices[i], &stop, now_ms);
        }
    }
    if (robot->is_open) {
        (void)iris_serial_continue(&robot->port, now_ms);
        iris_serial_close(&robot->port);
    }
    robot->is_open = 0;
}

const osiris_driver osiris_serial_robot_driver = {open_port, read_device, write_device, close_port};
