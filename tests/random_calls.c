/* A hundred thousand random calls of operations on pictures and in space: whatever each is given, it returns a status, reads
 * and writes what is its own, and leaves the rest as it was. The same calls in every run, on one kind of processor.
 * `random_calls N` makes call N alone, and `random_calls N COUNT` COUNT from N on: other ones for as long as one likes. */
#include <dirent.h>
#include <stdio.h>

#include "calls/calls.h"
#include "test.h"

#if defined(IRIS_CHECKED)
#include <sanitizer/common_interface_defs.h>
#endif

#define CALLS_MODULE(module) calls_##module,
static const random_call *const modules[] = {
#include "calls/modules.def"
};
#undef CALLS_MODULE
enum { MODULES = sizeof modules / sizeof modules[0], CALLS = 100000, FUNCTIONS_MAX = 512 };

static const random_call *functions[FUNCTIONS_MAX];
static uint32_t accepted[FUNCTIONS_MAX], function_count, first_call = 0, end_call = CALLS, current;

static void make_call(uint32_t number)
{
    uint32_t f = number % function_count;
    current = number;
    calls_start(number, functions[f]->name);
    functions[f]->call();
    accepted[f] += (uint32_t)calls_accepted();
}

static void a_hundred_thousand_random_calls(void **state)
{
    (void)state;
    uint32_t sum = 0;
    for (uint32_t i = first_call; i < end_call; i++) {
        make_call(i);
    }
    for (uint32_t f = 0; f < function_count; f++) {
        sum += accepted[f];
        if (accepted[f] == 0 && end_call - first_call >= CALLS) {
            fail_msg("%s was never called rightly", functions[f]->name);
        }
    }
    printf("#: %lu random calls of %lu functions, %lu refused\n", (unsigned long)(end_call - first_call),
           (unsigned long)function_count, (unsigned long)(end_call - first_call - sum));
}

/* Where operations are not of this kind: files, streams, sentences, and what drives, which fuzzing and tests of their own
 * are for; and numbers. */
static int has_no_operations(const char *header)
{
    static const char *const others[] = {
        "bmp.h",     "pnm.h",          "stream.h",       "command.h",     "serial.h",         "watchdog.h",
        "pwm.h",     "differential.h", "indicator.h",    "gpio.h",        "follow.h",         "steer.h",
        "scratch.h", "capture.h",      "v4l2.h",         "camera_list.h", "camera_control.h", "libcamera.h",
        "udp.h",     "mqtt.h",         "serial_robot.h", "gpio_drive.h",  "camera_eye.h"};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        if (strcmp(header, others[i]) == 0) {
            return 1;
        }
    }
    return 0;
}

static int is_called(const char *name)
{
    for (uint32_t f = 0; f < function_count; f++) {
        if (strcmp(functions[f]->name, name) == 0) {
            return 1;
        }
    }
    return 0;
}

/* The functions of a header that return a status. */
static int operations_of(const char *path)
{
    FILE *file = fopen(path, "r");
    char line[256], name[64];
    int count = 0;
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        if (sscanf(line, "iris_status %63[a-z0-9_](", name) == 1) {
            count++;
            if (!is_called(name)) {
                (void)fclose(file);
                fail_msg("%s has no random calls in tests/calls", name);
            }
        }
    }
    (void)fclose(file);
    return count;
}

static void every_operation_is_called(void **state)
{
    (void)state;
    static const char *const folders[] = {"include/iris",        "include/iris/xt",      "include/iris/3d",
                                          "include/iris/osiris", "include/iris/runtime", "include/iris/borg"};
    int count = 0;
    for (int i = 0; i < (int)(sizeof folders / sizeof folders[0]); i++) {
        char path[512];
        struct dirent *entry;
        DIR *folder = opendir(folders[i]);
        assert_non_null(folder); /* the tests run in the project's folder */
        while ((entry = readdir(folder))) {
            if (strstr(entry->d_name, ".h") && !has_no_operations(entry->d_name)) {
                snprintf(path, sizeof path, "%s/%s", folders[i], entry->d_name);
                count += operations_of(path);
            }
        }
        closedir(folder);
    }
    assert_int_equal(count, function_count);
}

#if defined(IRIS_CHECKED)
static void say_which(void)
{
    fprintf(stderr, "call %lu, %s\n", (unsigned long)current, functions[current % function_count]->name);
}

/* The sanitizer of undefined behavior has its own way to end, and calls this before it. */
void __ubsan_on_report(void); /* NOLINT(bugprone-reserved-identifier) */
void __ubsan_on_report(void)  /* NOLINT(bugprone-reserved-identifier) */
{
    say_which();
}
#endif

int main(int argc, char **argv)
{
    for (int m = 0; m < MODULES; m++) {
        for (const random_call *f = modules[m]; f->name && function_count < FUNCTIONS_MAX; f++) {
            functions[function_count++] = f;
        }
    }
    if (argc > 1) {
        first_call = (uint32_t)strtoul(argv[1], NULL, 10);
        end_call = first_call + (argc > 2 ? (uint32_t)strtoul(argv[2], NULL, 10) : 1);
    }
#if defined(IRIS_CHECKED)
    __sanitizer_set_death_callback(say_which);
#endif
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_operation_is_called),
        cmocka_unit_test(a_hundred_thousand_random_calls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
