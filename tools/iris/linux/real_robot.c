#include "../real_robot.h"

#include "../complain.h"
#include "iris/gpio_drive.h"
#include "iris/serial_robot.h"

#define RUN_US 10000

static osiris_serial_robot boards[OSIRIS_DRIVERS_MAX];
static osiris_remote_device states[OSIRIS_DRIVERS_MAX][OSIRIS_DEVICES_MAX];
static osiris_gpio_drive motors[OSIRIS_DRIVERS_MAX];
static robot_drivers opened;

static int open_one(int32_t i, const osiris_plan *plan, uint32_t now_ms)
{
    const osiris_driver_plan *driver = &plan->drivers[i];
    if (driver->kind == OSIRIS_DRIVER_CAMERA) {
        return 1;
    }
    iris_status status = IRIS_ERR_UNSUPPORTED;
    if (driver->kind == OSIRIS_DRIVER_SERIAL) {
        status = osiris_serial_robot_init(&boards[i], states[i], plan, i);
        opened.drivers[i] = &osiris_serial_robot_driver;
        opened.contexts[i] = &boards[i];
    } else if (driver->kind == OSIRIS_DRIVER_GPIO) {
        status = osiris_gpio_drive_init(&motors[i], plan, i);
        opened.drivers[i] = &osiris_gpio_drive_driver;
        opened.contexts[i] = &motors[i];
    }
    if (status == IRIS_OK) {
        status = opened.drivers[i]->open(opened.contexts[i], now_ms);
    } else {
        opened.drivers[i] = NULL;
    }
    if (status == IRIS_ERR_UNSUPPORTED) {
        complain(driver->name, "a driver of the simulator, or of another drive than it can turn");
    } else if (status != IRIS_OK) {
        complain(driver->path, "%s",
                 driver->kind == OSIRIS_DRIVER_SERIAL ? iris_serial_error(&boards[i].port)
                                                      : "cannot be opened");
    }
    return status == IRIS_OK;
}

int real_robot_open(robot_drivers *drivers, const osiris_plan *plan, uint32_t now_ms)
{
    for (int32_t i = 0; i < plan->driver_count; i++) {
        if (!open_one(i, plan, now_ms)) {
            real_robot_close(now_ms);
            return 0;
        }
    }
    *drivers = opened;
    return 1;
}

int64_t real_robot_run(int64_t now_us)
{
    int64_t wait = RUN_US;
    for (int32_t i = 0; i < OSIRIS_DRIVERS_MAX; i++) {
        if (opened.drivers[i] == &osiris_gpio_drive_driver) {
            const int64_t one = osiris_gpio_drive_run(&motors[i], now_us);
            wait = one < wait ? one : wait;
        }
    }
    return wait;
}

void real_robot_close(uint32_t now_ms)
{
    for (int32_t i = 0; i < OSIRIS_DRIVERS_MAX; i++) {
        if (opened.drivers[i]) {
            opened.drivers[i]->close(opened.contexts[i], now_ms);
            opened.drivers[i] = NULL;
        }
    }
}
