/* Ten minutes of a camera at 30 frames a second, by the guest's clock: every frame comes or is counted, and nothing grows. */
#define _POSIX_C_SOURCE 200809L
#include "../real_time/rig.h"
#include "iris/v4l2.h"

#include <dirent.h>
#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#define RATE                  30
#define VIVID_DROPPED_PERCENT 0x00f0f040u

static iris_v4l2 device;
static iris_capture camera;

static int64_t now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

/* Kilobytes that a file of the kernel's names so, as in "VmRSS:   1234 kB". */
static long kilobytes(const char *file, const char *name)
{
    char line[128];
    long found = -1;
    FILE *in = fopen(file, "r");
    assert_non_null(in);
    while (fgets(line, sizeof line, in)) {
        if (strncmp(line, name, strlen(name)) == 0) {
            found = strtol(line + strlen(name), NULL, 10);
        }
    }
    fclose(in);
    assert_true(found >= 0);
    return found;
}

typedef struct {
    long process_kb, kernel_kb;
    int handles;
} usage;

static usage used_now(void)
{
    usage now = {kilobytes("/proc/self/status", "VmRSS:"),
                 kilobytes("/proc/meminfo", "SUnreclaim:") + kilobytes("/proc/meminfo", "VmallocUsed:"), 0};
    DIR *folder = opendir("/proc/self/fd");
    assert_non_null(folder);
    while (readdir(folder)) {
        now.handles++;
    }
    closedir(folder);
    return now;
}

static void assert_flat(usage first, usage last)
{
    print_message("# process %ld and %ld KB, kernel %ld and %ld KB\n", first.process_kb, last.process_kb,
                  first.kernel_kb, last.kernel_kb);
    assert_int_equal(first.handles, last.handles);
    assert_true(last.process_kb - first.process_kb <= 64);
    assert_true(last.kernel_kb - first.kernel_kb <= 1024);
}

static void open_camera(iris_capture_policy policy)
{
    const iris_capture_config wanted = {
        .size = {320, 180}, .format = IRIS_YUYV, .rate_millihz = RATE * 1000, .policy = policy};
    assert_int_equal(iris_capture_open(&camera, iris_v4l2_source(&device), rig_node("RIG_WEBCAM"), &wanted),
                     IRIS_OK);
    assert_int_equal(camera.granted.rate_millihz, RATE * 1000);
}

/* Takes frames for so many seconds; after each one the program does something else for rest_ms. *frames is how many came in
 * that time, *ticks how many the camera's clock went on. */
static void watch(uint64_t *frames, uint64_t *ticks, int seconds, int rest_ms)
{
    iris_frame frame;
    assert_int_equal(iris_capture_next(&frame, &camera, 1000), IRIS_OK);
    const uint64_t first = frame.sequence;
    uint64_t last = first;
    const int64_t start = now_ms();
    assert_int_equal(iris_capture_give(&camera, &frame), IRIS_OK);
    for (*frames = 0; now_ms() - start < seconds * 1000; ++*frames) {
        assert_int_equal(iris_capture_next(&frame, &camera, 1000), IRIS_OK);
        assert_true(frame.sequence > last);
        last = frame.sequence;
        assert_int_equal(iris_capture_give(&camera, &frame), IRIS_OK);
        nanosleep(&(struct timespec){0, rest_ms * 1000000L}, NULL);
    }
    *ticks = last - first;
    assert_int_equal(camera.restarts, 0);
    assert_int_equal(camera.returns, 0);
    assert_int_equal(camera.damaged, 0);
}

static void every_frame_of_ten_minutes(void **state)
{
    (void)state;
    uint64_t frames, ticks;
    open_camera(IRIS_CAPTURE_EVERY);
    watch(&frames, &ticks, 20, 5);
    usage first = used_now();
    watch(&frames, &ticks, 600, 5);
    usage last = used_now();
    print_message("# %d frames in 600 s, %d lost\n", (int)frames, (int)camera.dropped);
    assert_in_range(frames, 600 * RATE - 1, 600 * RATE + 1);
    assert_int_equal(frames, ticks);
    assert_int_equal(camera.dropped, 0);
    assert_int_equal(camera.skipped, 0);
    assert_flat(first, last);
    iris_capture_close(&camera);
}

/* A program that looks at every fourth frame or so: the newest one, and all others are counted. */
static void a_slow_program_has_the_newest(void **state)
{
    (void)state;
    uint64_t frames, ticks;
    open_camera(IRIS_CAPTURE_LATEST);
    watch(&frames, &ticks, 60, 120);
    assert_in_range(frames, 60 * RATE / 5, 60 * RATE / 3);
    assert_in_range(ticks, 60 * RATE - 4, 60 * RATE + 6);
    assert_int_equal(camera.frames + camera.skipped + camera.dropped, ticks + (camera.frames - frames));
    iris_capture_close(&camera);
}

static void set_dropped(int percent)
{
    struct v4l2_control control = {VIVID_DROPPED_PERCENT, percent};
    int handle = open(rig_node("RIG_WEBCAM"), O_RDWR | O_CLOEXEC);
    assert_true(handle >= 0);
    assert_int_equal(ioctl(handle, VIDIOC_S_CTRL, &control), 0);
    close(handle);
}

/* What the driver drops is counted, and nothing else is lost. */
static void what_the_driver_drops_is_counted(void **state)
{
    (void)state;
    uint64_t frames, ticks;
    open_camera(IRIS_CAPTURE_EVERY);
    set_dropped(10);
    watch(&frames, &ticks, 60, 0);
    set_dropped(0);
    print_message("# %d frames, %d dropped by the driver\n", (int)frames, (int)camera.dropped);
    assert_in_range(camera.dropped, 60 * RATE / 20, 60 * RATE / 5);
    assert_in_range(ticks, 60 * RATE - 4, 60 * RATE + 6);
    assert_in_range(camera.frames + camera.dropped, ticks + 1,
                    ticks + 2); /* one before the first may be lost, too */
    iris_capture_close(&camera);
}

static int undropped(void **state)
{
    (void)state;
    set_dropped(0);
    iris_capture_close(&camera);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(every_frame_of_ten_minutes, undropped),
        cmocka_unit_test_teardown(a_slow_program_has_the_newest, undropped),
        cmocka_unit_test_teardown(what_the_driver_drops_is_counted, undropped),
    };
    return cmocka_run_group_tests_name("soak capture", tests, NULL, NULL);
}
