#include "../serial_orders.h"

#include "../complain.h"
#include "iris/serial.h"

#define BAUD         115200
#define RECONNECT_MS 500

static iris_serial port;
static iris_command_parser parser;

int serial_orders_open(const char *path)
{
    iris_command_parser_init(&parser);
    if (iris_serial_open(&port, path, BAUD, RECONNECT_MS, 0) != IRIS_OK) {
        complain(path, "%s", iris_serial_error(&port));
        iris_serial_close(&port);
        return 0;
    }
    return 1;
}

int serial_orders_next(iris_command *command, uint32_t now_ms)
{
    char bytes[256];
    size_t count = 0;
    int came = 0;
    do {
        if (iris_serial_receive(bytes, &count, &port, sizeof bytes, now_ms) != IRIS_OK) {
            return came;
        }
        for (size_t i = 0; i < count; i++) {
            came |= iris_command_parse(command, &parser, bytes[i]) == IRIS_OK;
        }
    } while (count == sizeof bytes);
    return came;
}

void serial_orders_close(void)
{
    iris_serial_close(&port);
}
