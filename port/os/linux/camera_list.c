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

/* A list that is read from a driver. */
typedef struct listing {
    void *entries; /* of the kind that ask fills */
    int32_t capacity;
    uint32_t type, fourcc;
    iris_size size;
    int is_whole; /* an answer said all that there is */

    /* Asks for answer i and, if there is room, makes it entry i. 0 or errno. */
    int (*ask)(struct listing *list, int handle, uint32_t i);
} listing;

static int has_room(const listing *list, uint32_t i)
{
    return i < (uint32_t)list->capacity;
}

static iris_status read_list(int32_t *count, const char *path, listing *list)
{
    struct v4l2_capability capability;
    int handle;
    int error = video_open(&handle, &list->type, &capability, path);
    *count = 0;
    if (error != 0) {
        return video_open_status(error);
    }
    while (*count < ANSWERS_MAX && !list->is_whole) {
        error = list->ask(list, handle, (uint32_t)*count);
        if (error != 0) {
            break;
        }
        ++*count;
    }
    (void)close(handle);
    return error != 0 && error != EINVAL && error != ENOTTY ? IRIS_ERR_IO
                                                            : count_status(*count, list->capacity);
}

static int ask_format(listing *list, int handle, uint32_t i)
{
    struct v4l2_fmtdesc offer;
    memset(&offer, 0, sizeof offer);
    offer.index = i;
    offer.type = list->type;
    int error = video_ask(handle, VIDIOC_ENUM_FMT, &offer);
    if (error == 0 && has_room(list, i)) {
        iris_camera_format *format = (iris_camera_format *)list->entries + i;
        const video_format *found = video_format_find(offer.pixelformat);
        memset(format, 0, sizeof *format);
        video_fourcc_text(format->fourcc, offer.pixelformat);
        problem_text_copy(format->description, sizeof format->description, offer.description,
                          sizeof offer.description);
        format->format = found ? found->format : 0;
    }
    return error;
}

iris_status iris_camera_list_formats(iris_camera_format *formats, int32_t *count, const char *path,
                                     int32_t capacity)
{
    listing list = {.entries = formats, .capacity = capacity, .ask = ask_format};
    if (!count || !path || capacity < 0 || (capacity > 0 && !formats)) {
        return IRIS_ERR_ARG;
    }
    return read_list(count, path, &list);
}

static int32_t side(uint32_t pixels)
{
    return pixels <= INT32_MAX ? (int32_t)pixels : INT32_MAX;
}

static int ask_sizes(listing *list, int handle, uint32_t i)
{
    struct v4l2_frmsizeenum answer;
    memset(&answer, 0, sizeof answer);
    answer.index = i;
    answer.pixel_format = list->fourcc;
    int error = video_ask(handle, VIDIOC_ENUM_FRAMESIZES, &answer);
    if (error != 0) {
        return error;
    }
    const struct v4l2_frmsize_stepwise *all = &answer.stepwise;
    iris_camera_sizes sizes = {{side(all->min_width), side(all->min_height)},
                               {side(all->max_width), side(all->max_height)},
                               {side(all->step_width), side(all->step_height)}};
    list->is_whole = answer.type != V4L2_FRMSIZE_TYPE_DISCRETE;
    if (!list->is_whole) {
        const iris_size single = {side(answer.discrete.width), side(answer.discrete.height)};
        sizes = (iris_camera_sizes){single, single, {0, 0}};
    }
    if (has_room(list, i)) {
        ((iris_camera_sizes *)list->entries)[i] = sizes;
    }
    return 0;
}

iris_status iris_camera_list_sizes(iris_camera_sizes *sizes, int32_t *count, const char *path,
                                   const char *fourcc, int32_t capacity)
{
    listing list = {.entries = sizes, .capacity = capacity, .ask = ask_sizes};
    list.fourcc = fourcc ? video_fourcc_parse(fourcc) : 0;
    if (!count || !path || !list.fourcc || capacity < 0 || (capacity > 0 && !sizes)) {
        return IRIS_ERR_ARG;
    }
    return read_list(count, path, &list);
}

static int ask_rates(listing *list, int handle, uint32_t i)
{
    struct v4l2_frmivalenum answer;
    memset(&answer, 0, sizeof answer);
    answer.index = i;
    answer.pixel_format = list->fourcc;
    answer.width = (uint32_t)list->size.w;
    answer.height = (uint32_t)list->size.h;
    int error = video_ask(handle, VIDIOC_ENUM_FRAMEINTERVALS, &answer);
    if (error != 0) {
        return error;
    }
    list->is_whole = answer.type != V4L2_FRMIVAL_TYPE_DISCRETE;
    if (has_room(list, i)) {
        ((iris_camera_rates *)list->entries)[i] =
            list->is_whole ? (iris_camera_rates){video_rate_millihz(answer.stepwise.max),
                                                 video_rate_millihz(answer.stepwise.min)}
                           : (iris_camera_rates){video_rate_millihz(answer.discrete),
                                                 video_rate_millihz(answer.discrete)};
    }
    return 0;
}

iris_status iris_camera_list_rates(iris_camera_rates *rates, int32_t *count, const char *path,
                                   const char *fourcc, iris_size size, int32_t capacity)
{
    listing list = {.entries = rates, .capacity = capacity, .size = size, .ask = ask_rates};
    list.fourcc = fourcc ? video_fourcc_parse(fourcc) : 0;
    if (!count || !path || !list.fourcc || capacity < 0 || (capacity > 0 && !rates)) {
        return IRIS_ERR_ARG;
    }
    return read_list(count, path, &list);
}
