/* A hundred thousand random calls of every operation on pictures: whatever it is given, it returns a status, reads and writes
 * what is its own, and leaves the rest as it was. The same calls in every run; `random_calls N` makes call N alone,
 * and `random_calls N COUNT` COUNT from N on: other ones for as long as one likes. */
#include <stdio.h>

#include "calls/calls.h"
#include "test.h"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/common_interface_defs.h>
#endif

#define CALLS_MODULE(module) calls_##module,
static const random_call *const modules[] = {
#include "calls/modules.def"
};
#undef CALLS_MODULE
enum { MODULES = sizeof modules / sizeof modules[0], CALLS = 100000, FUNCTIONS_MAX = 256 };

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

#if defined(__SANITIZE_ADDRESS__)
static void say_which(void)
{
    fprintf(stderr, "call %lu, %s\n", (unsigned long)current, functions[current % function_count]->name);
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
#if defined(__SANITIZE_ADDRESS__)
    __sanitizer_set_death_callback(say_which);
#endif
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_hundred_thousand_random_calls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
