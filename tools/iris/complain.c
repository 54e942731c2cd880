#include "complain.h"

#include <stdarg.h>
#include <stdio.h>

#include "one_line.h"
#include "progress.h"

static const char *current;
static void (*current_taker)(const char *subject, const char *text);

void complain_as(const char *command)
{
    current = command;
}

void complain_to(void (*taker)(const char *subject, const char *text))
{
    current_taker = taker;
}

void complain(const char *subject, const char *format, ...)
{
    char text[1024]; /* the rest of what is longer says nothing new */
    va_list list;
    va_start(list, format);
    /* clang-tidy 14 forgets va_start among several files. NOLINTNEXTLINE(clang-analyzer-valist.Uninitialized) */
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    if (current_taker) {
        current_taker(subject, text);
        return;
    }
    progress_clear();
    fflush(stdout); /* in the order things happened, where both go to the same place */
    fprintf(stderr, "iris%s%s: ", current ? " " : "", current ? current : "");
    if (subject) {
        one_line(stderr, subject);
        fputs(": ", stderr);
    }
    one_line(stderr, text);
    fputc('\n', stderr);
}
