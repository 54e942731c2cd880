#include "iris/osiris/plan.h"

#include "names.h"

static int is_within(int32_t value, int32_t low, int32_t high)
{
    return value >= low && value <= high;
}

static int are_one(const osiris_device *a, const osiris_device *b)
{
    return (a->name[0] != 0 && osiris_name_is(a->name, b->name)) ||
           (a->driver == b->driver && a->kind == b->kind && a->channel == b->channel);
}

static int are_devices(const osiris_plan *plan)
{
    for (int32_t i = 0; i < plan->device_count; i++) {
        const osiris_device *device = &plan->devices[i];
        if (osiris_device_check(device) != IRIS_OK || device->driver >= plan->driver_count) {
            return 0;
        }
        for (int32_t j = 0; j < i; j++) {
            if (are_one(device, &plan->devices[j])) {
                return 0;
            }
        }
    }
    return 1;
}

static int are_drivers(const osiris_plan *plan)
{
    for (int32_t i = 0; i < plan->driver_count; i++) {
        const osiris_driver_plan *d = &plan->drivers[i];
        if ((unsigned)d->kind > OSIRIS_DRIVER_CAMERA || !osiris_name_ends(d->name, sizeof d->name) ||
            !osiris_name_ends(d->path, sizeof d->path)) {
            return 0;
        }
    }
    return 1;
}

iris_status osiris_plan_check(const osiris_plan *plan)
{
    const int good = plan && osiris_name_ends(plan->name, sizeof plan->name) &&
                     is_within(plan->length_mm, 1, OSIRIS_BODY_MAX_MM) &&
                     is_within(plan->width_mm, 1, OSIRIS_BODY_MAX_MM) &&
                     is_within(plan->ahead_mm, -OSIRIS_BODY_MAX_MM, OSIRIS_BODY_MAX_MM) &&
                     osiris_drive_check(&plan->drive) == IRIS_OK &&
                     is_within(plan->driver_count, 1, OSIRIS_DRIVERS_MAX) &&
                     is_within(plan->device_count, 0, OSIRIS_DEVICES_MAX) &&
                     (plan->devices || plan->device_count == 0) && are_drivers(plan) && are_devices(plan);
    return good ? IRIS_OK : IRIS_ERR_ARG;
}

int32_t osiris_plan_find(const osiris_plan *plan, const char *name)
{
    for (int32_t i = 0; plan && name && *name && i < plan->device_count; i++) {
        if (osiris_name_is(plan->devices[i].name, name)) {
            return i;
        }
    }
    return -1;
}
