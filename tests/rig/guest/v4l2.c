/* A camera of the kernel's virtual driver: what is granted, who shares it, and every fault that the driver can be told to
 * have, at every point of a session. */
#include <errno.h>

#include "video_sender.h"
#include "vivid.h"

static iris_v4l2 device, other_device;
static iris_capture camera, other;
static const char *camera_path;

/* A test that failed may have left them open. */
static int close_all(void **state)
{
    iris_capture_close(&camera);
    iris_capture_close(&other);
    camera_path = webcam();
    return vivid_setup(state);
}

static void opens(const iris_capture_config *wanted)
{
    iris_status status = iris_capture_open(&camera, iris_v4l2_source(&device), camera_path, wanted);
    if (status != IRIS_OK) {
        fail_msg("%s", iris_capture_problem(&camera));
    }
}

/* It works, and has all its buffers. */
static void is_healthy(void)
{
    int took;
    opens(&vivid_wanted);
    assert_int_equal(camera.granted.buffers, 4);
    (void)vivid_take(&took, &camera, 3, 3000);
    assert_int_equal(took, 3);
    assert_int_equal(camera.restarts + camera.returns + camera.damaged, 0);
    iris_capture_close(&camera);
}

static void frames_follow_each_other(void **state)
{
    (void)state;
    iris_frame frame;
    int64_t last_us = 0;
    opens(&(iris_capture_config){.size = {640, 360}, .format = IRIS_YUYV, .rate_millihz = 30000});
    assert_int_equal(camera.granted.size.w, 640);
    assert_int_equal(camera.granted.size.h, 360);
    assert_int_equal(camera.granted.format, IRIS_YUYV);
    assert_int_equal(camera.granted.stride, 1280);
    assert_int_equal(camera.granted.rate_millihz, 30000);
    for (uint64_t i = 0; i < 8; i++) {
        assert_int_equal(iris_capture_next(&frame, &camera, 2000), IRIS_OK);
        assert_int_equal(frame.sequence, i + camera.dropped);
        assert_true(frame.time_us > last_us);
        assert_in_range(frame.time_us / 1000 - now_ms() + 5000, 0, 10000);
        last_us = frame.time_us;
        assert_int_equal(iris_capture_give(&camera, &frame), IRIS_OK);
    }
    iris_capture_close(&camera);
    is_healthy();
}

static void the_latest_is_new(void **state)
{
    (void)state;
    iris_capture_config wanted = vivid_wanted;
    wanted.policy = IRIS_CAPTURE_LATEST;
    opens(&wanted);
    for (int i = 0; i < 3; i++) {
        iris_frame frame;
        nanosleep(&(struct timespec){0, 120000000}, NULL); /* a slow program: several frames wait */
        assert_int_equal(iris_capture_next(&frame, &camera, 1000), IRIS_OK);
        assert_int_equal(iris_capture_give(&camera, &frame), IRIS_OK);
    }
    assert_true(camera.skipped >= 6);
    assert_int_equal(camera.frames, 3);
    iris_capture_close(&camera);
}

static void what_comes_nearest_is_granted(void **state)
{
    (void)state;
    opens(&(iris_capture_config){.size = {320, 240}, .format = IRIS_GRAY8, .rate_millihz = 1000000});
    assert_int_equal(camera.granted.size.w, 320);
    assert_int_equal(camera.granted.size.h, 180);
    assert_int_equal(camera.granted.format, IRIS_GRAY8);
    assert_int_equal(camera.granted.stride, 320);
    assert_in_range(camera.granted.rate_millihz, 60000, 200000);
    iris_capture_close(&camera);
    opens(NULL); /* as the source is set now, in the format that is preferred */
    assert_int_equal(camera.granted.size.w, 320);
    assert_int_equal(camera.granted.size.h, 180);
    assert_int_equal(camera.granted.format, IRIS_YUYV);
    iris_capture_close(&camera);
    assert_int_equal(iris_capture_open(&camera, iris_v4l2_source(&device), camera_path,
                                       &(iris_capture_config){.format = IRIS_HSL24}),
                     IRIS_ERR_FORMAT);
}

static void colors_are_told(void **state)
{
    (void)state;
    static const struct {
        const char *space, *encoding, *range;
        int32_t format;
        iris_color_matrix matrix;
        iris_color_range granted;
    } colors[] = {
        {"smpte-170m", "default", "default", IRIS_YUYV, IRIS_MATRIX_BT601, IRIS_RANGE_LIMITED},
        {"rec-709", "default", "default", IRIS_YUYV, IRIS_MATRIX_BT709, IRIS_RANGE_LIMITED},
        {"srgb", "default", "default", IRIS_CAPTURE_NV12, IRIS_MATRIX_BT601, IRIS_RANGE_LIMITED},
        {"bt-2020", "default", "default", IRIS_UYVY, IRIS_MATRIX_BT2020, IRIS_RANGE_LIMITED},
        {"rec-709", "itu-r-601", "full-range", IRIS_YUYV, IRIS_MATRIX_BT601, IRIS_RANGE_FULL},
        {"smpte-170m", "rec-709", "limited-range", IRIS_GRAY8, IRIS_MATRIX_BT709, IRIS_RANGE_LIMITED},
        {"srgb", "default", "default", IRIS_RGB888, IRIS_MATRIX_UNKNOWN, IRIS_RANGE_FULL},
        {"srgb", "default", "limited-range", IRIS_BGR888, IRIS_MATRIX_UNKNOWN, IRIS_RANGE_LIMITED},
    };
    for (size_t i = 0; i < sizeof colors / sizeof colors[0]; i++) {
        const char *path = camera_path;
        vivid_set(path, "colorspace", vivid_choice(path, "colorspace", colors[i].space));
        vivid_set(path, "y-cbcr-encoding", vivid_choice(path, "y-cbcr-encoding", colors[i].encoding));
        vivid_set(path, "quantization", vivid_choice(path, "quantization", colors[i].range));
        opens(&(iris_capture_config){.format = colors[i].format});
        assert_int_equal(camera.granted.matrix, colors[i].matrix);
        assert_int_equal(camera.granted.range, colors[i].granted);
        iris_capture_close(&camera);
    }
    vivid_set(camera_path, "colorspace", vivid_choice(camera_path, "colorspace", "srgb"));
    vivid_set(camera_path, "quantization", 0);
}

static void a_second_user_is_told_so(void **state)
{
    (void)state;
    int took;
    opens(&vivid_wanted);
    iris_capture_config wanted = vivid_wanted;
    wanted.size = (iris_size){640, 360};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(
            iris_capture_open(&other, iris_v4l2_source(&other_device), camera_path, i ? &wanted : NULL),
            IRIS_ERR_IO);
        assert_non_null(strstr(iris_capture_problem(&other), "another program uses the camera"));
    }
    (void)vivid_take(&took, &camera, 5, 3000); /* and the first one does not notice */
    assert_int_equal(took, 5);
    assert_int_equal(camera.restarts + camera.returns, 0);
    iris_capture_close(&camera);
    is_healthy();
}

static void counts_and_times_may_wrap(void **state)
{
    (void)state;
    int took;
    vivid_set(camera_path, "wrap-sequence-number", 1);
    opens(&vivid_wanted);
    for (int i = 0, wrapped = 0; !wrapped; i++) {
        iris_frame frame;
        assert_true(i < 400);
        assert_int_equal(iris_capture_next(&frame, &camera, 2000), IRIS_OK);
        assert_int_equal(frame.sequence, (uint64_t)i + camera.dropped);
        wrapped = camera.last_sequence < 1000 && i > 0;
        assert_int_equal(iris_capture_give(&camera, &frame), IRIS_OK);
    }
    assert_true(camera.dropped < 300);
    iris_capture_close(&camera);
    vivid_set(camera_path, "wrap-sequence-number", 0);
    for (int i = 1; i <= 2; i++) {
        vivid_set(camera_path, "wrap-timestamp", i);
        opens(&vivid_wanted);
        (void)vivid_take(&took, &camera, 5, 3000);
        assert_int_equal(took, 5);
        iris_capture_close(&camera);
    }
    vivid_set(camera_path, "wrap-timestamp", 0);
    is_healthy();
}

static void a_stream_that_breaks_is_started_again(void **state)
{
    (void)state;
    int took;
    opens(&vivid_wanted);
    (void)vivid_take(&took, &camera, 2, 3000);
    vivid_set(camera_path, "inject-fatal-streaming-error", 1);
    (void)vivid_take(&took, &camera, 5, 3000);
    assert_int_equal(took, 5);
    assert_int_equal(camera.restarts, 1);
    assert_int_equal(camera.returns, 0); /* without opening it again */
    iris_capture_close(&camera);
    is_healthy();
}

/* A source that is the camera, but for what happens to it at one point of the session. */
typedef enum { BEFORE_OPEN, BEFORE_START, STREAMING, BORROWED, BEFORE_STOP, BEFORE_CLOSE, POINTS } point;

typedef struct {
    const char *control;
    int64_t value;
    int lasts; /* until it is set to 0 */
} fault;

static const fault *now_comes;
static point when;
static const iris_capture_driver *real;

static void reach(point at)
{
    if (now_comes && at == when) {
        const fault *happens = now_comes;
        now_comes = NULL;
        vivid_set(camera_path, happens->control, happens->value);
    }
}

static iris_status haunted_open(void *state, iris_capture_grant *grant, const char *path,
                                const iris_capture_config *wanted)
{
    reach(BEFORE_OPEN);
    return real->open(state, grant, path, wanted);
}

static iris_status haunted_start(void *state)
{
    reach(BEFORE_START);
    return real->start(state);
}

static iris_status haunted_take(void *state, iris_frame *frame, int32_t timeout_ms)
{
    if (camera.frames == 2) {
        reach(STREAMING);
    }
    return real->take(state, frame, timeout_ms);
}

static iris_status haunted_give(void *state, int32_t index)
{
    if (camera.frames >= 2) {
        reach(BORROWED);
    }
    return real->give(state, index);
}

static void haunted_stop(void *state)
{
    reach(BEFORE_STOP);
    real->stop(state);
}

static void haunted_close(void *state)
{
    reach(BEFORE_CLOSE);
    real->close(state);
}

static const char *haunted_problem(const void *state)
{
    return real->problem(state);
}

static const iris_capture_driver haunted = {haunted_open, haunted_start, haunted_take,   haunted_give,
                                            haunted_stop, haunted_close, haunted_problem};

/* Opens it; a fault may make that fail once, with words. */
static void opens_at_last(const fault *happens, point at)
{
    const iris_capture_source source = {&haunted, &device};
    iris_status status = iris_capture_open(&camera, source, camera_path, &vivid_wanted);
    if (status != IRIS_OK) {
        assert_int_equal(status, IRIS_ERR_IO);
        assert_true(strlen(iris_capture_problem(&camera)) > 10);
        print_message("# %s at %d: open says: %s\n", happens->control, (int)at,
                      iris_capture_problem(&camera));
        status = iris_capture_open(&camera, source, camera_path, &vivid_wanted);
    }
    if (status != IRIS_OK) {
        fail_msg("%s at %d: %s", happens->control, (int)at, iris_capture_problem(&camera));
    }
}

/* While the fault lasts: nothing but good frames, few or none. */
static void endures(const fault *happens)
{
    int took;
    (void)vivid_take(&took, &camera, 6, 300);
    assert_true(happens->value != 100 || took <= 3); /* those that waited */
    vivid_set(camera_path, happens->control, 0);
}

/* One session with that fault. It goes on, or ends with words, in time; then the camera is as good as before. */
static void survives(const fault *happens, point at)
{
    int took = 0;
    int64_t start_ms = now_ms();
    real = iris_v4l2_source(&device).driver;
    now_comes = happens;
    when = at;
    opens_at_last(happens, at);
    (void)vivid_take(&took, &camera, at == STREAMING || at == BORROWED ? 3 : 0, 1000);
    if (happens->lasts && !now_comes) {
        endures(happens);
    }
    (void)vivid_take(&took, &camera, 5, 4000);
    if (took < 5) {
        fail_msg("%s at %d: %d frames came: %s", happens->control, (int)at, took,
                 iris_capture_problem(&camera));
    }
    print_message("# %s at %d: restarts %u, returns %u, damaged %u, dropped %u, %d ms\n", happens->control,
                  (int)at, (unsigned)camera.restarts, (unsigned)camera.returns, (unsigned)camera.damaged,
                  (unsigned)camera.dropped, (int)(now_ms() - start_ms));
    iris_capture_close(&camera);
    assert_null(now_comes);
    assert_int_equal(open_files(), files_before);
    assert_int_equal(mappings("/dev/video"), maps_before);
    if (happens->lasts) {
        vivid_set(camera_path, happens->control, 0);
    } else { /* what came too late for this session waits for the next one */
        opens_at_last(happens, at);
        (void)vivid_take(&took, &camera, 5, 4000);
        assert_int_equal(took, 5);
        iris_capture_close(&camera);
    }
    is_healthy();
}

static void every_fault_at_every_point_is_survived(void **state)
{
    (void)state;
    static const fault faults[] = {
        {"percentage-of-dropped-buffers", 100, 1},
        {"percentage-of-dropped-buffers", 50, 1},
        {"disconnect", 1, 0},
        {"inject-v4l2-buf-flag-error", 1, 0},
        {"inject-vidioc-reqbufs-error", 1, 0},
        {"inject-vidioc-qbuf-error", 1, 0},
        {"inject-vidioc-streamon-error", 1, 0},
        {"inject-fatal-streaming-error", 1, 0},
        {"wrap-sequence-number", 1, 1},
        {"wrap-timestamp", 1, 1},
        {"wrap-timestamp", 2, 1},
    };
    for (size_t i = 0; i < sizeof faults / sizeof faults[0]; i++) {
        for (int at = 0; at < POINTS; at++) {
            survives(&faults[i], (point)at);
        }
    }
}

/* A cable without a signal: frames go on coming. */
static void a_signal_that_is_lost_is_survived(void **state)
{
    (void)state;
    static const fault lost = {"dv-timings-signal-mode", 1, 1};
    camera_path = getenv("RIG_LOOP_IN");
    int handle = open(camera_path, O_RDWR | O_NONBLOCK);
    assert_true(handle >= 0);
    set_video_timings(handle, 0);
    close(handle);
    for (int at = 0; at < POINTS; at++) {
        survives(&lost, (point)at);
    }
}

static void a_camera_that_is_unplugged_returns(void **state)
{
    (void)state;
    iris_frame held, frame;
    int took;
    opens(&vivid_wanted);
    assert_int_equal(iris_capture_next(&held, &camera, 2000), IRIS_OK);
    vivid_set(camera_path, "disconnect", 1);
    assert_int_equal(iris_capture_next(&frame, &camera, 500), IRIS_ERR_IO);
    assert_non_null(strstr(iris_capture_problem(&camera), "gone"));
    assert_false(iris_capture_is_running(&camera));
    (void)memchr(held.image.data, 0, 320); /* what is borrowed stays in memory */
    assert_int_equal(iris_capture_next(&frame, &camera, 50), IRIS_ERR_IO);
    assert_int_equal(iris_capture_give(&camera, &held), IRIS_ERR_IO);
    int64_t start_ms = now_ms();
    (void)vivid_take(&took, &camera, 5, 4000);
    assert_int_equal(took, 5);
    print_message("#: 5 frames %d ms after the camera could return\n", (int)(now_ms() - start_ms));
    assert_int_equal(camera.returns, 1);
    iris_capture_close(&camera);
    is_healthy();
}

static void needs_the_virtual_machine(void **state)
{
    (void)state;
    print_message("no camera of the virtual machine (make test-linux)\n");
    skip();
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, close_all, vivid_teardown)
    const struct CMUnitTest tests[] = {
        CASE(frames_follow_each_other),
        CASE(the_latest_is_new),
        CASE(what_comes_nearest_is_granted),
        CASE(colors_are_told),
        CASE(a_second_user_is_told_so),
        CASE(counts_and_times_may_wrap),
        CASE(a_camera_that_is_unplugged_returns),
        CASE(every_fault_at_every_point_is_survived),
        CASE(a_stream_that_breaks_is_started_again),
        CASE(a_signal_that_is_lost_is_survived),
    };
    const struct CMUnitTest none[] = {cmocka_unit_test(needs_the_virtual_machine)};
    return webcam() ? cmocka_run_group_tests(tests, NULL, NULL) : cmocka_run_group_tests(none, NULL, NULL);
}
