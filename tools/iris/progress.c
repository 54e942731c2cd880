#include "progress.h"

#include <stdint.h>
#include <stdio.h>
#include <unistd.h>

#include "one_line.h"
#include "system.h"

#define PERIOD_MS 100

static int shown;
static int64_t last_ms;

void progress_show(const char *command, int part, int parts, const char *name)
{
    if (parts == 1 || !system_is_terminal(STDERR_FILENO)) {
        return;
    }
    int64_t now = system_clock_ms();
    if (last_ms != 0 && now - last_ms < PERIOD_MS) {
        return;
    }
    last_ms = now;
    char start[61];
    snprintf(start, sizeof start, "%s", name);
    fprintf(stderr, "\r\033[K%s %d", command, part);
    if (parts > 0) {
        fprintf(stderr, "/%d", parts);
    }
    fputc(' ', stderr);
    one_line(stderr, start);
    fflush(stderr);
    shown = 1;
}

void progress_clear(void)
{
    if (shown) {
        fputs("\r\033[K", stderr);
        fflush(stderr);
        shown = 0;
    }
}
