/* The lines of a robot file that are devices, and its drive. */
#include <string.h>

#include "names.h"
#include "robot_text_parts.h"

#define IN_DRIVE(field) offsetof(osiris_drive_config, field)

static const osiris_attribute drive_words[] = {
    {"speed", IN_DRIVE(speed_max_mms), 1, OSIRIS_SPEED_MAX_MMS, OSIRIS_WHOLE,
     "expected speed of a wheel in mm/s, 1 to 16000"},
    {"turn", IN_DRIVE(turn_rate_max), 1, OSIRIS_TURN_RATE_MAX, OSIRIS_DEGREES,
     "expected turn in degrees/s, up to 5760"},
    {"acceleration", IN_DRIVE(acceleration_mms2), 1, 1000000, OSIRIS_WHOLE,
     "expected acceleration in mm/s^2, 1 to 1000000"},
    {"turn-acceleration", IN_DRIVE(turn_acceleration), 1, 100000000, OSIRIS_DEGREES,
     "expected turn-acceleration in degrees/s^2, up to 549316"},
    {"track", IN_DRIVE(track_mm), 1, OSIRIS_SIDE_MAX_MM, OSIRIS_WHOLE, "expected track in mm, 1 to 4000"},
    {"wheelbase", IN_DRIVE(wheelbase_mm), 1, OSIRIS_SIDE_MAX_MM, OSIRIS_WHOLE,
     "expected wheelbase in mm, 1 to 4000"},
    {"steering", IN_DRIVE(steering_max), 182, 14563, OSIRIS_DEGREES, "expected steering in degrees, 1 to 80"},
    {"steering-rate", IN_DRIVE(steering_rate), 1, OSIRIS_TURN_RATE_MAX, OSIRIS_DEGREES,
     "expected steering-rate in degrees/s, up to 5760"},
    {"radius", IN_DRIVE(radius_mm), 1, OSIRIS_SIDE_MAX_MM, OSIRIS_WHOLE, "expected radius in mm, 1 to 4000"},
    {"wheels", IN_DRIVE(wheels), 3, 4, OSIRIS_WHOLE, "expected wheels, 3 or 4"},
};
enum {
    DRIVE_WORDS = sizeof drive_words / sizeof drive_words[0],
    TRACK = 4,
    WHEELBASE,
    STEERING,
    STEERING_RATE,
    RADIUS,
    WHEELS
};

#define BIT(i) (1u << (i))

/* By kind: words that must be there, and those that may be besides the first four. */
static const struct {
    const char *name;
    uint32_t must, may;
    const char *expected;
} drive_kinds[] = {
    {"differential", BIT(TRACK), 0,
     "expected differential with track and, if needed, speed, turn, and their accelerations"},
    {"ackermann", BIT(TRACK) | BIT(WHEELBASE) | BIT(STEERING), BIT(STEERING_RATE),
     "expected ackermann with track, wheelbase, and steering, and without radius and wheels"},
    {"omni", BIT(RADIUS) | BIT(WHEELS), 0,
     "expected omni with radius and wheels, and without track, wheelbase, and steering"},
};

static int take_by(int32_t *driver, osiris_robot_reading *reading)
{
    char name[OSIRIS_NAME_BYTES];
    if (osiris_take_name(name, sizeof name, &reading->reader)) {
        for (int32_t i = 0; i < reading->plan->driver_count; i++) {
            if (osiris_name_is(reading->plan->drivers[i].name, name)) {
                *driver = i;
                return 1;
            }
        }
    }
    return osiris_expect(&reading->reader, "expected a driver that has a line before this one");
}

static int is_taken(const osiris_robot_reading *reading, const osiris_device *device)
{
    for (int32_t i = 0; i < reading->plan->device_count; i++) {
        const osiris_device *other = &reading->devices[i];
        if (other->kind == device->kind && other->driver == device->driver &&
            other->channel == device->channel) {
            return 1;
        }
    }
    return 0;
}

/* One more device; one without a channel gets the first that is free. */
static int add(osiris_robot_reading *reading, osiris_device *device)
{
    if (device->channel < 0) {
        device->channel = 0;
        while (is_taken(reading, device)) {
            device->channel++;
        }
    }
    if (is_taken(reading, device)) {
        return osiris_expect(&reading->reader,
                             "expected a channel that no other device of this kind and driver has");
    }
    if (osiris_plan_find(reading->plan, device->name) >= 0) {
        return osiris_expect(&reading->reader, "expected a name that no other device has");
    }
    if (osiris_device_check(device) != IRIS_OK) {
        return osiris_expect(&reading->reader,
                             "expected from to be at most to, and raw values of calibrate to grow");
    }
    reading->devices[reading->plan->device_count++] = *device;
    return 1;
}

int osiris_robot_take_drive(osiris_robot_reading *reading)
{
    osiris_reader *r = &reading->reader;
    osiris_drive_config *drive = &reading->plan->drive;
    osiris_device device;
    uint32_t seen = 0;
    int kind = 0, taken = 1;
    while (kind < 3 && !iris_text_take_word(&r->lines, drive_kinds[kind].name)) {
        kind++;
    }
    if (kind == 3) {
        return osiris_expect(r, "expected differential, ackermann, or omni");
    }
    osiris_drive_defaults(drive, (osiris_drive_kind)kind);
    osiris_device_defaults(&device, OSIRIS_DRIVE);
    memcpy(device.name, "drive", 6);
    while (taken == 1 && r->lines.at < r->lines.end) {
        taken = iris_text_take_word(&r->lines, "by")
                    ? take_by(&device.driver, reading)
                    : osiris_take_one_of(drive, &seen, r, drive_words, DRIVE_WORDS);
    }
    if (r->expected) {
        return 0;
    }
    const uint32_t must = drive_kinds[kind].must;
    if (taken == 0 || (seen & must) != must || (seen & ~(15u | must | drive_kinds[kind].may)) != 0) {
        return osiris_expect(r, drive_kinds[kind].expected);
    }
    return add(reading, &device);
}

/* --- devices --- */

#define IN_DEVICE(field) offsetof(osiris_device, field)
#define FAR_MM           (OSIRIS_PLACE_MAX_MM - 1)

static const osiris_attribute device_words[] = {
    {"height", IN_DEVICE(height_mm), -9999, 9999, OSIRIS_WHOLE, "expected height in mm, -9999 to 9999"},
    {"cone", IN_DEVICE(width), 0, 65536, OSIRIS_DEGREES, "expected cone in degrees, 0 to 360"},
    {"error", IN_DEVICE(error_permil), 0, 1000, OSIRIS_TENTHS, "expected error in percent, 0 to 100"},
    {"rate", IN_DEVICE(period_ms), 1, 60000, OSIRIS_HERTZ, "expected rate in Hz, 0.017 to 1000"},
    {"latency", IN_DEVICE(latency_ms), 0, 10000, OSIRIS_WHOLE, "expected latency in ms, 0 to 10000"},
    {"channel", IN_DEVICE(channel), 0, 255, OSIRIS_WHOLE, "expected channel, 0 to 255"},
    /* of the first value */
    {"from", IN_DEVICE(least), -FAR_MM, FAR_MM, OSIRIS_WHOLE,
     "expected from with a whole number, at most 1048575"},
    {"to", IN_DEVICE(most), -FAR_MM, FAR_MM, OSIRIS_WHOLE,
     "expected to with a whole number, at most 1048575"},
    {"step", IN_DEVICE(resolution), 1, FAR_MM, OSIRIS_WHOLE, "expected step with a whole number from 1"},
    {"noise", IN_DEVICE(deviation), 0, FAR_MM, OSIRIS_WHOLE, "expected noise with a whole number from 0"},
};
enum { DEVICE_WORDS = sizeof device_words / sizeof device_words[0], FIRST_OF_VALUE = 6 };

/* The last four where the value is an angle. */
static const osiris_attribute angle_words[] = {
    {"from", IN_DEVICE(least), -32768, 32768, OSIRIS_DEGREES, "expected from in degrees, -180 to 180"},
    {"to", IN_DEVICE(most), -32768, 32768, OSIRIS_DEGREES, "expected to in degrees, -180 to 180"},
    {"step", IN_DEVICE(resolution), 1, 32768, OSIRIS_DEGREES, "expected step in degrees, above 0"},
    {"noise", IN_DEVICE(deviation), 0, 32768, OSIRIS_DEGREES, "expected noise in degrees, from 0"},
};

static const osiris_attribute facing = {
    "facing", 0, -131072, 131072, OSIRIS_DEGREES, "expected facing in degrees"};
static const osiris_attribute on_robot = {
    "at", 0, -9999, 9999, OSIRIS_WHOLE, "expected a place: X Y, mm ahead and to the left, less than 10000"};
static const osiris_attribute of_pair = {
    "calibrate", 0, INT32_MIN, INT32_MAX, OSIRIS_WHOLE, "expected 2 to 8 pairs RAW VALUE of whole numbers"};

static int take_calibration(osiris_calibration *c, osiris_reader *r)
{
    const char *at = r->lines.at;
    int64_t number;
    c->count = 0;
    while (c->count < OSIRIS_CALIBRATION_MAX && osiris_take_thousandths(&number, r)) {
        r->lines.at = at;
        if (!osiris_take_attribute(&c->raw[c->count], r, &of_pair) ||
            !osiris_take_attribute(&c->value[c->count], r, &of_pair)) {
            return 0;
        }
        c->count++;
        at = r->lines.at;
    }
    return c->count >= 2 || osiris_expect(r, of_pair.expected);
}

/* 1, 0, or -1 as osiris_take_one_of. */
static int take_word(osiris_device *device, uint32_t *seen, osiris_robot_reading *reading)
{
    osiris_reader *r = &reading->reader;
    int32_t angle = 0;
    const int is_angle = device->kind == OSIRIS_HEADING || device->kind == OSIRIS_STEERING;
    if (iris_text_take_word(&r->lines, "by")) {
        return take_by(&device->driver, reading) ? 1 : -1;
    }
    if (iris_text_take_word(&r->lines, "at")) {
        return osiris_take_attribute(&device->place.x_mm, r, &on_robot) &&
                       osiris_take_attribute(&device->place.y_mm, r, &on_robot)
                   ? 1
                   : -1;
    }
    if (iris_text_take_word(&r->lines, "facing")) {
        const int good = osiris_take_attribute(&angle, r, &facing);
        device->place.heading = iris_angle_wrap(angle);
        return good ? 1 : -1;
    }
    if (iris_text_take_word(&r->lines, "calibrate")) {
        return take_calibration(&device->calibration, r) ? 1 : -1;
    }
    const int taken =
        osiris_take_one_of(device, seen, r, device_words, is_angle ? FIRST_OF_VALUE : DEVICE_WORDS);
    uint32_t seen_angles = *seen >> FIRST_OF_VALUE;
    if (taken != 0 || !is_angle) {
        return taken;
    }
    const int taken_angle = osiris_take_one_of(device, &seen_angles, r, angle_words, 4);
    *seen |= seen_angles << FIRST_OF_VALUE;
    return taken_angle;
}

int osiris_robot_take_device(osiris_robot_reading *reading)
{
    osiris_reader *r = &reading->reader;
    osiris_device device;
    uint32_t seen = 0;
    int kind = OSIRIS_CAMERA, taken = 1;
    while (kind < OSIRIS_KINDS &&
           (kind == OSIRIS_DRIVE || !iris_text_take_word(&r->lines, osiris_kind_name((osiris_kind)kind)))) {
        kind++;
    }
    if (kind == OSIRIS_KINDS) {
        return osiris_expect(r, "expected robot, body, driver, drive, or a kind of device such as range");
    }
    osiris_device_defaults(&device, (osiris_kind)kind);
    device.channel = -1;
    if (!osiris_take_name(device.name, sizeof device.name, r)) {
        return osiris_expect(r, "expected a name of at most 15 characters");
    }
    while (taken == 1 && r->lines.at < r->lines.end) {
        taken = take_word(&device, &seen, reading);
    }
    if (taken < 0) {
        return 0;
    }
    if (taken == 0) {
        return osiris_expect(
            r, "expected at, height, facing, cone, from, to, step, noise, error, rate, latency, by, "
               "channel, or calibrate");
    }
    return add(reading, &device);
}
