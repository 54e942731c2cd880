/* Frames of a camera in memory that the driver and this program share. */
#include "v4l2_buffers.h"
#include "video_device.h"

#include <errno.h>
#include <poll.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>

/* Where the pixels are in the pieces of a buffer: the first byte, and the end. */
typedef struct {
    size_t first[2], end[2];
} extent;

iris_status v4l2_fail(iris_v4l2 *device, iris_status status, const char *what, int error)
{
    problem_text text = problem_text_in(device->problem, sizeof device->problem);
    problem_text_add(&text, what);
    if (error != 0) {
        problem_text_add(&text, ": ");
        problem_text_add(&text, video_error_text(error));
    }
    return status;
}

static int is_multi_plane(const iris_v4l2 *device)
{
    return device->type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE;
}

static void describe(struct v4l2_buffer *buffer, struct v4l2_plane planes[2], const iris_v4l2 *device,
                     int32_t index)
{
    memset(buffer, 0, sizeof *buffer);
    memset(planes, 0, 2 * sizeof *planes);
    buffer->type = device->type;
    buffer->memory = V4L2_MEMORY_MMAP;
    buffer->index = (uint32_t)index;
    if (is_multi_plane(device)) {
        buffer->m.planes = planes;
        buffer->length = (uint32_t)device->planes;
    }
}

/* Two pictures of NV12: the colors follow the luma, or have memory of their own. */
static iris_status view_nv12(iris_frame *frame, const iris_v4l2 *device, const iris_v4l2_memory *memory,
                             const extent *where)
{
    iris_size size = device->grant.size, half = {(size.w + 1) / 2, (size.h + 1) / 2};
    size_t first = where->first[1], end = where->end[1];
    if (device->planes == 1) {
        uint64_t luma = (uint64_t)device->grant.stride * (uint64_t)size.h;
        first = where->first[0];
        end = where->end[0];
        if (luma >= end - first) {
            return IRIS_ERR_RANGE;
        }
        first += (size_t)luma;
    }
    iris_status status =
        iris_image_wrap(&frame->image, (uint8_t *)memory[0].start + where->first[0],
                        where->end[0] - where->first[0], size, device->grant.stride, IRIS_GRAY8);
    if (status != IRIS_OK) {
        return status;
    }
    return iris_image_wrap(&frame->chroma, (uint8_t *)memory[device->planes - 1].start + first, end - first,
                           half, device->chroma_stride, IRIS_UV88);
}

/* Makes the views of a buffer; never beyond what is mapped. */
static iris_status view(iris_frame *frame, const iris_v4l2 *device, int32_t index, const extent *pixels)
{
    const iris_v4l2_memory *memory = device->memory[index];
    extent where = *pixels;
    for (int32_t i = 0; i < device->planes; i++) {
        if (where.end[i] > memory[i].bytes) {
            where.end[i] = memory[i].bytes;
        }
        if (where.first[i] >= where.end[i]) {
            return IRIS_ERR_RANGE;
        }
    }
    memset(&frame->chroma, 0, sizeof frame->chroma);
    if (device->grant.format == IRIS_CAPTURE_NV12) {
        return view_nv12(frame, device, memory, &where);
    }
    return iris_image_wrap(&frame->image, (uint8_t *)memory[0].start + where.first[0],
                           where.end[0] - where.first[0], device->grant.size, device->grant.stride,
                           (iris_format)device->grant.format);
}

/* Maps one buffer. 0, or errno. */
static int map_buffer(iris_v4l2 *device, int32_t index)
{
    struct v4l2_buffer buffer;
    struct v4l2_plane planes[2];
    describe(&buffer, planes, device, index);
    int error = video_ask(device->handle, VIDIOC_QUERYBUF, &buffer);
    if (error == 0 && is_multi_plane(device) && buffer.length != (uint32_t)device->planes) {
        error = EINVAL;
    }
    for (int32_t i = 0; i < device->planes && error == 0; i++) {
        size_t bytes = is_multi_plane(device) ? planes[i].length : buffer.length;
        uint32_t offset = is_multi_plane(device) ? planes[i].m.mem_offset : buffer.m.offset;
        void *start = mmap(NULL, bytes, PROT_READ, MAP_SHARED, device->handle, (off_t)offset);
        if (start == MAP_FAILED) {
            error = errno;
        } else {
            device->memory[index][i] = (iris_v4l2_memory){start, bytes};
        }
    }
    return error;
}

iris_status v4l2_map(iris_v4l2 *device, int32_t wanted)
{
    struct v4l2_requestbuffers request;
    memset(&request, 0, sizeof request);
    request.count = (uint32_t)wanted;
    request.type = device->type;
    request.memory = V4L2_MEMORY_MMAP;
    int error = video_ask(device->handle, VIDIOC_REQBUFS, &request);
    if (error != 0) {
        return v4l2_fail(device, IRIS_ERR_IO, "the driver has no buffers for it", error);
    }
    device->grant.buffers =
        request.count < IRIS_CAPTURE_BUFFERS_MAX ? (int32_t)request.count : IRIS_CAPTURE_BUFFERS_MAX;
    if (request.count < 2) {
        return v4l2_fail(device, IRIS_ERR_RANGE, "the driver has fewer than the two buffers that are needed",
                         0);
    }
    for (int32_t i = 0; i < device->grant.buffers; i++) {
        iris_frame frame;
        extent all = {{0, 0}, {SIZE_MAX, SIZE_MAX}};
        error = map_buffer(device, i);
        if (error != 0) {
            return v4l2_fail(device, IRIS_ERR_IO, "the buffers cannot be mapped", error);
        }
        if (view(&frame, device, i, &all) != IRIS_OK) {
            return v4l2_fail(device, IRIS_ERR_RANGE,
                             "the driver's buffers are too small for a picture, or odd", 0);
        }
    }
    return IRIS_OK;
}

void v4l2_release(iris_v4l2 *device)
{
    for (int32_t i = 0; i < IRIS_CAPTURE_BUFFERS_MAX; i++) {
        for (int32_t k = 0; k < 2; k++) {
            if (device->memory[i][k].start) {
                (void)munmap(device->memory[i][k].start, device->memory[i][k].bytes);
            }
        }
    }
    memset(device->memory, 0, sizeof device->memory);
    if (device->grant.buffers == 0) {
        return; /* they may be another program's */
    }
    struct v4l2_requestbuffers request;
    memset(&request, 0, sizeof request);
    request.type = device->type;
    request.memory = V4L2_MEMORY_MMAP;
    (void)video_ask(device->handle, VIDIOC_REQBUFS, &request);
    device->grant.buffers = 0;
}

/* Lets the driver have a buffer that nobody has. 0, or errno: nobody has it then. */
static int queue(iris_v4l2 *device, int32_t index)
{
    struct v4l2_buffer buffer;
    struct v4l2_plane planes[2];
    describe(&buffer, planes, device, index);
    int error = video_ask(device->handle, VIDIOC_QBUF, &buffer);
    if (error == 0) {
        device->queued |= 1u << index;
    }
    return error;
}

static int is_final(int error)
{
    return error == EIO || error == ENODEV;
}

/* The driver gets every buffer that nobody has. */
static iris_status queue_rest(iris_v4l2 *device)
{
    int error = 0;
    for (int32_t i = 0; i < device->grant.buffers; i++) {
        if (!((device->queued | device->borrowed) >> i & 1u)) {
            int failed = queue(device, i);
            error = failed ? failed : error;
            if (is_final(failed)) {
                break;
            }
        }
    }
    if (device->queued == 0 || is_final(error)) {
        return v4l2_fail(device, IRIS_ERR_IO, "the driver takes no buffer", error);
    }
    return IRIS_OK;
}

iris_status v4l2_start(void *state)
{
    iris_v4l2 *device = state;
    int type = (int)device->type;
    iris_status status = queue_rest(device);
    if (status == IRIS_OK) {
        int error = video_ask(device->handle, VIDIOC_STREAMON, &type);
        if (error != 0) {
            status = v4l2_fail(device, IRIS_ERR_IO, "the stream does not start", error);
        }
    }
    device->streaming = 1; /* or halfway: stop takes the buffers back */
    if (status != IRIS_OK) {
        v4l2_stop(device);
    }
    return status;
}

void v4l2_stop(void *state)
{
    iris_v4l2 *device = state;
    int type = (int)device->type;
    if (device->streaming) {
        (void)video_ask(device->handle, VIDIOC_STREAMOFF, &type);
    }
    device->streaming = 0;
    device->queued = 0;
}

static int64_t clock_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

/* IRIS_ERR_TIMEOUT: no frame waits. */
static iris_status dequeue(iris_v4l2 *device, iris_frame *frame)
{
    struct v4l2_buffer buffer;
    struct v4l2_plane planes[2];
    describe(&buffer, planes, device, 0);
    int error = video_ask(device->handle, VIDIOC_DQBUF, &buffer);
    if (error == EAGAIN) {
        return IRIS_ERR_TIMEOUT;
    }
    if (error != 0) {
        return v4l2_fail(device, IRIS_ERR_IO, "the stream broke", error);
    }
    if (buffer.index >= (uint32_t)device->grant.buffers || !(device->queued >> buffer.index & 1u)) {
        return v4l2_fail(device, IRIS_ERR_IO, "the driver handed over a buffer that it does not have", 0);
    }
    extent pixels = {{0, 0}, {buffer.bytesused, 0}};
    for (int32_t i = 0; i < device->planes && is_multi_plane(device); i++) {
        pixels.first[i] = planes[i].data_offset;
        pixels.end[i] = planes[i].bytesused;
    }
    frame->buffer = (int32_t)buffer.index;
    frame->sequence = buffer.sequence;
    frame->time_us =
        (int64_t)((uint64_t)buffer.timestamp.tv_sec * 1000000u + (uint64_t)buffer.timestamp.tv_usec);
    device->queued &= ~(1u << buffer.index);
    if (buffer.flags & V4L2_BUF_FLAG_ERROR || view(frame, device, frame->buffer, &pixels) != IRIS_OK) {
        (void)queue(device, frame->buffer); /* or the next call does */
        return IRIS_ERR_DATA;
    }
    device->borrowed |= 1u << buffer.index;
    return IRIS_OK;
}

/* Waits until something may have come. IRIS_ERR_IO: nothing will. */
static iris_status wait_for_frame(iris_v4l2 *device, int64_t rest_ms)
{
    struct pollfd entry = {device->handle, POLLIN, 0};
    int count = poll(&entry, 1, (int)rest_ms);
    if (count < 0 && errno != EINTR && errno != EAGAIN) {
        return v4l2_fail(device, IRIS_ERR_IO, "waiting for a frame", errno);
    }
    if (count > 0 && entry.revents & (POLLERR | POLLHUP | POLLNVAL)) {
        return v4l2_fail(device, IRIS_ERR_IO, "the stream broke", entry.revents & POLLHUP ? ENODEV : EIO);
    }
    return IRIS_OK;
}

iris_status v4l2_take(void *state, iris_frame *frame, int32_t timeout_ms)
{
    iris_v4l2 *device = state;
    int64_t end_ms = clock_ms() + timeout_ms;
    iris_status waited = IRIS_OK;
    for (int turns = 0;; turns++) {
        iris_status status = queue_rest(device);
        if (status == IRIS_OK) {
            status = dequeue(device, frame);
        }
        int64_t rest_ms = end_ms - clock_ms();
        if (status != IRIS_ERR_TIMEOUT || waited != IRIS_OK || rest_ms <= 0) {
            return status == IRIS_ERR_TIMEOUT ? (waited == IRIS_OK ? IRIS_ERR_TIMEOUT : waited) : status;
        }
        if (turns > 1) { /* a driver that says there is a frame, and has none */
            (void)poll(NULL, 0, 1);
        }
        waited = wait_for_frame(device, rest_ms);
    }
}

iris_status v4l2_give(void *state, int32_t index)
{
    iris_v4l2 *device = state;
    device->borrowed &= ~(1u << index);
    int error = queue(device, index); /* the next call tries again */
    return is_final(error) ? v4l2_fail(device, IRIS_ERR_IO, "the stream broke", error) : IRIS_OK;
}
