/* Text that may hold anything, such as a file's name, on one line of output. */
#ifndef IRIS_TOOL_ONE_LINE_H
#define IRIS_TOOL_ONE_LINE_H

#include <stdio.h>

/* Prints text with '?' for every control character: line breaks, and what a terminal would obey. */
void one_line(FILE *out, const char *text);

#endif
