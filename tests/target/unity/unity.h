/* The part of Unity's interface (ThrowTheSwitch) that the tests here use, for machines that have no copy of it: the
 * same macros, and output in the same form, file:line:test:PASS. */
#ifndef UNITY_H
#define UNITY_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

void setUp(void);
void tearDown(void);

void UnityBegin(const char *file);
int UnityEnd(void);
void UnityDefaultTestRun(void (*test)(void), const char *name, int line);

/* These end the test. */
__attribute__((noreturn)) void unity_fail(int line, const char *message);
__attribute__((noreturn)) void unity_ignore(int line, const char *message);

void unity_equal(int line, int64_t expected, int64_t actual);

#define UNITY_BEGIN()  UnityBegin(__FILE__)
#define UNITY_END()    UnityEnd()
#define RUN_TEST(test) UnityDefaultTestRun(test, #test, __LINE__)

#define TEST_FAIL_MESSAGE(message)   unity_fail(__LINE__, message)
#define TEST_IGNORE_MESSAGE(message) unity_ignore(__LINE__, message)
#define TEST_ASSERT_TRUE_MESSAGE(condition, message)                                                         \
    do {                                                                                                     \
        if (!(condition)) {                                                                                  \
            unity_fail(__LINE__, message);                                                                   \
        }                                                                                                    \
    } while (0)
#define TEST_ASSERT_TRUE(condition)                TEST_ASSERT_TRUE_MESSAGE(condition, "Expected TRUE Was FALSE")
#define TEST_ASSERT_FALSE(condition)               TEST_ASSERT_TRUE_MESSAGE(!(condition), "Expected FALSE Was TRUE")
#define TEST_ASSERT_NULL(pointer)                  TEST_ASSERT_TRUE((pointer) == NULL)
#define TEST_ASSERT_NOT_NULL(pointer)              TEST_ASSERT_TRUE((pointer) != NULL)
#define TEST_ASSERT_EQUAL_INT(expected, actual)    unity_equal(__LINE__, expected, actual)
#define TEST_ASSERT_EQUAL_INT32(expected, actual)  unity_equal(__LINE__, expected, actual)
#define TEST_ASSERT_EQUAL_UINT32(expected, actual) unity_equal(__LINE__, expected, actual)
#define TEST_ASSERT_EQUAL_INT64(expected, actual)  unity_equal(__LINE__, expected, actual)
#define TEST_ASSERT_EQUAL_STRING(expected, actual) TEST_ASSERT_TRUE(strcmp(expected, actual) == 0)
#define TEST_ASSERT_EQUAL_MEMORY(expected, actual, bytes)                                                    \
    TEST_ASSERT_TRUE_MESSAGE(memcmp(expected, actual, bytes) == 0, "Memory differs")
#define TEST_ASSERT_INT_WITHIN(delta, expected, actual)                                                      \
    TEST_ASSERT_TRUE((actual) >= (expected) - (delta) && (actual) <= (expected) + (delta))
#define TEST_ASSERT_LESS_OR_EQUAL_UINT32(threshold, actual) TEST_ASSERT_TRUE((actual) <= (threshold))

#endif
