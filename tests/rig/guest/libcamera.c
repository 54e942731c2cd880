/* Cameras behind libcamera: those of the virtual machine (the kernel's vimc), and everywhere what happens without any. */
#include "iris/libcamera.h"
#include "test.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

static iris_libcamera device;
static iris_capture camera;

static int is_built_in(void)
{
    iris_libcamera_info info;
    int32_t count;
    return iris_libcamera_list(&info, &count, 1) != IRIS_ERR_UNSUPPORTED;
}

/* Skips the test where vimc is not. */
static void need_camera(void)
{
    const char *media = getenv("RIG_MEDIA_CAMERA");
    const char *why = !is_built_in()   ? "built without libcamera"
                      : !getenv("RIG") ? "no camera that is always the same: make test-linux has one"
                      : !media || media[0] == '\0' ? "vimc could not be had when the rig was prepared"
                                                   : NULL;
    if (why) {
        print_message("%s\n", why);
        skip();
    }
}

static int64_t now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static void pause_ms(long ms)
{
    nanosleep(&(struct timespec){ms / 1000, ms % 1000 * 1000000}, NULL);
}

static iris_status open_with(const char *path, iris_capture_config config)
{
    return iris_capture_open(&camera, iris_libcamera_source(&device), path, &config);
}

static void open_small(int32_t format, iris_capture_policy policy)
{
    iris_capture_config config = {.size = {160, 120}, .format = format, .policy = policy};
    iris_status status = open_with("", config);
    if (status != IRIS_OK) {
        fail_msg("%s: %s", iris_status_text(status), iris_capture_problem(&camera));
    }
}

/* The next frame, at most 5 seconds from now: the machine is an emulated one. */
static void next(iris_frame *frame)
{
    iris_status status = iris_capture_next(frame, &camera, 5000);
    if (status != IRIS_OK) {
        fail_msg("%s: %s", iris_status_text(status), iris_capture_problem(&camera));
    }
}

static void give(const iris_frame *frame)
{
    assert_int_equal(iris_capture_give(&camera, frame), IRIS_OK);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    iris_libcamera_info info[1];
    int32_t count = 7;
    assert_int_equal(iris_libcamera_list(NULL, &count, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_libcamera_list(info, NULL, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_libcamera_list(info, &count, -1), IRIS_ERR_ARG);
    iris_libcamera_mode mode;
    assert_int_equal(iris_libcamera_list_modes(NULL, &count, "", 1), IRIS_ERR_ARG);
    assert_int_equal(iris_libcamera_list_modes(&mode, NULL, "", 1), IRIS_ERR_ARG);
    assert_int_equal(iris_libcamera_list_modes(&mode, &count, NULL, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_libcamera_list_modes(&mode, &count, "", -1), IRIS_ERR_ARG);
    assert_int_equal(count, 7);
    assert_int_equal(iris_capture_open(&camera, iris_libcamera_source(NULL), "", NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_capture_open(&camera, iris_libcamera_source(&device), NULL, NULL), IRIS_ERR_ARG);
}

static void without_libcamera_it_says_what_is_missing(void **state)
{
    (void)state;
    if (is_built_in()) {
        print_message("built with libcamera\n");
        skip();
    }
    iris_libcamera_info info[1];
    int32_t count = 7;
    assert_int_equal(iris_libcamera_list(info, &count, 1), IRIS_ERR_UNSUPPORTED);
    assert_int_equal(count, 0);
    count = 7;
    assert_int_equal(iris_libcamera_list_modes(NULL, &count, "", 0), IRIS_ERR_UNSUPPORTED);
    assert_int_equal(count, 0);
    assert_int_equal(open_with("", (iris_capture_config){0}), IRIS_ERR_UNSUPPORTED);
    assert_non_null(strstr(iris_capture_problem(&camera), "libcamera-dev"));
    assert_int_equal(iris_capture_is_running(&camera), 0);
    iris_capture_close(&camera);
}

static void a_camera_that_is_not_there_is_an_error(void **state)
{
    (void)state;
    if (!is_built_in()) {
        print_message("built without libcamera\n");
        skip();
    }
    static const char *const paths[] = {"no such camera", "999", " 0"};
    for (size_t i = 0; i < sizeof paths / sizeof paths[0]; i++) {
        assert_int_equal(open_with(paths[i], (iris_capture_config){0}), IRIS_ERR_IO);
        assert_non_null(strstr(iris_capture_problem(&camera), "no "));
        assert_non_null(strstr(iris_capture_problem(&camera), "camera"));
        assert_null(device.session);
        assert_int_equal(iris_capture_is_running(&camera), 0);
    }
    iris_capture_close(&camera);
}

static void vimc_is_listed(void **state)
{
    (void)state;
    need_camera();
    iris_libcamera_info info[8];
    int32_t count = 7;
    assert_int_equal(iris_libcamera_list(NULL, &count, 0), IRIS_ERR_FULL);
    assert_in_range(count, 1, 8);
    const int32_t all = count;
    assert_int_equal(iris_libcamera_list(info, &count, 8), IRIS_OK);
    assert_int_equal(count, all);
    int found = 0;
    for (int32_t i = 0; i < count; i++) {
        found += strstr(info[i].id, "vimc") != NULL && strcmp(info[i].model, "Sensor B") == 0;
    }
    assert_int_equal(found, 1);
    const iris_capture_config small = {.size = {160, 120}};
    assert_int_equal(open_with(info[0].id, small), IRIS_OK);
    iris_capture_close(&camera);
    assert_int_equal(open_with("0", small), IRIS_OK);
    iris_capture_close(&camera);
}

/* What is offered and read is granted. */
static void formats_and_sizes_are_listed(void **state)
{
    (void)state;
    need_camera();
    static iris_libcamera_mode modes[256];
    int32_t count = 7, reads = 0;
    assert_int_equal(iris_libcamera_list_modes(NULL, &count, "no such camera", 0), IRIS_ERR_IO);
    assert_int_equal(count, 0);
    assert_int_equal(iris_libcamera_list_modes(modes, &count, "", 1), count > 1 ? IRIS_ERR_FULL : IRIS_OK);
    const int32_t all = count;
    assert_int_equal(iris_libcamera_list_modes(modes, &count, "0", 256), IRIS_OK);
    assert_int_equal(count, all);
    for (int32_t i = 0; i < count; i++) {
        const iris_libcamera_mode *m = &modes[i];
        print_message("%s: %dx%d to %dx%d in steps of %dx%d\n", m->name, (int)m->least.w, (int)m->least.h,
                      (int)m->most.w, (int)m->most.h, (int)m->step.w, (int)m->step.h);
        assert_true(m->name[0] != '\0' && m->least.w > 0 && m->least.h > 0);
        assert_true(m->least.w <= m->most.w && m->least.h <= m->most.h);
        assert_int_equal(m->least.w == m->most.w && m->least.h == m->most.h, m->step.w == 0);
        if (m->format != 0 && m->least.w <= 160 && m->most.w >= 160) {
            const iris_capture_config config = {.size = {160, 120}, .format = m->format};
            assert_int_equal(open_with("0", config), IRIS_OK);
            assert_int_equal(camera.granted.format, m->format);
            iris_capture_close(&camera);
            reads++;
        }
    }
    assert_true(reads > 0);
}

/* What is granted is what the camera makes of it: 640x480 becomes 636x480, whose rows are not padded. */
static void what_was_negotiated_is_read_back(void **state)
{
    (void)state;
    need_camera();
    iris_capture_config config = {.size = {640, 480}, .format = IRIS_RGB888, .buffers = 3};
    assert_int_equal(open_with("", config), IRIS_OK);
    const iris_capture_grant *granted = &camera.granted;
    assert_int_equal(granted->size.w, 636);
    assert_int_equal(granted->size.h, 480);
    assert_int_equal(granted->format, IRIS_RGB888);
    assert_int_equal(granted->stride, 636 * 3);
    assert_int_equal(granted->matrix, IRIS_MATRIX_UNKNOWN);
    assert_in_range(granted->buffers, 2, IRIS_CAPTURE_BUFFERS_MAX);
    iris_frame frame;
    next(&frame);
    assert_int_equal(frame.image.w, 636);
    assert_int_equal(frame.image.h, 480);
    assert_int_equal(frame.image.stride, 636 * 3);
    assert_int_equal(frame.image.format, IRIS_RGB888);
    assert_int_equal(iris_image_check(&frame.image), IRIS_OK);
    assert_null(frame.chroma.data);
    give(&frame);
    iris_capture_close(&camera);
    assert_int_equal(granted->size.w, 636);
}

/* vimc shows bars: white, yellow, cyan, green, magenta, red, blue, black. */
static void bytes_are_in_the_order_that_the_format_says(void **state)
{
    (void)state;
    need_camera();
    static const struct {
        int32_t format;
        int red, blue;
    } orders[] = {{IRIS_RGB888, 0, 2}, {IRIS_BGR888, 2, 0}};
    for (size_t i = 0; i < sizeof orders / sizeof orders[0]; i++) {
        open_small(orders[i].format, IRIS_CAPTURE_EVERY);
        iris_frame frame;
        next(&frame);
        const uint8_t *row = iris_image_row(&frame.image, frame.image.h / 4);
        const uint8_t *yellow = row + frame.image.w * 3 / 16 * 3, *cyan = row + frame.image.w * 5 / 16 * 3;
        assert_true(yellow[orders[i].red] > 128 && yellow[1] > 128 && yellow[orders[i].blue] < 96);
        assert_true(cyan[orders[i].red] < 96 && cyan[1] > 128 && cyan[orders[i].blue] > 128);
        give(&frame);
        iris_capture_close(&camera);
    }
}

static void every_frame_comes_in_turn(void **state)
{
    (void)state;
    need_camera();
    open_small(0, IRIS_CAPTURE_EVERY);
    int64_t before_us = 0;
    for (uint64_t i = 0; i < 20; i++) {
        iris_frame frame;
        next(&frame);
        assert_int_equal(frame.sequence, i + camera.dropped);
        assert_true(frame.time_us > before_us);
        assert_true(frame.time_us / 1000 <= now_ms() && frame.time_us / 1000 > now_ms() - 10000);
        before_us = frame.time_us;
        give(&frame);
    }
    assert_int_equal(camera.frames, 20);
    assert_int_equal(camera.skipped, 0);
    assert_int_equal(camera.damaged, 0);
    assert_int_equal(camera.restarts, 0);
    iris_capture_close(&camera);
}

static void the_latest_frame_overtakes(void **state)
{
    (void)state;
    need_camera();
    open_small(0, IRIS_CAPTURE_LATEST);
    iris_frame first, second;
    next(&first);
    give(&first);
    next(&second);
    give(&second);
    const int64_t period_us = second.time_us - first.time_us;
    const uint64_t skipped = camera.skipped;
    pause_ms((long)(period_us / 1000 * camera.granted.buffers + 1000)); /* all buffers are full by then */
    first = second;
    next(&second);
    /* those given back are filled again meanwhile */
    assert_in_range(camera.skipped - skipped, camera.granted.buffers - 1, IRIS_CAPTURE_BUFFERS_MAX);
    assert_true(second.sequence >= first.sequence + (uint64_t)camera.granted.buffers);
    give(&second);
    iris_capture_close(&camera);
}

static void frames_are_borrowed_and_given_back_in_any_order(void **state)
{
    (void)state;
    need_camera();
    open_small(0, IRIS_CAPTURE_EVERY);
    iris_frame frames[IRIS_CAPTURE_BUFFERS_MAX], more;
    const int32_t most = camera.granted.buffers - 1;
    assert_true(most >= 2);
    for (int round = 0; round < 4; round++) {
        for (int32_t i = 0; i < most; i++) {
            next(&frames[i]);
            for (int32_t j = 0; j < i; j++) {
                assert_int_equal(iris_image_overlaps(&frames[i].image, &frames[j].image), 0);
            }
        }
        assert_int_equal(iris_capture_next(&more, &camera, 100), IRIS_ERR_FULL);
        for (int32_t i = 0; i < most; i++) {
            give(&frames[(i + round) % most]);
        }
        assert_int_equal(iris_capture_give(&camera, &frames[0]), IRIS_ERR_ARG);
    }
    next(&frames[0]); /* and is still borrowed at the end */
    iris_capture_close(&camera);
}

/* The system itself is asked to write there. */
static void frames_cannot_be_written(void **state)
{
    (void)state;
    need_camera();
    open_small(0, IRIS_CAPTURE_EVERY);
    iris_frame frame;
    next(&frame);
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(write(ends[1], frame.image.data, 1), 1);
    assert_int_equal(read(ends[0], frame.image.data, 1), -1);
    assert_int_equal(errno, EFAULT);
    close(ends[0]);
    close(ends[1]);
    give(&frame);
    iris_capture_close(&camera);
}

static void waiting_has_an_end(void **state)
{
    (void)state;
    need_camera();
    open_small(0, IRIS_CAPTURE_EVERY);
    iris_frame frame;
    int timeouts = 0;
    for (int i = 0; i < 10; i++) { /* no camera is as fast as that */
        int64_t start_ms = now_ms();
        iris_status status = iris_capture_next(&frame, &camera, 1);
        assert_true(now_ms() - start_ms < 3000); /* the emulated kernel keeps its only processor that long */
        timeouts += status == IRIS_ERR_TIMEOUT;
        if (status == IRIS_OK) {
            give(&frame);
        }
    }
    assert_true(timeouts > 0);
    iris_capture_close(&camera);
}

static void formats_that_it_does_not_have_are_refused(void **state)
{
    (void)state;
    need_camera();
    static const int32_t formats[] = {IRIS_RGB565_SWAP, IRIS_CAPTURE_NV12, IRIS_BAYER8_GRBG};
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        iris_capture_config config = {.format = formats[i]};
        assert_int_equal(open_with("", config), IRIS_ERR_FORMAT);
        assert_non_null(strstr(iris_capture_problem(&camera), "BGR888"));
        assert_null(device.session);
    }
}

/* One process, one camera, two that want it; the list meanwhile. */
static void a_second_user_is_refused(void **state)
{
    (void)state;
    need_camera();
    open_small(0, IRIS_CAPTURE_EVERY);
    static iris_libcamera other_device;
    iris_capture other;
    assert_int_equal(iris_capture_open(&other, iris_libcamera_source(&other_device), "", NULL), IRIS_ERR_IO);
    assert_non_null(strstr(iris_capture_problem(&other), "busy"));
    iris_libcamera_info info[8];
    int32_t count = 0;
    assert_int_equal(iris_libcamera_list(info, &count, 8), IRIS_OK);
    assert_true(count >= 1);
    iris_frame frame;
    next(&frame);
    give(&frame);
    iris_capture_close(&camera);
}

/* The stream is broken off and started again, as iris_capture_next does, with a frame in the caller's hands. */
static void a_borrowed_frame_survives_a_restart(void **state)
{
    (void)state;
    need_camera();
    iris_capture_source source = iris_libcamera_source(&device);
    iris_capture_grant grant;
    iris_capture_config config = {.size = {160, 120}, .buffers = 3};
    assert_int_equal(source.driver->open(&device, &grant, "", &config), IRIS_OK);
    assert_int_equal(source.driver->start(&device), IRIS_OK);
    iris_frame kept, frame;
    assert_int_equal(source.driver->take(&device, &kept, 5000), IRIS_OK);
    uint32_t sum = 0, sum_after = 0;
    for (size_t i = 0; i < (size_t)(kept.image.stride * kept.image.h); i++) {
        sum = sum * 31 + ((uint8_t *)kept.image.data)[i];
    }
    source.driver->stop(&device);
    assert_int_equal(source.driver->start(&device), IRIS_OK);
    for (int i = 0; i < 8; i++) {
        assert_int_equal(source.driver->take(&device, &frame, 5000), IRIS_OK);
        assert_int_not_equal(frame.buffer, kept.buffer);
        assert_int_equal(source.driver->give(&device, frame.buffer), IRIS_OK);
    }
    for (size_t i = 0; i < (size_t)(kept.image.stride * kept.image.h); i++) {
        sum_after = sum_after * 31 + ((uint8_t *)kept.image.data)[i];
    }
    assert_int_equal(sum, sum_after);
    assert_int_equal(source.driver->give(&device, kept.buffer), IRIS_OK);
    int seen = 0;
    for (int i = 0; i < 8; i++) {
        assert_int_equal(source.driver->take(&device, &frame, 5000), IRIS_OK);
        seen += frame.buffer == kept.buffer;
        assert_int_equal(source.driver->give(&device, frame.buffer), IRIS_OK);
    }
    assert_true(seen > 0);
    source.driver->stop(&device);
    source.driver->close(&device);
    assert_null(device.session);
}

static int count_entries(const char *path)
{
    DIR *folder = opendir(path);
    assert_non_null(folder);
    int count = 0;
    while (readdir(folder)) {
        count++;
    }
    closedir(folder);
    return count;
}

/* Mappings of buffers: those of memory come and go with the allocator, those of tracing when it likes. */
static int count_mappings(void)
{
    FILE *maps = fopen("/proc/self/maps", "r");
    assert_non_null(maps);
    char line[512];
    int count = 0;
    while (fgets(line, sizeof line, maps)) {
        count += strstr(line, "dmabuf") != NULL || strstr(line, "/dev/video") != NULL;
    }
    (void)fclose(maps);
    return count;
}

/* Threads, once no more of them end: one that was joined is listed a moment longer. */
static int count_threads(void)
{
    const struct timespec moment = {0, 20 * 1000 * 1000};
    int count = count_entries("/proc/self/task");
    for (int same = 0; same < 10; same++) {
        (void)nanosleep(&moment, NULL);
        const int now = count_entries("/proc/self/task");
        same = now == count ? same : -1;
        count = now;
    }
    return count;
}

static void nothing_stays_open(void **state)
{
    (void)state;
    need_camera();
    int descriptors = 0, mappings = 0, threads = 0;
    for (int i = 0; i < 4; i++) {
        iris_frame frame;
        if (i == 2) {
            iris_capture_config refused = {.format = IRIS_YUYV};
            assert_int_equal(open_with("", refused), IRIS_ERR_FORMAT);
        }
        open_small(i % 2 ? IRIS_RGB888 : IRIS_BGR888, IRIS_CAPTURE_EVERY);
        assert_true(count_mappings() > mappings);
        next(&frame);
        if (i % 3 != 0) {
            give(&frame);
        }
        iris_capture_close(&camera);
        iris_capture_close(&camera);
        if (i == 0) { /* what libcamera keeps for the whole process is there now */
            descriptors = count_entries("/proc/self/fd");
            mappings = count_mappings();
            threads = count_threads();
        }
        assert_int_equal(count_entries("/proc/self/fd"), descriptors);
        assert_int_equal(count_mappings(), mappings);
        assert_int_equal(count_threads(), threads);
    }
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
        cmocka_unit_test_teardown(wrong_calls_are_refused, close_camera),
        cmocka_unit_test_teardown(without_libcamera_it_says_what_is_missing, close_camera),
        cmocka_unit_test_teardown(a_camera_that_is_not_there_is_an_error, close_camera),
        cmocka_unit_test_teardown(vimc_is_listed, close_camera),
        cmocka_unit_test_teardown(formats_and_sizes_are_listed, close_camera),
        cmocka_unit_test_teardown(what_was_negotiated_is_read_back, close_camera),
        cmocka_unit_test_teardown(bytes_are_in_the_order_that_the_format_says, close_camera),
        cmocka_unit_test_teardown(every_frame_comes_in_turn, close_camera),
        cmocka_unit_test_teardown(the_latest_frame_overtakes, close_camera),
        cmocka_unit_test_teardown(frames_are_borrowed_and_given_back_in_any_order, close_camera),
        cmocka_unit_test_teardown(frames_cannot_be_written, close_camera),
        cmocka_unit_test_teardown(waiting_has_an_end, close_camera),
        cmocka_unit_test_teardown(formats_that_it_does_not_have_are_refused, close_camera),
        cmocka_unit_test_teardown(a_second_user_is_refused, close_camera),
        cmocka_unit_test_teardown(a_borrowed_frame_survives_a_restart, close_camera),
        cmocka_unit_test_teardown(nothing_stays_open, close_camera),
    };
    (void)setenv("LIBCAMERA_LOG_LEVELS", "*:FATAL", 0);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
