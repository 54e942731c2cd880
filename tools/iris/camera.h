/* The camera that a command looks through: one at a time. Where the library has no cameras, opening it fails. */
#ifndef IRIS_TOOL_CAMERA_H
#define IRIS_TOOL_CAMERA_H

#include "iris/capture.h"

/* For help texts. */
#define CAMERA_DEVICE_HELP                                                                                   \
    "a device such as /dev/video0, libcamera:ID, or a recording: a picture file, a\n"                        \
    "                folder of them, or - for standard input\n"

/* The options of a camera as texts, null where not given. */
typedef struct {
    const char *size, *format, *rate;
} camera_texts;

/* Reads them into *config, which is zeroed otherwise; rate is in frames per second, with up to 3 decimals. Returns 0 after
 * complaining. */
int camera_options_read(iris_capture_config *config, const camera_texts *texts);

/* The name of a format, as --format has it: "yuyv", "nv12", ... "?" for one that cameras do not have. */
const char *camera_format_name(int32_t format);

/* What names a camera behind libcamera: this and its id. */
#define CAMERA_LIBCAMERA       "libcamera:"
#define CAMERA_LIBCAMERA_BYTES 272

/* libcamera says on standard error what it does; not from now on, unless LIBCAMERA_LOG_LEVELS wants that. */
void camera_quiet_libcamera(void);

/* device: a node of the kernel's cameras, one behind libcamera, or a recording (recording.h). Complains; returns an exit
 * code. */
int camera_open(const char *device, const iris_capture_config *config);

/* As iris_capture_next; time_us of the frame is when it was there, by system_clock_us. */
iris_status camera_next(iris_frame *frame, int32_t timeout_ms);
void camera_give(const iris_frame *frame);
void camera_close(void);

/* Grant and counters. */
const iris_capture *camera_capture(void);

/* A recording: its frames have their times by their numbers. */
int camera_is_recording(void);

/* Has the recording had frames that could not be read? Also after closing. Of a camera it is nothing unusual. */
int camera_recording_is_damaged(void);

/* Why camera_next failed last. */
const char *camera_problem(void);

#endif
