/* IRIS - two motors on lines of a GPIO chip (gpio.h, pwm.h), as the driver of a differential drive of Osiris.
 *
 *     osiris_gpio_drive motors;
 *     osiris_gpio_drive_init(&motors, &plan, 0);                      chip, lines, and rate are the plan's
 *     osiris_robot_bind(&robot, 0, &osiris_gpio_drive_driver, &motors, now_ms);
 *     for (;;) {
 *         osiris_robot_drive(&robot, 200, 0, now_ms);                 every 500 ms or sooner
 *         wait_us = osiris_gpio_drive_run(&motors, now_us);           again after that time: pulses are made here
 *     }
 *
 * The wheels stand, and the lines are safe (all low), when nothing was told for OSIRIS_HOLD_MS, while the chip is away, and after
 * closing. A process that hangs leaves its lines as they are: `iris follow` shows how one is watched over.
 */
#ifndef IRIS_GPIO_DRIVE_H
#define IRIS_GPIO_DRIVE_H

#include "iris/gpio.h"
#include "iris/osiris/robot.h"
#include "iris/pwm.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Read gpio (its losses, and what iris_gpio_problem says) and the two speeds; the rest belongs to the functions. */
typedef struct {
    iris_gpio gpio;
    int32_t left_permil, right_permil; /* told last */
    const osiris_plan *plan;
    int32_t driver;
    iris_pwm left, right;
    uint32_t told_ms;
    iris_status state;
    int32_t is_open, is_told, values; /* values: that the lines have; -1: unknown */
} osiris_gpio_drive;

/* Makes it ready to be bound; the plan must outlive it. IRIS_ERR_ARG: null pointer, a bad plan, no such driver, or one that is not
 * GPIO; IRIS_ERR_UNSUPPORTED: the plan's drive is not differential. Nothing is touched then. O(devices^2). */
iris_status osiris_gpio_drive_init(osiris_gpio_drive *drive, const osiris_plan *plan, int32_t driver);

/* Drives the lines as they are to be now. now_us / 1000 is the clock of the robot's now_ms, as far as differences go. Returns
 * after how many microseconds to call again at the latest: 1 or more. 10000 when it is not open. */
int32_t osiris_gpio_drive_run(osiris_gpio_drive *drive, int64_t now_us);

/* The context is the osiris_gpio_drive. It has no sensors. Opening says what iris_gpio_open says. */
extern const osiris_driver osiris_gpio_drive_driver;

#ifdef __cplusplus
}
#endif

#endif
