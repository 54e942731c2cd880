/* Four lines that say what a command says. */
#include "iris/indicator.h"
#include "test.h"

enum { LEFT = IRIS_INDICATE_LEFT, RIGHT = IRIS_INDICATE_RIGHT, STOP = IRIS_INDICATE_STOP };

/* The lines but for the heartbeat, which has to beat. */
static uint32_t shown(iris_indicator *indicator, int32_t steer, int32_t speed)
{
    const iris_command command = {.steer_permil = steer, .speed_permil = speed};
    uint32_t before = indicator->lines;
    uint32_t lines = iris_indicator_update(indicator, &command);
    assert_int_equal(lines, indicator->lines);
    assert_int_equal((lines ^ before) & IRIS_INDICATE_HEARTBEAT, IRIS_INDICATE_HEARTBEAT);
    return lines & ~IRIS_INDICATE_HEARTBEAT;
}

static void a_side_is_on_beyond_the_dead_band(void **state)
{
    (void)state;
    iris_indicator indicator;
    assert_int_equal(iris_indicator_init(&indicator, NULL), IRIS_OK);
    assert_int_equal(indicator.lines, STOP);
    assert_int_equal(shown(&indicator, 0, 600), 0);
    assert_int_equal(shown(&indicator, 99, 600), 0);
    assert_int_equal(shown(&indicator, -99, 600), 0);
    assert_int_equal(shown(&indicator, 100, 600), RIGHT);
    assert_int_equal(shown(&indicator, 51, 600), RIGHT);
    assert_int_equal(shown(&indicator, 50, 600), 0);
    assert_int_equal(shown(&indicator, 99, 600), 0);
    assert_int_equal(shown(&indicator, -100, 600), LEFT);
    assert_int_equal(shown(&indicator, -51, 600), LEFT);
    assert_int_equal(shown(&indicator, -50, 600), 0);
    assert_int_equal(shown(&indicator, 1000, 600), RIGHT);
    assert_int_equal(shown(&indicator, -1000, 600), LEFT);
    assert_int_equal(shown(&indicator, 60, 600), 0); /* the other side's hysteresis is not this side's */
}

static void a_stop_is_a_stop(void **state)
{
    (void)state;
    iris_indicator indicator;
    assert_int_equal(iris_indicator_init(&indicator, NULL), IRIS_OK);
    assert_int_equal(shown(&indicator, 800, 600), RIGHT);
    assert_int_equal(shown(&indicator, 800, 0), STOP);
    assert_int_equal(shown(&indicator, 60, 1), 0);
    assert_int_equal(shown(&indicator, 0, -5), STOP);
}

static void limits_are_the_config_s(void **state)
{
    (void)state;
    iris_indicator indicator;
    const iris_indicator_config config = {300, 300};
    assert_int_equal(iris_indicator_init(&indicator, &config), IRIS_OK);
    assert_int_equal(shown(&indicator, 299, 600), 0);
    assert_int_equal(shown(&indicator, 301, 600), RIGHT);
    assert_int_equal(shown(&indicator, 300, 600), 0);
    assert_int_equal(shown(&indicator, INT32_MIN, INT32_MAX), LEFT);
}

static void arguments_are_checked(void **state)
{
    (void)state;
    static const iris_indicator_config bad[] = {{0, 0}, {-5, -10}, {1001, 50}, {100, 101}, {100, -1}};
    iris_indicator indicator, before;
    memset(&indicator, 0x5a, sizeof indicator);
    before = indicator;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(iris_indicator_init(&indicator, &bad[i]), IRIS_ERR_ARG);
    }
    assert_int_equal(iris_indicator_init(NULL, NULL), IRIS_ERR_ARG);
    assert_memory_equal(&indicator, &before, sizeof indicator);
    const iris_command command = {.speed_permil = 600};
    assert_int_equal(iris_indicator_update(NULL, &command), STOP);
    assert_int_equal(iris_indicator_update(&indicator, NULL), STOP);
    assert_memory_equal(&indicator, &before, sizeof indicator);
    iris_indicator_defaults(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_side_is_on_beyond_the_dead_band),
        cmocka_unit_test(a_stop_is_a_stop),
        cmocka_unit_test(limits_are_the_config_s),
        cmocka_unit_test(arguments_are_checked),
    };
    return cmocka_run_group_tests_name("indicator", tests, NULL, NULL);
}
