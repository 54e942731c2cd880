#include "../serial_orders.h"

#include "../complain.h"

int serial_orders_open(const char *path)
{
    complain(path, "serial ports are read on Linux only");
    return 0;
}

int serial_orders_next(iris_command *command, uint32_t now_ms)
{
    (void)command;
    (void)now_ms;
    return 0;
}

void serial_orders_close(void)
{
}
