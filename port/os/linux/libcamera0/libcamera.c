/* Cameras behind libcamera, in a build without it. */
#include "iris/libcamera.h"

#include <string.h>

static iris_status refuse(void *device, iris_capture_grant *grant, const char *path,
                          const iris_capture_config *wanted)
{
    (void)device, (void)grant, (void)path, (void)wanted;
    return IRIS_ERR_UNSUPPORTED;
}

/* The rest is for a device that is open, and none ever is. */
static iris_status start(void *device)
{
    (void)device;
    return IRIS_ERR_IO;
}

static iris_status take(void *device, iris_frame *frame, int32_t timeout_ms)
{
    (void)device, (void)frame, (void)timeout_ms;
    return IRIS_ERR_IO;
}

static iris_status give(void *device, int32_t buffer)
{
    (void)device, (void)buffer;
    return IRIS_ERR_IO;
}

static void do_nothing(void *device)
{
    (void)device;
}

static const char *problem(const void *device)
{
    (void)device;
    return "built without libcamera: install its development package (Debian: libcamera-dev) and build again";
}

iris_capture_source iris_libcamera_source(iris_libcamera *device)
{
    static const iris_capture_driver driver = {refuse, start, take, give, do_nothing, do_nothing, problem};
    if (device) {
        memset(device, 0, sizeof *device);
    }
    iris_capture_source source = {&driver, device};
    return source;
}

iris_status iris_libcamera_list(iris_libcamera_info *cameras, int32_t *count, int32_t capacity)
{
    if ((!cameras && capacity != 0) || !count || capacity < 0) {
        return IRIS_ERR_ARG;
    }
    *count = 0;
    return IRIS_ERR_UNSUPPORTED;
}

iris_status iris_libcamera_list_modes(iris_libcamera_mode *modes, int32_t *count, const char *path,
                                      int32_t capacity)
{
    if ((!modes && capacity != 0) || !count || !path || capacity < 0) {
        return IRIS_ERR_ARG;
    }
    *count = 0;
    return IRIS_ERR_UNSUPPORTED;
}
