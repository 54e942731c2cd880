/* The digest program's voice where there is an operating system. */
#include "digest.h"

#include <stdio.h>

void target_print(const char *text)
{
    fputs(text, stdout);
}
