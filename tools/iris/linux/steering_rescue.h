/* Stops the robot when its steering process is gone. */
#ifndef IRIS_TOOL_STEERING_RESCUE_H
#define IRIS_TOOL_STEERING_RESCUE_H

#include "../steering_option.h"

/* Opens everything anew, drives the lines to their safe values, sends the stop, and closes. Says nothing and takes no lock of
 * standard streams: another thread may hang in one. Some 100 ms. Returns 1 when all of it was taken. */
int steering_rescue(const steering_options *options);

#endif
