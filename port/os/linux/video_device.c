/* Devices of Video4Linux. */
#include "video_device.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

/* A call that is interrupted more often than this in a row has no chance. */
enum { TRIES = 16 };

/* Colors before gray, and what color.h takes in one step before what has to be put together. */
const video_format video_formats[VIDEO_FORMATS] = {
    {V4L2_PIX_FMT_YUYV, IRIS_YUYV, 1},          {V4L2_PIX_FMT_UYVY, IRIS_UYVY, 1},
    {V4L2_PIX_FMT_NV12, IRIS_CAPTURE_NV12, 1},  {V4L2_PIX_FMT_NV12M, IRIS_CAPTURE_NV12, 2},
    {V4L2_PIX_FMT_RGB24, IRIS_RGB888, 1},       {V4L2_PIX_FMT_BGR24, IRIS_BGR888, 1},
    {V4L2_PIX_FMT_RGB565, IRIS_RGB565, 1},      {V4L2_PIX_FMT_RGB565X, IRIS_RGB565_SWAP, 1},
    {V4L2_PIX_FMT_SRGGB8, IRIS_BAYER8_RGGB, 1}, {V4L2_PIX_FMT_SGRBG8, IRIS_BAYER8_GRBG, 1},
    {V4L2_PIX_FMT_SGBRG8, IRIS_BAYER8_GBRG, 1}, {V4L2_PIX_FMT_SBGGR8, IRIS_BAYER8_BGGR, 1},
    {V4L2_PIX_FMT_GREY, IRIS_GRAY8, 1},
};

const video_format *video_format_find(uint32_t fourcc)
{
    for (int i = 0; i < VIDEO_FORMATS; i++) {
        if (video_formats[i].fourcc == fourcc) {
            return &video_formats[i];
        }
    }
    return NULL;
}

void video_fourcc_text(char text[VIDEO_FOURCC_BYTES], uint32_t fourcc)
{
    unsigned char letters[4];
    for (int i = 0; i < 4; i++) {
        letters[i] = (unsigned char)(fourcc >> (8 * i) & (i == 3 ? 0x7fu : 0xffu));
    }
    problem_text_copy(text, 5, letters, sizeof letters);
    if (fourcc & 1u << 31) {
        problem_text rest = problem_text_in(text + strlen(text), VIDEO_FOURCC_BYTES - strlen(text));
        problem_text_add(&rest, "-BE");
    }
}

uint32_t video_fourcc_parse(const char *text)
{
    uint32_t fourcc = 0;
    size_t length = strlen(text), letters = length;
    if (length > 3 && strcmp(text + length - 3, "-BE") == 0) {
        letters = length - 3;
        fourcc = 1u << 31;
    }
    if (letters < 1 || letters > 4) {
        return 0;
    }
    for (size_t i = 0; i < 4; i++) {
        fourcc |= (uint32_t)(i < letters ? (unsigned char)text[i] & 0x7fu : (unsigned char)' ') << (8 * i);
    }
    return fourcc;
}

int video_ask(int handle, unsigned long request, void *argument)
{
    int error = 0;
    for (int i = 0; i < TRIES; i++) {
        if (ioctl(handle, request, argument) == 0) {
            return 0;
        }
        error = errno;
        if (error != EINTR) {
            break;
        }
    }
    return error ? error : EIO;
}

int video_open(int *handle, uint32_t *type, struct v4l2_capability *capability, const char *path)
{
    int opened = -1;
    for (int i = 0; i < TRIES && opened < 0; i++) {
        opened = open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC);
        if (opened < 0 && errno != EINTR) {
            break;
        }
    }
    if (opened < 0) {
        return errno;
    }
    memset(capability, 0, sizeof *capability);
    int error = video_ask(opened, VIDIOC_QUERYCAP, capability);
    uint32_t abilities =
        capability->capabilities & V4L2_CAP_DEVICE_CAPS ? capability->device_caps : capability->capabilities;
    if (error == 0 && abilities & V4L2_CAP_VIDEO_CAPTURE) {
        *type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    } else if (error == 0 && abilities & V4L2_CAP_VIDEO_CAPTURE_MPLANE) {
        *type = V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE;
    } else if (error == 0) {
        error = EINVAL;
    }
    if (error == 0 && !(abilities & V4L2_CAP_STREAMING)) {
        error = EOPNOTSUPP;
    }
    if (error != 0) {
        (void)close(opened);
        return error;
    }
    *handle = opened;
    return 0;
}

const char *video_error_text(int error)
{
    switch (error) {
    case ENOENT:
    case ENOTDIR:
        return "no such device";
    case ENODEV:
    case ENXIO:
        return "the camera is gone: unplugged, or its driver was removed";
    case EACCES:
    case EPERM:
        return "no permission (is the user in the group that owns the device, often video?)";
    case EBUSY:
        return "another program uses the camera";
    case EINVAL:
    case ENOTTY:
        return "the driver refuses";
    case EPIPE:
    case ENOLINK:
        return "the parts of the camera are not connected for this size and format";
    case ENOMEM:
        return "no memory for it: take fewer buffers or a smaller size";
    case ENOSPC:
        return "the bus has no room for it: take a smaller size, a lower rate, or another USB port";
    case EMFILE:
    case ENFILE:
        return "too many files are open";
    case ETIMEDOUT:
        return "the camera does not answer";
    case EINTR:
        return "signals interrupt every call";
    default:
        return "input or output failed";
    }
}

iris_status video_open_status(int error)
{
    switch (error) {
    case EINVAL:
    case ENOTTY:
    case EISDIR:
    case EOPNOTSUPP:
        return IRIS_ERR_UNSUPPORTED;
    default:
        return IRIS_ERR_IO;
    }
}

const char *video_open_text(int error)
{
    if (error == EOPNOTSUPP) {
        return "the driver cannot hand over frames in mapped memory";
    }
    return video_open_status(error) == IRIS_ERR_UNSUPPORTED ? "not a device that captures pictures"
                                                            : video_error_text(error);
}

int32_t video_rate_millihz(struct v4l2_fract interval)
{
    if (interval.numerator == 0) {
        return 0;
    }
    uint64_t rate = ((uint64_t)interval.denominator * 1000u + interval.numerator / 2) / interval.numerator;
    return rate <= INT32_MAX ? (int32_t)rate : INT32_MAX;
}
