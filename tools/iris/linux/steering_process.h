/* The process that owns what `iris follow` steers by: the serial port, the GPIO lines, the watchdog, the pulses. */
#ifndef IRIS_TOOL_STEERING_PROCESS_H
#define IRIS_TOOL_STEERING_PROCESS_H

#include "../steering_option.h"

/* Opens everything, says so over the link, steers until the link ends, and stops the robot. Returns an exit code. */
int steering_process_run(const steering_options *options, int link);

#endif
