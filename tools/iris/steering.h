/* Steering out of `iris follow`: commands to the robot over a serial port and GPIO lines.
 *
 * On Linux a process of its own owns both. It gets the commands over a socket, of which the newest counts, and stops the robot
 * when none has come for --watchdog, the first one included, and when this process ends, however it does. If that process is
 * gone or hangs, this one stops the robot and ends.
 */
#ifndef IRIS_TOOL_STEERING_H
#define IRIS_TOOL_STEERING_H

#include <stdint.h>

#include "iris/command.h"
#include "steering_option.h"

/* Opens what the options name, which must stay. Complains; returns an exit code. */
int steering_open(const steering_options *options);

/* Never waits. The sentences are numbered where they are sent: command->seq does not matter. */
void steering_send(const iris_command *command);

/* Stops the robot until the next command. Never waits. */
void steering_halt(void);

/* Waits until `ms` milliseconds after opening. */
void steering_wait(int64_t ms);

/* Stops the robot, in at most a second, and closes. Complains; returns an exit code. A signal that ends the program does so
 * after the same. */
int steering_stop(void);

#endif
