/* Two motors on GPIO lines: the lines are played here, instead of gpio.h's. */
#include "iris/gpio_drive.h"

#include "iris/osiris/robot_text.h"
#include "test.h"

static uint32_t lines_now;
static int32_t offsets[IRIS_GPIO_LINES_MAX], is_held;
static iris_status answer;

iris_status iris_gpio_open(iris_gpio *gpio, const char *chip, const iris_gpio_line *lines, int32_t count,
                           int32_t reconnect_ms, uint32_t now_ms)
{
    (void)gpio;
    (void)reconnect_ms;
    (void)now_ms;
    assert_string_equal(chip, "mychip");
    for (int32_t i = 0; i < count; i++) {
        offsets[i] = lines[i].offset;
        assert_int_equal(lines[i].safe, 0);
    }
    is_held = answer == IRIS_OK || answer == IRIS_ERR_IO;
    lines_now = 0;
    return answer;
}

iris_status iris_gpio_set(iris_gpio *gpio, uint32_t values, uint32_t now_ms)
{
    (void)gpio;
    (void)now_ms;
    assert_int_equal(is_held, 1);
    lines_now = answer == IRIS_OK ? values : 0;
    return answer;
}

void iris_gpio_close(iris_gpio *gpio)
{
    (void)gpio;
    lines_now = 0;
    is_held = 0;
}

static osiris_plan plan;
static osiris_device devices[OSIRIS_DEVICES_MAX];
static osiris_reading readings[OSIRIS_DEVICES_MAX];
static osiris_robot robot;
static osiris_gpio_drive motors;

static const char text[] =
    "robot r\n"
    "driver motors gpio mychip left-dir 5 left-pwm 6 right-dir 13 right-pwm 19 rate 50\n"
    "drive differential track 200 speed 500 turn 360 acceleration 10000 turn-acceleration 36000\n"
    "range front\n";

static void begin(iris_status opens)
{
    osiris_problem problem;
    answer = opens;
    assert_int_equal(osiris_robot_read_text(&plan, devices, OSIRIS_DEVICES_MAX, &problem, text, strlen(text)),
                     IRIS_OK);
    assert_int_equal(osiris_robot_init(&robot, readings, &plan), IRIS_OK);
    assert_int_equal(osiris_gpio_drive_init(&motors, &plan, 0), IRIS_OK);
    assert_int_equal(osiris_robot_bind(&robot, 0, &osiris_gpio_drive_driver, &motors, 0), opens);
}

/* Of a second from now_ms on, in permil: how long each line was high. The robot is told every 100 ms at first. */
static void share(int32_t *high, int32_t speed, int32_t turn_rate, uint32_t from_ms)
{
    memset(high, 0, OSIRIS_GPIO_LINES * sizeof *high);
    for (uint32_t us = 0; us < 1000000; us += 200) {
        const uint32_t ms = from_ms + us / 1000;
        if (us % 100000 == 0) {
            assert_int_equal(osiris_robot_drive(&robot, speed, turn_rate, ms), IRIS_OK);
        }
        assert_true(osiris_gpio_drive_run(&motors, (int64_t)from_ms * 1000 + us) >= 1);
        for (int i = 0; i < OSIRIS_GPIO_LINES; i++) {
            high[i] += (int32_t)(lines_now >> i & 1);
        }
    }
    for (int i = 0; i < OSIRIS_GPIO_LINES; i++) {
        high[i] = high[i] * 1000 / 5000;
    }
}

static void wheels_turn_as_told(void **state)
{
    (void)state;
    int32_t high[OSIRIS_GPIO_LINES];
    begin(IRIS_OK);
    assert_int_equal(offsets[OSIRIS_LINE_LEFT_DIR], 5);
    assert_int_equal(offsets[OSIRIS_LINE_RIGHT_PWM], 19);
    share(high, 250, 0, 0);
    share(high, 250, 0, 1000);
    assert_true(abs(high[OSIRIS_LINE_LEFT_PWM] - 500) <= 12 && abs(high[OSIRIS_LINE_RIGHT_PWM] - 500) <= 12);
    assert_int_equal(high[OSIRIS_LINE_LEFT_DIR], 0);
    share(high, 0, 16384,
          2000); /* a quarter turn a second to the right: 157 mm/s of 500, the right one backwards */
    share(high, 0, 16384, 3000);
    assert_true(abs(high[OSIRIS_LINE_LEFT_PWM] - 314) <= 12 && abs(high[OSIRIS_LINE_RIGHT_PWM] - 314) <= 12);
    assert_int_equal(high[OSIRIS_LINE_LEFT_DIR], 0);
    assert_int_equal(high[OSIRIS_LINE_RIGHT_DIR], 1000);
    assert_int_equal(osiris_robot_sense(&robot, 4000), IRIS_ERR_IO); /* it has no sensors */
    assert_int_equal(readings[1].validity, OSIRIS_BROKEN);
    osiris_robot_close(&robot, 4000);
    assert_int_equal(is_held, 0);
    assert_int_equal(osiris_gpio_drive_run(&motors, 5000000), 10000);
}

static void it_stands_when_left_alone(void **state)
{
    (void)state;
    begin(IRIS_OK);
    for (uint32_t ms = 0; ms < 300; ms += 50) {
        assert_int_equal(osiris_robot_drive(&robot, 500, 0, ms), IRIS_OK);
    }
    for (int64_t us = 250000; us < 2000000; us += 500) {
        (void)osiris_gpio_drive_run(&motors, us);
        assert_true(us <= 760000 || lines_now == 0);
        assert_true(us < 300000 || us > 740000 || lines_now != 0); /* full speed has no edges */
    }
}

static void a_chip_that_goes(void **state)
{
    (void)state;
    begin(IRIS_OK);
    assert_int_equal(osiris_robot_drive(&robot, 500, 0, 0), IRIS_OK);
    assert_int_equal(osiris_robot_drive(&robot, 500, 0, 100), IRIS_OK);
    answer = IRIS_ERR_IO;
    (void)osiris_gpio_drive_run(&motors, 130000);
    assert_int_equal(osiris_robot_drive(&robot, 500, 0, 140), IRIS_ERR_IO);
    answer = IRIS_OK;
    (void)osiris_gpio_drive_run(&motors, 150000);
    assert_int_equal(osiris_robot_drive(&robot, 500, 0, 160), IRIS_OK);
    assert_true(lines_now != 0);
    osiris_robot_close(&robot, 200);
    begin(IRIS_ERR_IO); /* not there yet: it goes on trying */
    answer = IRIS_OK;
    (void)osiris_gpio_drive_run(&motors, 10000);
    assert_int_equal(osiris_robot_drive(&robot, 500, 0, 20), IRIS_OK);
    osiris_robot_close(&robot, 200);
    begin(IRIS_ERR_UNSUPPORTED);
    assert_int_equal(is_held, 0);
    assert_int_equal(osiris_gpio_drive_init(NULL, &plan, 0), IRIS_ERR_ARG);
    assert_int_equal(osiris_gpio_drive_init(&motors, &plan, 1), IRIS_ERR_ARG);
    osiris_drive_defaults(&plan.drive, OSIRIS_OMNI);
    assert_int_equal(osiris_gpio_drive_init(&motors, &plan, 0), IRIS_ERR_UNSUPPORTED);
    plan.drivers[0].kind = OSIRIS_DRIVER_SERIAL;
    assert_int_equal(osiris_gpio_drive_init(&motors, &plan, 0), IRIS_ERR_ARG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wheels_turn_as_told),
        cmocka_unit_test(it_stands_when_left_alone),
        cmocka_unit_test(a_chip_that_goes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
