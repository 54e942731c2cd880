#include "iris/osiris/robot_text.h"

#include <string.h>

#include "attribute.h"
#include "names.h"
#include "robot_text_parts.h"

static const char too_many[] = "expected fewer devices or drivers: there is no room for more";

enum { HAS_ROBOT = 1, HAS_BODY = 2, HAS_DRIVE = 4 };

/* --- robot, body, driver --- */

static int once(osiris_robot_reading *reading, int what, const char *expected)
{
    if (reading->has & what) {
        return osiris_expect(&reading->reader, expected);
    }
    reading->has |= what;
    return 1;
}

static int take_robot(osiris_robot_reading *reading)
{
    return once(reading, HAS_ROBOT, "expected one robot in a file") &&
           (osiris_take_name(reading->plan->name, OSIRIS_NAME_BYTES, &reading->reader) ||
            osiris_expect(&reading->reader, "expected a name of at most 15 characters"));
}

static const osiris_attribute body_ahead = {
    "ahead", 0, -OSIRIS_BODY_MAX_MM, OSIRIS_BODY_MAX_MM, OSIRIS_WHOLE, "expected ahead in mm, -4000 to 4000"};
static const osiris_attribute body_side = {
    "body", 0, 1, OSIRIS_BODY_MAX_MM, OSIRIS_WHOLE, "expected length and width in mm, 1 to 4000"};

static int take_body(osiris_robot_reading *reading)
{
    osiris_reader *r = &reading->reader;
    osiris_plan *plan = reading->plan;
    return once(reading, HAS_BODY, "expected one body in a file") &&
           osiris_take_attribute(&plan->length_mm, r, &body_side) &&
           osiris_take_attribute(&plan->width_mm, r, &body_side) &&
           (!iris_text_take_word(&r->lines, "ahead") ||
            osiris_take_attribute(&plan->ahead_mm, r, &body_ahead));
}

#define GPIO_LINE(word, index)                                                                               \
    {                                                                                                        \
        word, offsetof(osiris_driver_plan, lines) + sizeof(int32_t) * (index), 0, 1023, OSIRIS_WHOLE,        \
            "expected a line of the chip, 0 to 1023"                                                         \
    }

static const osiris_attribute driver_words[] = {
    {"rate", offsetof(osiris_driver_plan, rate), 1, 4000000, OSIRIS_WHOLE, "expected rate, 1 to 4000000"},
    GPIO_LINE("left-dir", OSIRIS_LINE_LEFT_DIR),
    GPIO_LINE("left-pwm", OSIRIS_LINE_LEFT_PWM),
    GPIO_LINE("right-dir", OSIRIS_LINE_RIGHT_DIR),
    GPIO_LINE("right-pwm", OSIRIS_LINE_RIGHT_PWM),
};

static int take_driver_words(osiris_driver_plan *driver, osiris_reader *r)
{
    const int is_gpio = driver->kind == OSIRIS_DRIVER_GPIO;
    const int words = is_gpio ? 5 : driver->kind == OSIRIS_DRIVER_SERIAL;
    uint32_t seen = 0;
    int taken = 1;
    driver->rate = is_gpio ? 100 : driver->kind == OSIRIS_DRIVER_SERIAL ? 115200 : 0;
    while (taken == 1 && r->lines.at < r->lines.end) {
        taken = osiris_take_one_of(driver, &seen, r, driver_words, words);
    }
    if (taken < 0) {
        return 0;
    }
    if (is_gpio && seen >> 1 != 15) {
        return osiris_expect(r, "expected left-dir, left-pwm, right-dir, and right-pwm with a line each");
    }
    if (is_gpio && driver->rate > 10000) {
        return osiris_expect(r, "expected a rate of 1 to 10000 pulses a second");
    }
    return 1;
}

static int take_driver(osiris_robot_reading *reading)
{
    static const char *const kinds[] = {"simulated", "serial", "gpio", "camera"};
    osiris_reader *r = &reading->reader;
    osiris_plan *plan = reading->plan;
    if (plan->driver_count >= OSIRIS_DRIVERS_MAX) {
        return osiris_expect(r, too_many);
    }
    osiris_driver_plan *driver = &plan->drivers[plan->driver_count];
    if (reading->implied) {
        return osiris_expect(r, "expected drivers before the drive and the devices");
    }
    if (!osiris_take_name(driver->name, sizeof driver->name, r)) {
        return osiris_expect(r, "expected a name of at most 15 characters");
    }
    for (int32_t i = 0; i < plan->driver_count; i++) {
        if (osiris_name_is(plan->drivers[i].name, driver->name)) {
            return osiris_expect(r, "expected a name that no other driver has");
        }
    }
    int kind = 0;
    while (kind < 4 && !iris_text_take_word(&r->lines, kinds[kind])) {
        kind++;
    }
    if (kind == 4) {
        return osiris_expect(r, "expected simulated, serial, gpio, or camera");
    }
    driver->kind = (osiris_driver_kind)kind;
    if (driver->kind != OSIRIS_DRIVER_SIMULATED && !osiris_take_name(driver->path, sizeof driver->path, r)) {
        return osiris_expect(r, "expected a path or chip of at most 63 characters");
    }
    plan->driver_count++;
    return take_driver_words(driver, r);
}

/* --- the whole --- */

static int take_line(osiris_robot_reading *reading)
{
    iris_text_lines *lines = &reading->reader.lines;
    if (iris_text_take_word(lines, "robot")) {
        return take_robot(reading);
    }
    if (iris_text_take_word(lines, "body")) {
        return take_body(reading);
    }
    if (iris_text_take_word(lines, "driver")) {
        return take_driver(reading);
    }
    if (reading->plan->driver_count == 0) { /* nobody names one: simulated */
        memcpy(reading->plan->drivers[0].name, "simulated", 10);
        reading->plan->driver_count = 1;
        reading->implied = 1;
    }
    if (reading->plan->device_count >= reading->capacity) {
        return osiris_expect(&reading->reader, too_many);
    }
    if (iris_text_take_word(lines, "drive")) {
        return once(reading, HAS_DRIVE, "expected one drive in a file") && osiris_robot_take_drive(reading);
    }
    return osiris_robot_take_device(reading);
}

static iris_status wrong(osiris_problem *problem, int32_t line, const char *expected)
{
    problem->line = line;
    problem->expected = expected;
    return expected == too_many ? IRIS_ERR_FULL : IRIS_ERR_DATA;
}

iris_status osiris_robot_read_text(osiris_plan *plan, osiris_device *devices, int32_t capacity,
                                   osiris_problem *problem, const char *text, size_t bytes)
{
    if (!plan || !devices || !problem || !text) {
        return IRIS_ERR_ARG;
    }
    osiris_robot_reading reading = {osiris_reader_of(text, bytes),
                                    plan,
                                    devices,
                                    capacity < OSIRIS_DEVICES_MAX ? capacity : OSIRIS_DEVICES_MAX,
                                    0,
                                    0};
    osiris_reader *r = &reading.reader;
    memset(plan, 0, sizeof *plan);
    plan->devices = devices;
    plan->length_mm = plan->width_mm = 200;
    while (iris_text_next_line(&r->lines)) {
        if (take_line(&reading) && r->lines.at < r->lines.end) {
            osiris_expect(r, "expected a word that belongs here, or the end of the line");
        }
        if (r->expected) {
            return wrong(problem, r->lines.line, r->expected);
        }
    }
    const int32_t last = r->lines.line < 1 ? 1 : r->lines.line;
    if (!(reading.has & HAS_ROBOT)) {
        return wrong(problem, last, "expected a line that begins with robot");
    }
    if (!(reading.has & HAS_DRIVE)) {
        return wrong(problem, last, "expected a line that begins with drive");
    }
    return osiris_plan_check(plan) == IRIS_OK ? IRIS_OK
                                              : wrong(problem, last, "expected a robot that holds together");
}
