/* Every call that a session with a camera makes of the system fails once, or from then on; the driver behind it is real. */
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <linux/videodev2.h>

#include "vivid.h"

enum { FRAMES = 4, STEPS_MAX = 400, FOREVER = 1 << 30 };

static iris_v4l2 device;
static iris_capture camera;
static int watching, step, fail_at, fail_times, fail_error;

static int fails(void)
{
    int at = step;
    step += watching;
    if (!watching || at < fail_at || at - fail_at >= fail_times) {
        return 0;
    }
    errno = fail_error;
    return 1;
}

/* NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): the system's are reserved names */
int ioctl(int handle, unsigned long request, ...)
{
    va_list arguments;
    va_start(arguments, request);
    void *argument = va_arg(arguments, void *);
    va_end(arguments);
    /* one of a list's entries is as good as another */
    if (!(request == VIDIOC_ENUM_FMT && ((struct v4l2_fmtdesc *)argument)->index > 1) && fails()) {
        return -1;
    }
    return (int)syscall(SYS_ioctl, handle, request, argument);
}

/* NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): the system's are reserved names */
int open(const char *path, int flags, ...)
{
    return fails() ? -1 : (int)syscall(SYS_openat, AT_FDCWD, path, flags, 0600);
}

/* NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): the system's are reserved names */
int poll(struct pollfd *entries, nfds_t count, int timeout_ms)
{
    const struct timespec timeout = {timeout_ms / 1000, (long)(timeout_ms % 1000) * 1000000};
    return count > 0 && fails() ? -1 : (int)syscall(SYS_ppoll, entries, count, &timeout, NULL, 0);
}

/* NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): the system's are reserved names */
void *mmap(void *address, size_t bytes, int protection, int flags, int handle, off_t offset)
{
    if (watching && handle >= 0 && fail_error != EINTR && fails()) { /* no signal interrupts it */
        return MAP_FAILED;
    }
    return (void *)syscall(SYS_mmap, address, bytes, protection, flags, handle, offset);
}

static iris_status opens(void)
{
    iris_capture_config wanted = vivid_wanted;
    wanted.rate_millihz = 200000;
    wanted.reconnect_ms = 1;
    return iris_capture_open(&camera, iris_v4l2_source(&device), webcam(), &wanted);
}

static void nothing_is_left(void)
{
    watching = 0;
    iris_capture_close(&camera);
    assert_int_equal(open_files(), files_before);
    assert_int_equal(mappings("/dev/video"), maps_before);
}

/* One frame stays borrowed while the next ones come and go. */
static void session(int at, int error)
{
    iris_frame held;
    int took = 0, holds;
    step = 0;
    fail_at = at;
    fail_error = error;
    fail_times = 1;
    watching = 1;
    iris_status status = opens();
    if (status != IRIS_OK) {
        assert_int_not_equal(error, EINTR); /* a signal is no failure */
        assert_true(status == IRIS_ERR_IO || status == IRIS_ERR_UNSUPPORTED);
        assert_true(strlen(iris_capture_problem(&camera)) > 10);
        status = opens();
    }
    assert_int_equal(status, IRIS_OK);
    int64_t start_ms = now_ms();
    do {
        holds = iris_capture_next(&held, &camera, 300) == IRIS_OK;
    } while (!holds && now_ms() - start_ms < 3000);
    assert_true(holds);
    (void)vivid_take(&took, &camera, FRAMES, 500);
    (void)iris_capture_give(&camera, &held);
    if (took < FRAMES) {
        (void)vivid_take(&took, &camera, FRAMES, 4000);
    }
    if (took < FRAMES) {
        fail_msg("call %d with %d: %d frames: %s", at, error, took, iris_capture_problem(&camera));
    }
    if (error == EINTR) {
        assert_int_equal(camera.restarts + camera.returns, 0);
    }
    iris_capture_close(&camera);
    nothing_is_left();
}

static void every_call_may_fail_once(void **state)
{
    (void)state;
    static const int errors[] = {EIO, ENODEV, EINTR, EBUSY, ENOMEM};
    int sessions = 0;
    for (size_t i = 0; i < sizeof errors / sizeof errors[0]; i++) {
        int at = 0;
        do {
            session(at, errors[i]);
            assert_true(++at < STEPS_MAX);
            sessions++;
        } while (step >= at);
    }
    print_message("#: %d sessions with one failed call\n", sessions);
    assert_true(sessions > 100);
}

/* The camera is pulled out for good. */
static void every_call_may_be_the_last_that_works(void **state)
{
    (void)state;
    int at = 0, frames;
    do {
        iris_frame held;
        int took, holds = 0;
        step = 0;
        fail_at = at;
        fail_error = ENODEV;
        fail_times = FOREVER;
        watching = 1;
        frames = 0;
        if (opens() == IRIS_OK) {
            holds = iris_capture_next(&held, &camera, 300) == IRIS_OK;
            (void)vivid_take(&took, &camera, FRAMES, 150);
            frames = took;
            if (holds) {
                (void)iris_capture_give(&camera, &held);
            }
            iris_frame frame;
            int64_t start_ms = now_ms();
            iris_status status = iris_capture_next(&frame, &camera, 20);
            assert_in_range(now_ms() - start_ms, 0, 3000);
            if (frames < FRAMES) {
                assert_int_equal(status, IRIS_ERR_IO);
                assert_non_null(strstr(iris_capture_problem(&camera), "gone"));
            }
        } else {
            assert_true(strlen(iris_capture_problem(&camera)) > 10);
        }
        nothing_is_left();
        assert_true(++at < STEPS_MAX);
    } while (frames < FRAMES);
    print_message("#: %d sessions that ended early\n", at - 1);
    assert_true(at > 20);
    fail_times = 0; /* and the driver is as good as before */
    assert_int_equal(opens(), IRIS_OK);
    int took;
    (void)vivid_take(&took, &camera, FRAMES, 3000);
    assert_int_equal(took, FRAMES);
    assert_int_equal(camera.granted.buffers, 4);
    iris_capture_close(&camera);
}

static int stop_watching(void **state)
{
    watching = 0;
    iris_capture_close(&camera);
    return vivid_setup(state);
}

static void needs_the_virtual_machine(void **state)
{
    (void)state;
    print_message("no camera of the virtual machine (make test-linux)\n");
    skip();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_call_may_fail_once, stop_watching, vivid_teardown),
        cmocka_unit_test_setup_teardown(every_call_may_be_the_last_that_works, stop_watching, vivid_teardown),
    };
    const struct CMUnitTest none[] = {cmocka_unit_test(needs_the_virtual_machine)};
    return webcam() ? cmocka_run_group_tests(tests, NULL, NULL) : cmocka_run_group_tests(none, NULL, NULL);
}
