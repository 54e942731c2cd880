/* A driver of the kernel's that answers as it is told to, also what no driver should: the program's own open, ioctl, and
 * poll. For one test, which is the program. */
#ifndef FAKE_VIDEO_H
#define FAKE_VIDEO_H

#include <errno.h>
#include <fcntl.h>
#include <linux/videodev2.h>
#include <poll.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include "test.h"

enum { W = 64, H = 4, ROW = 2 * W, PICTURE = ROW * H, PAGE = 4096, NEVER = 1 << 30 };

/* The driver. What is set before a test is what it answers. */
static struct {
    int handle; /* of its memory; -1: not open */
    uint32_t capabilities, device_capabilities;
    uint32_t offers[4];
    int endless; /* the list of formats has no end */
    int multi, planes;
    struct v4l2_pix_format pix; /* what a size and format are settled for */
    uint32_t strides[2];        /* of several planes */
    struct v4l2_captureparm rate;
    uint32_t grants;           /* buffers */
    uint32_t length;           /* of each, or of its planes */
    uint32_t pieces;           /* that a buffer is said to have */
    uint32_t offset;           /* added to where a buffer is */
    int ready;                 /* frames that wait */
    int always_ready;          /* poll says so */
    struct v4l2_buffer answer; /* index, bytesused, flags, timestamp */
    struct v4l2_plane planes_answer[2];
    int any_index; /* answer.index counts, not the first that is queued */

    unsigned long failing; /* this request fails */
    int error, times, after;
    int poll_error;
    uint32_t queued;
    int streams, requests, polls;
    struct v4l2_format asked;
    struct v4l2_streamparm asked_rate;
} fake;

static int refuse(int error)
{
    errno = error;
    return -1;
}

static int enumerate(struct v4l2_fmtdesc *offer)
{
    if (!fake.endless && (offer->index >= 4 || fake.offers[offer->index] == 0)) {
        return refuse(EINVAL);
    }
    offer->pixelformat = fake.offers[offer->index % 4];
    return 0;
}

static int settle(struct v4l2_format *format)
{
    if (fake.multi) {
        format->fmt.pix_mp.width = fake.pix.width;
        format->fmt.pix_mp.height = fake.pix.height;
        format->fmt.pix_mp.pixelformat = fake.pix.pixelformat;
        format->fmt.pix_mp.field = (uint8_t)fake.pix.field;
        format->fmt.pix_mp.num_planes = (uint8_t)fake.planes;
        format->fmt.pix_mp.plane_fmt[0].bytesperline = fake.strides[0];
        format->fmt.pix_mp.plane_fmt[1].bytesperline = fake.strides[1];
    } else {
        format->fmt.pix = fake.pix;
    }
    return 0;
}

static int query(struct v4l2_buffer *buffer)
{
    uint32_t at = buffer->index * 2 * PAGE + fake.offset;
    if (fake.multi) {
        for (uint32_t i = 0; i < 2 && i < buffer->length; i++) {
            buffer->m.planes[i].length = fake.length;
            buffer->m.planes[i].m.mem_offset = at + i * PAGE;
        }
        buffer->length = fake.pieces;
    } else {
        buffer->length = fake.length;
        buffer->m.offset = at;
    }
    return 0;
}

static int dequeue(struct v4l2_buffer *buffer)
{
    if (fake.ready == 0) {
        return refuse(EAGAIN);
    }
    fake.ready--;
    uint32_t index = 0;
    while (index < 8 && !(fake.queued >> index & 1u)) {
        index++;
    }
    buffer->index = fake.any_index ? fake.answer.index : index;
    buffer->bytesused = fake.answer.bytesused;
    buffer->flags = fake.answer.flags;
    buffer->timestamp = fake.answer.timestamp;
    buffer->sequence = fake.answer.sequence++;
    if (fake.multi) {
        memcpy(buffer->m.planes, fake.planes_answer, (size_t)fake.planes * sizeof fake.planes_answer[0]);
    }
    fake.queued &= ~(1u << (index & 7u));
    return 0;
}

static int answer(unsigned long request, void *argument)
{
    switch (request) {
    case VIDIOC_QUERYCAP:
        ((struct v4l2_capability *)argument)->capabilities = fake.capabilities;
        ((struct v4l2_capability *)argument)->device_caps = fake.device_capabilities;
        return 0;
    case VIDIOC_ENUM_FMT:
        return enumerate(argument);
    case VIDIOC_S_FMT:
        fake.asked = *(struct v4l2_format *)argument;
        return settle(argument);
    case VIDIOC_G_FMT:
        return settle(argument);
    case VIDIOC_S_PARM:
        fake.asked_rate = *(struct v4l2_streamparm *)argument;
        ((struct v4l2_streamparm *)argument)->parm.capture = fake.rate;
        return 0;
    case VIDIOC_G_PARM:
        ((struct v4l2_streamparm *)argument)->parm.capture = fake.rate;
        return 0;
    case VIDIOC_REQBUFS:
        if (((struct v4l2_requestbuffers *)argument)->count > 0) {
            ((struct v4l2_requestbuffers *)argument)->count = fake.grants;
        }
        return 0;
    case VIDIOC_QUERYBUF:
        return query(argument);
    case VIDIOC_QBUF:
        assert_false(fake.queued >> ((struct v4l2_buffer *)argument)->index & 1u);
        fake.queued |= 1u << ((struct v4l2_buffer *)argument)->index;
        return 0;
    case VIDIOC_DQBUF:
        return dequeue(argument);
    case VIDIOC_STREAMON:
        fake.streams = 1;
        return 0;
    case VIDIOC_STREAMOFF:
        fake.streams = 0;
        fake.queued = 0;
        return 0;
    default:
        return refuse(ENOTTY);
    }
}

/* NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): the system's are reserved names */
int ioctl(int handle, unsigned long request, ...)
{
    va_list arguments;
    va_start(arguments, request);
    void *argument = va_arg(arguments, void *);
    va_end(arguments);
    if (handle != fake.handle) {
        return (int)syscall(SYS_ioctl, handle, request, argument);
    }
    fake.requests++;
    if (request == fake.failing && fake.after-- <= 0 && fake.times > 0) {
        fake.times--;
        return refuse(fake.error);
    }
    return answer(request, argument);
}

/* NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): the system's are reserved names */
int open(const char *path, int flags, ...)
{
    if (strcmp(path, "camera") != 0) {
        fake.handle = -1; /* its number is used again */
        return (int)syscall(SYS_openat, AT_FDCWD, path, flags, 0600);
    }
    assert_true((flags & O_NONBLOCK) && (flags & O_CLOEXEC));
    fake.handle = (int)syscall(SYS_memfd_create, "fake-camera", 0);
    assert_true(fake.handle >= 0);
    assert_int_equal(ftruncate(fake.handle, (off_t)64 * PAGE), 0);
    return fake.handle;
}

/* NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): the system's are reserved names */
int poll(struct pollfd *entries, nfds_t count, int timeout_ms)
{
    if (count == 0 || fake.handle < 0) {
        return (int)syscall(SYS_ppoll, entries, count,
                            &(struct timespec){timeout_ms / 1000, (long)(timeout_ms % 1000) * 1000000}, NULL,
                            0);
    }
    fake.polls++;
    entries[0].revents = POLLIN;
    if (fake.poll_error != 0) {
        return refuse(fake.poll_error);
    }
    if (fake.ready > 0 || fake.always_ready) {
        return 1;
    }
    nanosleep(&(struct timespec){timeout_ms / 1000, (long)(timeout_ms % 1000) * 1000000}, NULL);
    return 0;
}

#endif
