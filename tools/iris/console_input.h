/* Standard input as far as it is there, without waiting: once in posix/, once in windows/.
 */
#ifndef IRIS_TOOL_CONSOLE_INPUT_H
#define IRIS_TOOL_CONSOLE_INPUT_H

#include <stddef.h>

/* How many bytes were taken, at most `room`; 0: none are there now; -1: none will come any more. */
int console_input(char *bytes, size_t room);

#endif
