/* Serial ports over pseudo-terminals, with both ends in this program. The robot's end is the master. */
#define _XOPEN_SOURCE 700
#include "iris/serial.h"
#include "iris/command.h"
#include "test.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

/* The library's write and ioctl come here, so that the port can fail, take part of a sentence, or be slow. */
static ssize_t write_limit = -1; /* bytes that one write takes; -1: all */
static int write_error;          /* errno of the next writes; 0: none */
static int queued;               /* bytes that TIOCOUTQ reports on top */

/* NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): the system's are reserved names */
ssize_t write(int handle, const void *bytes, size_t count)
{
    if (write_error != 0) {
        errno = write_error;
        return -1;
    }
    if (write_limit == 0) {
        errno = EAGAIN;
        return -1;
    }
    if (write_limit > 0 && count > (size_t)write_limit) {
        count = (size_t)write_limit;
    }
    return syscall(SYS_write, handle, bytes, count);
}

/* NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): as above, the system's are reserved names */
int ioctl(int handle, unsigned long request, ...)
{
    va_list arguments;
    va_start(arguments, request);
    void *argument = va_arg(arguments, void *);
    va_end(arguments);
    int result = (int)syscall(SYS_ioctl, handle, request, argument);
    if (result == 0 && request == TIOCOUTQ) {
        *(int *)argument += queued;
    }
    return result;
}

static int open_master(char *slave_path, size_t capacity)
{
    int master = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
    assert_true(master >= 0);
    assert_int_equal(grantpt(master), 0);
    assert_int_equal(unlockpt(master), 0);
    const char *name = ptsname(master);
    assert_non_null(name);
    assert_true(strlen(name) < capacity);
    strcpy(slave_path, name);
    return master;
}

/* Everything that is there for the robot, up to capacity; waits a little for the first byte only if there is
 * none. */
static size_t read_all(int master, char *bytes, size_t capacity)
{
    size_t have = 0;
    for (int quiet = 0; quiet < 20 && have < capacity;) {
        ssize_t got = read(master, bytes + have, capacity - have);
        if (got > 0) {
            have += (size_t)got;
            quiet = 0;
        } else {
            quiet++;
            nanosleep(&(struct timespec){0, 500000}, NULL);
        }
    }
    return have;
}

static size_t sentence_of(char *sentence, int32_t seq)
{
    iris_command command = {seq, IRIS_LINE_FOUND, -180, 750, -1250, -93, 880};
    size_t length = 0;
    assert_int_equal(iris_command_format(sentence, IRIS_COMMAND_SENTENCE_BYTES, &length, &command), IRIS_OK);
    return length;
}

static iris_status send_seq(iris_serial *serial, int32_t seq, uint32_t now_ms)
{
    char sentence[IRIS_COMMAND_SENTENCE_BYTES];
    size_t length = sentence_of(sentence, seq);
    return iris_serial_send(serial, sentence, length, now_ms);
}

/* The sequence numbers of the good sentences in these bytes; how many, and *broken the ones that were not. */
static int sequences(int32_t *seqs, int *broken, iris_command_parser *parser, const char *bytes, size_t count)
{
    int good = 0;
    for (size_t i = 0; i < count; i++) {
        iris_command command;
        iris_status status = iris_command_parse(&command, parser, bytes[i]);
        if (status == IRIS_OK) {
            seqs[good++] = command.seq;
        }
        *broken += status == IRIS_ERR_DATA;
    }
    return good;
}

static int heal(void **state)
{
    (void)state;
    write_limit = -1;
    write_error = 0;
    queued = 0;
    return 0;
}

static void every_byte_passes_both_ways(void **state)
{
    (void)state;
    char path[64];
    int master = open_master(path, sizeof path);
    iris_serial serial;
    assert_int_equal(iris_serial_open(&serial, path, 115200, 500, 0), IRIS_OK);
    uint8_t all[256], back[512];
    for (int i = 0; i < 256; i++) {
        all[i] = (uint8_t)i;
    }
    assert_int_equal(iris_serial_send(&serial, (char *)all, 128, 1), IRIS_OK);
    assert_int_equal(iris_serial_send(&serial, (char *)all + 128, 128, 2), IRIS_OK);
    assert_int_equal(read_all(master, (char *)back, 256), 256);
    assert_memory_equal(back, all, 256);
    assert_int_equal(read_all(master, (char *)back, 256), 0); /* and no echo below */

    size_t have = 0, count = 99;
    assert_int_equal(iris_serial_receive(back, &count, &serial, sizeof back, 3), IRIS_OK);
    assert_int_equal(count, 0);
    assert_int_equal(syscall(SYS_write, master, all, (size_t)256), 256);
    for (int i = 0; i < 200 && have < 256; i++) {
        assert_int_equal(iris_serial_receive(back + have, &count, &serial, 7, 4), IRIS_OK);
        have += count;
        nanosleep(&(struct timespec){0, count ? 0 : 1000000}, NULL);
    }
    assert_int_equal(have, 256);
    assert_memory_equal(back, all, 256);
    assert_int_equal(read_all(master, (char *)back, 256), 0);
    assert_int_equal(iris_serial_receive(back, &count, &serial, 0, 5), IRIS_OK);
    assert_int_equal(serial.sent, 2);
    assert_int_equal(serial.dropped, 0);
    iris_serial_close(&serial);
    close(master);
}

static void settings_are_really_set(void **state)
{
    (void)state;
    static const struct {
        int32_t baud;
        speed_t speed;
    } speeds[] = {
        {1200, B1200},       {1800, B1800},       {2400, B2400},       {4800, B4800},
        {9600, B9600},       {19200, B19200},     {38400, B38400},     {57600, B57600},
        {115200, B115200},   {230400, B230400},   {460800, B460800},   {500000, B500000},
        {576000, B576000},   {921600, B921600},   {1000000, B1000000}, {1152000, B1152000},
        {1500000, B1500000}, {2000000, B2000000}, {2500000, B2500000}, {3000000, B3000000},
        {3500000, B3500000}, {4000000, B4000000},
    };
    char path[64];
    int master = open_master(path, sizeof path);
    int watcher = open(path, O_RDWR | O_NOCTTY);
    for (size_t i = 0; i < sizeof speeds / sizeof speeds[0]; i++) {
        iris_serial serial;
        assert_int_equal(iris_serial_open(&serial, path, speeds[i].baud, 500, 0), IRIS_OK);
        struct termios now;
        assert_int_equal(tcgetattr(watcher, &now), 0);
        assert_int_equal(cfgetospeed(&now), speeds[i].speed);
        assert_int_equal(cfgetispeed(&now), speeds[i].speed);
        assert_int_equal(now.c_cflag & (CSIZE | PARENB | CSTOPB | CRTSCTS | CLOCAL | CREAD),
                         CS8 | CLOCAL | CREAD);
        assert_int_equal(now.c_lflag & (ICANON | ECHO | ISIG | IEXTEN), 0);
        assert_int_equal(now.c_iflag & (IXON | IXOFF | IXANY | ICRNL | INLCR | IGNCR | ISTRIP), 0);
        assert_int_equal(now.c_oflag & OPOST, 0);
        int exclusive = 0;
        assert_int_equal(ioctl(watcher, TIOCGEXCL, &exclusive), 0);
        assert_int_equal(exclusive, 1);
        iris_serial_close(&serial);
        assert_int_equal(ioctl(watcher, TIOCGEXCL, &exclusive), 0);
        assert_int_equal(exclusive, 0);
    }
    close(watcher);
    close(master);
}

static void what_is_no_port_is_refused(void **state)
{
    (void)state;
    char directory[] = "/tmp/iris-serial-XXXXXX", file[64], missing[64];
    assert_non_null(mkdtemp(directory));
    snprintf(file, sizeof file, "%s/file", directory);
    snprintf(missing, sizeof missing, "%s/missing", directory);
    FILE *out = fopen(file, "w");
    assert_non_null(out);
    fputs("kept", out);
    fclose(out);
    iris_serial serial;
    assert_int_equal(iris_serial_open(&serial, missing, 9600, 500, 0), IRIS_ERR_IO);
    assert_string_equal(iris_serial_error(&serial), "no such device");
    iris_serial_close(&serial);
    assert_int_equal(iris_serial_open(&serial, "", 9600, 500, 0), IRIS_ERR_IO);
    const char *const not_ports[] = {file, directory, "/dev/null"};
    for (int i = 0; i < 3; i++) {
        assert_int_equal(iris_serial_open(&serial, not_ports[i], 9600, 500, 0), IRIS_ERR_IO);
        assert_string_equal(iris_serial_error(&serial), "not a serial port");
        assert_int_equal(serial.handle, -1);
        assert_int_equal(send_seq(&serial, 1, 1), IRIS_ERR_IO);
        assert_int_equal(serial.dropped, 1);
        iris_serial_close(&serial);
    }
    struct stat info;
    assert_int_equal(stat(file, &info), 0);
    assert_int_equal(info.st_size, 4);
    unlink(file);
    rmdir(directory);

    iris_serial untouched;
    memset(&untouched, 0x5a, sizeof untouched);
    memset(&serial, 0x5a, sizeof serial);
    static const int32_t bad_bauds[] = {0, -1, 1, 50, 110, 300, 9601, 115201, 4000001, INT32_MAX, INT32_MIN};
    for (size_t i = 0; i < sizeof bad_bauds / sizeof bad_bauds[0]; i++) {
        assert_int_equal(iris_serial_open(&serial, "/dev/null", bad_bauds[i], 500, 0), IRIS_ERR_ARG);
    }
    assert_int_equal(iris_serial_open(&serial, NULL, 9600, 500, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_serial_open(NULL, "/dev/null", 9600, 500, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_serial_open(&serial, "/dev/null", 9600, -1, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_serial_open(&serial, "/dev/null", 9600, 60001, 0), IRIS_ERR_ARG);
    assert_memory_equal(&serial, &untouched, sizeof serial);
}

static void arguments_are_checked(void **state)
{
    (void)state;
    char path[64];
    int master = open_master(path, sizeof path);
    iris_serial serial;
    size_t count;
    char byte[1];
    assert_int_equal(iris_serial_open(&serial, path, 9600, 500, 0), IRIS_OK);
    assert_int_equal(iris_serial_send(NULL, "x", 1, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_serial_send(&serial, NULL, 1, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_serial_send(&serial, "x", 0, 0), IRIS_ERR_RANGE);
    assert_int_equal(iris_serial_send(&serial, "x", IRIS_SERIAL_SENTENCE_MAX + 1, 0), IRIS_ERR_RANGE);
    assert_int_equal(iris_serial_continue(NULL, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_serial_receive(NULL, &count, &serial, 1, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_serial_receive(byte, NULL, &serial, 1, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_serial_receive(byte, &count, NULL, 1, 0), IRIS_ERR_ARG);
    iris_serial_close(NULL);
    iris_serial_close(&serial);
    iris_serial_close(&serial);
    assert_int_equal(send_seq(&serial, 1, 100000), IRIS_ERR_IO); /* closed is closed */
    assert_int_equal(iris_serial_receive(byte, &count, &serial, 1, 200000), IRIS_ERR_IO);
    iris_serial zeroed = {0};
    iris_serial_close(&zeroed); /* does not close standard input */
    assert_int_equal(iris_serial_continue(&zeroed, 100000), IRIS_ERR_IO);
    assert_true(fcntl(0, F_GETFD) >= 0 || errno == EBADF);
    assert_non_null(iris_serial_error(NULL));
    for (int error = -1; error < 200; error++) {
        serial.error = error;
        assert_true(strlen(iris_serial_error(&serial)) > 5);
    }
    close(master);
}

/* Nobody reads: the pseudo-terminal's buffer fills, and not one call waits. Then somebody reads. */
static void a_blocked_port_keeps_the_newest(void **state)
{
    (void)state;
    char path[64];
    int master = open_master(path, sizeof path);
    iris_serial serial;
    assert_int_equal(iris_serial_open(&serial, path, 115200, 500, 0), IRIS_OK);
    enum { CALLS = 9000 };
    int full = 0;
    double longest_ms = 0;
    for (int32_t seq = 0; seq < CALLS; seq++) {
        struct timespec before, after;
        clock_gettime(CLOCK_MONOTONIC, &before);
        iris_status status = send_seq(&serial, seq, (uint32_t)seq);
        clock_gettime(CLOCK_MONOTONIC, &after);
        double ms = (after.tv_sec - before.tv_sec) * 1e3 + (after.tv_nsec - before.tv_nsec) * 1e-6;
        longest_ms = ms > longest_ms ? ms : longest_ms;
        assert_true(status == IRIS_OK || (status == IRIS_ERR_FULL && ++full));
    }
    assert_true(full > 1000);
    assert_true(longest_ms < 2000); /* one call on a busy machine; a call that waits would never come back */
    assert_int_equal(serial.sent + serial.dropped + (serial.length > 0) + (serial.waiting > 0), CALLS);

    static char bytes[1 << 20];
    static int32_t seqs[CALLS];
    size_t have = read_all(master, bytes, sizeof bytes);
    while (iris_serial_continue(&serial, CALLS) == IRIS_ERR_FULL) {
        have += read_all(master, bytes + have, sizeof bytes - have);
    }
    have += read_all(master, bytes + have, sizeof bytes - have);
    iris_command_parser parser = {0};
    int broken = 0;
    int good = sequences(seqs, &broken, &parser, bytes, have);
    assert_int_equal(broken, 0);
    assert_int_equal(good, serial.sent);
    assert_int_equal(serial.sent + serial.dropped, CALLS);
    assert_int_equal(seqs[good - 1], CALLS - 1); /* the newest arrived */
    for (int i = 1; i < good; i++) {
        assert_true(seqs[i] > seqs[i - 1]);
    }
    iris_serial_close(&serial);
    close(master);
}

/* For every n: the port takes n bytes at a time. */
static void short_writes_are_continued(void **state)
{
    (void)state;
    char path[64];
    int master = open_master(path, sizeof path);
    for (ssize_t n = 1; n <= 45; n++) {
        iris_serial serial;
        assert_int_equal(iris_serial_open(&serial, path, 115200, 500, 0), IRIS_OK);
        write_limit = n;
        iris_status status = IRIS_OK;
        for (int32_t seq = 1; seq <= 60; seq++) {
            status = send_seq(&serial, seq, 0);
        }
        for (int i = 0; i < 100 && status == IRIS_ERR_FULL; i++) {
            status = iris_serial_continue(&serial, 0);
        }
        assert_int_equal(status, IRIS_OK);
        char bytes[4096];
        int32_t seqs[64];
        int broken = 0;
        iris_command_parser parser = {0};
        size_t have = read_all(master, bytes, sizeof bytes);
        int good = sequences(seqs, &broken, &parser, bytes, have);
        assert_int_equal(broken, 0);
        assert_int_equal(good, serial.sent);
        assert_int_equal(serial.sent + serial.dropped, 60);
        assert_int_equal(seqs[0], 1);
        assert_int_equal(seqs[good - 1], 60);
        write_limit = -1;
        iris_serial_close(&serial);
    }
    close(master);
}

/* A sentence that has not begun is replaced; one that has begun is finished; a slow line's queue is not
 * filled. */
static void the_newest_waits(void **state)
{
    (void)state;
    char path[64], bytes[512];
    int master = open_master(path, sizeof path);
    iris_serial serial;
    assert_int_equal(iris_serial_open(&serial, path, 1200, 500, 0), IRIS_OK);
    int32_t seqs[8];
    int broken = 0;
    iris_command_parser parser = {0};

    write_limit = 0;
    assert_int_equal(send_seq(&serial, 1, 0), IRIS_ERR_FULL);
    assert_int_equal(send_seq(&serial, 2, 0), IRIS_ERR_FULL);
    assert_int_equal(serial.dropped, 1);
    write_limit = 5;
    assert_int_equal(send_seq(&serial, 3, 0), IRIS_ERR_FULL); /* 3 begins */
    write_limit = 0;
    assert_int_equal(send_seq(&serial, 4, 0), IRIS_ERR_FULL);
    assert_int_equal(send_seq(&serial, 5, 0), IRIS_ERR_FULL);
    write_limit = -1;
    assert_int_equal(iris_serial_continue(&serial, 0), IRIS_OK);
    assert_int_equal(sequences(seqs, &broken, &parser, bytes, read_all(master, bytes, sizeof bytes)), 2);
    assert_int_equal(seqs[0], 3);
    assert_int_equal(seqs[1], 5);
    assert_int_equal(serial.sent, 2);
    assert_int_equal(serial.dropped, 3);

    queued = 1; /* bytes of the last sentence are still on the line */
    assert_int_equal(send_seq(&serial, 6, 0), IRIS_ERR_FULL);
    assert_int_equal(send_seq(&serial, 7, 0), IRIS_ERR_FULL);
    queued = 0;
    assert_int_equal(send_seq(&serial, 8, 0), IRIS_OK);
    assert_int_equal(sequences(seqs, &broken, &parser, bytes, read_all(master, bytes, sizeof bytes)), 1);
    assert_int_equal(seqs[0], 8);
    assert_int_equal(broken, 0);

    write_error = EINTR;
    assert_int_equal(send_seq(&serial, 9, 0), IRIS_ERR_FULL);
    assert_true(serial.handle >= 0);
    iris_serial_close(&serial);
    assert_int_equal(serial.dropped, 6);
    close(master);
}

/* Also by root, whom the terminal itself lets in. */
static void a_port_has_one_user(void **state)
{
    (void)state;
    char path[64];
    int master = open_master(path, sizeof path);
    struct termios now;
    iris_serial first, second;
    assert_int_equal(iris_serial_open(&first, path, 9600, 0, 0), IRIS_OK);
    assert_int_equal(iris_serial_open(&second, path, 115200, 0, 0), IRIS_ERR_IO);
    assert_string_equal(iris_serial_error(&second), "another program has the port");
    assert_int_equal(tcgetattr(first.handle, &now), 0);
    assert_int_equal(cfgetospeed(&now), B9600);
    iris_serial_close(&second);
    int copy = dup(first.handle);
    iris_serial_close(&first);
    assert_int_equal(iris_serial_open(&second, path, 9600, 0, 0), IRIS_OK);
    iris_serial_close(&second);
    close(copy);
    close(master);
}

/* The cable is pulled, in the middle of a sentence too; another device appears under the same name. */
static void a_lost_port_comes_back(void **state)
{
    (void)state;
    char path[64], link[80], directory[] = "/tmp/iris-serial-XXXXXX", bytes[512];
    assert_non_null(mkdtemp(directory));
    snprintf(link, sizeof link, "%s/port", directory);
    int master = open_master(path, sizeof path);
    assert_int_equal(symlink(path, link), 0);
    iris_serial serial;
    const uint32_t start = UINT32_MAX - 1200; /* the caller's clock wraps on the way */
    assert_int_equal(iris_serial_open(&serial, link, 115200, 500, start), IRIS_OK);
    assert_int_equal(send_seq(&serial, 1, start), IRIS_OK);
    write_limit = 10;
    assert_int_equal(send_seq(&serial, 2, start + 10), IRIS_ERR_FULL);
    write_limit = -1;
    int32_t seqs[8];
    int broken = 0;
    iris_command_parser parser = {0};
    assert_int_equal(sequences(seqs, &broken, &parser, bytes, read_all(master, bytes, sizeof bytes)), 1);
    close(master);

    assert_int_equal(send_seq(&serial, 3, start + 1000), IRIS_ERR_IO);
    assert_string_equal(iris_serial_error(&serial), "the other end hung up, or the device was unplugged");
    assert_int_equal(serial.dropped, 2);
    assert_int_equal(send_seq(&serial, 4, start + 1100), IRIS_ERR_IO);
    assert_int_equal(serial.error, EIO);                               /* not tried yet */
    assert_int_equal(send_seq(&serial, 5, start + 1500), IRIS_ERR_IO); /* tried: not there */
    unlink(link);
    assert_int_equal(send_seq(&serial, 6, start + 2000), IRIS_ERR_IO);
    assert_string_equal(iris_serial_error(&serial), "no such device");

    master = open_master(path, sizeof path);
    assert_int_equal(symlink(path, link), 0);
    assert_int_equal(send_seq(&serial, 7, start + 2499), IRIS_ERR_IO); /* too early */
    assert_int_equal(serial.reconnects, 0);
    assert_int_equal(send_seq(&serial, 8, start + 2500), IRIS_OK);
    assert_int_equal(serial.reconnects, 1);
    assert_int_equal(serial.sent, 2);
    assert_int_equal(serial.dropped, 6);
    /* the robot's parser, which holds the beginning of sentence 2, finds 8 whole */
    assert_int_equal(sequences(seqs, &broken, &parser, bytes, read_all(master, bytes, sizeof bytes)), 1);
    assert_int_equal(seqs[0], 8);
    assert_int_equal(broken, 1);

    close(master); /* the reading side notices too */
    size_t count = 99;
    assert_int_equal(iris_serial_receive(bytes, &count, &serial, sizeof bytes, start + 2600), IRIS_ERR_IO);
    assert_int_equal(count, 0);
    assert_int_equal(serial.handle, -1);
    assert_int_equal(serial.error, EIO);
    unlink(link);
    rmdir(directory);
    iris_serial_close(&serial);
}

/* The device fails at call n, for every n and every way to fail: an error, no broken sentence, and it goes
 * on. */
static void a_failure_at_every_step_is_survived(void **state)
{
    (void)state;
    static const int errors[] = {EIO, ENODEV, ENXIO, EPIPE};
    char path[64], bytes[4096];
    int master = open_master(path, sizeof path);
    for (int step = 1; step <= 24; step++) {
        iris_serial serial;
        assert_int_equal(iris_serial_open(&serial, path, 9600, 0, 0), IRIS_OK);
        size_t have = 0;
        int failed = 0, handle = serial.handle;
        write_limit = 7;
        for (int32_t seq = 1; seq <= 30; seq++) {
            if (seq == step) { /* what the system holds may die with the port: the robot takes it before */
                have = read_all(master, bytes, sizeof bytes);
            }
            write_error = seq == step ? errors[step % 4] : 0;
            iris_status status = send_seq(&serial, seq, (uint32_t)seq);
            failed += status == IRIS_ERR_IO;
            assert_int_equal(status == IRIS_ERR_IO, seq == step);
        }
        assert_int_equal(failed, 1);
        assert_int_equal(serial.reconnects, 1);
        assert_int_equal(serial.handle, handle); /* the old one was closed: nothing leaks */
        write_limit = -1;
        assert_int_equal(iris_serial_continue(&serial, 50), IRIS_OK);
        assert_int_equal(serial.sent + serial.dropped, 30);
        int32_t seqs[64];
        int broken = 0;
        iris_command_parser parser = {0};
        have += read_all(master, bytes + have, sizeof bytes - have);
        int good = sequences(seqs, &broken, &parser, bytes, have);
        assert_int_equal(good, serial.sent);
        assert_in_range(broken, 0, 1); /* the one cut by the failure */
        assert_int_equal(seqs[good - 1], 30);
        iris_serial_close(&serial);
    }
    close(master);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(every_byte_passes_both_ways, heal),
        cmocka_unit_test_teardown(settings_are_really_set, heal),
        cmocka_unit_test_teardown(what_is_no_port_is_refused, heal),
        cmocka_unit_test_teardown(arguments_are_checked, heal),
        cmocka_unit_test_teardown(a_blocked_port_keeps_the_newest, heal),
        cmocka_unit_test_teardown(short_writes_are_continued, heal),
        cmocka_unit_test_teardown(the_newest_waits, heal),
        cmocka_unit_test_teardown(a_port_has_one_user, heal),
        cmocka_unit_test_teardown(a_lost_port_comes_back, heal),
        cmocka_unit_test_teardown(a_failure_at_every_step_is_survived, heal),
    };
    return cmocka_run_group_tests_name("serial", tests, NULL, NULL);
}
