#include "iris/runtime/order.h"

#include "test.h"

static iris_status read_text(iris_order *order, int32_t *column, const char *text)
{
    return iris_order_read(order, column, text, strlen(text));
}

static void texts_are_what_they_say(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        iris_order order;
        const char *written;
    } cases[] = {
        {"stop", {IRIS_ORDER_STOP, 0, 0}, "stop"},
        {"STOP\r\n", {IRIS_ORDER_STOP, 0, 0}, "stop"},
        {"  go 500 # ahead", {IRIS_ORDER_GO, 500, 0}, "go 500"},
        {"go -20 300", {IRIS_ORDER_GO, -20, 300}, "go -20 300"},
        {"turn 90", {IRIS_ORDER_TURN, 16384, 0}, "turn 90"},
        {"turn -12.5", {IRIS_ORDER_TURN, -2276, 0}, "turn -12.502"}, /* 2275.56 units: 12.50244 degrees */
        {"Turn 36000", {IRIS_ORDER_TURN, 6553600, 0}, "turn 36000"},
        {"drive 200 30", {IRIS_ORDER_DRIVE, 200, 5461}, "drive 200 29.998"},
        {"drive\t-200 -45#x", {IRIS_ORDER_DRIVE, -200, -8192}, "drive -200 -45"},
        {"drive 0 .5", {IRIS_ORDER_DRIVE, 0, 91}, "drive 0 0.5"},
        {"follow", {IRIS_ORDER_FOLLOW_LINE, 0, 0}, "follow"},
        {"follow 300", {IRIS_ORDER_FOLLOW_LINE, 300, 0}, "follow 300"},
        {"lock", {IRIS_ORDER_LOCK_ON, 0, 0}, "lock"},
        {"goto 1200 -300", {IRIS_ORDER_GO_TO, 1200, -300}, "goto 1200 -300"},
        {"goto 0 0", {IRIS_ORDER_GO_TO, 0, 0}, "goto 0 0"},
        {"explore 16000", {IRIS_ORDER_EXPLORE, 16000, 0}, "explore 16000"},
        {"map", {IRIS_ORDER_MAP, 0, 0}, "map"},
        {"detect", {IRIS_ORDER_DETECT, 0, 0}, "detect"},
        {"reset", {IRIS_ORDER_RESET_TIME, 0, 0}, "reset"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        iris_order order = {IRIS_ORDER_NONE, 7, 7};
        int32_t column = 77;
        char text[IRIS_ORDER_TEXT_BYTES];
        size_t length = 0;
        assert_int_equal(read_text(&order, &column, cases[i].text), IRIS_OK);
        assert_int_equal(column, 0);
        assert_int_equal(order.verb, cases[i].order.verb);
        assert_int_equal(order.a, cases[i].order.a);
        assert_int_equal(order.b, cases[i].order.b);
        assert_int_equal(iris_order_write(text, sizeof text, &length, &order), IRIS_OK);
        assert_string_equal(text, cases[i].written);
        assert_int_equal(length, strlen(text));
    }
}

static void what_is_wrong_is_shown(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        iris_status status;
        int32_t column;
    } cases[] = {
        {"", IRIS_ERR_END, 0},
        {"   # nothing", IRIS_ERR_END, 0},
        {"fly 3", IRIS_ERR_DATA, 1},
        {"  going", IRIS_ERR_DATA, 3},
        {"go", IRIS_ERR_DATA, 3},
        {"go x", IRIS_ERR_DATA, 4},
        {"go 5x", IRIS_ERR_DATA, 4},
        {"go 1.5", IRIS_ERR_DATA, 4},
        {"go 5 6 7", IRIS_ERR_DATA, 8},
        {"go 5 -6", IRIS_ERR_RANGE, 6},
        {"go 10000001", IRIS_ERR_RANGE, 4},
        {"go 99999999999999999999999999999", IRIS_ERR_RANGE, 4},
        {"turn 36000.01", IRIS_ERR_RANGE, 6},
        {"turn 1.2345", IRIS_ERR_DATA, 6},
        {"turn .", IRIS_ERR_DATA, 6},
        {"turn -", IRIS_ERR_DATA, 6},
        {"turn 99999999999999999999.9", IRIS_ERR_RANGE, 6},
        {"drive 5", IRIS_ERR_DATA, 8},
        {"drive 16001 0", IRIS_ERR_RANGE, 7},
        {"stop now", IRIS_ERR_DATA, 6},
        {"goto 5", IRIS_ERR_DATA, 7},
        {"follow -1", IRIS_ERR_RANGE, 8},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        iris_order order = {IRIS_ORDER_NONE, 7, 7};
        int32_t column = 77;
        assert_int_equal(read_text(&order, &column, cases[i].text), cases[i].status);
        assert_int_equal(column, cases[i].column);
        assert_int_equal(order.a, 7);
    }
}

/* Truth: read again, it is the same. */
static void every_angle_is_read_as_it_was(void **state)
{
    (void)state;
    for (int32_t units = -70000; units <= 70000; units += units > -300 && units < 300 ? 1 : 17) {
        const iris_order order = {IRIS_ORDER_TURN, units, 0};
        iris_order again = {IRIS_ORDER_NONE, 0, 0};
        char text[IRIS_ORDER_TEXT_BYTES];
        size_t length = 0;
        int32_t column = 0;
        assert_int_equal(iris_order_write(text, sizeof text, &length, &order), IRIS_OK);
        assert_int_equal(iris_order_read(&again, &column, text, length), IRIS_OK);
        assert_int_equal(again.a, units);
    }
}

static void orders_have_ranges(void **state)
{
    (void)state;
    static const iris_order good[] = {{IRIS_ORDER_GO, -10000000, 16000},
                                      {IRIS_ORDER_DRIVE, -16000, 1048576},
                                      {IRIS_ORDER_GO_TO, 10000000, -10000000},
                                      {IRIS_ORDER_TURN, -6553600, 0}};
    static const iris_order out_of_range[] = {
        {IRIS_ORDER_STOP, 1, 0},        {IRIS_ORDER_MAP, 0, -1},       {IRIS_ORDER_GO, INT32_MIN, 0},
        {IRIS_ORDER_GO, 0, -1},         {IRIS_ORDER_TURN, 6553601, 0}, {IRIS_ORDER_TURN, 0, 1},
        {IRIS_ORDER_DRIVE, 0, 1048577}, {IRIS_ORDER_DRIVE, -16001, 0}, {IRIS_ORDER_EXPLORE, INT32_MAX, 0}};
    char text[IRIS_ORDER_TEXT_BYTES];
    size_t length = 99;
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        assert_int_equal(iris_order_check(&good[i]), IRIS_OK);
        assert_int_equal(iris_order_write(text, sizeof text, &length, &good[i]), IRIS_OK);
        assert_int_equal(iris_order_write(text, length, &length, &good[i]), IRIS_ERR_RANGE);
        assert_int_equal(iris_order_write(text, length + 1, &length, &good[i]), IRIS_OK);
    }
    length = 99;
    for (size_t i = 0; i < sizeof out_of_range / sizeof out_of_range[0]; i++) {
        assert_int_equal(iris_order_check(&out_of_range[i]), IRIS_ERR_RANGE);
        assert_int_equal(iris_order_write(text, sizeof text, &length, &out_of_range[i]), IRIS_ERR_RANGE);
    }
    const iris_order none = {IRIS_ORDER_NONE, 0, 0}, beyond = {(iris_order_verb)IRIS_ORDER_VERBS, 0, 0};
    assert_int_equal(iris_order_check(&none), IRIS_ERR_ARG);
    assert_int_equal(iris_order_check(&beyond), IRIS_ERR_ARG);
    assert_int_equal(iris_order_check(NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_order_write(NULL, 9, &length, &good[0]), IRIS_ERR_ARG);
    assert_int_equal(length, 99);
    assert_null(iris_order_name(0));
    assert_null(iris_order_name(-1));
    assert_null(iris_order_name(IRIS_ORDER_VERBS));
    assert_string_equal(iris_order_name(IRIS_ORDER_GO_TO), "goto");
}

static void sentences_become_drives(void **state)
{
    (void)state;
    iris_order order = {IRIS_ORDER_NONE, 7, 7};
    iris_command command = {1, IRIS_LINE_FOUND, -500, 800, 0, 0, 0};
    assert_int_equal(iris_order_of_command(&order, &command, 400, 32768), IRIS_OK);
    assert_int_equal(order.verb, IRIS_ORDER_DRIVE);
    assert_int_equal(order.a, 320);
    assert_int_equal(order.b, -13107); /* 0.5 0.8 32768 is 13107.2 */
    command.speed_permil = 0;
    assert_int_equal(iris_order_of_command(&order, &command, 16000, 1048576), IRIS_OK);
    assert_int_equal(order.a, 0);
    assert_int_equal(order.b, 0);
    command = (iris_command){1, IRIS_LINE_FOUND, 1000, 1000, 0, 0, 0};
    assert_int_equal(iris_order_of_command(&order, &command, 16000, 1048576), IRIS_OK);
    assert_int_equal(order.a, 16000);
    assert_int_equal(order.b, 1048576);
    assert_int_equal(iris_order_of_command(&order, &command, 0, 1), IRIS_ERR_RANGE);
    assert_int_equal(iris_order_of_command(&order, &command, 1, -1), IRIS_ERR_RANGE);
    command.steer_permil = 1001;
    assert_int_equal(iris_order_of_command(&order, &command, 1, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_order_of_command(NULL, &command, 1, 1), IRIS_ERR_ARG);
    assert_int_equal(order.a, 16000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts_are_what_they_say),       cmocka_unit_test(what_is_wrong_is_shown),
        cmocka_unit_test(every_angle_is_read_as_it_was), cmocka_unit_test(orders_have_ranges),
        cmocka_unit_test(sentences_become_drives),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
