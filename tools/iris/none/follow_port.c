/* The serial port of `iris follow` where the library has none. */
#include "../follow_port.h"

#include "../complain.h"

int follow_port_open(const char *path, int32_t baud)
{
    (void)baud;
    complain(path, "this build of iris has no serial ports");
    return EXIT_BAD_DATA;
}

void follow_port_send(const iris_command *command)
{
    (void)command;
}

void follow_port_wait(int64_t ms)
{
    (void)ms;
}

int follow_port_stop(void)
{
    return EXIT_BAD_DATA;
}
