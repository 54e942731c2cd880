/* The GPIO lines of `iris follow`: what a command says on them, the pulses of motors, and one word when the chip goes away or is
 * back. */
#ifndef IRIS_TOOL_STEERING_LINES_H
#define IRIS_TOOL_STEERING_LINES_H

#include <stdint.h>

#include "../steering_option.h"
#include "iris/differential.h"
#include "iris/gpio.h"
#include "iris/indicator.h"
#include "iris/pwm.h"

typedef enum {
    LINES_INITIAL, /* no command yet, for the watchdog's time */
    LINES_DRIVEN,  /* as the last command says */
    LINES_SAFE
} steering_lines_mode;

typedef struct {
    const steering_options *options;
    iris_gpio gpio;
    iris_indicator indicator;
    iris_wheels wheels;
    iris_pwm left, right;
    int has_motors;
    int is_away;
    int64_t driven_us; /* when the chip was last asked */
} steering_lines;

/* Complains; returns an exit code. */
int steering_lines_open(steering_lines *lines, const steering_options *options, int64_t now_us);

/* A fresh command. */
void steering_lines_take(steering_lines *lines, const iris_command *command);

/* Drives what has to be driven now. Returns in how many microseconds to call again. */
int64_t steering_lines_drive(steering_lines *lines, steering_lines_mode mode, int64_t now_us);

#endif
