#include "complain.h"

#include <stdarg.h>
#include <stdio.h>

#include "progress.h"

static const char *current;

void complain_as(const char *command)
{
    current = command;
}

void complain(const char *subject, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    progress_clear();
    fflush(stdout); /* in the order things happened, where both go to the same place */
    fprintf(stderr, "iris%s%s: ", current ? " " : "", current ? current : "");
    if (subject) {
        for (const char *at = subject; *at != '\0'; at++) { /* a name with a line break stays on its line */
            fputc((unsigned char)*at < ' ' ? '?' : *at, stderr);
        }
        fputs(": ", stderr);
    }
    /* clang-tidy 14 forgets va_start when it reads several files. NOLINTNEXTLINE(clang-analyzer-valist.Uninitialized) */
    vfprintf(stderr, format, list);
    va_end(list);
    fputc('\n', stderr);
}
