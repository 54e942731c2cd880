/* The serial port of `iris follow`: sends commands, says once when the port goes away, is blocked, or works again, and
 * stops the robot when the program ends, by a signal too.
 */
#ifndef IRIS_TOOL_FOLLOW_PORT_H
#define IRIS_TOOL_FOLLOW_PORT_H

#include <stdint.h>

#include "iris/command.h"

/* Opens the port; path must stay. Complains; returns an exit code. */
int follow_port_open(const char *path, int32_t baud);

/* Never waits. */
void follow_port_send(const iris_command *command);

/* Waits until `ms` milliseconds after opening, while what waits is sent. */
void follow_port_wait(int64_t ms);

/* Sends the command to stop, waits at most half a second until it has left, closes the port. Returns an exit code. */
int follow_port_stop(void);

#endif
