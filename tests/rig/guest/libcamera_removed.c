/* A camera behind libcamera breaks off in mid-stream, or is unplugged and comes back. No virtual camera of the kernel can be
 * unplugged under libcamera, so this program calls what libcamera itself calls then. */
#define _GNU_SOURCE
#include "iris/libcamera.h"
#include "test.h"

#include <dlfcn.h>

static iris_libcamera device;
static iris_capture camera;

/* The camera of libcamera's that was opened last: its acquire comes here first. */
static void *object;
int acquire(void *self) __asm__("_ZN9libcamera6Camera7acquireEv");

/* A function of libcamera's camera, called on it. */
static int call(const char *symbol, void *self)
{
    int (*function)(void *);
    void *address = dlsym(RTLD_NEXT, symbol);
    assert_non_null(address);
    memcpy(&function, &address, sizeof function);
    return function(self);
}

int acquire(void *self)
{
    object = self;
    return call("_ZN9libcamera6Camera7acquireEv", self);
}

static void break_off(void)
{
    assert_int_equal(call("_ZN9libcamera6Camera4stopEv", object), 0);
}

static void unplug(void)
{
    break_off();
    (void)call("_ZN9libcamera6Camera10disconnectEv", object);
}

static void open_camera(void)
{
    int32_t count;
    const char *media = getenv("RIG_MEDIA_CAMERA");
    const char *why = iris_libcamera_list(NULL, &count, 0) == IRIS_ERR_UNSUPPORTED ? "built without libcamera"
                      : !getenv("RIG") ? "no camera that is always the same: make test-linux has one"
                      : !media || media[0] == '\0' ? "vimc could not be had when the rig was prepared"
                                                   : NULL;
    if (why) {
        print_message("%s\n", why);
        skip();
    }
    iris_capture_config config = {.size = {160, 120}, .reconnect_ms = 100};
    assert_int_equal(iris_capture_open(&camera, iris_libcamera_source(&device), "", &config), IRIS_OK);
}

static void next(iris_frame *frame)
{
    assert_int_equal(iris_capture_next(frame, &camera, 5000), IRIS_OK);
}

static void give(const iris_frame *frame)
{
    assert_int_equal(iris_capture_give(&camera, frame), IRIS_OK);
}

/* What was filled before comes first, then the end of it is seen, and the stream started again, within one call. */
static void a_stream_that_breaks_off_is_started_again(void **state)
{
    (void)state;
    open_camera();
    iris_frame kept, frame;
    next(&kept);
    for (uint32_t round = 1; round <= 2; round++) {
        break_off();
        for (int32_t i = 0; i < 2 * camera.granted.buffers; i++) {
            next(&frame);
            assert_int_not_equal(frame.buffer, kept.buffer);
            give(&frame);
        }
        assert_int_equal(camera.restarts, round);
        assert_int_equal(camera.returns, 0);
    }
    give(&kept);
    iris_capture_close(&camera);
}

/* Frames that were filled before it went may come first. */
static void see_it_gone(void)
{
    iris_frame frame;
    iris_status status = IRIS_OK;
    for (int32_t i = 0; i <= camera.granted.buffers && status == IRIS_OK; i++) {
        status = iris_capture_next(&frame, &camera, 5000);
        if (status == IRIS_OK) { /* the camera takes it no more */
            assert_int_equal(iris_capture_give(&camera, &frame), IRIS_ERR_IO);
        }
    }
    assert_int_equal(status, IRIS_ERR_IO);
    assert_int_equal(iris_capture_is_running(&camera), 0);
    assert_non_null(strstr(iris_capture_problem(&camera), "removed"));
}

static void a_removed_camera_comes_back(void **state)
{
    (void)state;
    open_camera();
    for (uint32_t round = 1; round <= 2; round++) {
        iris_frame frame;
        next(&frame);
        give(&frame);
        unplug();
        see_it_gone();
        assert_null(device.session);
        next(&frame);
        give(&frame);
        assert_int_equal(camera.returns, round);
    }
    iris_capture_close(&camera);
}

/* Its memory stays until it is given back. */
static void a_frame_outlives_its_camera(void **state)
{
    (void)state;
    open_camera();
    iris_frame kept, frame;
    next(&kept);
    unplug();
    see_it_gone();
    unsigned sum = 0;
    for (int32_t y = 0; y < kept.image.h; y++) {
        sum += *(const uint8_t *)iris_image_row(&kept.image, y);
    }
    assert_true(sum > 0);
    assert_int_equal(iris_capture_next(&frame, &camera, 300), IRIS_ERR_IO);
    assert_non_null(device.session);
    assert_int_equal(iris_capture_give(&camera, &kept), IRIS_ERR_IO);
    assert_null(device.session);
    next(&frame);
    give(&frame);
    assert_int_equal(camera.returns, 1);
    iris_capture_close(&camera);
}

static void a_removed_camera_is_closed(void **state)
{
    (void)state;
    open_camera();
    unplug();
    iris_capture_close(&camera);
    assert_null(device.session);
}

/* After a test that failed, too. */
static int close_camera(void **state)
{
    (void)state;
    iris_capture_close(&camera);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_stream_that_breaks_off_is_started_again, close_camera),
        cmocka_unit_test_teardown(a_removed_camera_comes_back, close_camera),
        cmocka_unit_test_teardown(a_frame_outlives_its_camera, close_camera),
        cmocka_unit_test_teardown(a_removed_camera_is_closed, close_camera),
    };
    (void)setenv("LIBCAMERA_LOG_LEVELS", "*:FATAL", 0);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
