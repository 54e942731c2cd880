#include "iris/gpio_drive.h"

#include <string.h>

enum { AWAY_MS = 250, IDLE_US = 10000 };

iris_status osiris_gpio_drive_init(osiris_gpio_drive *drive, const osiris_plan *plan, int32_t driver)
{
    if (!drive || osiris_plan_check(plan) != IRIS_OK || driver < 0 || driver >= plan->driver_count ||
        plan->drivers[driver].kind != OSIRIS_DRIVER_GPIO) {
        return IRIS_ERR_ARG;
    }
    if (plan->drive.kind != OSIRIS_DIFFERENTIAL) {
        return IRIS_ERR_UNSUPPORTED;
    }
    memset(drive, 0, sizeof *drive);
    drive->plan = plan;
    drive->driver = driver;
    return IRIS_OK;
}

static iris_status open_lines(void *context, uint32_t now_ms)
{
    osiris_gpio_drive *drive = context;
    const osiris_driver_plan *plan = &drive->plan->drivers[drive->driver];
    iris_gpio_line lines[OSIRIS_GPIO_LINES];
    memset(lines, 0, sizeof lines);
    for (int i = 0; i < OSIRIS_GPIO_LINES; i++) {
        lines[i].offset = plan->lines[i];
    }
    if (iris_pwm_init(&drive->left, plan->rate, now_ms * 1000u) != IRIS_OK ||
        iris_pwm_init(&drive->right, plan->rate, now_ms * 1000u) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    drive->state = iris_gpio_open(&drive->gpio, plan->path, lines, OSIRIS_GPIO_LINES, AWAY_MS, now_ms);
    drive->is_open = drive->state == IRIS_OK || drive->state == IRIS_ERR_IO;
    drive->is_told = 0;
    drive->values = -1;
    if (drive->state != IRIS_OK && !drive->is_open) {
        iris_gpio_close(&drive->gpio);
    }
    return drive->state;
}

static iris_status read_nothing(void *context, osiris_raw *raw, const osiris_device *device, uint32_t now_ms)
{
    (void)context;
    (void)raw;
    (void)device;
    (void)now_ms;
    return IRIS_ERR_UNSUPPORTED;
}

static int32_t permil_of(iris_q16 speed_q16, int32_t most_mms)
{
    const int64_t permil = (int64_t)speed_q16 * 1000 / ((int64_t)most_mms * 65536);
    return (int32_t)(permil > 1000 ? 1000 : permil < -1000 ? -1000 : permil);
}

static iris_status write_drive(void *context, const osiris_device *device, const osiris_raw *raw,
                               uint32_t now_ms)
{
    osiris_gpio_drive *drive = context;
    const osiris_velocity velocity = {raw->values[0], raw->values[1], raw->values[2]};
    osiris_wheels wheels;
    if (device->kind != OSIRIS_DRIVE) {
        return IRIS_ERR_UNSUPPORTED;
    }
    const iris_status status = osiris_drive_wheels(&wheels, &drive->plan->drive, &velocity);
    if (status != IRIS_OK) {
        return status;
    }
    drive->left_permil = permil_of(wheels.speed_q16[0], drive->plan->drive.speed_max_mms);
    drive->right_permil = permil_of(wheels.speed_q16[1], drive->plan->drive.speed_max_mms);
    drive->told_ms = now_ms;
    drive->is_told = 1;
    return drive->state;
}

int32_t osiris_gpio_drive_run(osiris_gpio_drive *drive, int64_t now_us)
{
    if (!drive || !drive->is_open) {
        return IDLE_US;
    }
    const uint32_t now_ms = (uint32_t)(now_us / 1000);
    const int moves = drive->is_told && (int32_t)(now_ms - drive->told_ms) <= OSIRIS_HOLD_MS;
    iris_pwm_run(&drive->left, moves ? drive->left_permil : 0, (uint32_t)now_us);
    iris_pwm_run(&drive->right, moves ? drive->right_permil : 0, (uint32_t)now_us);
    const int32_t values = (drive->left.backward ? 1 << OSIRIS_LINE_LEFT_DIR : 0) |
                           (drive->left.level ? 1 << OSIRIS_LINE_LEFT_PWM : 0) |
                           (drive->right.backward ? 1 << OSIRIS_LINE_RIGHT_DIR : 0) |
                           (drive->right.level ? 1 << OSIRIS_LINE_RIGHT_PWM : 0);
    if (values != drive->values || drive->state != IRIS_OK) {
        drive->state = iris_gpio_set(&drive->gpio, (uint32_t)values, now_ms);
        drive->values = drive->state == IRIS_OK ? values : -1;
    }
    const int32_t wait =
        drive->left.wait_us < drive->right.wait_us ? drive->left.wait_us : drive->right.wait_us;
    return wait < IDLE_US ? wait : IDLE_US;
}

static void close_lines(void *context, uint32_t now_ms)
{
    osiris_gpio_drive *drive = context;
    (void)now_ms;
    if (drive->is_open) {
        iris_gpio_close(&drive->gpio);
    }
    drive->is_open = 0;
}

const osiris_driver osiris_gpio_drive_driver = {open_lines, read_nothing, write_drive, close_lines};
