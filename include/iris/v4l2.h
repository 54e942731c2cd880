/* IRIS - cameras of the Linux kernel (Video4Linux) as a source of frames.
 *
 * The path is that of a device, such as "/dev/video0", or a link to one: those in /dev/v4l/by-id find a camera again that
 * came back under another number. Frames lie in the driver's own memory, mapped for reading only:
 * a program that writes to a frame ends there.
 *
 * What is read, in the order in which format 0 (any) takes what the camera offers: YUYV, UYVY, NV12 (in one piece of
 * memory, or in two: NM12), RGB3 (IRIS_RGB888), BGR3 (IRIS_BGR888), RGBP (IRIS_RGB565), RGBR (IRIS_RGB565_SWAP),
 * RGGB, GRBG, GBRG, BA81 (Bayer), GREY. Compressed pictures are not: a camera that offers nothing else is refused, and
 * iris_capture_problem names what it offers. Many USB cameras have MJPG for their largest sizes only.
 *
 * A driver goes to the nearest size, stride, and rate that it has, and says so: read the grant. A camera that has several
 * inputs keeps the one that is set; controls such as the exposure are in camera_control.h, what a camera can do in
 * camera_list.h. The time of a frame is usually CLOCK_MONOTONIC, when its first or last pixel came.
 *
 * A frame that the driver calls damaged, or that is shorter than the picture, is counted and not delivered. No answer of a
 * driver makes the program read outside what is mapped.
 */
#ifndef IRIS_V4L2_H
#define IRIS_V4L2_H

#include "iris/capture.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Memory of a buffer, in one piece or two. */
typedef struct {
    void *start; /* null: not mapped */
    size_t bytes;
} iris_v4l2_memory;

/* One camera; belongs to the functions. */
typedef struct {
    int handle;    /* file descriptor, -1 when closed */
    uint32_t type; /* of the kernel's buffers */
    int32_t planes;
    iris_capture_grant grant;
    int32_t chroma_stride;
    int32_t streaming;
    uint32_t queued;   /* a bit for each buffer: the driver has it */
    uint32_t borrowed; /* the program has it; one that nobody has is queued by the next call */
    iris_v4l2_memory memory[IRIS_CAPTURE_BUFFERS_MAX][2];
    char problem[IRIS_CAPTURE_PROBLEM_BYTES];
} iris_v4l2;

/* The source that *device is, for iris_capture_open. Not while a capture uses the device. Null: a source that
 * iris_capture_open refuses. */
iris_capture_source iris_v4l2_source(iris_v4l2 *device);

#ifdef __cplusplus
}
#endif

#endif
