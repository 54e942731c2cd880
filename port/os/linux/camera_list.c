/* Cameras of the kernel, and what their drivers say of themselves. */
#include "iris/camera_list.h"
#include "video_device.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

enum {
    DEVICES = 256,    /* minor numbers of the kernel's video devices */
    ANSWERS_MAX = 512 /* the longest list that is read from a driver */
};

static iris_status count_status(int32_t count, int32_t capacity)
{
    return count > capacity ? IRIS_ERR_FULL : IRIS_OK;
}

/* Is there a camera at path? One that cannot be opened, but is there, is one with a problem. */
static int describe(iris_camera *camera, const char *path)
{
    struct v4l2_capability capability;
    uint32_t type;
    int handle;
    int error = video_open(&handle, &type, &capability, path);
    if (error == ENOENT || error == ENXIO || error == ENODEV ||
        video_open_status(error) == IRIS_ERR_UNSUPPORTED) {
        return 0;
    }
    memset(camera, 0, sizeof *camera);
    problem_text_copy(camera->path, sizeof camera->path, path, sizeof camera->path);
    if (error != 0) {
        camera->problem = video_open_text(error);
        return 1;
    }
    problem_text_copy(camera->card, sizeof camera->card, capability.card, sizeof capability.card);
    problem_text_copy(camera->driver, sizeof camera->driver, capability.driver, sizeof capability.driver);
    problem_text_copy(camera->bus, sizeof camera->bus, capability.bus_info, sizeof capability.bus_info);
    (void)close(handle);
    return 1;
}

iris_status iris_camera_list(iris_camera *cameras, int32_t *count, int32_t capacity)
{
    if (!count || capacity < 0 || (capacity > 0 && !cameras)) {
        return IRIS_ERR_ARG;
    }
    *count = 0;
    for (int i = 0; i < DEVICES; i++) {
        char path[32];
        iris_camera camera;
        problem_text text = problem_text_in(path, sizeof path);
        problem_text_add(&text, "/dev/video");
        problem_text_add_number(&text, i);
        if (describe(&camera, path)) {
            if (*count < capacity) {
                cameras[*count] = camera;
            }
            ++*count;
        }
    }
    return count_status(*count, capacity);
}

/* A list of the driver's has ended, or could not be read. */
static iris_status end_status(int error, int32_t count, int32_t capacity)
{
    if (error != 0 && error != EINVAL && error != ENOTTY) {
        return IRIS_ERR_IO;
    }
    return count_status(count, capacity);
}

iris_status iris_camera_list_formats(iris_camera_format *formats, int32_t *count, const char *path,
                                     int32_t capacity)
{
    if (!count || !path || capacity < 0 || (capacity > 0 && !formats)) {
        return IRIS_ERR_ARG;
    }
    struct v4l2_capability capability;
    uint32_t type;
    int handle;
    int error = video_open(&handle, &type, &capability, path);
    *count = 0;
    if (error != 0) {
        return video_open_status(error);
    }
    for (uint32_t i = 0; i < ANSWERS_MAX; i++) {
        struct v4l2_fmtdesc offer;
        memset(&offer, 0, sizeof offer);
        offer.index = i;
        offer.type = type;
        error = video_ask(handle, VIDIOC_ENUM_FMT, &offer);
        if (error != 0) {
            break;
        }
        if (*count < capacity) {
            iris_camera_format *format = &formats[*count];
            const video_format *found = video_format_find(offer.pixelformat);
            memset(format, 0, sizeof *format);
            video_fourcc_text(format->fourcc, offer.pixelformat);
            problem_text_copy(format->description, sizeof format->description, offer.description,
                              sizeof offer.description);
            format->format = found ? found->format : 0;
        }
        ++*count;
    }
    (void)close(handle);
    return end_status(error, *count, capacity);
}

static int32_t side(uint32_t pixels)
{
    return pixels <= INT32_MAX ? (int32_t)pixels : INT32_MAX;
}

iris_status iris_camera_list_sizes(iris_camera_sizes *sizes, int32_t *count, const char *path,
                                   const char *fourcc, int32_t capacity)
{
    if (!count || !path || !fourcc || capacity < 0 || (capacity > 0 && !sizes) ||
        !video_fourcc_parse(fourcc)) {
        return IRIS_ERR_ARG;
    }
    struct v4l2_capability capability;
    uint32_t type;
    int handle;
    int error = video_open(&handle, &type, &capability, path);
    *count = 0;
    if (error != 0) {
        return video_open_status(error);
    }
    for (uint32_t i = 0; i < ANSWERS_MAX; i++) {
        struct v4l2_frmsizeenum answer;
        memset(&answer, 0, sizeof answer);
        answer.index = i;
        answer.pixel_format = video_fourcc_parse(fourcc);
        error = video_ask(handle, VIDIOC_ENUM_FRAMESIZES, &answer);
        if (error != 0) {
            break;
        }
        const struct v4l2_frmsize_stepwise *all = &answer.stepwise;
        int single = answer.type == V4L2_FRMSIZE_TYPE_DISCRETE;
        if (*count < capacity && single) {
            iris_size size = {side(answer.discrete.width), side(answer.discrete.height)};
            sizes[*count] = (iris_camera_sizes){size, size, {0, 0}};
        } else if (*count < capacity) {
            sizes[*count] = (iris_camera_sizes){{side(all->min_width), side(all->min_height)},
                                                {side(all->max_width), side(all->max_height)},
                                                {side(all->step_width), side(all->step_height)}};
        }
        ++*count;
        if (!single) {
            break; /* one answer says all */
        }
    }
    (void)close(handle);
    return end_status(error, *count, capacity);
}

/* Of an interval between frames; 0 for none. */
static int32_t rate_of(struct v4l2_fract interval)
{
    if (interval.numerator == 0) {
        return 0;
    }
    uint64_t rate = ((uint64_t)interval.denominator * 1000u + interval.numerator / 2) / interval.numerator;
    return rate <= INT32_MAX ? (int32_t)rate : INT32_MAX;
}

iris_status iris_camera_list_rates(iris_camera_rates *rates, int32_t *count, const char *path,
                                   const char *fourcc, iris_size size, int32_t capacity)
{
    if (!count || !path || !fourcc || capacity < 0 || (capacity > 0 && !rates) ||
        !video_fourcc_parse(fourcc)) {
        return IRIS_ERR_ARG;
    }
    struct v4l2_capability capability;
    uint32_t type;
    int handle;
    int error = video_open(&handle, &type, &capability, path);
    *count = 0;
    if (error != 0) {
        return video_open_status(error);
    }
    for (uint32_t i = 0; i < ANSWERS_MAX; i++) {
        struct v4l2_frmivalenum answer;
        memset(&answer, 0, sizeof answer);
        answer.index = i;
        answer.pixel_format = video_fourcc_parse(fourcc);
        answer.width = (uint32_t)size.w;
        answer.height = (uint32_t)size.h;
        error = video_ask(handle, VIDIOC_ENUM_FRAMEINTERVALS, &answer);
        if (error != 0) {
            break;
        }
        int single = answer.type == V4L2_FRMIVAL_TYPE_DISCRETE;
        struct v4l2_fract longest = single ? answer.discrete : answer.stepwise.max;
        struct v4l2_fract shortest = single ? answer.discrete : answer.stepwise.min;
        if (*count < capacity) {
            rates[*count] = (iris_camera_rates){rate_of(longest), rate_of(shortest)};
        }
        ++*count;
        if (!single) {
            break;
        }
    }
    (void)close(handle);
    return end_status(error, *count, capacity);
}
