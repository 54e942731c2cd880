/* Pictures that go into the kernel's virtual driver and come out of its camera: the output device of a loop. */
#ifndef VIDEO_SENDER_H
#define VIDEO_SENDER_H

#include <fcntl.h>
#include <linux/v4l2-dv-timings.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "test.h"

/* Controls of vivid. */
enum {
    VIVID = 0x00f0f000,
    VIVID_TEXT = VIVID + 1, /* 2: none */
    VIVID_COLORSPACE = VIVID + 19,
    VIVID_LOOP = VIVID + 37
};

enum { SENDER_PICTURES = 4 };

typedef struct {
    int handle, multi, planes;
    uint32_t type;
    uint8_t *memory[SENDER_PICTURES][2];
    size_t bytes[SENDER_PICTURES][2];
    int32_t stride[2];
} video_sender;

static inline void ask_video(int handle, unsigned long request, void *argument)
{
    int result;
    do {
        result = ioctl(handle, request, argument);
    } while (result < 0 && errno == EINTR);
    if (result != 0) {
        fail_msg("request %lx: %s", request, strerror(errno));
    }
}

static inline void set_video_control(int handle, uint32_t id, int32_t value)
{
    struct v4l2_control control = {id, value};
    ask_video(handle, VIDIOC_S_CTRL, &control);
}

/* 640x480 at 60 Hz, which both ends of the cable have to have. */
static inline void set_video_timings(int handle, int is_output)
{
    int first = 0;
    struct v4l2_dv_timings timings = V4L2_DV_BT_DMT_640X480P60;
    ask_video(handle, is_output ? VIDIOC_S_OUTPUT : VIDIOC_S_INPUT, &first);
    ask_video(handle, VIDIOC_S_DV_TIMINGS, &timings);
}

static inline void sender_describe(struct v4l2_buffer *buffer, struct v4l2_plane planes[2],
                                   const video_sender *sender, int index)
{
    memset(buffer, 0, sizeof *buffer);
    memset(planes, 0, 2 * sizeof *planes);
    buffer->type = sender->type;
    buffer->memory = V4L2_MEMORY_MMAP;
    buffer->index = (uint32_t)index;
    buffer->field = V4L2_FIELD_NONE;
    if (sender->multi) {
        buffer->m.planes = planes;
        buffer->length = (uint32_t)sender->planes;
    }
}

static inline void sender_queue(const video_sender *sender, int index)
{
    struct v4l2_buffer buffer;
    struct v4l2_plane planes[2];
    sender_describe(&buffer, planes, sender, index);
    buffer.bytesused = (uint32_t)sender->bytes[index][0];
    for (int i = 0; i < sender->planes; i++) {
        planes[i].bytesused = planes[i].length = (uint32_t)sender->bytes[index][i];
    }
    ask_video(sender->handle, VIDIOC_QBUF, &buffer);
}

static inline void sender_set_format(video_sender *sender, uint32_t fourcc, int w, int h)
{
    struct v4l2_format format;
    memset(&format, 0, sizeof format);
    format.type = sender->type;
    if (sender->multi) {
        format.fmt.pix_mp.width = (uint32_t)w;
        format.fmt.pix_mp.height = (uint32_t)h;
        format.fmt.pix_mp.pixelformat = fourcc;
        format.fmt.pix_mp.field = V4L2_FIELD_NONE;
        format.fmt.pix_mp.colorspace = V4L2_COLORSPACE_SRGB;
        ask_video(sender->handle, VIDIOC_S_FMT, &format);
        sender->planes = format.fmt.pix_mp.num_planes;
        sender->stride[0] = (int32_t)format.fmt.pix_mp.plane_fmt[0].bytesperline;
        sender->stride[1] = (int32_t)format.fmt.pix_mp.plane_fmt[1].bytesperline;
        assert_int_equal(format.fmt.pix_mp.pixelformat, fourcc);
    } else {
        format.fmt.pix.width = (uint32_t)w;
        format.fmt.pix.height = (uint32_t)h;
        format.fmt.pix.pixelformat = fourcc;
        format.fmt.pix.field = V4L2_FIELD_NONE;
        format.fmt.pix.colorspace = V4L2_COLORSPACE_SRGB;
        ask_video(sender->handle, VIDIOC_S_FMT, &format);
        sender->planes = 1;
        sender->stride[0] = (int32_t)format.fmt.pix.bytesperline;
        assert_int_equal(format.fmt.pix.pixelformat, fourcc);
    }
    assert_true(sender->planes <= 2);
}

/* Opens the output at path with buffers for SENDER_PICTURES pictures of that format, which the caller fills. */
static inline void sender_open(video_sender *sender, const char *path, uint32_t fourcc, int w, int h)
{
    struct v4l2_capability capability;
    memset(sender, 0, sizeof *sender);
    sender->handle = open(path, O_RDWR | O_NONBLOCK);
    assert_true(sender->handle >= 0);
    ask_video(sender->handle, VIDIOC_QUERYCAP, &capability);
    sender->multi = (capability.device_caps & V4L2_CAP_VIDEO_OUTPUT_MPLANE) != 0;
    sender->type = sender->multi ? V4L2_BUF_TYPE_VIDEO_OUTPUT_MPLANE : V4L2_BUF_TYPE_VIDEO_OUTPUT;
    set_video_timings(sender->handle, 1);
    sender_set_format(sender, fourcc, w, h);
    struct v4l2_requestbuffers request = {
        .count = SENDER_PICTURES, .type = sender->type, .memory = V4L2_MEMORY_MMAP};
    ask_video(sender->handle, VIDIOC_REQBUFS, &request);
    assert_int_equal(request.count, SENDER_PICTURES);
    for (int i = 0; i < SENDER_PICTURES; i++) {
        struct v4l2_buffer buffer;
        struct v4l2_plane planes[2];
        sender_describe(&buffer, planes, sender, i);
        ask_video(sender->handle, VIDIOC_QUERYBUF, &buffer);
        for (int k = 0; k < sender->planes; k++) {
            size_t bytes = sender->multi ? planes[k].length : buffer.length;
            off_t offset = sender->multi ? planes[k].m.mem_offset : buffer.m.offset;
            void *memory = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, sender->handle, offset);
            assert_true(memory != MAP_FAILED);
            sender->memory[i][k] = memory;
            sender->bytes[i][k] = bytes;
        }
    }
}

static inline void sender_start(const video_sender *sender)
{
    int type = (int)sender->type;
    for (int i = 0; i < SENDER_PICTURES; i++) {
        sender_queue(sender, i);
    }
    ask_video(sender->handle, VIDIOC_STREAMON, &type);
}

/* Sends again what has been shown. */
static inline void sender_go_on(const video_sender *sender)
{
    struct v4l2_buffer buffer;
    struct v4l2_plane planes[2];
    for (;;) {
        sender_describe(&buffer, planes, sender, 0);
        if (ioctl(sender->handle, VIDIOC_DQBUF, &buffer) != 0) {
            assert_int_equal(errno, EAGAIN);
            return;
        }
        sender_queue(sender, (int)buffer.index);
    }
}

static inline void sender_close(video_sender *sender)
{
    for (int i = 0; i < SENDER_PICTURES; i++) {
        for (int k = 0; k < sender->planes; k++) {
            munmap(sender->memory[i][k], sender->bytes[i][k]);
        }
    }
    close(sender->handle);
}

#endif
