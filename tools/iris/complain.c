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
    progress_clear();
    fflush(stdout); /* in the order things happened, where both go to the same place */
    fprintf(stderr, "iris%s%s: ", current ? " " : "", current ? current : "");
    if (subject) {
        fprintf(stderr, "%s: ", subject);
    }
    va_start(list, format);
    vfprintf(stderr, format, list);
    va_end(list);
    fputc('\n', stderr);
}
