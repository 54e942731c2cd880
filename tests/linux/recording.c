/* Recordings as a source: pictures of 16x12 pixels whose every pixel is the frame's number. */
#include "iris/recording.h"
#include "test.h"

#include <fcntl.h>
#include <stdio.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "iris/bmp.h"
#include "iris/pnm.h"

enum { W = 16, H = 12 };

static uint8_t memory[IRIS_RECORDING_BYTES(W, H, 3)];
static iris_recording device = {.memory = memory, .bytes = sizeof memory};
static iris_capture camera;
static iris_frame frame;
static char folder[64];

static int64_t clock_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static void sleep_ms(int ms)
{
    nanosleep(&(struct timespec){ms / 1000, ms % 1000 * 1000000L}, NULL);
}

static const char *path_of(const char *name)
{
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

/* The bytes of a picture of that many pixels, all of them `value` (green 0 when it has colors). */
static size_t encode(uint8_t *bytes, size_t capacity, iris_size size, iris_format format, int value)
{
    static uint8_t pixels[3 * 64 * 64];
    iris_image image;
    iris_memory_sink sink = {.capacity = capacity};
    sink.data = bytes;
    assert_int_equal(iris_image_wrap(&image, pixels, sizeof pixels, size, 0, format), IRIS_OK);
    for (size_t i = 0; i < sizeof pixels; i++) {
        pixels[i] =
            (uint8_t)(format == IRIS_GRAY8 || i % 3 != 1 ? value + (format != IRIS_GRAY8 && i % 3) : 0);
    }
    assert_int_equal(format == IRIS_BGR888 ? iris_bmp_write(iris_sink_memory(&sink), &image)
                                           : iris_pnm_write(iris_sink_memory(&sink), &image),
                     IRIS_OK);
    return sink.used;
}

static void store(const char *name, const void *bytes, size_t count)
{
    FILE *file = fopen(path_of(name), "ab");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, count, file), count);
    assert_int_equal(fclose(file), 0);
}

/* Adds a picture to a file. */
static void store_picture(const char *name, iris_size size, iris_format format, int value)
{
    uint8_t bytes[8192];
    store(name, bytes, encode(bytes, sizeof bytes, size, format, value));
}

static void store_gray(const char *name, int value)
{
    store_picture(name, (iris_size){W, H}, IRIS_GRAY8, value);
}

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/iris-recording-XXXXXX");
    device.bytes = sizeof memory;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    char command[128];
    (void)state;
    iris_capture_close(&camera);
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command); /* NOLINT(cert-env33-c): a path of our own */
}

static iris_status open_recording(const char *path, const iris_capture_config *config)
{
    return iris_capture_open(&camera, iris_recording_source(&device), path, config);
}

/* The next frame's first byte, which every other pixel agrees with; the frame is given back. */
static int next_value(int32_t timeout_ms)
{
    assert_int_equal(iris_capture_next(&frame, &camera, timeout_ms), IRIS_OK);
    const uint8_t *first = frame.image.data;
    const int bytes = frame.image.format == IRIS_GRAY8 ? 1 : 3;
    for (int y = 0; y < H; y++) {
        const uint8_t *row = iris_image_row(&frame.image, y);
        for (int x = 0; x < W * bytes; x++) {
            assert_int_equal(row[x], first[x % bytes]);
        }
    }
    int value = *first;
    assert_int_equal(iris_capture_give(&camera, &frame), IRIS_OK);
    return value;
}

static void assert_end(iris_status status)
{
    for (int i = 0; i < 4; i++) {
        assert_int_equal(iris_capture_next(&frame, &camera, 100), status);
    }
}

static void a_folder_plays_in_the_order_of_names(void **state)
{
    (void)state;
    char name[32];
    for (int i = 39; i >= 0; i--) {
        snprintf(name, sizeof name, "f%d.pgm", i);
        store_gray(name, i);
    }
    store("f3.txt", "no picture", 10);
    store(".bmp", "no picture", 10);
    assert_int_equal(open_recording(folder, NULL), IRIS_OK);
    assert_int_equal(camera.granted.size.w, W);
    assert_int_equal(camera.granted.size.h, H);
    assert_int_equal(camera.granted.format, IRIS_GRAY8);
    assert_int_equal(camera.granted.stride, W);
    assert_int_equal(camera.granted.rate_millihz, 0);
    assert_int_equal(camera.granted.buffers, 2);
    int sequence = 0;
    for (int tens = 0; tens < 4; tens++) { /* f0 f1 f10 ... f19 f2 f20 ... */
        for (int i = -1; i < 10; i++) {
            if (tens == 0 && i >= 0) {
                break;
            }
            int expected = i < 0 ? tens : tens * 10 + i;
            assert_int_equal(next_value(0), expected);
            assert_int_equal(frame.sequence, sequence++);
        }
    }
    for (int i = 4; i < 10; i++) {
        assert_int_equal(next_value(0), i);
    }
    assert_end(IRIS_ERR_END);
    assert_int_equal(camera.frames, 40);
    assert_int_equal(camera.dropped + camera.skipped + camera.damaged, 0);
}

static void every_format_that_is_wanted(void **state)
{
    (void)state;
    store_picture("a.ppm", (iris_size){W, H}, IRIS_RGB888, 100);
    store_picture("b.bmp", (iris_size){W, H}, IRIS_BGR888, 100);
    store_gray("c.pgm", 50);
    iris_capture_config config = {.format = IRIS_RGB888};
    for (int k = 0; k < 2; k++) {
        assert_int_equal(open_recording(folder, k ? &config : NULL), IRIS_OK);
        assert_int_equal(camera.granted.format, IRIS_RGB888);
        assert_int_equal(next_value(0), 100);
        assert_memory_equal(memory, "\x64\x00\x65", 3);
        assert_int_equal(next_value(0), 101); /* a BMP's first byte is blue */
        assert_memory_equal(memory, "\x65\x00\x64", 3);
        assert_int_equal(next_value(0), 50);
        assert_memory_equal(memory, "\x32\x32\x32", 3);
        iris_capture_close(&camera);
    }
    config.format = IRIS_BGR888;
    assert_int_equal(open_recording(folder, &config), IRIS_OK);
    assert_int_equal(next_value(0), 101);
    iris_capture_close(&camera);
    config.format = IRIS_GRAY8;
    assert_int_equal(open_recording(folder, &config), IRIS_OK);
    assert_int_equal(next_value(0), 42); /* luma */
    assert_int_equal(next_value(0), 42);
    assert_int_equal(next_value(0), 50);
    iris_capture_close(&camera);
    config.format = IRIS_YUYV;
    assert_int_equal(open_recording(folder, &config), IRIS_ERR_FORMAT);
    config.format = IRIS_CAPTURE_NV12;
    assert_int_equal(open_recording(folder, &config), IRIS_ERR_FORMAT);
    assert_true(strlen(iris_capture_problem(&camera)) > 0);
}

static void bad_pictures_are_counted_and_the_others_go_on(void **state)
{
    (void)state;
    store("a.bmp", "", 0);
    store("b.ppm", "P6 is not all", 13);
    store_gray("c.pgm", 3);
    store("d.pgm", "P5 16 12 255\n too few", 21);
    store_picture("e.pgm", (iris_size){W, H + 1}, IRIS_GRAY8, 5);
    assert_int_equal(mkdir(path_of("f.bmp"), 0777), 0);
    assert_int_equal(mkfifo(path_of("g.bmp"), 0777), 0);
    assert_int_equal(symlink("nowhere", path_of("h.bmp")), 0);
    store_gray("i.pgm", 9);
    store("j.bmp", "text", 4);
    assert_int_equal(open_recording(folder, NULL), IRIS_OK);
    assert_int_equal(next_value(100), 3);
    assert_int_equal(frame.sequence, 2);
    assert_int_equal(next_value(100), 9);
    assert_int_equal(frame.sequence, 8);
    assert_int_equal(camera.damaged, 7);
    assert_string_equal(iris_capture_problem(&camera), "h.bmp: no such file or folder");
    assert_end(IRIS_ERR_END);
    assert_int_equal(camera.damaged, 8);
    assert_int_equal(camera.frames, 2);
    assert_int_equal(camera.dropped, 0);
}

static void assert_refused(const char *path, iris_status status, const char *problem)
{
    assert_int_equal(open_recording(path, NULL), status);
    assert_string_equal(iris_capture_problem(&camera), problem);
}

static void what_is_no_recording_is_refused(void **state)
{
    (void)state;
    const char nothing[] = "no .bmp, .pgm, .ppm, or .pnm file in this folder";
    assert_refused(path_of("missing"), IRIS_ERR_IO, "no such file or folder");
    assert_refused(folder, IRIS_ERR_IO, nothing);
    store("a.bmp", "", 0);
    assert_refused(folder, IRIS_ERR_IO, "a.bmp: is empty");
    assert_refused(path_of("a.bmp"), IRIS_ERR_IO, "is empty");
    store("b.bmp", "text", 4);
    assert_refused(folder, IRIS_ERR_IO, "b.bmp: neither BMP nor PGM/PPM");
    assert_refused(path_of("b.bmp"), IRIS_ERR_IO, "neither BMP nor PGM/PPM");
    store("c.pgm", "P2 1 1 255 9", 12);
    assert_refused(path_of("c.pgm"), IRIS_ERR_UNSUPPORTED, "a kind of BMP or PNM that is not read");
    assert_int_equal(mkfifo(path_of("d"), 0777), 0);
    assert_refused(path_of("d"), IRIS_ERR_UNSUPPORTED,
                   "neither a file nor a folder; a pipe goes to standard input");
    store_gray("e.pgm", 1);
    device.bytes = (size_t)W * H - 1;
    assert_refused(path_of("e.pgm"), IRIS_ERR_SCRATCH, "bytes that the memory for a frame must have: 192");
    device.bytes++;
    assert_int_equal(open_recording(path_of("e.pgm"), NULL), IRIS_OK);
    assert_int_equal(next_value(0), 1);
}

static void a_file_may_hold_several_pictures(void **state)
{
    (void)state;
    store_gray("a", 1);
    store_picture("a", (iris_size){W, H}, IRIS_BGR888, 2);
    store_picture("a", (iris_size){W + 1, H}, IRIS_GRAY8, 3);
    store_gray("a", 4);
    assert_int_equal(open_recording(path_of("a"), NULL), IRIS_OK);
    assert_int_equal(next_value(0), 1);
    assert_int_equal(next_value(0), 1); /* luma of 2, 0, 2 */
    assert_int_equal(next_value(100), 4);
    assert_int_equal(frame.sequence, 3);
    assert_int_equal(camera.damaged, 1);
    assert_end(IRIS_ERR_END);
    iris_capture_close(&camera);
    store("a", "garbage", 7);
    assert_int_equal(open_recording(path_of("a"), NULL), IRIS_OK);
    assert_int_equal(next_value(0) + next_value(0) + next_value(100), 6);
    assert_end(IRIS_ERR_TRUNCATED);
    assert_string_equal(iris_capture_problem(&camera), "neither BMP nor PGM/PPM");
}

static void one_frame_is_borrowed_at_a_time(void **state)
{
    (void)state;
    iris_frame second;
    store_gray("a", 1);
    store_gray("a", 2);
    assert_int_equal(open_recording(path_of("a"), NULL), IRIS_OK);
    assert_int_equal(iris_capture_next(&frame, &camera, 0), IRIS_OK);
    assert_int_equal(iris_capture_next(&second, &camera, 0), IRIS_ERR_FULL);
    assert_int_equal(*(const uint8_t *)frame.image.data, 1);
    assert_int_equal(iris_capture_give(&camera, &frame), IRIS_OK);
    assert_int_equal(iris_capture_give(&camera, &frame), IRIS_ERR_ARG);
    assert_int_equal(next_value(0), 2);
}

/* Twenty frames, 0 to 19, in a folder or in one file. */
static const char *twenty(int in_one)
{
    char name[32];
    for (int i = 0; i < 20; i++) {
        snprintf(name, sizeof name, "%02d.pgm", i);
        store_gray(in_one ? "all.pgm" : name, i);
    }
    return in_one ? path_of("all.pgm") : folder;
}

static void frames_come_when_they_are_due(void **state)
{
    (void)state;
    const iris_capture_config config = {.rate_millihz = 200000};
    for (int in_one = 0; in_one < 2; in_one++) {
        int64_t last_us = 0;
        int64_t start_ms = clock_ms();
        assert_int_equal(open_recording(twenty(in_one), &config), IRIS_OK);
        assert_int_equal(camera.granted.rate_millihz, 200000);
        for (int i = 0; i < 20; i++) {
            assert_int_equal(next_value(1000), i);
            assert_true(i == 0 || frame.time_us - last_us == 5000);
            last_us = frame.time_us;
            assert_true(clock_ms() - start_ms >= i * 5 - 1);
        }
        iris_capture_close(&camera);
    }
}

static void a_frame_that_is_not_due_is_a_timeout(void **state)
{
    (void)state;
    const iris_capture_config config = {.rate_millihz = 1000, .policy = IRIS_CAPTURE_LATEST};
    assert_int_equal(open_recording(twenty(0), &config), IRIS_OK);
    assert_int_equal(next_value(0), 0);
    int64_t start_ms = clock_ms();
    assert_int_equal(iris_capture_next(&frame, &camera, 20), IRIS_ERR_TIMEOUT);
    assert_int_equal(iris_capture_next(&frame, &camera, 0), IRIS_ERR_TIMEOUT);
    assert_in_range(clock_ms() - start_ms, 19, 900);
    assert_int_equal(next_value(5000), 1);
    assert_int_equal(camera.frames, 2);
    assert_int_equal(camera.dropped, 0);
}

static void every_frame_comes_to_who_is_late(void **state)
{
    (void)state;
    const iris_capture_config config = {.rate_millihz = 1000000};
    for (int in_one = 0; in_one < 2; in_one++) {
        assert_int_equal(open_recording(twenty(in_one), &config), IRIS_OK);
        sleep_ms(100);
        for (int i = 0; i < 20; i++) {
            assert_int_equal(next_value(0), i);
        }
        assert_end(IRIS_ERR_END);
        assert_int_equal(camera.dropped + camera.skipped, 0);
        iris_capture_close(&camera);
    }
}

static void the_latest_frame_comes_to_who_is_late(void **state)
{
    (void)state;
    const iris_capture_config config = {.rate_millihz = 100000, .policy = IRIS_CAPTURE_LATEST};
    for (int in_one = 0; in_one < 2; in_one++) {
        assert_int_equal(open_recording(twenty(in_one), &config), IRIS_OK);
        int first = next_value(0);
        sleep_ms(85);
        int seen = next_value(0);
        assert_in_range(seen, first + 8 < 19 ? first + 8 : 19, 19);
        assert_int_equal(camera.dropped, seen - 1);
        assert_int_equal(frame.sequence, seen);
        sleep_ms(300);
        assert_true(seen == 19 || next_value(0) == 19);
        assert_end(IRIS_ERR_END);
        assert_int_equal(camera.frames + camera.dropped, 20);
        iris_capture_close(&camera);
    }
}

/* What goes to standard input, from a child that waits before the second part and again before the end. */
static void send(const uint8_t *bytes, size_t first, size_t second, int pause_ms, int last_pause_ms)
{
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        (void)close(ends[0]);
        (void)!write(ends[1], bytes, first);
        sleep_ms(pause_ms);
        (void)!write(ends[1], bytes + first, second);
        sleep_ms(last_pause_ms);
        _exit(0);
    }
    (void)close(ends[1]);
    assert_int_equal(dup2(ends[0], STDIN_FILENO), STDIN_FILENO);
    (void)close(ends[0]);
}

static int end_input(void **state)
{
    (void)close(STDIN_FILENO);
    (void)!open("/dev/null", O_RDONLY);
    while (waitpid(-1, NULL, 0) > 0) {
    }
    return remove_folder(state);
}

static size_t encode_gray(uint8_t *bytes, size_t capacity, int count)
{
    size_t used = 0;
    for (int i = 0; i < count; i++) {
        used += encode(bytes + used, capacity - used, (iris_size){W, H}, IRIS_GRAY8, i);
    }
    return used;
}

static void standard_input_in_pieces(void **state)
{
    (void)state;
    static uint8_t bytes[8192];
    size_t count = encode_gray(bytes, sizeof bytes, 5);
    send(bytes, count / 2, count - count / 2, 300, 1000);
    assert_int_equal(open_recording("-", NULL), IRIS_OK);
    for (int i = 0; i < 5; i++) {
        assert_int_equal(next_value(1000), i);
    }
    int64_t start_ms = clock_ms();
    assert_int_equal(iris_capture_next(&frame, &camera, 20), IRIS_ERR_TIMEOUT);
    assert_in_range(clock_ms() - start_ms, 19, 900);
    assert_int_equal(iris_capture_next(&frame, &camera, 5000), IRIS_ERR_END);
    assert_end(IRIS_ERR_END);
}

static void standard_input_that_is_late_shifts_what_follows(void **state)
{
    (void)state;
    static uint8_t bytes[8192];
    const iris_capture_config config = {.rate_millihz = 4000, .policy = IRIS_CAPTURE_LATEST};
    size_t count = encode_gray(bytes, sizeof bytes, 4);
    send(bytes, count / 4, count - count / 4, 900, 0);
    assert_int_equal(open_recording("-", &config), IRIS_OK);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(next_value(2000), i);
    }
    assert_int_equal(camera.dropped, 0);
}

static void standard_input_that_stops_within_a_picture(void **state)
{
    (void)state;
    static uint8_t bytes[8192];
    size_t count = encode_gray(bytes, sizeof bytes, 2);
    send(bytes, count - 5, 0, 3500, 0); /* open, but silent */
    assert_int_equal(open_recording("-", NULL), IRIS_OK);
    assert_int_equal(next_value(0), 0);
    int64_t start_ms = clock_ms();
    assert_int_equal(iris_capture_next(&frame, &camera, 10), IRIS_ERR_TRUNCATED);
    assert_in_range(clock_ms() - start_ms, IRIS_RECORDING_PICTURE_MS - 10, IRIS_RECORDING_PICTURE_MS + 1400);
    assert_string_equal(iris_capture_problem(&camera), "the picture did not come to its end in time");
    assert_end(IRIS_ERR_TRUNCATED);
}

static void standard_input_that_ends_within_a_picture(void **state)
{
    (void)state;
    static uint8_t bytes[8192];
    size_t count = encode_gray(bytes, sizeof bytes, 2);
    send(bytes, count - 5, 0, 0, 0);
    assert_int_equal(open_recording("-", NULL), IRIS_OK);
    assert_int_equal(next_value(0), 0);
    assert_end(IRIS_ERR_TRUNCATED);
    assert_string_equal(iris_capture_problem(&camera), "ends too early");
}

static void nothing_stays_open(void **state)
{
    (void)state;
    int before = dup(STDERR_FILENO);
    (void)close(before);
    store_gray("a.pgm", 1);
    store("b.pgm", "P5", 2);
    store("c.pgm", "P5 99 9 255\n", 12);
    for (int i = 0; i < 50; i++) {
        (void)open_recording(i % 4 == 0 ? folder
                                        : path_of(i % 4 == 1   ? "a.pgm"
                                                  : i % 4 == 2 ? "b.pgm"
                                                               : "c.pgm"),
                             NULL);
        while (iris_capture_next(&frame, &camera, 0) == IRIS_OK) {
            (void)iris_capture_give(&camera, &frame);
        }
        iris_capture_close(&camera);
    }
    int after = dup(STDERR_FILENO);
    (void)close(after);
    assert_int_equal(before, after);
}

#define TEST(name)      cmocka_unit_test_setup_teardown(name, make_folder, remove_folder)
#define TEST_PIPE(name) cmocka_unit_test_setup_teardown(name, make_folder, end_input)

int main(void)
{
    const struct CMUnitTest tests[] = {TEST(a_folder_plays_in_the_order_of_names),
                                       TEST(every_format_that_is_wanted),
                                       TEST(bad_pictures_are_counted_and_the_others_go_on),
                                       TEST(what_is_no_recording_is_refused),
                                       TEST(a_file_may_hold_several_pictures),
                                       TEST(one_frame_is_borrowed_at_a_time),
                                       TEST(frames_come_when_they_are_due),
                                       TEST(a_frame_that_is_not_due_is_a_timeout),
                                       TEST(every_frame_comes_to_who_is_late),
                                       TEST(the_latest_frame_comes_to_who_is_late),
                                       TEST_PIPE(standard_input_in_pieces),
                                       TEST_PIPE(standard_input_that_is_late_shifts_what_follows),
                                       TEST_PIPE(standard_input_that_stops_within_a_picture),
                                       TEST_PIPE(standard_input_that_ends_within_a_picture),
                                       TEST(nothing_stays_open)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
