/* What recording.c consists of: names of a folder, and pictures out of bytes that may be late. */
#ifndef IRIS_RECORDING_PARTS_H
#define IRIS_RECORDING_PARTS_H

#include "iris/recording.h"

/* CLOCK_MONOTONIC. */
int64_t iris_recording_clock_us(void);

/* Sets the problem: "subject: text", or the text alone when subject is null. */
void iris_recording_say(iris_recording *device, const char *subject, const char *text);

/* What a failed call to the system means. */
const char *iris_recording_reason(int error);

/* How many names follow, up to `wanted` (at most IRIS_RECORDING_NAMES); -1 with the problem set: cannot be listed. */
int32_t iris_recording_names_left(iris_recording *device, int32_t wanted);

/* Moves on to the next name, which iris_recording_names_left has seen; it is in device->last then. */
void iris_recording_next_name(iris_recording *device);

/* Begins at the first name again. */
void iris_recording_first_name(iris_recording *device);

/* Opens the file in device->last, or closes the one that is open. IRIS_ERR_IO. */
iris_status iris_recording_open_file(iris_recording *device);
void iris_recording_close_file(iris_recording *device);

/* Makes device->handle ready for its first picture. */
void iris_recording_rewind(iris_recording *device);

/* Is there a byte, or the end of the input, within the time? */
int iris_recording_wait(iris_recording *device, int32_t timeout_ms);

/* Reads the header of the picture that follows; *size and *is_gray tell what it holds. The errors of iris_bmp_begin,
 * with the problem set. */
iris_status iris_recording_begin(iris_size *size, int *is_gray, iris_recording *device);

/* Reads the picture that has begun into `image`, or passes over it when image is null. The same errors. */
iris_status iris_recording_finish(const iris_image *image, iris_recording *device);

#endif
