/* The buffers of a camera, and its stream; what v4l2.c has agreed on is in the device. */
#ifndef V4L2_BUFFERS_H
#define V4L2_BUFFERS_H

#include "iris/v4l2.h"

/* Says in device->problem what went wrong, and returns status. error: errno, or 0 for no words about it. */
iris_status v4l2_fail(iris_v4l2 *device, iris_status status, const char *what, int error);

/* Has the driver make buffers and maps them; their count goes into the grant. v4l2_release takes back what there is. */
iris_status v4l2_map(iris_v4l2 *device, int32_t wanted);
void v4l2_release(iris_v4l2 *device);

/* As capture.h says of a driver. */
iris_status v4l2_start(void *state);
iris_status v4l2_take(void *state, iris_frame *frame, int32_t timeout_ms);
iris_status v4l2_give(void *state, int32_t index);
void v4l2_stop(void *state);

#endif
