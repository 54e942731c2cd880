/* Robot files: what they say, and what is wrong with them. */
#include "iris/osiris/robot_text.h"

#include "random_within.h"
#include "test.h"

static osiris_plan plan;
static osiris_device devices[OSIRIS_DEVICES_MAX];
static osiris_problem problem;

static iris_status reads(const char *text)
{
    return osiris_robot_read_text(&plan, devices, OSIRIS_DEVICES_MAX, &problem, text, strlen(text));
}

static const char whole[] =
    "robot r\ndriver a serial /dev/x\ndrive differential track 150 speed 90\n"
    "body 220 180 ahead -40\nrange front at 150 -70 facing 350 cone 15 from 30 to 200\n";

static const char every[] = "# all of it\n"
                            "robot rover # a name\n"
                            "\tbody 220 180 ahead -40\r\n"
                            "driver motors gpio chip/0 right-pwm 19 left-dir 5 left-pwm 6 right-dir 13\n"
                            "driver board serial /dev/ttyUSB0 rate 9600\n"
                            "driver eye camera frames\n\n"
                            "drive ackermann steering 28.5 wheelbase 260 track 160 speed 800 turn 180 "
                            "acceleration 1200 by board\n"
                            "range front at 150 -70 height 30 facing 350 cone 15 from 30 to 2000 step 10 "
                            "noise 8 error 1.5 rate 20 "
                            "latency 30 by board channel 7\n"
                            "range left by board\n"
                            "range right calibrate 80 800 130 500\n"
                            "heading compass noise 2 step 0.5\n"
                            "camera eye by eye rate 30";

static void every_word(void **state)
{
    (void)state;
    assert_int_equal(reads(every), IRIS_OK);
    assert_int_equal(osiris_plan_check(&plan), IRIS_OK);
    assert_string_equal(plan.name, "rover");
    assert_int_equal(plan.length_mm, 220);
    assert_int_equal(plan.width_mm, 180);
    assert_int_equal(plan.ahead_mm, -40);
    assert_int_equal(plan.driver_count, 3);
    assert_int_equal(plan.drivers[0].kind, OSIRIS_DRIVER_GPIO);
    assert_string_equal(plan.drivers[0].path, "chip/0");
    assert_int_equal(plan.drivers[0].rate, 100);
    assert_int_equal(plan.drivers[0].lines[OSIRIS_LINE_LEFT_DIR], 5);
    assert_int_equal(plan.drivers[0].lines[OSIRIS_LINE_LEFT_PWM], 6);
    assert_int_equal(plan.drivers[0].lines[OSIRIS_LINE_RIGHT_DIR], 13);
    assert_int_equal(plan.drivers[0].lines[OSIRIS_LINE_RIGHT_PWM], 19);
    assert_int_equal(plan.drivers[1].rate, 9600);
    assert_int_equal(plan.drivers[2].kind, OSIRIS_DRIVER_CAMERA);
    assert_int_equal(plan.drive.kind, OSIRIS_ACKERMANN);
    assert_int_equal(plan.drive.steering_max, 5188); /* 28.5 / 360 * 65536 */
    assert_int_equal(plan.drive.steering_rate, 32768);
    assert_int_equal(plan.drive.turn_rate_max, 32768);
}

static void every_word_of_devices(void **state)
{
    (void)state;
    assert_int_equal(reads(every), IRIS_OK);
    assert_int_equal(plan.device_count, 6);
    assert_string_equal(devices[0].name, "drive");
    assert_int_equal(devices[0].driver, 1);
    const osiris_device *front = &devices[1];
    assert_int_equal(front->kind, OSIRIS_RANGE);
    assert_int_equal(front->place.x_mm, 150);
    assert_int_equal(front->place.y_mm, -70);
    assert_int_equal(front->height_mm, 30);
    assert_int_equal(front->place.heading, -1820);
    assert_int_equal(front->width, 2731);
    assert_int_equal(front->least, 30);
    assert_int_equal(front->most, 2000);
    assert_int_equal(front->resolution, 10);
    assert_int_equal(front->deviation, 8);
    assert_int_equal(front->error_permil, 15);
    assert_int_equal(front->period_ms, 50);
    assert_int_equal(front->latency_ms, 30);
    assert_int_equal(front->driver, 1);
    assert_int_equal(front->channel, 7);
    assert_int_equal(devices[2].channel, 0);
    assert_int_equal(devices[3].driver, 0);
    assert_int_equal(devices[3].calibration.count, 2);
    assert_int_equal(devices[3].calibration.value[1], 500);
    assert_int_equal(devices[4].deviation, 364);
    assert_int_equal(devices[4].resolution, 91);
    assert_int_equal(devices[5].driver, 2);
    assert_int_equal(devices[5].period_ms, 33);
}

static void least(void **state)
{
    (void)state;
    assert_int_equal(reads("robot a\ndrive omni wheels 4 radius 90\n"), IRIS_OK);
    assert_int_equal(plan.driver_count, 1);
    assert_int_equal(plan.drivers[0].kind, OSIRIS_DRIVER_SIMULATED);
    assert_string_equal(plan.drivers[0].name, "simulated");
    assert_int_equal(plan.width_mm, 200);
    assert_int_equal(plan.device_count, 1);
}

/* What is wrong, in which line, by which words. */
static const struct {
    const char *text;
    int line;
    const char *words;
} wrong[] = {
    {"", 1, "begins with robot"},
    {"drive omni wheels 3 radius 90\n\n", 2, "begins with robot"},
    {"robot a\n", 1, "begins with drive"},
    {"robot a\nrobot b\n", 2, "one robot"},
    {"robot\n", 1, "a name"},
    {"robot sixteen-letters-\n", 1, "a name"},
    {"robot a b\n", 1, "the end of the line"},
    {"robot a\nbody 10\n", 2, "length and width"},
    {"robot a\nbody 10 0\n", 2, "length and width"},
    {"robot a\nbody 10 10 ahead 5.5\n", 2, "ahead in mm"},
    {"robot a\nbody 10 10\nbody 10 10\n", 3, "one body"},
    {"driver\n", 1, "a name"},
    {"driver a\n", 1, "simulated, serial, gpio, or camera"},
    {"driver a serial\n", 1, "a path"},
    {"driver a serial p rate 0\n", 1, "rate"},
    {"driver a serial p rate 9600 rate 9600\n", 1, "each word once"},
    {"driver a serial p left-dir 1\n", 1, "belongs here"},
    {"driver a gpio p left-dir 1 left-pwm 2 right-dir 3\n", 1,
     "left-dir, left-pwm, right-dir, and right-pwm"},
    {"driver a gpio p left-dir 1 left-pwm 2 right-dir 3 right-pwm 2000\n", 1, "a line of the chip"},
    {"driver a simulated\ndriver a simulated\n", 2, "no other driver"},
    {"drive omni wheels 3 radius 90\ndriver a simulated\n", 2, "drivers before"},
    {"drive\n", 1, "differential, ackermann, or omni"},
    {"drive legs\n", 1, "differential, ackermann, or omni"},
    {"drive differential\n", 1, "differential with track"},
    {"drive differential track 100 wheels 3\n", 1, "differential with track"},
    {"drive ackermann track 100 wheelbase 100\n", 1, "ackermann with"},
    {"drive ackermann track 100 wheelbase 100 steering 81\n", 1, "1 to 80"},
    {"drive omni wheels 5 radius 90\n", 1, "3 or 4"},
    {"drive omni wheels 3 radius 90 track 5\n", 1, "omni with"},
    {"drive omni wheels 3 radius 90 wheels 3\n", 1, "each word once"},
    {"drive omni wheels 3 radius 90 colour 3\n", 1, "omni with"},
    {"drive omni wheels 3 radius 90 by me\n", 1, "a driver that has a line"},
    {"drive omni wheels 3 radius 90 speed 16001\n", 1, "speed of a wheel"},
    {"drive omni wheels 3 radius 90\ndrive omni wheels 3 radius 90\n", 2, "one drive"},
    {"wheel a\n", 1, "a kind of device"},
    {"range\n", 1, "a name"},
    {"range a at 1\n", 1, "a place"},
    {"range a at 1 10000\n", 1, "a place"},
    {"range a facing north\n", 1, "facing in degrees"},
    {"range a cone 361\n", 1, "0 to 360"},
    {"range a from 100 to 50\n", 1, "from to be at most to"},
    {"range a step 0\n", 1, "step"},
    {"range a noise -1\n", 1, "noise"},
    {"range a rate 0\n", 1, "rate in Hz"},
    {"range a rate 0.01\n", 1, "rate in Hz"},
    {"range a latency 10001\n", 1, "latency"},
    {"range a channel 256\n", 1, "channel"},
    {"range a colour red\n", 1, "at, height, facing"},
    {"range a to 5 to 6\n", 1, "each word once"},
    {"heading a to 5 to 6\n", 1, "each word once"},
    {"range a calibrate 1 2\n", 1, "pairs"},
    {"range a calibrate 1 2 3\n", 1, "pairs"},
    {"range a calibrate 1 2 1 3\n", 1, "raw values"},
    {"range a calibrate 1 1 2 2 3 3 4 4 5 5 6 6 7 7 8 8 9 9\n", 1, "at, height"},
    {"range a\nrange a\n", 2, "no other device"},
    {"range a channel 0\nrange b channel 0\n", 2, "a channel"},
    {"range a by b\n", 1, "a driver that has a line"},
    {"range a to 1048576\n", 1, "to with"},
    {"range a to 9999999999\n", 1, "to with"},
    {"range a to 1.\n", 1, "to with"},
    {"range a to -\n", 1, "to with"},
    {"range a to 1.2345\n", 1, "to with"},
};

static void errors(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        problem.expected = NULL;
        assert_int_equal(reads(wrong[i].text), IRIS_ERR_DATA);
        assert_int_equal(problem.line, wrong[i].line);
        if (!strstr(problem.expected, wrong[i].words)) {
            assert_string_equal(problem.expected, wrong[i].words);
        }
        assert_true(strncmp(problem.expected, "expected ", 9) == 0);
    }
}

static void too_many(void **state)
{
    (void)state;
    static const char text[] = "robot a\ndrive omni wheels 3 radius 90\nrange a\nrange b\n";
    assert_int_equal(osiris_robot_read_text(&plan, devices, 3, &problem, text, sizeof text), IRIS_OK);
    assert_int_equal(osiris_robot_read_text(&plan, devices, 2, &problem, text, sizeof text), IRIS_ERR_FULL);
    assert_int_equal(problem.line, 4);
    assert_int_equal(osiris_robot_read_text(&plan, devices, -1, &problem, text, sizeof text), IRIS_ERR_FULL);
    assert_int_equal(problem.line, 2);
    assert_int_equal(reads("driver a simulated\ndriver b simulated\ndriver c simulated\ndriver d simulated\n"
                           "driver e simulated\n"),
                     IRIS_ERR_FULL);
    assert_int_equal(osiris_robot_read_text(NULL, devices, 3, &problem, text, 5), IRIS_ERR_ARG);
    assert_int_equal(osiris_robot_read_text(&plan, NULL, 3, &problem, text, 5), IRIS_ERR_ARG);
    assert_int_equal(osiris_robot_read_text(&plan, devices, 3, NULL, text, 5), IRIS_ERR_ARG);
    assert_int_equal(osiris_robot_read_text(&plan, devices, 3, &problem, NULL, 5), IRIS_ERR_ARG);
}

/* Spoiled texts are read or refused, and what is read holds together. */
static void hostile(void **state)
{
    (void)state;
    static const char bytes[] = "\0\n# \t-.9aZ\x7f\xff";
    char text[sizeof whole];
    int read = 0;
    for (int i = 0; i < 4000; i++) {
        memcpy(text, whole, sizeof whole);
        size_t length = (size_t)random_within(0, (int32_t)sizeof whole - 1);
        for (int k = random_within(0, 5); k > 0; k--) {
            text[random_within(0, (int32_t)sizeof whole - 1)] =
                bytes[random_within(0, (int32_t)sizeof bytes - 1)];
        }
        const iris_status status =
            osiris_robot_read_text(&plan, devices, OSIRIS_DEVICES_MAX, &problem, text, length);
        assert_true(status == IRIS_OK ? osiris_plan_check(&plan) == IRIS_OK
                                      : problem.line >= 1 && problem.expected != NULL);
        read += status == IRIS_OK;
    }
    assert_true(read > 50);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_word), cmocka_unit_test(every_word_of_devices),
        cmocka_unit_test(least),      cmocka_unit_test(errors),
        cmocka_unit_test(too_many),   cmocka_unit_test(hostile),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
