#include "iris/osiris/device.h"

#include <string.h>

#include "names.h"

typedef struct {
    const char *name, *unit;
    int32_t width, least, most, period_ms;
} kind_facts;

static const kind_facts facts[OSIRIS_KINDS] = {
    {"nothing", "", 0, 0, 0, 100},       {"camera", "mm", 10923, 50, 3000, 50},
    {"range", "mm", 2731, 20, 2000, 50}, {"line", "mm", 0, 0, 60, 20},
    {"bump", "", 21845, 0, 0, 20},       {"odometry", "mm", 0, 0, 0, 20},
    {"heading", "units", 0, 0, 0, 50},   {"battery", "mV", 0, 6400, 8400, 1000},
    {"drive", "mm/s", 0, 0, 0, 20},      {"steering", "units", 0, -5461, 5461, 20},
    {"gripper", "permil", 0, 0, 0, 20},  {"light", "", 0, 0, 0, 20},
    {"sound", "Hz", 0, 20, 20000, 20},
};

static const kind_facts *facts_of(osiris_kind kind)
{
    return &facts[(unsigned)kind < OSIRIS_KINDS ? kind : OSIRIS_NOTHING];
}

const char *osiris_kind_name(osiris_kind kind)
{
    return facts_of(kind)->name;
}

const char *osiris_kind_unit(osiris_kind kind)
{
    return facts_of(kind)->unit;
}

void osiris_device_defaults(osiris_device *device, osiris_kind kind)
{
    if (device) {
        const kind_facts *f = facts_of(kind);
        memset(device, 0, sizeof *device);
        device->kind = kind;
        device->width = f->width;
        device->least = f->least;
        device->most = f->most;
        device->period_ms = f->period_ms;
        device->resolution = 1;
    }
}

static int is_within(int32_t value, int32_t low, int32_t high)
{
    return value >= low && value <= high;
}

static int is_place(int32_t mm)
{
    return mm > -OSIRIS_PLACE_MAX_MM && mm < OSIRIS_PLACE_MAX_MM;
}

static int is_calibration(const osiris_calibration *c)
{
    int good = c->count == 0 || is_within(c->count, 2, OSIRIS_CALIBRATION_MAX);
    for (int32_t i = 1; good && i < c->count; i++) {
        good = c->raw[i - 1] < c->raw[i];
    }
    return good;
}

iris_status osiris_device_check(const osiris_device *device)
{
    if (!device || device->kind <= OSIRIS_NOTHING || device->kind >= OSIRIS_KINDS) {
        return IRIS_ERR_ARG;
    }
    const int good =
        osiris_name_ends(device->name, sizeof device->name) && is_within(device->driver, 0, 255) &&
        is_within(device->channel, 0, 255) && is_within(device->place.x_mm, -9999, 9999) &&
        is_within(device->place.y_mm, -9999, 9999) && is_within(device->height_mm, -9999, 9999) &&
        is_within(device->width, 0, 65536) && is_place(device->least) && is_place(device->most) &&
        device->least <= device->most && is_within(device->resolution, 1, OSIRIS_PLACE_MAX_MM) &&
        is_within(device->deviation, 0, OSIRIS_PLACE_MAX_MM) && is_within(device->error_permil, 0, 1000) &&
        is_within(device->period_ms, 1, 60000) && is_within(device->latency_ms, 0, 10000) &&
        is_calibration(&device->calibration);
    return good ? IRIS_OK : IRIS_ERR_ARG;
}
