/* The counter's voice where there is an operating system. */
#include "bench.h"

#include <stdio.h>

void target_print(const char *text)
{
    fputs(text, stdout);
}
