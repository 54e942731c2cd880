#include "../camera.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "../complain.h"
#include "../picture.h"
#include "../system.h"
#include "iris/libcamera.h"
#include "iris/recording.h"
#include "iris/v4l2.h"

/* Memory for a frame of a recording: enough for the largest that can be followed. It is taken as it is used. Where a
 * program may not have so much, less is enough for smaller ones. */
#define RECORDING_BYTES       IRIS_RECORDING_BYTES(8192, 8192, 3)
#define RECORDING_LEAST_BYTES IRIS_RECORDING_BYTES(320, 240, 1)

/* A time of a driver that is farther away than this is none. */
#define TRUSTED_US 1000000

static struct {
    iris_capture capture;
    iris_v4l2 v4l2;
    iris_libcamera libcamera;
    iris_recording recording;
    int is_recording;
} camera;

void camera_quiet_libcamera(void)
{
    (void)setenv("LIBCAMERA_LOG_LEVELS", "*:FATAL", 0);
}

static int is_libcamera(const char *device)
{
    return strncmp(device, CAMERA_LIBCAMERA, strlen(CAMERA_LIBCAMERA)) == 0;
}

/* What is no recording by its name, also while it is not there. */
static int is_device(const char *path)
{
    struct stat status;
    return strncmp(path, "/dev/video", 10) == 0 || (stat(path, &status) == 0 && S_ISCHR(status.st_mode));
}

static iris_capture_source source_of(const char *device)
{
    camera.is_recording = 0;
    if (is_libcamera(device)) {
        camera_quiet_libcamera();
        return iris_libcamera_source(&camera.libcamera);
    }
    camera.is_recording = !is_device(device);
    if (!camera.is_recording) {
        return iris_v4l2_source(&camera.v4l2);
    }
    size_t bytes = RECORDING_BYTES;
    while (!camera.recording.memory && bytes >= RECORDING_LEAST_BYTES) {
        camera.recording.memory = malloc(bytes);
        camera.recording.bytes = camera.recording.memory ? bytes : 0;
        bytes /= 2;
    }
    return iris_recording_source(&camera.recording);
}

int camera_open(const char *device, const iris_capture_config *config)
{
    const char *path = is_libcamera(device) ? device + strlen(CAMERA_LIBCAMERA) : device;
    iris_status status = iris_capture_open(&camera.capture, source_of(device), path, config);
    if (status == IRIS_OK) {
        return EXIT_DONE;
    }
    const char *problem = iris_capture_problem(&camera.capture);
    if (status == IRIS_ERR_SCRATCH && camera.recording.bytes < RECORDING_BYTES) {
        problem = "out of memory";
    }
    complain(device, "%s", *problem != '\0' ? problem : iris_status_text(status));
    camera_close();
    return EXIT_BAD_DATA;
}

iris_status camera_next(iris_frame *frame, int32_t timeout_ms)
{
    iris_status status = iris_capture_next(frame, &camera.capture, timeout_ms);
    int64_t now_us = system_clock_us();
    if (status == IRIS_OK && !camera.is_recording &&
        (frame->time_us > now_us || frame->time_us < now_us - TRUSTED_US)) {
        frame->time_us = now_us;
    }
    return status;
}

void camera_give(const iris_frame *frame)
{
    (void)iris_capture_give(&camera.capture, frame);
}

void camera_close(void)
{
    iris_capture_close(&camera.capture);
    free(camera.recording.memory);
    camera.recording.memory = NULL;
}

const iris_capture *camera_capture(void)
{
    return &camera.capture;
}

int camera_is_recording(void)
{
    return camera.is_recording;
}

int camera_recording_is_damaged(void)
{
    return camera.is_recording && camera.capture.damaged > 0;
}

const char *camera_problem(void)
{
    return iris_capture_problem(&camera.capture);
}
