#include "unity.h"

#include <setjmp.h>

#include "target.h"

static struct {
    jmp_buf leave;
    const char *file, *test;
    int32_t tests, failures, ignored;
} unity;

static void print_number(int64_t value)
{
    char text[21], *digit = text + sizeof text - 1;
    uint64_t rest = value < 0 ? 0u - (uint64_t)value : (uint64_t)value;
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

static void print_verdict(int line, const char *verdict)
{
    target_print(unity.file);
    target_print(":");
    print_number(line);
    target_print(":");
    target_print(unity.test);
    target_print(verdict);
}

void unity_fail(int line, const char *message)
{
    print_verdict(line, ":FAIL: ");
    target_print(message);
    longjmp(unity.leave, 1);
}

void unity_ignore(int line, const char *message)
{
    print_verdict(line, ":IGNORE: ");
    target_print(message);
    longjmp(unity.leave, 2);
}

void unity_equal(int line, int64_t expected, int64_t actual)
{
    if (expected != actual) {
        print_verdict(line, ":FAIL: Expected ");
        print_number(expected);
        target_print(" Was ");
        print_number(actual);
        longjmp(unity.leave, 1);
    }
}

void UnityDefaultTestRun(void (*test)(void), const char *name, int line)
{
    unity.test = name;
    unity.tests++;
    int left = setjmp(unity.leave);
    if (left == 0) {
        setUp();
        test();
        print_verdict(line, ":PASS");
    }
    unity.failures += left == 1;
    unity.ignored += left == 2;
    tearDown();
    target_print("\n");
}

void UnityBegin(const char *file)
{
    unity.file = file;
    unity.tests = unity.failures = unity.ignored = 0;
}

int UnityEnd(void)
{
    print_number(unity.tests);
    target_print(" Tests ");
    print_number(unity.failures);
    target_print(" Failures ");
    print_number(unity.ignored);
    target_print(" Ignored\n");
    return (int)unity.failures;
}
