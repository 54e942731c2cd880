#include "iris/camera_eye.h"

#include <string.h>

enum { AGAIN_MS = 1000 }; /* opening a camera takes a while, too */

iris_status osiris_camera_eye_init(osiris_camera_eye *eye, const osiris_camera_parts *parts,
                                   const osiris_plan *plan, int32_t driver)
{
    if (!eye || !parts || !parts->source.driver || !parts->look || osiris_plan_check(plan) != IRIS_OK ||
        driver < 0 || driver >= plan->driver_count || plan->drivers[driver].kind != OSIRIS_DRIVER_CAMERA) {
        return IRIS_ERR_ARG;
    }
    memset(eye, 0, sizeof *eye);
    eye->source = parts->source;
    eye->look = parts->look;
    eye->looker = parts->looker;
    eye->plan = plan;
    eye->driver = driver;
    return IRIS_OK;
}

static iris_status open_camera(void *context, uint32_t now_ms)
{
    osiris_camera_eye *eye = context;
    iris_capture_config config;
    eye->tried_ms = now_ms;
    memset(&config, 0, sizeof config);
    config.policy = IRIS_CAPTURE_LATEST;
    const iris_status status =
        iris_capture_open(&eye->capture, eye->source, eye->plan->drivers[eye->driver].path, &config);
    eye->is_open = status == IRIS_OK;
    return status;
}

static iris_status read_camera(void *context, osiris_raw *raw, const osiris_device *device, uint32_t now_ms)
{
    osiris_camera_eye *eye = context;
    iris_frame frame;
    if (device->kind != OSIRIS_CAMERA || device->driver != eye->driver || device->channel != 0) {
        return IRIS_ERR_UNSUPPORTED;
    }
    if (!eye->is_open && (now_ms - eye->tried_ms < AGAIN_MS || open_camera(eye, now_ms) != IRIS_OK)) {
        return IRIS_ERR_IO;
    }
    iris_status status = iris_capture_next(&frame, &eye->capture, 0);
    if (status != IRIS_OK) {
        return status;
    }
    osiris_raw made = {OSIRIS_CAMERA, OSIRIS_VALID, now_ms, {0, 0, 0, 0}};
    status = eye->look(eye->looker, made.values, &frame);
    (void)iris_capture_give(&eye->capture, &frame);
    if (status == IRIS_ERR_END) {
        made.validity = OSIRIS_BEYOND;
        status = IRIS_OK;
    }
    if (status != IRIS_OK) {
        return status == IRIS_ERR_TIMEOUT ? IRIS_ERR_DATA : status;
    }
    *raw = made;
    return IRIS_OK;
}

static iris_status write_nothing(void *context, const osiris_device *device, const osiris_raw *raw,
                                 uint32_t now_ms)
{
    (void)context;
    (void)device;
    (void)raw;
    (void)now_ms;
    return IRIS_ERR_UNSUPPORTED;
}

static void close_camera(void *context, uint32_t now_ms)
{
    osiris_camera_eye *eye = context;
    (void)now_ms;
    if (eye->is_open) {
        iris_capture_close(&eye->capture);
    }
    eye->is_open = 0;
}

const osiris_driver osiris_camera_eye_driver = {open_camera, read_camera, write_nothing, close_camera};
