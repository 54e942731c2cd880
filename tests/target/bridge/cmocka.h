/* CMocka's interface, as far as the tests of the library use it, in Unity's macros: the same test files run on the host
 * with CMocka and on bare metal with Unity. Instead of CMocka's own header on the include path. */
#ifndef IRIS_BRIDGE_CMOCKA_H
#define IRIS_BRIDGE_CMOCKA_H

#include "target.h"
#include "unity.h"

#define assert_true(condition)             TEST_ASSERT_TRUE_MESSAGE(condition, #condition)
#define assert_false(condition)            TEST_ASSERT_TRUE_MESSAGE(!(condition), "not " #condition)
#define assert_int_equal(actual, expected) TEST_ASSERT_EQUAL_INT64((int64_t)(expected), (int64_t)(actual))
#define assert_int_not_equal(actual, other)                                                                  \
    TEST_ASSERT_TRUE_MESSAGE((actual) != (other), #actual " is " #other)
#define assert_in_range(actual, least, most)                                                                 \
    TEST_ASSERT_TRUE_MESSAGE((uintmax_t)(actual) >= (uintmax_t)(least) &&                                    \
                                 (uintmax_t)(actual) <= (uintmax_t)(most),                                   \
                             #actual " is not in " #least " to " #most)
#define assert_null(pointer)     TEST_ASSERT_TRUE_MESSAGE((pointer) == NULL, #pointer " is not null")
#define assert_non_null(pointer) TEST_ASSERT_TRUE_MESSAGE((pointer) != NULL, #pointer " is null")
#define assert_ptr_equal(actual, expected)                                                                   \
    TEST_ASSERT_TRUE_MESSAGE((const void *)(actual) == (const void *)(expected), #actual " is "              \
                                                                                         "not " #expected)
#define assert_string_equal(actual, expected) TEST_ASSERT_EQUAL_STRING(expected, actual)
#define assert_memory_equal(actual, expected, bytes)                                                         \
    TEST_ASSERT_TRUE_MESSAGE(memcmp(actual, expected, bytes) == 0, #actual " differs from " #expected)
#define assert_memory_not_equal(actual, other, bytes)                                                        \
    TEST_ASSERT_TRUE_MESSAGE(memcmp(actual, other, bytes) != 0, #actual " is as " #other)
#define fail()        TEST_FAIL_MESSAGE("failed")
#define fail_msg(...) TEST_FAIL_MESSAGE(bridge_text(__VA_ARGS__))
#define skip()        TEST_IGNORE_MESSAGE("what it needs is not here")

#define print_message(...) target_print(bridge_text(__VA_ARGS__))
#define print_error(...)   print_message(__VA_ARGS__)

struct CMUnitTest {
    const char *name;
    void (*test)(void **state);
};
#define cmocka_unit_test(test)                                                                               \
    {                                                                                                        \
#test, test                                                                                          \
    }

#define cmocka_run_group_tests(tests, setup, teardown)                                                       \
    bridge_run(__FILE__, tests, sizeof(tests) / sizeof((tests)[0]), setup, teardown)
#define cmocka_run_group_tests_name(name, tests, setup, teardown)                                            \
    bridge_run(name, tests, sizeof(tests) / sizeof((tests)[0]), setup, teardown)

/* Runs the tests behind setup and before teardown, either of which may be null and returns 0 when it worked; the number
 * that failed. */
int bridge_run(const char *name, const struct CMUnitTest *tests, size_t count, int (*setup)(void **state),
               int (*teardown)(void **state));

/* A message of printf's; it lasts until the next one. */
__attribute__((format(printf, 1, 2))) const char *bridge_text(const char *format, ...);

#endif
