#include "steering_port.h"

#include "../complain.h"

#define RECONNECT_MS 250
#define BLOCKED_MS   1000 /* a port that took nothing for so long is blocked */

static void change_to(steering_port *port, steering_port_condition condition)
{
    if (condition == port->condition) {
        return;
    }
    port->condition = condition;
    switch (condition) {
    case PORT_WORKS:
        complain(port->serial.path, "works again");
        break;
    case PORT_AWAY:
        complain(port->serial.path, "%s; going on without it", iris_serial_error(&port->serial));
        break;
    case PORT_BLOCKED:
        complain(port->serial.path, "blocked, takes no more commands; going on");
        break;
    }
}

/* What the last call says about the port. */
static void judge(steering_port *port, iris_status status, int64_t now_ms)
{
    if (status == IRIS_ERR_IO) {
        port->busy_since_ms = -1;
        change_to(port, PORT_AWAY);
    } else if (status == IRIS_OK || port->serial.sent != port->sent) {
        port->busy_since_ms = -1;
        change_to(port, PORT_WORKS);
    } else if (port->busy_since_ms < 0) {
        port->busy_since_ms = now_ms;
    } else if (now_ms - port->busy_since_ms > BLOCKED_MS) {
        change_to(port, PORT_BLOCKED);
    }
    port->sent = port->serial.sent;
}

int steering_port_open(steering_port *port, const char *path, int32_t baud, int64_t now_ms)
{
    port->condition = PORT_WORKS;
    port->busy_since_ms = -1;
    port->sent = 0;
    iris_status status = iris_serial_open(&port->serial, path, baud, RECONNECT_MS, (uint32_t)now_ms);
    if (status == IRIS_ERR_ARG) {
        complain("--baud", "%d is no usual speed (9600, 19200, 38400, 57600, 115200, ...)", (int)baud);
        return EXIT_BAD_CALL;
    }
    if (status != IRIS_OK) {
        complain(path, "%s", iris_serial_error(&port->serial));
        iris_serial_close(&port->serial);
        return EXIT_BAD_DATA;
    }
    return EXIT_DONE;
}

iris_status steering_port_send(steering_port *port, const iris_command *command, int64_t now_ms)
{
    char sentence[IRIS_COMMAND_SENTENCE_BYTES];
    size_t length;
    iris_status status = iris_command_format(sentence, sizeof sentence, &length, command);
    if (status == IRIS_OK) {
        status = iris_serial_send(&port->serial, sentence, length, (uint32_t)now_ms);
        judge(port, status, now_ms);
    }
    return status;
}

iris_status steering_port_continue(steering_port *port, int64_t now_ms)
{
    iris_status status = iris_serial_continue(&port->serial, (uint32_t)now_ms);
    judge(port, status, now_ms);
    return status;
}
