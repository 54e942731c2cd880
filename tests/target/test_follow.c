/* The firmware follower: rows in, sentences out. */
#include "unity.h"

#include "target.h"

#include "course.h"

#include "iris/command.h"

static uint32_t now_ms;
static int frames;
static iris_command command;
static iris_status read;

void setUp(void)
{
}

void tearDown(void)
{
}

/* The firmware's main. */
int follow_main(void);

int sensor_frame(void)
{
    now_ms += 33;
    return frames-- > 0;
}

uint32_t board_milliseconds(void)
{
    return now_ms;
}

/* The robot's other half. */
void uart_send(const char *bytes, size_t count)
{
    iris_command_parser parser;
    iris_command_parser_init(&parser);
    read = IRIS_ERR_TRUNCATED;
    while (count-- > 0) {
        read = iris_command_parse(&command, &parser, *bytes++);
    }
}

/* What is sent after the last of three frames of one view. */
static iris_command view(int32_t left, int32_t lean)
{
    frames = 3;
    course_set(left, lean);
    TEST_ASSERT_EQUAL_INT(0, follow_main());
    TEST_ASSERT_EQUAL_INT(IRIS_OK, read);
    return command;
}

static void a_line_straight_ahead_is_found(void)
{
    iris_command seen = view(73, 0);
    TEST_ASSERT_EQUAL_INT(IRIS_LINE_FOUND, seen.state);
    TEST_ASSERT_INT_WITHIN(20, 0, seen.offset_permil);
    TEST_ASSERT_INT_WITHIN(150, 0, seen.angle_centideg);
    TEST_ASSERT_INT_WITHIN(40, 0, seen.steer_permil);
}

/* 14 pixels from column 110: center 116.5, offset (116.5 - 79.5) / 80. */
static void a_line_on_the_right_steers_right(void)
{
    iris_command seen = view(110, 0);
    TEST_ASSERT_EQUAL_INT(IRIS_LINE_FOUND, seen.state);
    TEST_ASSERT_INT_WITHIN(20, 462, seen.offset_permil);
    TEST_ASSERT_TRUE(seen.steer_permil > 100);
}

/* 40 pixels over 120 rows: 18.43 degrees. */
static void a_leaning_line_has_its_angle(void)
{
    iris_command right = view(60, 40), left = view(86, -40);
    TEST_ASSERT_INT_WITHIN(200, 1843, right.angle_centideg);
    TEST_ASSERT_INT_WITHIN(200, -1843, left.angle_centideg);
}

static void an_empty_floor_is_never_found(void)
{
    iris_command seen = view(1000, 0);
    TEST_ASSERT_EQUAL_INT(IRIS_LINE_LOST, seen.state);
}

static void the_stack_stays_small(void)
{
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(1024, target_stack_used());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_line_straight_ahead_is_found);
    RUN_TEST(a_line_on_the_right_steers_right);
    RUN_TEST(a_leaning_line_has_its_angle);
    RUN_TEST(an_empty_floor_is_never_found);
    RUN_TEST(the_stack_stays_small);
    return UNITY_END();
}
