/* Pictures out of a descriptor's bytes, which have to come in time. */
#include "recording_parts.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

int64_t iris_recording_clock_us(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000;
}

static size_t append(char *text, size_t length, size_t capacity, const char *more)
{
    size_t bytes = strlen(more), room = capacity - 1 - length;
    bytes = bytes < room ? bytes : room;
    memcpy(text + length, more, bytes);
    text[length + bytes] = '\0';
    return length + bytes;
}

void iris_recording_say(iris_recording *device, const char *subject, const char *text)
{
    size_t length = 0;
    if (subject) {
        length = append(device->problem, length, sizeof device->problem, subject);
        length = append(device->problem, length, sizeof device->problem, ": ");
    }
    append(device->problem, length, sizeof device->problem, text);
}

const char *iris_recording_reason(int error)
{
    switch (error) {
    case ENOENT:
    case ENOTDIR:
        return "no such file or folder";
    case EACCES:
    case EPERM:
        return "no permission to read it";
    case EMFILE:
    case ENFILE:
        return "too many files are open";
    case ETIMEDOUT:
        return "the picture did not come to its end in time";
    default:
        return "cannot be read";
    }
}

int iris_recording_wait(iris_recording *device, int32_t timeout_ms)
{
    int64_t end_us = iris_recording_clock_us() + (int64_t)timeout_ms * 1000;
    struct pollfd input = {device->handle, POLLIN, 0};
    if (device->first < device->count || device->stream.ahead_count > 0) {
        return 1;
    }
    for (;;) {
        int64_t rest_us = end_us - iris_recording_clock_us();
        int ready = poll(&input, 1, rest_us > 0 ? (int)((rest_us + 999) / 1000) : 0);
        if (ready > 0 || (ready < 0 && errno != EINTR)) {
            return 1; /* what is wrong shows in reading */
        }
        if (rest_us <= 0) {
            return 0;
        }
    }
}

/* Of iris_source. */
static ptrdiff_t read_bytes(void *user, uint8_t *bytes, size_t wanted)
{
    iris_recording *device = user;
    while (device->first == device->count) {
        int64_t rest_ms = device->until_ms - iris_recording_clock_us() / 1000;
        if (!iris_recording_wait(device, rest_ms > 0 ? (int32_t)rest_ms : 0)) {
            device->stalled = 1;
            return -1;
        }
        ssize_t got = read(device->handle, device->buffer, sizeof device->buffer);
        if (got == 0 || (got < 0 && errno != EINTR && errno != EAGAIN)) {
            return got;
        }
        device->first = 0;
        device->count = got > 0 ? (size_t)got : 0;
    }
    size_t waiting = device->count - device->first, given = wanted < waiting ? wanted : waiting;
    memcpy(bytes, device->buffer + device->first, given);
    device->first += given;
    return (ptrdiff_t)given;
}

void iris_recording_rewind(iris_recording *device)
{
    device->first = device->count = 0;
    device->begun = 0;
    device->stalled = 0;
    (void)iris_stream_init(&device->stream, (iris_source){read_bytes, device});
}

void iris_recording_close_file(iris_recording *device)
{
    if (device->handle > STDIN_FILENO) {
        (void)close(device->handle);
    }
    device->handle = -1;
    device->begun = 0;
}

iris_status iris_recording_open_file(iris_recording *device)
{
    struct stat status;
    device->handle = openat(device->folder, device->last, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (device->handle < 0) {
        iris_recording_say(device, device->last, iris_recording_reason(errno));
        return IRIS_ERR_IO;
    }
    if (fstat(device->handle, &status) != 0 || !S_ISREG(status.st_mode)) {
        iris_recording_say(device, device->last, "not a file");
        iris_recording_close_file(device);
        return IRIS_ERR_IO;
    }
    iris_recording_rewind(device);
    return IRIS_OK;
}

/* Says what a status of reading means; hands it on. */
static iris_status judge(iris_recording *device, iris_status status)
{
    const char *text = iris_status_text(status);
    switch (status) {
    case IRIS_OK:
    case IRIS_ERR_END:
        return status;
    case IRIS_ERR_IO:
        text = iris_recording_reason(device->stalled ? ETIMEDOUT : EIO);
        break;
    case IRIS_ERR_TRUNCATED:
        text = "ends too early";
        break;
    case IRIS_ERR_DATA:
        text = device->begun ? "damaged, contradicts its own format" : "neither BMP nor PGM/PPM";
        break;
    case IRIS_ERR_UNSUPPORTED:
        text = "a kind of BMP or PNM that is not read";
        break;
    default:
        break;
    }
    iris_recording_say(device, device->folder >= 0 ? device->last : NULL, text);
    return status;
}

iris_status iris_recording_begin(iris_size *size, int *is_gray, iris_recording *device)
{
    device->until_ms = iris_recording_clock_us() / 1000 + IRIS_RECORDING_PICTURE_MS;
    iris_status status = iris_stream_kind(&device->kind, &device->stream);
    if (status == IRIS_OK) {
        device->begun = 1;
        status = device->kind == IRIS_PICTURE_BMP ? iris_bmp_begin(&device->bmp, &device->stream)
                                                  : iris_pnm_begin(&device->pnm, &device->stream);
    }
    if (status != IRIS_OK) {
        status = judge(device, status);
        device->begun = 0;
        return status;
    }
    int is_bmp = device->kind == IRIS_PICTURE_BMP;
    *size = (iris_size){is_bmp ? device->bmp.w : device->pnm.w, is_bmp ? device->bmp.h : device->pnm.h};
    *is_gray = is_bmp ? device->bmp.is_gray : device->pnm.is_gray;
    return IRIS_OK;
}

iris_status iris_recording_finish(const iris_image *image, iris_recording *device)
{
    iris_status status;
    device->until_ms = iris_recording_clock_us() / 1000 + IRIS_RECORDING_PICTURE_MS;
    if (device->kind == IRIS_PICTURE_BMP) {
        status = image ? iris_bmp_read(image, &device->bmp) : iris_bmp_finish(&device->bmp);
    } else {
        status = image ? iris_pnm_read(image, &device->pnm) : iris_pnm_finish(&device->pnm);
    }
    status = judge(device, status);
    device->begun = 0;
    return status;
}
