/* Where the library has no cameras. */
#include "../camera.h"

#include "../complain.h"

int camera_open(const char *device, const iris_capture_config *config)
{
    (void)config;
    complain(device, "this build of iris has no cameras");
    return EXIT_BAD_DATA;
}

iris_status camera_next(iris_frame *frame, int32_t timeout_ms)
{
    (void)frame;
    (void)timeout_ms;
    return IRIS_ERR_UNSUPPORTED;
}

void camera_give(const iris_frame *frame)
{
    (void)frame;
}

void camera_close(void)
{
}

const iris_capture *camera_capture(void)
{
    static const iris_capture none;
    return &none;
}

void camera_quiet_libcamera(void)
{
}

int camera_is_recording(void)
{
    return 0;
}

int camera_recording_is_damaged(void)
{
    return 0;
}

const char *camera_problem(void)
{
    return "this build of iris has no cameras";
}
