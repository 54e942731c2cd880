#include "../stop_signal.h"

#include <signal.h>

static volatile sig_atomic_t came;

static void note(int number)
{
    (void)number;
    came = 1;
}

void stop_signal_catch(void)
{
    (void)signal(SIGINT, note);
}

int stop_signal_came(void)
{
    return came;
}
