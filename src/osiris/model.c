#include "iris/osiris/model.h"

#include <string.h>

#include "rounded.h"

/* Of a value of this size. Below 2^21 each: squares fit. */
static int32_t uncertainty_of(const osiris_device *device, int32_t value)
{
    const int64_t size = osiris_size_of(value);
    const int64_t deviation = device->deviation + size * device->error_permil / 1000;
    const int64_t step = device->resolution;
    return (int32_t)iris_sqrt_u64((uint64_t)(deviation * deviation + step * step / 12));
}

static void read_camera(osiris_reading *reading, const osiris_device *device)
{
    const uint32_t distance = iris_hypot(reading->values[0], reading->values[1]);
    reading->uncertainty[0] = reading->uncertainty[1] = uncertainty_of(device, iris_sat_s32(distance));
    if (reading->values[3] < 0 || reading->values[2] < 0 || reading->values[2] > 0xFFFFFF) {
        reading->validity = OSIRIS_BROKEN;
    } else if (distance > (uint32_t)osiris_within(device->most, 0, INT32_MAX)) {
        reading->validity = OSIRIS_BEYOND;
    }
}

static void read_odometry(osiris_reading *reading, const osiris_device *device)
{
    const int32_t way = iris_sat_s32(iris_hypot(reading->values[0], reading->values[1]));
    reading->uncertainty[0] = reading->uncertainty[1] = uncertainty_of(device, way);
    if (reading->values[2] < -32768 || reading->values[2] > 32767) {
        reading->validity = OSIRIS_BROKEN;
    }
}

static void read_line(osiris_reading *reading, const osiris_device *device)
{
    reading->uncertainty[0] = uncertainty_of(device, reading->values[0]);
    if (osiris_size_of(reading->values[1]) > 16384) {
        reading->validity = OSIRIS_BROKEN;
    } else if (osiris_size_of(reading->values[0]) > device->most) {
        reading->validity = OSIRIS_BEYOND;
    }
}

static void read_range(osiris_reading *reading, const osiris_device *device)
{
    if (reading->values[0] > device->most) {
        reading->validity = OSIRIS_BEYOND;
        return;
    }
    reading->values[0] = reading->values[0] < device->least ? device->least : reading->values[0];
    reading->uncertainty[0] = uncertainty_of(device, reading->values[0]);
}

static void read_battery(osiris_reading *reading, const osiris_device *device)
{
    const int64_t full = (int64_t)device->most - device->least;
    const int64_t have =
        osiris_within(reading->values[0], device->least, device->most) - (int64_t)device->least;
    reading->values[1] = full > 0 ? (int32_t)osiris_quotient(have * 1000, full) : 1000;
    reading->uncertainty[0] = uncertainty_of(device, reading->values[0]);
}

static void read_valid(osiris_reading *reading, const osiris_device *device)
{
    switch (device->kind) {
    case OSIRIS_CAMERA:
        read_camera(reading, device);
        break;
    case OSIRIS_RANGE:
        read_range(reading, device);
        break;
    case OSIRIS_LINE:
        read_line(reading, device);
        break;
    case OSIRIS_BUMP:
        reading->values[0] = reading->values[0] != 0;
        break;
    case OSIRIS_ODOMETRY:
        read_odometry(reading, device);
        break;
    case OSIRIS_HEADING:
        reading->values[0] = iris_angle_wrap(reading->values[0]);
        reading->uncertainty[0] = uncertainty_of(device, 0);
        break;
    default:
        read_battery(reading, device);
        break;
    }
}

iris_status osiris_model_read(osiris_reading *reading, const osiris_device *device, const osiris_raw *raw)
{
    if (!reading || !raw || osiris_device_check(device) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    osiris_reading made;
    memset(&made, 0, sizeof made);
    made.kind = device->kind;
    made.time_ms = raw->time_ms - (uint32_t)device->latency_ms;
    made.validity =
        raw->validity == OSIRIS_VALID || raw->validity == OSIRIS_BEYOND ? raw->validity : OSIRIS_BROKEN;
    const int can_see_nothing =
        device->kind == OSIRIS_CAMERA || device->kind == OSIRIS_RANGE || device->kind == OSIRIS_LINE;
    if (raw->kind != device->kind || !osiris_kind_is_sensor(device->kind) ||
        (made.validity == OSIRIS_BEYOND && !can_see_nothing)) {
        made.validity = OSIRIS_BROKEN;
    }
    if (made.validity == OSIRIS_VALID) {
        memcpy(made.values, raw->values, sizeof made.values);
        made.values[0] = osiris_calibration_value(&device->calibration, raw->values[0]);
        read_valid(&made, device);
    }
    *reading = made;
    return IRIS_OK;
}

void osiris_model_age(osiris_reading *reading, const osiris_device *device, uint32_t now_ms)
{
    if (reading && device && (reading->validity == OSIRIS_VALID || reading->validity == OSIRIS_BEYOND)) {
        const int64_t most = 3 * (int64_t)device->period_ms + device->latency_ms + OSIRIS_STALE_MS;
        if ((int32_t)(now_ms - reading->time_ms) > most) {
            reading->validity = OSIRIS_STALE;
        }
    }
}

iris_status osiris_model_write(osiris_raw *raw, const osiris_device *device,
                               const int32_t values[OSIRIS_VALUES], uint32_t now_ms)
{
    if (!raw || !values || osiris_device_check(device) != IRIS_OK || osiris_kind_is_sensor(device->kind)) {
        return IRIS_ERR_ARG;
    }
    int32_t first = values[0];
    if (device->kind == OSIRIS_STEERING || (device->kind == OSIRIS_SOUND && first != 0)) {
        first = osiris_within(first, device->least, device->most);
    } else if (device->kind == OSIRIS_GRIPPER) {
        first = osiris_within(first, 0, 1000);
    } else if (device->kind == OSIRIS_LIGHT) {
        first &= 0xFFFFFF;
    }
    memset(raw, 0, sizeof *raw);
    raw->kind = device->kind;
    raw->validity = OSIRIS_VALID;
    raw->time_ms = now_ms;
    memcpy(raw->values, values, sizeof raw->values);
    raw->values[0] = osiris_calibration_raw(&device->calibration, first);
    return IRIS_OK;
}
