/* Recordings as a source of frames: when each is due, and what becomes of pictures that are no frames. */
#include "iris/recording.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "recording_parts.h"

static iris_format format_of(int32_t wanted, int is_gray)
{
    return wanted ? (iris_format)wanted : is_gray ? IRIS_GRAY8 : IRIS_RGB888;
}

/* Finds what kind of thing the path is; device->folder or device->handle is open then. */
static iris_status open_path(iris_recording *device, const char *path)
{
    struct stat status;
    if (strcmp(path, "-") == 0) {
        device->handle = STDIN_FILENO;
        return IRIS_OK;
    }
    int handle = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (handle < 0 || fstat(handle, &status) != 0) {
        iris_recording_say(device, NULL, iris_recording_reason(errno));
        if (handle >= 0) {
            (void)close(handle);
        }
        return IRIS_ERR_IO;
    }
    if (S_ISDIR(status.st_mode)) {
        device->folder = handle;
        return IRIS_OK;
    }
    if (!S_ISREG(status.st_mode)) {
        iris_recording_say(device, NULL, "neither a file nor a folder; a pipe goes to standard input");
        (void)close(handle);
        return IRIS_ERR_UNSUPPORTED;
    }
    device->handle = handle;
    return IRIS_OK;
}

/* The size of the first picture of the folder that has one. */
static iris_status look_into_folder(iris_size *size, int *is_gray, iris_recording *device)
{
    iris_status status = IRIS_ERR_END;
    iris_recording_first_name(device);
    int32_t left = iris_recording_names_left(device, 1);
    if (left == 0) {
        iris_recording_say(device, NULL, "no .bmp, .pgm, .ppm, or .pnm file in this folder");
    }
    for (; left > 0 && status != IRIS_OK; left = iris_recording_names_left(device, 1)) {
        iris_recording_next_name(device);
        if (iris_recording_open_file(device) == IRIS_OK) {
            status = iris_recording_begin(size, is_gray, device);
            if (status == IRIS_ERR_END) {
                iris_recording_say(device, device->last, "is empty");
            }
            iris_recording_close_file(device);
        }
    }
    iris_recording_first_name(device);
    return status == IRIS_OK ? IRIS_OK : IRIS_ERR_IO;
}

/* The size of the first picture, which has begun then. */
static iris_status look_into_stream(iris_size *size, int *is_gray, iris_recording *device)
{
    iris_recording_rewind(device);
    if (!iris_recording_wait(device, IRIS_RECORDING_FIRST_MS)) {
        iris_recording_say(device, NULL, "no picture came");
        return IRIS_ERR_IO;
    }
    iris_status status = iris_recording_begin(size, is_gray, device);
    if (status == IRIS_ERR_END) {
        iris_recording_say(device, NULL, "is empty");
    }
    return status == IRIS_OK || status == IRIS_ERR_UNSUPPORTED || status == IRIS_ERR_RANGE ? status
                                                                                           : IRIS_ERR_IO;
}

static void say_memory(iris_recording *device, uint64_t bytes)
{
    char digits[24];
    int at = (int)sizeof digits - 1;
    digits[at] = '\0';
    for (; bytes > 0; bytes /= 10) {
        digits[--at] = (char)('0' + (int)(bytes % 10));
    }
    iris_recording_say(device, "bytes that the memory for a frame must have", digits + at);
}

static void recording_close(void *user)
{
    iris_recording *device = user;
    iris_recording_close_file(device);
    if (device->folder >= 0) {
        (void)close(device->folder);
        device->folder = -1;
    }
}

static iris_status recording_open(void *user, iris_capture_grant *grant, const char *path,
                                  const iris_capture_config *wanted)
{
    iris_recording *device = user;
    int is_gray = 0;
    device->folder = device->handle = -1;
    device->begun = device->held = device->borrowed = 0;
    device->index = 0;
    device->over = IRIS_OK;
    device->problem[0] = '\0';
    if (wanted->format != 0 && wanted->format != IRIS_GRAY8 && wanted->format != IRIS_RGB888 &&
        wanted->format != IRIS_BGR888) {
        iris_recording_say(device, NULL, "a recording gives GRAY8, RGB888, or BGR888");
        return IRIS_ERR_FORMAT;
    }
    iris_status status = open_path(device, path);
    if (status != IRIS_OK) {
        return status;
    }
    status = device->folder >= 0 ? look_into_folder(&device->size, &is_gray, device)
                                 : look_into_stream(&device->size, &is_gray, device);
    device->format = format_of(wanted->format, is_gray);
    size_t row = status == IRIS_OK ? iris_format_row_bytes(device->format, device->size.w) : 0;
    if (status == IRIS_OK && (!device->memory || device->bytes / row < (size_t)device->size.h)) {
        say_memory(device, (uint64_t)row * (uint64_t)device->size.h);
        status = IRIS_ERR_SCRATCH;
    }
    if (status != IRIS_OK) {
        recording_close(device);
        return status;
    }
    device->rate_millihz = wanted->rate_millihz;
    device->policy = wanted->policy;
    *grant = (iris_capture_grant){.size = device->size,
                                  .format = (int32_t)device->format,
                                  .stride = (int32_t)row,
                                  .rate_millihz = wanted->rate_millihz,
                                  .buffers = 2,
                                  .range = IRIS_RANGE_FULL};
    return IRIS_OK;
}

static iris_status recording_start(void *user)
{
    iris_recording *device = user;
    device->start_us = iris_recording_clock_us();
    return IRIS_OK;
}

/* n * to / from, rounded down, also where n * to has more than 64 bits. */
static int64_t scale(int64_t n, int64_t to, int64_t from)
{
    return n / from * to + n % from * to / from;
}

static int64_t due_us(const iris_recording *device, int64_t index)
{
    return device->start_us + scale(index, 1000000000, device->rate_millihz);
}

/* The newest frame that is due by now; the one that comes next, where frames are not to be left out. */
static int64_t newest_due(const iris_recording *device)
{
    if (device->rate_millihz == 0 || device->policy != IRIS_CAPTURE_LATEST) {
        return device->index;
    }
    return scale(iris_recording_clock_us() - device->start_us, device->rate_millihz, 1000000000);
}

/* The picture that has begun, or its place, has gone by without a frame. */
static iris_status pass_over(iris_recording *device)
{
    device->index++;
    return IRIS_ERR_DATA;
}

/* Reads the picture that has begun into memory. IRIS_ERR_DATA: it has another size; else why it cannot be read. */
static iris_status hold(iris_recording *device, iris_size size)
{
    iris_image image;
    if (size.w != device->size.w || size.h != device->size.h) {
        iris_status status = device->folder >= 0 ? IRIS_OK : iris_recording_finish(NULL, device);
        if (status == IRIS_OK) {
            iris_recording_say(device, device->folder >= 0 ? device->last : NULL,
                               "another size than the first picture");
        }
        return status == IRIS_OK ? IRIS_ERR_DATA : IRIS_ERR_TRUNCATED;
    }
    (void)iris_image_wrap(&image, device->memory, device->bytes, device->size, 0, device->format);
    device->held = 0;
    iris_status status = iris_recording_finish(&image, device);
    device->held = status == IRIS_OK;
    return status == IRIS_OK ? IRIS_OK : IRIS_ERR_TRUNCATED;
}

/* Brings the next picture of a folder into memory. IRIS_ERR_DATA: it is none. */
static iris_status fetch_named(iris_recording *device)
{
    iris_size size;
    int is_gray;
    int64_t newest = newest_due(device);
    while (device->index < newest && iris_recording_names_left(device, 2) >= 2 - device->held) {
        if (!device->held) {
            iris_recording_next_name(device);
        }
        device->held = 0;
        device->index++;
    }
    if (device->held) {
        return IRIS_OK;
    }
    int32_t left = iris_recording_names_left(device, 1);
    if (left < 1) {
        device->over = left == 0 ? IRIS_ERR_END : IRIS_ERR_TRUNCATED;
        return device->over;
    }
    iris_recording_next_name(device);
    if (iris_recording_open_file(device) != IRIS_OK) {
        return pass_over(device);
    }
    iris_status status = iris_recording_begin(&size, &is_gray, device);
    if (status == IRIS_OK) {
        status = hold(device, size);
    } else if (status == IRIS_ERR_END) {
        iris_recording_say(device, device->last, "is empty");
    }
    iris_recording_close_file(device);
    return status == IRIS_OK ? IRIS_OK : pass_over(device);
}

/* Sees to it that a picture has begun. IRIS_ERR_TIMEOUT, or why there is none. */
static iris_status begin_next(iris_size *size, iris_recording *device, int32_t timeout_ms)
{
    int is_gray;
    if (device->begun) {
        *size = device->kind == IRIS_PICTURE_BMP ? (iris_size){device->bmp.w, device->bmp.h}
                                                 : (iris_size){device->pnm.w, device->pnm.h};
        return IRIS_OK;
    }
    int had_to_wait = !iris_recording_wait(device, 0);
    if (had_to_wait && !iris_recording_wait(device, timeout_ms)) {
        return IRIS_ERR_TIMEOUT;
    }
    if (had_to_wait && device->rate_millihz > 0) {
        int64_t late_us = iris_recording_clock_us() - due_us(device, device->index + device->held);
        device->start_us += late_us > 0 ? late_us : 0;
    }
    iris_status status = iris_recording_begin(size, &is_gray, device);
    if (status != IRIS_OK) {
        device->over = status == IRIS_ERR_END ? IRIS_ERR_END : IRIS_ERR_TRUNCATED;
        return device->over;
    }
    return IRIS_OK;
}

/* Brings the next picture of a file or of standard input into memory, over those that it has overtaken.
 * IRIS_ERR_DATA: it is no frame. */
static iris_status fetch_streamed(iris_recording *device, int32_t timeout_ms)
{
    iris_size size;
    int64_t newest = newest_due(device);
    while (!device->held || device->index < newest) {
        iris_status status = begin_next(&size, device, device->held ? 0 : timeout_ms);
        if (status != IRIS_OK) {
            return device->held ? IRIS_OK : status;
        }
        device->index += device->held;
        status = hold(device, size);
        if (status == IRIS_ERR_TRUNCATED) {
            device->over = status;
            return status;
        }
        if (status == IRIS_ERR_DATA) {
            device->held = 0;
            return pass_over(device);
        }
    }
    return IRIS_OK;
}

/* Waits until the frame is due. 0: it will not be before the end of the wait, which is over now. */
static int wait_until_due(const iris_recording *device, int64_t end_us)
{
    int64_t due = device->rate_millihz > 0 ? due_us(device, device->index) : 0;
    int64_t until_us = due < end_us ? due : end_us;
    const struct timespec until = {(time_t)(until_us / 1000000), (long)(until_us % 1000000) * 1000};
    while (iris_recording_clock_us() < until_us) {
        (void)clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, NULL);
    }
    return due <= iris_recording_clock_us();
}

static iris_status recording_take(void *user, iris_frame *frame, int32_t timeout_ms)
{
    iris_recording *device = user;
    int64_t end_us = iris_recording_clock_us() + (int64_t)timeout_ms * 1000;
    if (device->borrowed) {
        return IRIS_ERR_TIMEOUT;
    }
    if (device->over != IRIS_OK && !device->held) {
        return device->over;
    }
    frame->sequence = (uint64_t)device->index;
    if (device->over == IRIS_OK) {
        iris_status status = device->folder >= 0 ? fetch_named(device) : fetch_streamed(device, timeout_ms);
        if (status != IRIS_OK) {
            frame->sequence = (uint64_t)(device->index - (status == IRIS_ERR_DATA));
            return status;
        }
    }
    if (!wait_until_due(device, end_us)) {
        return IRIS_ERR_TIMEOUT;
    }
    memset(frame, 0, sizeof *frame);
    (void)iris_image_wrap(&frame->image, device->memory, device->bytes, device->size, 0, device->format);
    frame->sequence = (uint64_t)device->index;
    frame->time_us = device->rate_millihz > 0 ? due_us(device, device->index) : iris_recording_clock_us();
    device->held = 0;
    device->borrowed = 1;
    device->index++;
    return IRIS_OK;
}

static iris_status recording_give(void *user, int32_t buffer)
{
    iris_recording *device = user;
    (void)buffer;
    device->borrowed = 0;
    return IRIS_OK;
}

static void recording_stop(void *user)
{
    (void)user;
}

static const char *recording_problem(const void *user)
{
    const iris_recording *device = user;
    return device->problem;
}

iris_capture_source iris_recording_source(iris_recording *device)
{
    static const iris_capture_driver driver = {recording_open,   recording_start, recording_take,
                                               recording_give,   recording_stop,  recording_close,
                                               recording_problem};
    return (iris_capture_source){&driver, device};
}
