/* A robot at the other end of a line. */
#include <string.h>

#include "iris/command.h"
#include "iris/osiris/telemetry.h"
#include "rounded.h"
#include "wheels.h"

iris_status osiris_remote_init(osiris_remote *remote, osiris_remote_device *devices, const osiris_plan *plan,
                               int32_t driver)
{
    if (!remote || osiris_plan_check(plan) != IRIS_OK || (!devices && plan->device_count > 0) || driver < 0 ||
        driver >= plan->driver_count) {
        return IRIS_ERR_ARG;
    }
    memset(remote, 0, sizeof *remote);
    remote->plan = plan;
    remote->driver = driver;
    remote->devices = devices;
    for (int32_t i = 0; i < plan->device_count; i++) {
        memset(&devices[i], 0, sizeof devices[i]);
    }
    return IRIS_OK;
}

/* -1: none of this driver's. */
static int32_t index_of(const osiris_remote *remote, osiris_kind kind, int32_t channel)
{
    for (int32_t i = 0; i < remote->plan->device_count; i++) {
        const osiris_device *d = &remote->plan->devices[i];
        if (d->driver == remote->driver && d->kind == kind && d->channel == channel) {
            return i;
        }
    }
    return -1;
}

iris_status osiris_remote_take(osiris_remote *remote, const void *bytes, size_t count, uint32_t now_ms)
{
    if (!remote || (!bytes && count > 0)) {
        return IRIS_ERR_ARG;
    }
    for (size_t i = 0; i < count; i++) {
        osiris_telemetry t;
        const iris_status status = osiris_telemetry_parse(&t, &remote->parser, ((const char *)bytes)[i]);
        const int32_t found = status == IRIS_OK ? index_of(remote, t.raw.kind, t.channel) : -1;
        if (found >= 0 && osiris_kind_is_sensor(t.raw.kind)) {
            remote->devices[found].raw = t.raw;
            remote->devices[found].raw.time_ms = now_ms;
            remote->devices[found].is_new = 1;
            remote->taken++;
        } else if (status != IRIS_ERR_TRUNCATED) {
            remote->refused++;
        }
    }
    return IRIS_OK;
}

iris_status osiris_remote_read(osiris_remote *remote, osiris_raw *raw, const osiris_device *device)
{
    if (!remote || !raw || !device) {
        return IRIS_ERR_ARG;
    }
    const int32_t found = index_of(remote, device->kind, device->channel);
    if (found < 0 || device->driver != remote->driver || !osiris_kind_is_sensor(device->kind)) {
        return IRIS_ERR_UNSUPPORTED;
    }
    if (!remote->devices[found].is_new) {
        return IRIS_ERR_TIMEOUT;
    }
    remote->devices[found].is_new = 0;
    *raw = remote->devices[found].raw;
    return IRIS_OK;
}

static int32_t next_seq(int32_t *seq)
{
    const int32_t now = *seq;
    *seq = now >= 9999 ? 0 : now + 1;
    return now;
}

static int32_t permil(int64_t share, int64_t of)
{
    return of > 0 ? (int32_t)osiris_quotient((share > of ? of : share < -of ? -of : share) * 1000, of) : 0;
}

/* The share that the wheels differ by (differential.h), or that the wheels are steered by. It only drives ahead. */
static iris_command command_of(osiris_remote *remote, const osiris_raw *raw)
{
    const osiris_drive_config *drive = &remote->plan->drive;
    const int32_t ahead_q16 = osiris_within(raw->values[0], 0, INT32_MAX);
    const int32_t turn_q8 = osiris_within(raw->values[2], -(1 << 28), 1 << 28);
    const int32_t arm = drive->kind == OSIRIS_OMNI ? drive->radius_mm : (drive->track_mm + 1) / 2;
    iris_command command = {next_seq(&remote->command_seq), IRIS_LINE_FOUND, 0, 0, 0, 0, 1000};
    command.speed_permil = permil(ahead_q16, (int64_t)drive->speed_max_mms * 65536);
    if (command.speed_permil == 0) {
        command.state = IRIS_LINE_LOST;
        command.confidence_permil = 0;
    } else if (drive->kind == OSIRIS_ACKERMANN) {
        command.steer_permil = permil(raw->values[3], drive->steering_max);
    } else {
        command.steer_permil = permil(osiris_rim_q16(turn_q8, arm), ahead_q16);
    }
    return command;
}

iris_status osiris_remote_tell(char *sentences, size_t *length, osiris_remote *remote,
                               const osiris_device *device, const osiris_raw *raw)
{
    if (!sentences || !length || !remote || !device || !raw) {
        return IRIS_ERR_ARG;
    }
    size_t first = 0, second = 0;
    if (index_of(remote, device->kind, device->channel) < 0 || device->driver != remote->driver ||
        osiris_kind_is_sensor(device->kind)) {
        return IRIS_ERR_UNSUPPORTED;
    }
    if (device->kind == OSIRIS_DRIVE) {
        const iris_command command = command_of(remote, raw);
        const iris_status status = iris_command_format(sentences, OSIRIS_REMOTE_BYTES, &first, &command);
        if (status != IRIS_OK) {
            return status;
        }
    }
    osiris_telemetry t = {next_seq(&remote->seq), device->channel, *raw};
    t.raw.kind = device->kind;
    t.raw.validity = OSIRIS_VALID;
    const iris_status status =
        osiris_telemetry_format(sentences + first, OSIRIS_REMOTE_BYTES - first, &second, &t);
    *length = first + second;
    return status;
}
