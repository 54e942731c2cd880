/* The firmware follower: rows in, sentences out. */
#include "unity.h"

#include "course.h"
#include "follower.h"

#include "iris/command.h"

static uint32_t now_ms;

void setUp(void)
{
    TEST_ASSERT_EQUAL_INT(0, follower_start());
}

void tearDown(void)
{
}

/* The last of three frames of one view, as the robot's other half reads it. */
static iris_command view(int32_t left, int32_t lean)
{
    iris_command command = {0};
    iris_command_parser parser;
    course_set(left, lean);
    for (int frame = 0; frame < 3; frame++) {
        const char *sentence = follower_frame(course_row, now_ms += 33);
        TEST_ASSERT_NOT_NULL(sentence);
        iris_command_parser_init(&parser);
        iris_status status = IRIS_ERR_TRUNCATED;
        while (*sentence) {
            status = iris_command_parse(&command, &parser, *sentence++);
        }
        TEST_ASSERT_EQUAL_INT(IRIS_OK, status);
    }
    return command;
}

static void a_line_straight_ahead_is_found(void)
{
    iris_command command = view(73, 0);
    TEST_ASSERT_EQUAL_INT(IRIS_LINE_FOUND, command.state);
    TEST_ASSERT_INT_WITHIN(20, 0, command.offset_permil);
    TEST_ASSERT_INT_WITHIN(150, 0, command.angle_centideg);
    TEST_ASSERT_INT_WITHIN(40, 0, command.steer_permil);
}

/* 14 pixels from column 110: center 116.5, offset (116.5 - 79.5) / 80. */
static void a_line_on_the_right_steers_right(void)
{
    iris_command command = view(110, 0);
    TEST_ASSERT_EQUAL_INT(IRIS_LINE_FOUND, command.state);
    TEST_ASSERT_INT_WITHIN(20, 462, command.offset_permil);
    TEST_ASSERT_TRUE(command.steer_permil > 100);
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
    iris_command command = view(1000, 0);
    TEST_ASSERT_EQUAL_INT(IRIS_LINE_LOST, command.state);
}

static void memory_stays_within_4_kilobytes(void)
{
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(4096, follower_memory());
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(1536, target_stack_used());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_line_straight_ahead_is_found);
    RUN_TEST(a_line_on_the_right_steers_right);
    RUN_TEST(a_leaning_line_has_its_angle);
    RUN_TEST(an_empty_floor_is_never_found);
    RUN_TEST(memory_stays_within_4_kilobytes);
    return UNITY_END();
}
