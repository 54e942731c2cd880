/* The foundation on the real instruction set: views, working memory, and the compiler's promises. */
#include "unity.h"

#include "target.h"

#include "iris/command.h"
#include "iris/fixed.h"
#include "iris/image.h"
#include "iris/scratch.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void variables_start_as_written(void)
{
    static int32_t written = 4711;
    static int32_t zero;
    TEST_ASSERT_EQUAL_INT32(4711, written);
    TEST_ASSERT_EQUAL_INT32(0, zero);
    written = zero = 1;
}

static void negative_numbers_shift_arithmetically(void)
{
    volatile int32_t low = INT32_MIN, five = -5;
    TEST_ASSERT_EQUAL_INT32(-1, low >> 31);
    TEST_ASSERT_EQUAL_INT32(-3, five >> 1);
}

static void views_are_checked(void)
{
    static uint32_t words[8];
    uint8_t *bytes = (uint8_t *)words;
    iris_image image, part;
    TEST_ASSERT_EQUAL_INT(IRIS_ERR_ALIGN,
                          iris_image_wrap(&image, bytes + 1, 16, (iris_size){8, 2}, 0, IRIS_MASK1));
    TEST_ASSERT_EQUAL_INT(IRIS_ERR_RANGE,
                          iris_image_wrap(&image, bytes, 31, (iris_size){8, 4}, 0, IRIS_GRAY8));
    TEST_ASSERT_EQUAL_INT(IRIS_OK, iris_image_wrap(&image, bytes, 32, (iris_size){8, 4}, -8, IRIS_GRAY8));
    TEST_ASSERT_TRUE(iris_image_row(&image, 0) == bytes + 24);
    TEST_ASSERT_EQUAL_INT(IRIS_ERR_RANGE, iris_image_crop(&part, &image, (iris_rect){1, 0, INT32_MAX, 1}));
    TEST_ASSERT_EQUAL_INT(IRIS_OK, iris_image_crop(&part, &image, (iris_rect){1, 1, 3, 2}));
    TEST_ASSERT_TRUE(iris_image_row(&part, 1) == bytes + 9);
}

static void working_memory_is_exact(void)
{
    static IRIS_SCRATCH_BUFFER(buffer, 48);
    iris_scratch scratch;
    TEST_ASSERT_EQUAL_INT(IRIS_OK, iris_scratch_init(&scratch, buffer.memory, 48));
    TEST_ASSERT_NOT_NULL(iris_scratch_take(&scratch, 17));
    TEST_ASSERT_NULL(iris_scratch_take(&scratch, 17));
    TEST_ASSERT_NOT_NULL(iris_scratch_take(&scratch, 16));
    TEST_ASSERT_EQUAL_UINT32(48, scratch.peak);
}

static void sentences_go_both_ways(void)
{
    const iris_command sent = {42, IRIS_LINE_FOUND, -180, 750, -1250, -93, 880};
    iris_command received;
    iris_command_parser parser;
    char sentence[IRIS_COMMAND_SENTENCE_BYTES];
    size_t length = 0;
    TEST_ASSERT_EQUAL_INT(IRIS_OK, iris_command_format(sentence, sizeof sentence, &length, &sent));
    TEST_ASSERT_EQUAL_STRING("$PIRIS,42,F,-180,750,-1250,-93,880*27\r\n", sentence);
    iris_command_parser_init(&parser);
    iris_status status = IRIS_ERR_TRUNCATED;
    for (size_t i = 0; i < length; i++) {
        status = iris_command_parse(&received, &parser, sentence[i]);
    }
    TEST_ASSERT_EQUAL_INT(IRIS_OK, status);
    TEST_ASSERT_EQUAL_INT32(-1250, received.angle_centideg);
}

static void trigonometry_agrees_at_landmarks(void)
{
    TEST_ASSERT_EQUAL_INT32(IRIS_Q30_ONE, iris_sin_q30(16384));
    TEST_ASSERT_EQUAL_INT32(8192, iris_atan2_angle(7, 7));
    TEST_ASSERT_EQUAL_UINT32(65535, iris_sqrt_u32(UINT32_MAX));
}

static void the_stack_stays_small(void)
{
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(1024, target_stack_used());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(variables_start_as_written);
    RUN_TEST(negative_numbers_shift_arithmetically);
    RUN_TEST(views_are_checked);
    RUN_TEST(working_memory_is_exact);
    RUN_TEST(sentences_go_both_ways);
    RUN_TEST(trigonometry_agrees_at_landmarks);
    RUN_TEST(the_stack_stays_small);
    return UNITY_END();
}
