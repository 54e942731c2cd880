/* Serial ports behind real drivers, in the virtual machine: the far end is its host, reached by the command `rig`. */
#define _XOPEN_SOURCE 700
#include "iris/command.h"
#include "iris/serial.h"
#include "rig.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

static const char *const unplugged = "the other end hung up, or the device was unplugged";

static uint32_t now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint32_t)now.tv_sec * 1000u + (uint32_t)(now.tv_nsec / 1000000);
}

static void pause_ms(int ms)
{
    nanosleep(&(struct timespec){ms / 1000, ms % 1000 * 1000000L}, NULL);
}

/* What arrived at the far end and was not looked at yet; waits for `count` bytes, for five seconds at most. */
static size_t far_end(char *bytes, size_t capacity, const char *port, size_t count)
{
    char command[80];
    snprintf(command, sizeof command, "rig received %s %zu", port, count);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    size_t have = fread(bytes, 1, capacity, pipe);
    assert_int_equal(pclose(pipe), 0);
    assert_true(have < capacity);
    return have;
}

static iris_status send_seq(iris_serial *serial, size_t *bytes, int32_t seq)
{
    char sentence[IRIS_COMMAND_SENTENCE_BYTES];
    iris_command command = {seq, IRIS_LINE_FOUND, -180, 750, -1250, -93, 880};
    size_t length = 0;
    uint32_t sent = serial->sent;
    assert_int_equal(iris_command_format(sentence, sizeof sentence, &length, &command), IRIS_OK);
    iris_status status = iris_serial_send(serial, sentence, length, now_ms());
    *bytes += serial->sent != sent ? length : 0;
    return status;
}

/* The good sentences in these bytes, which must be in order after *last; *broken counts those that were not good. */
static uint32_t good_sentences(int32_t *last, uint32_t *broken, const char *bytes, size_t count)
{
    iris_command_parser parser = {0};
    uint32_t good = 0;
    for (size_t i = 0; i < count; i++) {
        iris_command command;
        iris_status status = iris_command_parse(&command, &parser, bytes[i]);
        if (status == IRIS_OK) {
            assert_true(command.seq > *last);
            *last = command.seq;
            good++;
        }
        *broken += status == IRIS_ERR_DATA;
    }
    return good;
}

static char arrived[65536];

static void sentences_arrive_whole(const char *port, const char *path, int32_t baud, int every_ms)
{
    iris_serial serial;
    size_t bytes = 0;
    char request[32];
    snprintf(request, sizeof request, "clear %s", port);
    rig(request);
    assert_int_equal(iris_serial_open(&serial, path, baud, 500, now_ms()), IRIS_OK);
    iris_status status = IRIS_OK;
    for (int32_t seq = 1; seq <= 100; seq++) {
        status = send_seq(&serial, &bytes, seq);
        assert_true(status == IRIS_OK || status == IRIS_ERR_FULL);
        pause_ms(every_ms);
    }
    for (int i = 0; i < 200 && status == IRIS_ERR_FULL; i++) {
        pause_ms(10);
        status = iris_serial_continue(&serial, now_ms());
    }
    assert_int_equal(status, IRIS_OK);
    iris_serial_close(&serial);
    assert_int_equal(serial.sent + serial.dropped, 100);
    int32_t last = 0;
    uint32_t broken = 0;
    size_t have = far_end(arrived, sizeof arrived, port, bytes);
    assert_int_equal(good_sentences(&last, &broken, arrived, have), serial.sent);
    assert_int_equal(broken, 0);
    assert_int_equal(last, 100);
}

static void sentences_arrive_whole_at_every_speed(void **state)
{
    (void)state;
    const char *path = rig_node("RIG_SERIAL");
    sentences_arrive_whole("serial", path, 9600, 5);
    sentences_arrive_whole("serial", path, 115200, 1);
    sentences_arrive_whole("serial", path, 115200, 0);
}

static void sentences_arrive_whole_over_usb(void **state)
{
    (void)state;
    const char *path = rig_node("RIG_USB_SERIAL");
    sentences_arrive_whole("usb", path, 9600, 5);
    sentences_arrive_whole("usb", path, 115200, 0);
}

static void bytes_arrive_from_the_far_end(void **state)
{
    (void)state;
    static const char *const ports[][2] = {{"RIG_SERIAL", "serial"}, {"RIG_USB_SERIAL", "usb"}};
    for (int i = 0; i < 2; i++) {
        char command[120];
        uint8_t back[64];
        size_t have = 0, count = 0;
        iris_serial serial;
        assert_int_equal(iris_serial_open(&serial, rig_node(ports[i][0]), 115200, 500, now_ms()), IRIS_OK);
        snprintf(command, sizeof command, "printf '\\000\\021\\023\\003\\377\\n\\r' | rig send %s",
                 ports[i][1]);
        assert_int_equal(system(command), 0);
        for (int turn = 0; turn < 500 && have < 7; turn++) {
            assert_int_equal(iris_serial_receive(back + have, &count, &serial, sizeof back - have, now_ms()),
                             IRIS_OK);
            have += count;
            pause_ms(10);
        }
        assert_int_equal(have, 7);
        assert_memory_equal(back, "\000\021\023\003\377\n\r", 7);
        iris_serial_close(&serial);
    }
}

/* Sends every 10 ms until the port is away (or back); the sentences that it took. */
static int32_t send_until(iris_status wanted, iris_serial *serial, size_t *bytes, int32_t seq)
{
    for (int turn = 0; turn < 500; turn++) {
        iris_status status = send_seq(serial, bytes, ++seq);
        if (status == wanted) {
            return seq;
        }
        pause_ms(10);
    }
    fail_msg("not %s within 5 s", iris_status_text(wanted));
    return seq;
}

/* While sentences leave at full speed the cable is pulled, and some time later put back; again and again. */
static void unplugged_in_mid_stream_and_plugged_again(void **state)
{
    (void)state;
    const char *path = rig_node("RIG_USB_SERIAL");
    iris_serial serial;
    size_t bytes = 0;
    int32_t seq = 0, last = 0;
    uint32_t broken = 0, good = 0;
    rig("clear usb");
    assert_int_equal(iris_serial_open(&serial, path, 115200, 50, now_ms()), IRIS_OK);
    const int handle = serial.handle;
    for (uint32_t round = 1; round <= 3; round++) {
        for (int i = 0; i < 10; i++) {
            (void)send_seq(&serial, &bytes, ++seq);
            pause_ms(2);
        }
        assert_int_equal(system("(sleep 0.1; rig unplug; touch /tmp/gone) &"), 0);
        seq = send_until(IRIS_ERR_IO, &serial, &bytes, seq);
        if (serial.error != ENODEV) { /* which is what a write meets while the device goes */
            assert_string_equal(iris_serial_error(&serial), unplugged);
        }
        assert_int_equal(serial.handle, -1);
        assert_int_equal(serial.reconnects, round - 1);
        for (int i = 0; i < 500 && access("/tmp/gone", F_OK) != 0; i++) {
            pause_ms(10);
        }
        assert_int_equal(unlink("/tmp/gone"), 0);
        pause_ms(60);
        assert_int_equal(send_seq(&serial, &bytes, ++seq), IRIS_ERR_IO); /* tried: not there */
        assert_string_equal(iris_serial_error(&serial), "no such device");

        /* What left before may be cut, at its end only. */
        size_t have = far_end(arrived, sizeof arrived, "usb", 0);
        good += good_sentences(&last, &broken, arrived, have);
        assert_int_equal(broken, 0);
        rig("plug");
        seq = send_until(IRIS_OK, &serial, &bytes, seq);
        assert_int_equal(serial.reconnects, round);
        assert_int_equal(serial.handle, handle); /* the old one was closed: nothing leaks */
        bytes = 0;
        seq = send_until(IRIS_OK, &serial, &bytes, seq);
        have = far_end(arrived, sizeof arrived, "usb", bytes);
        good += good_sentences(&last, &broken, arrived, have);
        assert_int_equal(broken, 0);
        assert_int_equal(last, seq);
    }
    iris_serial_close(&serial);
    assert_int_equal(serial.sent + serial.dropped, seq);
    assert_in_range(good, 1, serial.sent); /* what the system held died with the port */
}

static void unplugged_while_reading(void **state)
{
    (void)state;
    iris_serial serial;
    char byte;
    size_t count = 99;
    assert_int_equal(iris_serial_open(&serial, rig_node("RIG_USB_SERIAL"), 115200, 0, now_ms()), IRIS_OK);
    assert_int_equal(iris_serial_receive(&byte, &count, &serial, 1, now_ms()), IRIS_OK);
    assert_int_equal(count, 0);
    rig("unplug");
    assert_int_equal(iris_serial_receive(&byte, &count, &serial, 1, now_ms()), IRIS_ERR_IO);
    assert_string_equal(iris_serial_error(&serial), unplugged);
    assert_int_equal(iris_serial_receive(&byte, &count, &serial, 1, now_ms()), IRIS_ERR_IO);
    assert_string_equal(iris_serial_error(&serial), "no such device");
    rig("plug");
    assert_int_equal(iris_serial_receive(&byte, &count, &serial, 1, now_ms()), IRIS_OK);
    assert_int_equal(serial.reconnects, 1);
    iris_serial_close(&serial);
}

/* Its settings outlive the unplugging: the new device starts with the driver's own. */
static void speed_is_set_again_after_plugging(void **state)
{
    (void)state;
    const char *path = rig_node("RIG_USB_SERIAL");
    iris_serial serial;
    struct termios now;
    assert_int_equal(iris_serial_open(&serial, path, 38400, 0, now_ms()), IRIS_OK);
    rig("unplug");
    assert_int_equal(iris_serial_send(&serial, "x", 1, now_ms()), IRIS_ERR_IO);
    rig("plug");
    assert_int_equal(iris_serial_send(&serial, "x", 1, now_ms()), IRIS_OK);
    assert_int_equal(tcgetattr(serial.handle, &now), 0);
    assert_int_equal(cfgetospeed(&now), B38400);
    assert_int_equal(now.c_lflag & (ICANON | ECHO), 0);
    iris_serial_close(&serial);
}

static void a_node_without_hardware_is_refused(void **state)
{
    (void)state;
    iris_serial serial;
    assert_int_equal(iris_serial_open(&serial, rig_node("RIG_BARE_SERIAL"), 9600, 0, 0), IRIS_ERR_IO);
    assert_string_equal(iris_serial_error(&serial), "no device behind this name");
    assert_int_equal(serial.handle, -1);
    assert_int_equal(iris_serial_send(&serial, "x", 1, 1), IRIS_ERR_IO);
    iris_serial_close(&serial);
}

/* Be it nobody, or root. */
static void a_second_user_is_kept_out(void **state)
{
    (void)state;
    const char *path = rig_node("RIG_SERIAL");
    iris_serial serial;
    assert_int_equal(chmod(path, 0666), 0);
    assert_int_equal(iris_serial_open(&serial, path, 9600, 0, 0), IRIS_OK);
    for (int is_root = 0; is_root < 2; is_root++) {
        pid_t child = fork();
        if (child == 0) {
            iris_serial second;
            int kept_out = (is_root || setuid(65534) == 0) &&
                           iris_serial_open(&second, path, 9600, 0, 0) == IRIS_ERR_IO &&
                           strcmp(iris_serial_error(&second), "another program has the port") == 0;
            _exit(kept_out ? 0 : 1);
        }
        int status = -1;
        assert_int_equal(waitpid(child, &status, 0), child);
        assert_int_equal(status, 0);
    }
    iris_serial_close(&serial);
}

/* After a failure the next test finds its port again. */
static int plugged(void **state)
{
    (void)state;
    return system("[ -e \"$RIG_USB_SERIAL\" ] || rig plug");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sentences_arrive_whole_at_every_speed),
        cmocka_unit_test(sentences_arrive_whole_over_usb),
        cmocka_unit_test(bytes_arrive_from_the_far_end),
        cmocka_unit_test_teardown(unplugged_in_mid_stream_and_plugged_again, plugged),
        cmocka_unit_test_teardown(unplugged_while_reading, plugged),
        cmocka_unit_test_teardown(speed_is_set_again_after_plugging, plugged),
        cmocka_unit_test(a_node_without_hardware_is_refused),
        cmocka_unit_test(a_second_user_is_kept_out),
    };
    return cmocka_run_group_tests_name("serial_ports", tests, NULL, NULL);
}
