/* Where `iris follow` steers: --serial, --baud, --gpio, --pwm, and --watchdog. */
#ifndef IRIS_TOOL_STEERING_OPTION_H
#define IRIS_TOOL_STEERING_OPTION_H

#include <stdint.h>

#include "iris/gpio.h"

#define STEERING_HELP                                                                                        \
    "  --serial DEV   send each command to a serial port; files are then paced at --rate\n"                  \
    "  --baud N       its speed, default 115200\n"                                                           \
    "  --gpio CHIP:LINE=N,...  drive lines of a GPIO chip (path, name, label) by number: left, right,\n"     \
    "                 stop, heartbeat; left-pwm, left-dir, right-pwm, right-dir of two motors. Behind N:\n"  \
    "                 :active-low, :initial=V, :safe=V (when the robot stands; default 1 for stop)\n"        \
    "  --pwm HZ       pulses of a motor in a second, 1 to 1000, default 100\n"                               \
    "  --watchdog T   stop the robot when no command has come for T, such as 200ms; always on,\n"            \
    "                 default 3 frames at --rate, at least 200ms\n"

/* What a line is for. */
typedef enum {
    STEERING_LEFT,
    STEERING_RIGHT,
    STEERING_STOP,
    STEERING_HEARTBEAT,
    STEERING_LEFT_PWM,
    STEERING_LEFT_DIR,
    STEERING_RIGHT_PWM,
    STEERING_RIGHT_DIR,
    STEERING_ROLES
} steering_role;

/* The options as texts, null where not given. */
typedef struct {
    const char *serial, *baud, *gpio, *pwm, *watchdog;
} steering_texts;

typedef struct {
    int used;           /* 0: neither --serial nor --gpio */
    const char *serial; /* device; null: none */
    int32_t baud;
    char chip[256]; /* empty: no lines */
    iris_gpio_line lines[STEERING_ROLES];
    steering_role roles[STEERING_ROLES]; /* of each line */
    int32_t line_count;
    int32_t pwm_hz;
    int32_t watchdog_ms;
} steering_options;

/* rate: frames per second. Complains and returns 0 when a text is wrong. */
int steering_options_read(steering_options *options, const steering_texts *texts, int32_t rate);

#endif
