/* What programs in the virtual machine need of it: tests/rig/start names the devices, tests/rig/rig the requests. */
#ifndef IRIS_RIG_H
#define IRIS_RIG_H

#include "test.h"

#include <stdio.h>

/* The device that this variable names, such as RIG_WEBCAM. The test is skipped when the rig could not be given one. */
static inline const char *rig_node(const char *variable)
{
    const char *path = getenv(variable);
    if (!path || path[0] == '\0') {
        print_message("# %s: the rig has no such device\n", variable);
        skip();
    }
    return path;
}

/* Asks the host, for example to "unplug"; the test fails when it cannot. */
static inline void rig(const char *request)
{
    char command[120];
    assert_in_range(snprintf(command, sizeof command, "rig %s", request), 5, sizeof command - 1);
    assert_int_equal(system(command), 0);
}

#endif
