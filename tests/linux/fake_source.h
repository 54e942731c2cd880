/* A source of frames that fails when it is told to, and watches how it is used. */
#ifndef FAKE_SOURCE_H
#define FAKE_SOURCE_H

#include <time.h>

#include "iris/capture.h"
#include "test.h"

enum { BUFFERS = 4, NEVER = 1 << 30 };

typedef struct {
    int is_open, runs;
    uint32_t borrowed;
    int opens, starts, closes, gives;
    iris_capture_config wanted;
    iris_capture_grant grant; /* what it offers; size 0x0: what is wanted */

    uint32_t sequence; /* of its next frame */
    int waiting;       /* frames that are there */
    int damaged;       /* of them the next so many are bad */
    int broken;        /* take fails until a restart, or for good: 2 */
    int missing;       /* open fails so many times */
    int step, fail_at; /* the calls that may fail, counted, and the first that does */
    int fail_times;    /* so many in a row */
    iris_status fail_status;
    int64_t opened_ms[64];
} fake_source;

static fake_source fake;
static uint8_t pixels[BUFFERS][8 * 4];

static int64_t now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static int fails(void)
{
    int at = fake.step++;
    return at >= fake.fail_at && at < fake.fail_at + fake.fail_times;
}

static iris_status fake_open(void *device, iris_capture_grant *grant, const char *path,
                             const iris_capture_config *wanted)
{
    assert_ptr_equal(device, &fake);
    assert_string_equal(path, "somewhere");
    assert_false(fake.is_open);
    fake.opened_ms[fake.opens++ % 64] = now_ms();
    fake.wanted = *wanted;
    if (fails()) {
        return fake.fail_status;
    }
    if (fake.missing > 0) {
        fake.missing--;
        return IRIS_ERR_IO;
    }
    *grant = fake.grant;
    if (wanted->size.w) {
        grant->size = wanted->size;
    }
    fake.is_open = 1;
    fake.borrowed = 0;
    return IRIS_OK;
}

static iris_status fake_start(void *device)
{
    assert_ptr_equal(device, &fake);
    assert_true(fake.is_open && !fake.runs);
    fake.starts++;
    if (fails()) {
        return fake.fail_status;
    }
    fake.runs = 1;
    fake.sequence = 0;
    fake.broken = fake.broken == 2 ? 2 : 0;
    return IRIS_OK;
}

static void nap(int32_t ms)
{
    nanosleep(&(struct timespec){ms / 1000, (long)(ms % 1000) * 1000000}, NULL);
}

static iris_status fake_take(void *device, iris_frame *frame, int32_t timeout_ms)
{
    assert_ptr_equal(device, &fake);
    assert_true(fake.is_open && fake.runs && timeout_ms >= 0);
    if (fake.broken) {
        return IRIS_ERR_IO;
    }
    int failed = fails();
    if (failed && fake.fail_status != IRIS_ERR_DATA) {
        return fake.fail_status;
    }
    if (fake.waiting == 0) {
        nap(timeout_ms);
        return IRIS_ERR_TIMEOUT;
    }
    fake.waiting--;
    memset(frame, 0, sizeof *frame);
    frame->sequence = fake.sequence++;
    if (failed || fake.damaged > 0) {
        fake.damaged -= fake.damaged > 0;
        return IRIS_ERR_DATA;
    }
    frame->buffer = 0;
    while (frame->buffer < BUFFERS && fake.borrowed >> frame->buffer & 1u) {
        frame->buffer++;
    }
    assert_true(frame->buffer < BUFFERS);
    fake.borrowed |= 1u << frame->buffer;
    assert_int_equal(iris_image_wrap(&frame->image, pixels[frame->buffer], sizeof pixels[0],
                                     (iris_size){8, 4}, 0, IRIS_GRAY8),
                     IRIS_OK);
    return IRIS_OK;
}

static iris_status fake_give(void *device, int32_t buffer)
{
    assert_ptr_equal(device, &fake);
    assert_true(fake.is_open && fake.runs && (fake.borrowed >> buffer & 1u));
    fake.borrowed &= ~(1u << buffer);
    fake.gives++;
    return fails() ? fake.fail_status : IRIS_OK;
}

static void fake_stop(void *device)
{
    assert_ptr_equal(device, &fake);
    assert_true(fake.is_open && fake.runs);
    fake.runs = 0;
}

static void fake_close(void *device)
{
    assert_ptr_equal(device, &fake);
    assert_true(fake.is_open && !fake.runs);
    fake.is_open = 0;
    fake.closes++;
}

static const char *fake_problem(const void *device)
{
    assert_ptr_equal(device, &fake);
    return "because";
}

static const iris_capture_driver driver = {fake_open, fake_start, fake_take,   fake_give,
                                           fake_stop, fake_close, fake_problem};
static const iris_capture_source source = {&driver, &fake};

#endif
