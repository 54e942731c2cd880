/* The serial port of `iris follow`: sends commands, and says once when the port goes away, is blocked, or works again. */
#ifndef IRIS_TOOL_STEERING_PORT_H
#define IRIS_TOOL_STEERING_PORT_H

#include <stdint.h>

#include "iris/command.h"
#include "iris/serial.h"

typedef enum { PORT_WORKS, PORT_AWAY, PORT_BLOCKED } steering_port_condition;

typedef struct {
    iris_serial serial;
    steering_port_condition condition;
    int64_t busy_since_ms; /* -1: not busy */
    uint32_t sent;         /* serial.sent when last looked at */
} steering_port;

/* Complains; returns an exit code. */
int steering_port_open(steering_port *port, const char *path, int32_t baud, int64_t now_ms);

/* Both never wait, and return what iris_serial_send and iris_serial_continue do. */
iris_status steering_port_send(steering_port *port, const iris_command *command, int64_t now_ms);
iris_status steering_port_continue(steering_port *port, int64_t now_ms);

#endif
