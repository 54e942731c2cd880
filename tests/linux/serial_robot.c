/* A robot behind a serial port: its other end, a pseudo-terminal's master, is played here. */
#define _XOPEN_SOURCE 700
#include "iris/serial_robot.h"

#include "iris/osiris/robot.h"
#include "iris/osiris/robot_text.h"
#include "test.h"

#include <fcntl.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

static osiris_plan plan;
static osiris_device devices[OSIRIS_DEVICES_MAX];
static osiris_reading readings[OSIRIS_DEVICES_MAX];
static osiris_remote_device states[OSIRIS_DEVICES_MAX];
static osiris_robot robot;
static osiris_serial_robot board;

static int begin(iris_status opens)
{
    char text[400];
    osiris_problem problem;
    const int master = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
    assert_true(master >= 0 && grantpt(master) == 0 && unlockpt(master) == 0);
    snprintf(text, sizeof text,
             "robot r\ndriver board serial %s\ndrive differential track 200\nrange front to 3000\n",
             opens == IRIS_OK ? ptsname(master) : "/dev/nowhere");
    assert_int_equal(osiris_robot_read_text(&plan, devices, OSIRIS_DEVICES_MAX, &problem, text, strlen(text)),
                     IRIS_OK);
    assert_int_equal(osiris_robot_init(&robot, readings, &plan), IRIS_OK);
    assert_int_equal(osiris_serial_robot_init(&board, states, &plan, 0), IRIS_OK);
    assert_int_equal(osiris_robot_bind(&robot, 0, &osiris_serial_robot_driver, &board, 0), opens);
    return master;
}

/* What the robot heard last of its drive, within some milliseconds; 0 when nothing. */
static int heard(osiris_telemetry *last, int master)
{
    osiris_telemetry_parser parser;
    int count = 0;
    memset(&parser, 0, sizeof parser);
    for (int quiet = 0; quiet < 20; quiet++) {
        char byte;
        while (read(master, &byte, 1) == 1) {
            count += osiris_telemetry_parse(last, &parser, byte) == IRIS_OK;
        }
        nanosleep(&(struct timespec){0, 500000}, NULL);
    }
    return count;
}

static void drives_and_senses(void **state)
{
    (void)state;
    osiris_telemetry t;
    osiris_obstacle obstacle;
    char sentence[OSIRIS_TELEMETRY_BYTES];
    size_t length = 0;
    const int master = begin(IRIS_OK);
    assert_int_equal(osiris_robot_sense(&robot, 10), IRIS_OK);
    assert_int_equal(readings[1].validity, OSIRIS_NEVER);
    for (uint32_t ms = 20; ms <= 220; ms += 20) {
        assert_int_equal(osiris_robot_drive(&robot, 100, 0, ms), IRIS_OK);
        assert_true(heard(&t, master) >= 1);
    }
    assert_int_equal(t.raw.kind, OSIRIS_DRIVE);
    assert_int_equal(t.raw.values[0], 100 * 65536);
    memset(&t, 0, sizeof t);
    t.raw.kind = OSIRIS_RANGE;
    t.raw.validity = OSIRIS_VALID;
    t.raw.values[0] = 640;
    assert_int_equal(osiris_telemetry_format(sentence, sizeof sentence, &length, &t), IRIS_OK);
    assert_int_equal(write(master, "noise", 5), 5);
    assert_int_equal(write(master, sentence, length), (int)length);
    nanosleep(&(struct timespec){0, 5000000}, NULL);
    assert_int_equal(osiris_robot_sense(&robot, 240), IRIS_OK);
    assert_int_equal(readings[1].validity, OSIRIS_VALID);
    assert_int_equal(osiris_robot_obstacle(&obstacle, &robot, 0), IRIS_OK);
    assert_int_equal(obstacle.distance_mm, 540); /* from the body's edge */
    osiris_robot_close(&robot, 260);
    assert_true(heard(&t, master) >= 1);
    assert_int_equal(t.raw.values[0], 0); /* it stands */
    close(master);
}

static void a_port_that_goes(void **state)
{
    (void)state;
    const int master = begin(IRIS_OK);
    close(master);
    assert_int_equal(osiris_robot_sense(&robot, 20), IRIS_ERR_IO);
    assert_int_equal(readings[1].validity, OSIRIS_BROKEN);
    assert_int_equal(osiris_robot_drive(&robot, 100, 0, 40), IRIS_ERR_IO);
    osiris_robot_close(&robot, 60);
}

static void a_port_that_is_not_there(void **state)
{
    (void)state;
    const int master = begin(IRIS_ERR_IO);
    assert_int_equal(osiris_robot_sense(&robot, 20), IRIS_ERR_IO);
    osiris_robot_close(&robot, 60);
    osiris_robot_close(&robot, 60);
    close(master);
    assert_int_equal(osiris_serial_robot_init(NULL, states, &plan, 0), IRIS_ERR_ARG);
    assert_int_equal(osiris_serial_robot_init(&board, states, &plan, 1), IRIS_ERR_ARG);
    plan.drivers[0].kind = OSIRIS_DRIVER_GPIO;
    assert_int_equal(osiris_serial_robot_init(&board, states, &plan, 0), IRIS_ERR_ARG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drives_and_senses),
        cmocka_unit_test(a_port_that_goes),
        cmocka_unit_test(a_port_that_is_not_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
