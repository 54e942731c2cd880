/* Devices of Video4Linux: opening one, asking it, and the formats that IRIS reads. */
#ifndef VIDEO_DEVICE_H
#define VIDEO_DEVICE_H

#include <linux/videodev2.h>
#include <stdint.h>

#include "problem_text.h"

#include "iris/capture.h"

/* Room for the name of a format. */
#define VIDEO_FOURCC_BYTES 8

/* A format of the kernel's, and what it is here. */
typedef struct {
    uint32_t fourcc;
    int32_t format; /* an iris_format or IRIS_CAPTURE_NV12 */
    int32_t planes; /* pieces of memory */
} video_format;

enum { VIDEO_FORMATS = 13 };
extern const video_format video_formats[VIDEO_FORMATS]; /* the preferred first */

/* Null for one that IRIS does not read. */
const video_format *video_format_find(uint32_t fourcc);

void video_fourcc_text(char text[VIDEO_FOURCC_BYTES], uint32_t fourcc);

/* 0 for a name that is none. */
uint32_t video_fourcc_parse(const char *text);

/* ioctl that is repeated when a signal came between. 0, or errno. */
int video_ask(int handle, unsigned long request, void *argument);

/* Opens a device that captures pictures, and says what it is. 0, or errno: EINVAL for what is no such device. *handle and
 * *type, that of its buffers, are written on success. */
int video_open(int *handle, uint32_t *type, struct v4l2_capability *capability, const char *path);

/* Why, as the end of a sentence. Static storage. */
const char *video_error_text(int error);

/* The same and the status for errno of video_open. */
const char *video_open_text(int error);
iris_status video_open_status(int error);

/* Frames in 1000 seconds of an interval between frames; 0 for none. */
int32_t video_rate_millihz(struct v4l2_fract interval);

#endif
