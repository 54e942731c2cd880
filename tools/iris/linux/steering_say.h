/* What is said on standard error by what must not wait: a pipe that nobody reads, or a terminal that is halted, would stop the
 * robot's steering for good. What cannot be said now is not said. */
#ifndef IRIS_TOOL_STEERING_SAY_H
#define IRIS_TOOL_STEERING_SAY_H

#include <stddef.h>

/* One line, as complain says it. subject: null for none. Takes no lock of standard streams. */
void steering_say(const char *subject, const char *text);

/* Bytes as they are, line break and all. A signal may call it. */
void steering_say_bytes(const char *bytes, size_t count);

#endif
