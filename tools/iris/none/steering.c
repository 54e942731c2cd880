/* Steering out of `iris follow` where the library has neither serial ports nor GPIO lines. */
#include "../steering.h"

#include "../complain.h"

int steering_open(const steering_options *options)
{
    if (options->serial) {
        complain(options->serial, "this build of iris has no serial ports");
    } else {
        complain(options->chip, "this build of iris has no GPIO lines");
    }
    return EXIT_BAD_DATA;
}

void steering_send(const iris_command *command)
{
    (void)command;
}

void steering_halt(void)
{
}

void steering_wait(int64_t ms)
{
    (void)ms;
}

int steering_stop(void)
{
    return EXIT_BAD_DATA;
}
