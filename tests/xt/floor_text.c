/* Floors as text: read again as they were; every damage is found, and its line is told. */
#include <stdio.h>

#include "xt/floor_camera.h"

static const char example[] = "iris floor 1\n"
                              "size 320 240\n"
                              "image_from_floor_q32\n"
                              "3435973836 0 687194767360\n"
                              "0 -12884901 85899345920\n"
                              "0 21474836 4294967296\n";

static void texts_come_back(void **state)
{
    (void)state;
    for (int k = 0; k < 500; k++) {
        test_camera c = any_camera();
        iris_floor plane = true_floor(&c), again;
        char text[IRIS_FLOOR_TEXT_BYTES];
        size_t length = 0, shorter = 77;
        int32_t line = -1;
        assert_int_equal(iris_floor_write_text(text, sizeof text, &length, &plane), IRIS_OK);
        assert_int_equal(strlen(text), length);
        memset(&again, 0x5A, sizeof again);
        assert_int_equal(iris_floor_read_text(&again, &line, text, length + (size_t)(k % 2)), IRIS_OK);
        assert_memory_equal(&again, &plane, sizeof plane);
        assert_int_equal(line, -1);
        char small[IRIS_FLOOR_TEXT_BYTES] = "x";
        assert_int_equal(iris_floor_write_text(small, length, &shorter, &plane), IRIS_ERR_RANGE);
        assert_int_equal(shorter, 77);
        assert_string_equal(small, "x");
        assert_int_equal(iris_floor_write_text(small, length + 1, &shorter, &plane), IRIS_OK);
        for (size_t i = 0; i < length; i++) { /* cut off, and each byte changed */
            iris_status status = iris_floor_read_text(&again, &line, text, i);
            assert_true(status == IRIS_ERR_TRUNCATED || status == IRIS_ERR_DATA || i == length - 1 ||
                        text + i == strstr(text, "check "));
            char kept = text[i];
            text[i] = (char)(kept ^ 1 << k % 7);
            status = iris_floor_read_text(&again, &line, text, length);
            assert_true(status != IRIS_OK || kept == '\n' || kept == ' ' ||
                        strncmp(text + i, "#heck ", 6) == 0);
            text[i] = kept;
        }
    }
}

static void the_longest_fits(void **state)
{
    (void)state;
    const iris_q32 most = (iris_q32)1 << 62, less = most / 4;
    const iris_q32 numbers[9] = {-most, -less, -less, -less, -most, -less, -less, -less, -most};
    iris_floor plane;
    char text[IRIS_FLOOR_TEXT_BYTES];
    size_t length;
    int32_t line;
    assert_int_equal(iris_floor_init(&plane, (iris_size){IRIS_SIDE_MAX, IRIS_SIDE_MAX}, numbers), IRIS_OK);
    assert_int_equal(iris_floor_write_text(text, sizeof text, &length, &plane), IRIS_OK);
    assert_true(length > IRIS_FLOOR_TEXT_BYTES - 50);
    assert_int_equal(iris_floor_read_text(&plane, &line, text, length), IRIS_OK);
    assert_memory_equal(plane.to_image_q32, numbers, sizeof numbers);
}

/* Finds the check that belongs to a text without one, as only somebody who means it would. */
static uint32_t check_of(const int64_t *numbers)
{
    uint32_t sum = 2166136261u;
    for (int i = 0; i < 11; i++) {
        for (int k = 0; k < 8; k++) {
            sum = (sum ^ (uint32_t)((uint64_t)numbers[i] >> 8 * k & 255)) * 16777619u;
        }
    }
    return sum;
}

static void people_may_write(void **state)
{
    (void)state;
    const int64_t numbers[11] = {320,       240,         3435973836, 0,        687194767360, 0,
                                 -12884901, 85899345920, 0,          21474836, 4294967296};
    char text[1000], check[32];
    iris_floor plane;
    int32_t line;
    snprintf(check, sizeof check, "check %08X\n", (unsigned)check_of(numbers));
    snprintf(text, sizeof text, "%s%s", example, check);
    assert_int_equal(iris_floor_read_text(&plane, &line, text, strlen(text)), IRIS_OK);
    assert_memory_equal(plane.to_image_q32, numbers + 2, sizeof plane.to_image_q32);
    snprintf(text, sizeof text,
             "# my floor\r\n\r\n  iris \t floor 1 # one\r\nsize 320 240\r\n\n image_from_floor_q32#\r\n"
             "3435973836 0 687194767360\r\n0   -12884901 85899345920\r\n\t0 21474836 4294967296\r\n%s# end",
             check);
    assert_int_equal(iris_floor_read_text(&plane, &line, text, strlen(text)), IRIS_OK);
    assert_memory_equal(plane.to_image_q32, numbers + 2, sizeof plane.to_image_q32);
}

static void needs_no_check(void **state)
{
    (void)state;
    const int64_t numbers[9] = {3435973836,  0, 687194767360, 0,         -12884901,
                                85899345920, 0, 21474836,     4294967296};
    char text[1000];
    iris_floor plane;
    int32_t line = 0;
    const size_t length = strlen(example);
    assert_int_equal(example[length - 1], '\n');
    assert_int_equal(iris_floor_read_text(&plane, &line, example, length), IRIS_OK);
    assert_memory_equal(plane.to_image_q32, numbers, sizeof numbers);
    snprintf(text, sizeof text, "%s\n# by hand", example);
    assert_int_equal(iris_floor_read_text(&plane, &line, text, strlen(text)), IRIS_OK);
    for (size_t i = 0; i < length; i++) { /* a text that was cut is none */
        assert_int_not_equal(iris_floor_read_text(&plane, &line, example, i), IRIS_OK);
    }
    snprintf(text, sizeof text, "%schec", example);
    assert_int_equal(iris_floor_read_text(&plane, &line, text, strlen(text)), IRIS_ERR_DATA);
}

static void refuses(iris_status expected, int32_t expected_line, const char *text)
{
    iris_floor plane, kept;
    int32_t line = -1;
    memset(&plane, 0x5A, sizeof plane);
    kept = plane;
    iris_status status = iris_floor_read_text(&plane, &line, text, strlen(text));
    if (status != expected || line != expected_line) {
        print_error("status %d, line %d of: %s\n", (int)status, (int)line, text);
        fail();
    }
    assert_memory_equal(&plane, &kept, sizeof kept);
}

static void lines_are_told(void **state)
{
    (void)state;
    refuses(IRIS_ERR_TRUNCATED, 1, "");
    refuses(IRIS_ERR_TRUNCATED, 3, "# no\n\n");
    refuses(IRIS_ERR_DATA, 1, "P5\n3 4\n");
    refuses(IRIS_ERR_DATA, 1, "iris floor\n");
    refuses(IRIS_ERR_DATA, 1, "iris floor 0\n");
    refuses(IRIS_ERR_DATA, 1, "iris floor 1 1\n");
    refuses(IRIS_ERR_UNSUPPORTED, 2, "#\niris floor 2\n");
    refuses(IRIS_ERR_UNSUPPORTED, 2, "#\niris floor 2 with more\n");
    refuses(IRIS_ERR_DATA, 3, "\niris floor 1\nsize 320\n");
    refuses(IRIS_ERR_DATA, 2, "iris floor 1\nsize 0 240\n");
    refuses(IRIS_ERR_DATA, 2, "iris floor 1\nsize 320 32768\n");
    refuses(IRIS_ERR_DATA, 2, "iris floor 1\nsize 320 240x\n");
    refuses(IRIS_ERR_DATA, 3, "iris floor 1\nsize 320 240\nimage_from_floor_q16\n");
    refuses(IRIS_ERR_DATA, 4, "iris floor 1\nsize 320 240\nimage_from_floor_q32\n1 2\n");
    refuses(IRIS_ERR_DATA, 4, "iris floor 1\nsize 320 240\nimage_from_floor_q32\n1 2 9999999999999999999\n");
    refuses(IRIS_ERR_DATA, 4, "iris floor 1\nsize 320 240\nimage_from_floor_q32\n1 2 -\n");
    refuses(IRIS_ERR_TRUNCATED, 5, "iris floor 1\nsize 320 240\nimage_from_floor_q32\n1 2 3");
    char text[400];
    snprintf(text, sizeof text, "%scheck 12345678\n", example);
    refuses(IRIS_ERR_DATA, 7, text);
    snprintf(text, sizeof text, "%scheck 1234567\n", example);
    refuses(IRIS_ERR_DATA, 7, text);
    snprintf(text, sizeof text, "%sbraced\n", example);
    refuses(IRIS_ERR_DATA, 7, text);
}

static void arguments_are_checked(void **state)
{
    (void)state;
    test_camera c = any_camera();
    iris_floor plane = true_floor(&c);
    char text[IRIS_FLOOR_TEXT_BYTES];
    size_t length;
    int32_t line;
    assert_int_equal(iris_floor_write_text(NULL, sizeof text, &length, &plane), IRIS_ERR_ARG);
    assert_int_equal(iris_floor_write_text(text, sizeof text, NULL, &plane), IRIS_ERR_ARG);
    assert_int_equal(iris_floor_write_text(text, sizeof text, &length, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_floor_read_text(NULL, &line, example, 4), IRIS_ERR_ARG);
    assert_int_equal(iris_floor_read_text(&plane, NULL, example, 4), IRIS_ERR_ARG);
    assert_int_equal(iris_floor_read_text(&plane, &line, NULL, 4), IRIS_ERR_ARG);
    assert_int_equal(iris_floor_read_text(&plane, &line, NULL, 0), IRIS_ERR_TRUNCATED);
    memset(&plane, 0, sizeof plane);
    assert_int_equal(iris_floor_write_text(text, sizeof text, &length, &plane), IRIS_ERR_RANGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts_come_back),  cmocka_unit_test(the_longest_fits),
        cmocka_unit_test(people_may_write), cmocka_unit_test(needs_no_check),
        cmocka_unit_test(lines_are_told),   cmocka_unit_test(arguments_are_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
