/* iris borg run: robots of a team, a process each, that tell each other over a network.
 */
#ifndef IRIS_TOOL_BORG_RUN_H
#define IRIS_TOOL_BORG_RUN_H

#include <stdint.h>

typedef struct {
    const char *script; /* null: the robot's chunk comes from the broker */
    const char
        *robots; /* robot files with commas between, one robot each, over and over; null: a small robot */
    const char *world;     /* null: a room that is built in */
    const char *transport; /* null: UDP multicast at its usual place */
    int32_t ref, unit;     /* the robot that this process is; 0: all of the script's, a process each */
    int32_t timeout_s;     /* where the script names none */
    int32_t seed;          /* of the noise of sensors */
    int32_t speed;         /* simulated seconds in one second */
    int serve;             /* starts no robot, and has a broker keep the chunks until it is asked to end */
    int json;
} borg_run_wishes;

/* Complains; returns an exit code. */
int borg_run(const borg_run_wishes *wishes);

#endif
