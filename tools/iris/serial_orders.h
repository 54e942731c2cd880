/* Command sentences that come in by a serial port, as a gamepad's stream: once in linux/, and refused in none/.
 */
#ifndef IRIS_TOOL_SERIAL_ORDERS_H
#define IRIS_TOOL_SERIAL_ORDERS_H

#include "iris/command.h"

/* path must stay. Complains; returns 1, or 0. */
int serial_orders_open(const char *path);

/* The newest sentence since the last call. 0: none came. Never waits. */
int serial_orders_next(iris_command *command, uint32_t now_ms);

void serial_orders_close(void);

#endif
