/* Groups of CMocka's tests, run by Unity; and the C library's memory and files on a board. */
#include "cmocka.h"

#include <stdarg.h>
#include <stdio.h>

void initialise_monitor_handles(void); /* of the C library's semihosting */
void *__wrap__sbrk(ptrdiff_t bytes);   /* instead of its heap, which it expects below the stack */
extern uint8_t link_bss_end[], link_ram_end[];

static const struct CMUnitTest *current;
static void *state;

static void run_current(void)
{
    current->test(&state);
}

void setUp(void)
{
}

void tearDown(void)
{
}

int bridge_run(const char *name, const struct CMUnitTest *tests, size_t count, int (*setup)(void **state),
               int (*teardown)(void **state))
{
    initialise_monitor_handles();
    UnityBegin(name);
    int broken = setup && setup(&state) != 0;
    for (size_t i = 0; !broken && i < count; i++) {
        current = &tests[i];
        UnityDefaultTestRun(run_current, current->name, 0);
    }
    broken |= teardown && teardown(&state) != 0;
    return UnityEnd() + broken;
}

const char *bridge_text(const char *format, ...)
{
    static char text[256];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return text;
}

void *__wrap__sbrk(ptrdiff_t bytes)
{
    static uint8_t *end = link_bss_end;
    if (bytes > link_ram_end - end) {
        return (void *)-1;
    }
    end += bytes;
    return end - bytes;
}
