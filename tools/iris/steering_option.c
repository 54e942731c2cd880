#include "steering_option.h"

#include <stdio.h>
#include <string.h>

#include "args.h"
#include "complain.h"

#define WATCHDOG_FRAMES   3
#define WATCHDOG_LEAST_MS 200
#define WATCHDOG_MOST_MS  60000

static const char *const role_names[STEERING_ROLES] = {"left",     "right",    "stop",      "heartbeat",
                                                       "left-pwm", "left-dir", "right-pwm", "right-dir"};

/* Takes what stands before `separator` off *text, or all of it; null at its end. */
static char *part_of(char **text, char separator)
{
    char *part = *text;
    if (part) {
        *text = strchr(part, separator);
        if (*text) {
            *(*text)++ = '\0';
        }
    }
    return part;
}

/* Reads 0 or 1 behind `name`=. */
static int read_value(int32_t *value, const char *property, const char *name)
{
    size_t length = strlen(name);
    if (strncmp(property, name, length) != 0 || property[length] != '=' ||
        !args_numbers(value, 1, ',', property + length + 1)) {
        return 0;
    }
    return *value == 0 || *value == 1;
}

/* Which role has this name? STEERING_ROLES: none. */
static int role_of(const char *name)
{
    int role = 0;
    while (role < STEERING_ROLES && strcmp(role_names[role], name) != 0) {
        role++;
    }
    return role;
}

/* What stands behind the number. Returns 0 after complaining. */
static int read_properties(iris_gpio_line *line, char *text)
{
    int initial_given = 0;
    for (char *property = part_of(&text, ':'); property; property = part_of(&text, ':')) {
        if (strcmp(property, "active-low") == 0) {
            line->active_low = 1;
        } else if (read_value(&line->initial, property, "initial")) {
            initial_given = 1;
        } else if (!read_value(&line->safe, property, "safe")) {
            complain("--gpio",
                     "active-low, initial=0, initial=1, safe=0, or safe=1 behind a number, not '%s'",
                     property);
            return 0;
        }
    }
    line->initial = initial_given ? line->initial : line->safe;
    return 1;
}

/* NAME=N[:PROPERTY]... Returns 0 after complaining. */
static int read_entry(steering_options *options, char *entry)
{
    char *rest = entry;
    const char *name = part_of(&rest, '=');
    const int role = role_of(name);
    if (role == STEERING_ROLES || !rest) {
        complain("--gpio",
                 "a line is left, right, stop, heartbeat, left-pwm, left-dir, right-pwm, or right-dir, then "
                 "= and its number, not '%s'",
                 name);
        return 0;
    }
    iris_gpio_line line = {0, 0, 0, role == STEERING_STOP};
    const char *number = part_of(&rest, ':');
    if (!args_numbers(&line.offset, 1, ',', number) || line.offset < 0) {
        complain("--gpio", "%s: a number of a line, 0 or more, not '%s'", name, number);
        return 0;
    }
    for (int32_t i = 0; i < options->line_count; i++) {
        if ((int)options->roles[i] == role || options->lines[i].offset == line.offset) {
            complain("--gpio", "%s is given twice", (int)options->roles[i] == role ? name : number);
            return 0;
        }
    }
    if (!read_properties(&line, rest)) {
        return 0;
    }
    if ((role == STEERING_LEFT_PWM || role == STEERING_RIGHT_PWM) && line.initial && !line.safe) {
        complain("--gpio", "%s: initial=1 would drive the motor before any command", name);
        return 0;
    }
    options->roles[options->line_count] = (steering_role)role;
    options->lines[options->line_count++] = line;
    return 1;
}

static int has(const steering_options *options, steering_role role)
{
    for (int32_t i = 0; i < options->line_count; i++) {
        if (options->roles[i] == role) {
            return 1;
        }
    }
    return 0;
}

/* CHIP:ENTRY,... A chip's label may have colons itself. */
static int read_gpio(steering_options *options, const char *text)
{
    char entries[512];
    const char *equals = strchr(text, '='), *colon = equals;
    while (colon && colon > text && *colon != ':') {
        colon--;
    }
    if (!colon || colon == text || strlen(text) >= sizeof entries ||
        (size_t)(colon - text) >= sizeof options->chip) {
        complain("--gpio", "a chip and its lines, such as gpiochip0:left=17,right=18,stop=27, not '%s'",
                 text);
        return 0;
    }
    memcpy(options->chip, text, (size_t)(colon - text));
    options->chip[colon - text] = '\0';
    snprintf(entries, sizeof entries, "%s", colon + 1);
    char *rest = entries;
    for (char *entry = part_of(&rest, ','); entry; entry = part_of(&rest, ',')) {
        if (!read_entry(options, entry)) {
            return 0;
        }
    }
    if (has(options, STEERING_LEFT_PWM) != has(options, STEERING_RIGHT_PWM)) {
        complain("--gpio", "left-pwm and right-pwm: two wheels need both");
        return 0;
    }
    if ((has(options, STEERING_LEFT_DIR) || has(options, STEERING_RIGHT_DIR)) &&
        !has(options, STEERING_LEFT_PWM)) {
        complain("--gpio", "left-dir and right-dir: only together with left-pwm and right-pwm");
        return 0;
    }
    return 1;
}

/* 200ms, 200, or 1s. */
static int read_watchdog(int32_t *ms, const char *text)
{
    char number[16];
    size_t length = strspn(text, "0123456789");
    const char *unit = text + length;
    const int is_s = strcmp(unit, "s") == 0;
    if (length < 1 || length > 6 || (!is_s && *unit != '\0' && strcmp(unit, "ms") != 0)) {
        complain("--watchdog", "a time such as 200ms or 1s, not '%s'", text);
        return 0;
    }
    memcpy(number, text, length);
    number[length] = '\0';
    if (!args_numbers(ms, 1, ',', number) || *ms > WATCHDOG_MOST_MS ||
        *ms * (is_s ? 1000 : 1) > WATCHDOG_MOST_MS || *ms < (is_s ? 1 : 10)) {
        complain("--watchdog", "10ms to 60s, not '%s'", text);
        return 0;
    }
    *ms *= is_s ? 1000 : 1;
    return 1;
}

int steering_options_read(steering_options *options, const steering_texts *texts, int32_t rate)
{
    const int32_t frames_ms = (WATCHDOG_FRAMES * 1000 + rate - 1) / rate;
    options->serial = texts->serial;
    options->used = texts->serial || texts->gpio;
    options->baud = 115200;
    options->pwm_hz = 100;
    options->watchdog_ms = frames_ms > WATCHDOG_LEAST_MS ? frames_ms : WATCHDOG_LEAST_MS;
    const args_whole numbers[] = {{"--baud", texts->baud, &options->baud, 1200, 4000000},
                                  {"--pwm", texts->pwm, &options->pwm_hz, 1, 1000}};
    if (texts->baud && !texts->serial) {
        complain("--baud", "only together with --serial");
        return 0;
    }
    if (texts->watchdog && !options->used) {
        complain("--watchdog", "only together with --serial or --gpio");
        return 0;
    }
    if (!args_wholes(numbers, 2) || (texts->gpio && !read_gpio(options, texts->gpio)) ||
        (texts->watchdog && !read_watchdog(&options->watchdog_ms, texts->watchdog))) {
        return 0;
    }
    if (texts->pwm && !has(options, STEERING_LEFT_PWM)) {
        complain("--pwm", "only together with left-pwm and right-pwm of --gpio");
        return 0;
    }
    return 1;
}
