/* IRIS - a robot behind a serial port, as a driver of Osiris: what its sensors say and what its actuators are to do are
 * sentences of iris/osiris/telemetry.h, sent and received by serial.h.
 *
 *     osiris_serial_robot board;
 *     osiris_serial_robot_init(&board, states, &plan, 0);             path and rate are the plan's
 *     osiris_robot_bind(&robot, 0, &osiris_serial_robot_driver, &board, now_ms);
 *
 * A sentence that finds the port busy waits, and the next one takes its place, whatever it is for: what is told once only, to a
 * lamp say, may be lost on a line that is full.
 *
 * A port that is away breaks its readings (OSIRIS_BROKEN) until it is back; nothing is to be opened again by hand. Closing tells
 * the drives to stand still, as far as the port takes that.
 */
#ifndef IRIS_SERIAL_ROBOT_H
#define IRIS_SERIAL_ROBOT_H

#include "iris/osiris/telemetry.h"
#include "iris/serial.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Read port.error and its counters, and remote.taken and refused; the rest belongs to the functions. */
typedef struct {
    osiris_remote remote;
    iris_serial port;
    uint32_t took_ms; /* when the port was looked at last */
    iris_status state;
    int32_t is_open;
} osiris_serial_robot;

/* Makes it ready to be bound. Errors and memory as osiris_remote_init; IRIS_ERR_ARG, too, for a driver that is not serial. */
iris_status osiris_serial_robot_init(osiris_serial_robot *robot, osiris_remote_device *devices,
                                     const osiris_plan *plan, int32_t driver);

/* The context is the osiris_serial_robot. Opening says what iris_serial_open says. */
extern const osiris_driver osiris_serial_robot_driver;

#ifdef __cplusplus
}
#endif

#endif
