#include "digest.h"

#include "iris/differential.h"
#include "iris/indicator.h"
#include "iris/pwm.h"
#include "iris/watchdog.h"

/* Two motors and four lines under random commands, which sometimes stay away. */
static void wheels_and_lines(void)
{
    iris_watchdog dog;
    iris_indicator indicator;
    iris_pwm left, right;
    uint32_t now_us = 0xfff00000u;
    digest_number(iris_watchdog_init(&dog, 30));
    digest_number(iris_indicator_init(&indicator, NULL));
    digest_number(iris_pwm_init(&left, 90, now_us));
    digest_number(iris_pwm_init(&right, 300, now_us));
    for (int32_t frame = 0; frame < 400; frame++) {
        iris_differential_config config = {0, 1000, 0};
        iris_command command = {0};
        iris_wheels wheels;
        config.turn_permil = digest_between(0, 4000);
        config.least_permil = digest_between(0, 200);
        command.steer_permil = digest_between(-1000, 1000);
        command.speed_permil = digest_between(-100, 1000);
        digest_number(iris_indicator_update(&indicator, &command));
        if (iris_differential_mix(&wheels, &command, &config) == IRIS_OK) {
            iris_watchdog_feed(&dog, now_us / 1000);
            digest_number(wheels.left_permil);
            digest_number(wheels.right_permil);
            iris_pwm_run(&left, wheels.left_permil, now_us);
            iris_pwm_run(&right, wheels.right_permil, now_us);
            digest_number(left.level + 2 * left.backward + 4 * right.level + 8 * right.backward);
            digest_number(left.wait_us);
            digest_number(right.wait_us);
        }
        now_us += (uint32_t)digest_between(0, 25000);
        digest_number(iris_watchdog_left_ms(&dog, now_us / 1000));
    }
    digest_number(dog.expirations);
}

const digest_operation digest_drive[] = {
    {"drive.wheels_and_lines", wheels_and_lines},
    {NULL, NULL},
};
