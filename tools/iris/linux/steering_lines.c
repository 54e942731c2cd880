#include "steering_lines.h"

#include "../complain.h"

#define RECONNECT_MS 250
#define CHECK_US     50000 /* so often the chip is asked whether it is there */

int steering_lines_open(steering_lines *lines, const steering_options *options, int64_t now_us)
{
    lines->options = options;
    lines->driven_us = now_us;
    (void)iris_indicator_init(&lines->indicator, NULL);
    (void)iris_pwm_init(&lines->left, options->pwm_hz, (uint32_t)now_us);
    (void)iris_pwm_init(&lines->right, options->pwm_hz, (uint32_t)now_us);
    for (int32_t i = 0; i < options->line_count; i++) {
        lines->has_motors |= options->roles[i] == STEERING_LEFT_PWM;
    }
    if (iris_gpio_open(&lines->gpio, options->chip, options->lines, options->line_count, RECONNECT_MS,
                       (uint32_t)(now_us / 1000)) != IRIS_OK) {
        complain(options->chip, "%s", iris_gpio_problem(&lines->gpio));
        iris_gpio_close(&lines->gpio);
        return EXIT_BAD_DATA;
    }
    return EXIT_DONE;
}

void steering_lines_take(steering_lines *lines, const iris_command *command)
{
    (void)iris_indicator_update(&lines->indicator, command);
    (void)iris_differential_mix(&lines->wheels, command, NULL);
}

static uint32_t value_of(const steering_lines *lines, steering_role role)
{
    switch (role) {
    case STEERING_LEFT:
        return (lines->indicator.lines & IRIS_INDICATE_LEFT) != 0;
    case STEERING_RIGHT:
        return (lines->indicator.lines & IRIS_INDICATE_RIGHT) != 0;
    case STEERING_STOP:
        return (lines->indicator.lines & IRIS_INDICATE_STOP) != 0;
    case STEERING_HEARTBEAT:
        return (lines->indicator.lines & IRIS_INDICATE_HEARTBEAT) != 0;
    case STEERING_LEFT_PWM:
        return (uint32_t)lines->left.level;
    case STEERING_LEFT_DIR:
        return (uint32_t)lines->left.backward;
    case STEERING_RIGHT_PWM:
        return (uint32_t)lines->right.level;
    case STEERING_RIGHT_DIR:
        return (uint32_t)lines->right.backward;
    default:
        return 0;
    }
}

static uint32_t values_of(const steering_lines *lines, steering_lines_mode mode)
{
    const steering_options *options = lines->options;
    uint32_t values = 0;
    for (int32_t i = 0; i < options->line_count; i++) {
        const iris_gpio_line *line = &options->lines[i];
        uint32_t value = mode == LINES_INITIAL ? (uint32_t)line->initial
                         : mode == LINES_SAFE  ? (uint32_t)line->safe
                                               : value_of(lines, options->roles[i]);
        values |= value << i;
    }
    return values;
}

int64_t steering_lines_drive(steering_lines *lines, steering_lines_mode mode, int64_t now_us)
{
    const int moving = mode == LINES_DRIVEN && lines->has_motors;
    iris_pwm_run(&lines->left, moving ? lines->wheels.left_permil : 0, (uint32_t)now_us);
    iris_pwm_run(&lines->right, moving ? lines->wheels.right_permil : 0, (uint32_t)now_us);
    const uint32_t values = values_of(lines, mode);
    if (lines->is_away || values != lines->gpio.values || now_us - lines->driven_us >= CHECK_US) {
        iris_status status = iris_gpio_set(&lines->gpio, values, (uint32_t)(now_us / 1000));
        lines->driven_us = now_us;
        if ((status != IRIS_OK) != lines->is_away) {
            lines->is_away = status != IRIS_OK;
            complain(lines->options->chip, lines->is_away ? "%s; going on without it" : "works again",
                     iris_gpio_problem(&lines->gpio));
        }
    }
    int64_t wait_us = CHECK_US;
    if (moving) {
        wait_us = lines->left.wait_us < wait_us ? lines->left.wait_us : wait_us;
        wait_us = lines->right.wait_us < wait_us ? lines->right.wait_us : wait_us;
    }
    return wait_us;
}
