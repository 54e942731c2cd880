/* What all sources of frames share: counting, the policy, and getting over a source that breaks or goes away. */
#include "iris/capture.h"

#include <poll.h>
#include <string.h>
#include <time.h>

enum {
    CLOSED = 0,
    RUNNING,
    AWAY,  /* closed, to be opened again */
    BROKEN /* stopped, not closed yet: frames are borrowed */
};

static int64_t clock_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static void wait_until(int64_t until_ms)
{
    int64_t rest_ms = until_ms - clock_ms();
    if (rest_ms > 0) {
        (void)poll(NULL, 0, (int)rest_ms);
    }
}

static int in_range(int32_t value, int32_t low, int32_t high)
{
    return value == 0 || (value >= low && value <= high);
}

/* Fills *config with what is wanted, without zeros where a default is known. 0: a value is outside its range. */
static int complete(iris_capture_config *config, const iris_capture_config *wanted)
{
    if (wanted) {
        *config = *wanted;
    } else {
        memset(config, 0, sizeof *config);
    }
    if ((config->size.w == 0) != (config->size.h == 0) || !in_range(config->size.w, 1, IRIS_SIDE_MAX) ||
        !in_range(config->size.h, 1, IRIS_SIDE_MAX) || !in_range(config->rate_millihz, 1, 1000000) ||
        !in_range(config->stride, 1, INT32_MAX) || !in_range(config->buffers, 2, IRIS_CAPTURE_BUFFERS_MAX) ||
        !in_range(config->reconnect_ms, 1, 60000) ||
        (config->policy != IRIS_CAPTURE_EVERY && config->policy != IRIS_CAPTURE_LATEST) ||
        !(config->format == IRIS_CAPTURE_NV12 || in_range(config->format, IRIS_GRAY8, IRIS_HSL48))) {
        return 0;
    }
    config->buffers = config->buffers ? config->buffers : 4;
    config->reconnect_ms = config->reconnect_ms ? config->reconnect_ms : 250;
    return 1;
}

/* Opens the device, and starts it. */
static iris_status set_going(iris_capture *capture, iris_capture_grant *grant)
{
    const iris_capture_driver *driver = capture->source.driver;
    void *device = capture->source.device;
    memset(grant, 0, sizeof *grant);
    iris_status status = driver->open(device, grant, capture->path, &capture->config);
    capture->tried_ms =
        clock_ms(); /* after what may have taken long: the others on its bus shall have their time */
    if (status != IRIS_OK) {
        return status;
    }
    status = driver->start(device);
    if (status != IRIS_OK) {
        driver->close(device);
        return status;
    }
    capture->state = RUNNING;
    capture->restarted = 0;
    capture->counting = 0;
    return IRIS_OK;
}

iris_status iris_capture_open(iris_capture *capture, iris_capture_source source, const char *path,
                              const iris_capture_config *config)
{
    if (!capture || !source.driver || !source.device || !path) {
        return IRIS_ERR_ARG;
    }
    memset(capture, 0, sizeof *capture);
    capture->source = source;
    capture->path = path;
    if (!complete(&capture->config, config)) {
        return IRIS_ERR_ARG;
    }
    iris_status status = set_going(capture, &capture->granted);
    if (status ==
        IRIS_OK) { /* what a source that returns has to be again, whatever it was set to meanwhile */
        capture->config.size = capture->granted.size;
        capture->config.format = capture->granted.format;
    }
    return status;
}

/* The stream is over for now: closes the device as soon as no frame is borrowed. */
static void lose(iris_capture *capture)
{
    capture->tried_ms = clock_ms();
    capture->state = BROKEN;
    if (capture->borrowed == 0) {
        capture->source.driver->close(capture->source.device);
        capture->state = AWAY;
    }
}

/* The stream broke: stops it and starts it again, or loses the source. */
static iris_status restart(iris_capture *capture)
{
    capture->source.driver->stop(capture->source.device);
    if (capture->source.driver->start(capture->source.device) != IRIS_OK) {
        lose(capture);
        return IRIS_ERR_IO;
    }
    capture->restarts++;
    capture->restarted = 1;
    capture->counting = 0;
    return IRIS_OK;
}

static int same_pictures(const iris_capture_grant *a, const iris_capture_grant *b)
{
    return a->size.w == b->size.w && a->size.h == b->size.h && a->format == b->format &&
           a->stride == b->stride;
}

/* Tries to open a lost source, when it is time for that before the end of the wait. */
static iris_status come_back(iris_capture *capture, int64_t end_ms)
{
    int64_t due_ms = capture->tried_ms + capture->config.reconnect_ms;
    if (capture->state != AWAY || due_ms > end_ms) {
        wait_until(end_ms);
        return IRIS_ERR_IO;
    }
    wait_until(due_ms);
    iris_capture_grant grant;
    capture->changed = 0;
    if (set_going(capture, &grant) != IRIS_OK) {
        return IRIS_ERR_IO;
    }
    capture->changed = !same_pictures(&grant, &capture->granted);
    if (capture->changed) {
        capture->source.driver->stop(capture->source.device);
        lose(capture);
        return IRIS_ERR_IO;
    }
    capture->granted = grant;
    capture->returns++;
    return IRIS_OK;
}

/* Counts a frame that the source delivered, and what is missing before it; its sequence becomes ours. */
static void count(iris_capture *capture, iris_frame *frame)
{
    uint32_t sequence = (uint32_t)frame->sequence, lost = sequence - capture->last_sequence - 1;
    if (capture->counting && lost < 0x80000000u) { /* a count that runs backwards tells nothing */
        capture->dropped += lost;
        capture->sequence += lost;
    }
    capture->counting = 1;
    capture->last_sequence = sequence;
    frame->sequence = capture->sequence++;
}

/* Replaces the frame by the newest of those that wait behind it. */
static void overtake(iris_frame *frame, iris_capture *capture)
{
    const iris_capture_driver *driver = capture->source.driver;
    void *device = capture->source.device;
    for (int i = 0; i < IRIS_CAPTURE_BUFFERS_MAX; i++) {
        iris_frame newer;
        iris_status status = driver->take(device, &newer, 0);
        if (status != IRIS_OK && status != IRIS_ERR_DATA) {
            return; /* what is wrong will be met by the next call, too */
        }
        count(capture, &newer);
        if (status == IRIS_ERR_DATA) {
            capture->damaged++;
            continue;
        }
        (void)driver->give(device, frame->buffer);
        capture->skipped++;
        *frame = newer;
    }
}

/* Waits for a good frame on a stream that runs. It may be started again, but only once before a frame comes. */
static iris_status receive(iris_frame *frame, iris_capture *capture, int64_t end_ms)
{
    const iris_capture_driver *driver = capture->source.driver;
    for (int64_t rest_ms = end_ms - clock_ms();; rest_ms = end_ms - clock_ms()) {
        iris_status status = driver->take(capture->source.device, frame, rest_ms > 0 ? (int32_t)rest_ms : 0);
        if (status == IRIS_OK) {
            capture->restarted = 0;
            count(capture, frame);
            return IRIS_OK;
        }
        if (status == IRIS_ERR_DATA) {
            count(capture, frame);
            capture->damaged++;
        } else if (status != IRIS_ERR_IO) {
            return status;
        } else if (capture->restarted) {
            driver->stop(capture->source.device);
            lose(capture);
            return IRIS_ERR_IO;
        } else if (restart(capture) != IRIS_OK) {
            return IRIS_ERR_IO;
        }
        if (rest_ms <= 0) {
            return IRIS_ERR_TIMEOUT;
        }
    }
}

static int32_t count_bits(uint32_t bits)
{
    int32_t bit_count = 0;
    for (; bits != 0; bits &= bits - 1) {
        bit_count++;
    }
    return bit_count;
}

iris_status iris_capture_next(iris_frame *frame, iris_capture *capture, int32_t timeout_ms)
{
    if (!frame || !capture || capture->state == CLOSED || timeout_ms < 0) {
        return IRIS_ERR_ARG;
    }
    int64_t end_ms = clock_ms() + timeout_ms;
    if (capture->state != RUNNING && come_back(capture, end_ms) != IRIS_OK) {
        return IRIS_ERR_IO;
    }
    if (count_bits(capture->borrowed) >= capture->granted.buffers - 1) {
        return IRIS_ERR_FULL;
    }
    iris_frame next;
    iris_status status = receive(&next, capture, end_ms);
    if (status != IRIS_OK) {
        return status;
    }
    if (capture->config.policy == IRIS_CAPTURE_LATEST) {
        overtake(&next, capture);
    }
    capture->borrowed |= 1u << next.buffer;
    capture->frames++;
    *frame = next;
    return IRIS_OK;
}

iris_status iris_capture_give(iris_capture *capture, const iris_frame *frame)
{
    if (!capture || !frame || frame->buffer < 0 || frame->buffer >= IRIS_CAPTURE_BUFFERS_MAX ||
        !(capture->borrowed >> frame->buffer & 1u)) {
        return IRIS_ERR_ARG;
    }
    capture->borrowed &= ~(1u << frame->buffer);
    if (capture->state == RUNNING) {
        return capture->source.driver->give(capture->source.device, frame->buffer);
    }
    if (capture->borrowed == 0) {
        lose(capture);
    }
    return IRIS_ERR_IO;
}

void iris_capture_close(iris_capture *capture)
{
    if (!capture || capture->state == CLOSED) {
        return;
    }
    if (capture->state == RUNNING) {
        capture->source.driver->stop(capture->source.device);
    }
    if (capture->state != AWAY) {
        capture->source.driver->close(capture->source.device);
    }
    capture->state = CLOSED;
    capture->borrowed = 0;
}

int iris_capture_is_running(const iris_capture *capture)
{
    return capture && capture->state == RUNNING;
}

const char *iris_capture_problem(const iris_capture *capture)
{
    if (capture && capture->changed) {
        return "the source came back with another size or format than it had";
    }
    return capture && capture->source.driver ? capture->source.driver->problem(capture->source.device)
                                             : "not opened";
}
