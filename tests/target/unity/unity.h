/* The part of Unity's interface (ThrowTheSwitch) that the tests here use, for machines that have no copy of it: the
 * same macros, and output in the same form, file:line:test:PASS. One test program per firmware includes this once. */
#ifndef UNITY_H
#define UNITY_H

#include <setjmp.h>
#include <stdint.h>
#include <string.h>

#include "target.h"

void setUp(void);
void tearDown(void);

static struct {
    jmp_buf leave;
    const char *file, *test;
    int32_t tests, failures, ignored;
} unity;

static inline void unity_print_number(int32_t value)
{
    char text[12], *digit = text + sizeof text - 1;
    uint32_t rest = value < 0 ? 0u - (uint32_t)value : (uint32_t)value;
    *digit = '\0';
    do {
        *--digit = (char)('0' + rest % 10);
        rest /= 10;
    } while (rest != 0);
    if (value < 0) {
        *--digit = '-';
    }
    target_print(digit);
}

static inline void unity_verdict(int line, const char *verdict)
{
    target_print(unity.file);
    target_print(":");
    unity_print_number(line);
    target_print(":");
    target_print(unity.test);
    target_print(verdict);
}

__attribute__((noreturn)) static inline void unity_fail(int line, const char *message)
{
    unity_verdict(line, ":FAIL: ");
    target_print(message);
    longjmp(unity.leave, 1);
}

__attribute__((noreturn)) static inline void unity_ignore(int line, const char *message)
{
    unity_verdict(line, ":IGNORE: ");
    target_print(message);
    longjmp(unity.leave, 2);
}

static inline void unity_equal(int line, intmax_t expected, intmax_t actual)
{
    if (expected != actual) {
        unity_verdict(line, ":FAIL: Expected ");
        unity_print_number((int32_t)expected);
        target_print(" Was ");
        unity_print_number((int32_t)actual);
        longjmp(unity.leave, 1);
    }
}

static inline void unity_run(void (*test)(void), const char *name, int line)
{
    unity.test = name;
    unity.tests++;
    int left = setjmp(unity.leave);
    if (left == 0) {
        setUp();
        test();
        unity_verdict(line, ":PASS");
    }
    unity.failures += left == 1;
    unity.ignored += left == 2;
    tearDown();
    target_print("\n");
}

static inline int unity_end(void)
{
    unity_print_number(unity.tests);
    target_print(" Tests ");
    unity_print_number(unity.failures);
    target_print(" Failures ");
    unity_print_number(unity.ignored);
    target_print(" Ignored\n");
    return (int)unity.failures;
}

#define UNITY_BEGIN()  ((void)(unity.file = __FILE__))
#define UNITY_END()    unity_end()
#define RUN_TEST(test) unity_run(test, #test, __LINE__)

#define TEST_FAIL_MESSAGE(message)   unity_fail(__LINE__, message)
#define TEST_IGNORE_MESSAGE(message) unity_ignore(__LINE__, message)
#define TEST_ASSERT_TRUE(condition)                                                                          \
    do {                                                                                                     \
        if (!(condition)) {                                                                                  \
            unity_fail(__LINE__, "Expected TRUE Was FALSE");                                                 \
        }                                                                                                    \
    } while (0)
#define TEST_ASSERT_FALSE(condition)               TEST_ASSERT_TRUE(!(condition))
#define TEST_ASSERT_NULL(pointer)                  TEST_ASSERT_TRUE((pointer) == NULL)
#define TEST_ASSERT_NOT_NULL(pointer)              TEST_ASSERT_TRUE((pointer) != NULL)
#define TEST_ASSERT_EQUAL_INT(expected, actual)    unity_equal(__LINE__, expected, actual)
#define TEST_ASSERT_EQUAL_INT32(expected, actual)  unity_equal(__LINE__, expected, actual)
#define TEST_ASSERT_EQUAL_UINT32(expected, actual) unity_equal(__LINE__, expected, actual)
#define TEST_ASSERT_EQUAL_STRING(expected, actual) TEST_ASSERT_TRUE(strcmp(expected, actual) == 0)
#define TEST_ASSERT_EQUAL_MEMORY(expected, actual, bytes)                                                    \
    TEST_ASSERT_TRUE(memcmp(expected, actual, bytes) == 0)
#define TEST_ASSERT_INT_WITHIN(delta, expected, actual)                                                      \
    TEST_ASSERT_TRUE((actual) >= (expected) - (delta) && (actual) <= (expected) + (delta))
#define TEST_ASSERT_LESS_OR_EQUAL_UINT32(threshold, actual) TEST_ASSERT_TRUE((actual) <= (threshold))

#endif
