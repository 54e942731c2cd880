#include "progress.h"

#include <stdint.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

#include "one_line.h"

#define PERIOD_MS 100

static int shown;
static int64_t last_ms;

static int64_t now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

void progress_show(const char *command, int part, int parts, const char *name)
{
    if (parts < 2 || !isatty(STDERR_FILENO)) {
        return;
    }
    int64_t now = now_ms();
    if (last_ms != 0 && now - last_ms < PERIOD_MS) {
        return;
    }
    last_ms = now;
    char start[61];
    snprintf(start, sizeof start, "%s", name);
    fprintf(stderr, "\r\033[K%s %d/%d ", command, part, parts);
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
