/* One robot of a team in a process: a simulated body with its behaviors, a runtime, and a member of the team on a network.
 */
#ifndef IRIS_TOOL_BORG_ROBOT_H
#define IRIS_TOOL_BORG_ROBOT_H

#include "../borg_run.h"
#include "iris/borg/chunk.h"
#include "team_link.h"

/* What one process tells another of a robot, whole in one write to a pipe. */
#define BORG_STATES_BYTES 256
typedef struct {
    int32_t ref, unit;
    int32_t at_ms; /* of the robot's time since its start */
    int32_t x_mm, y_mm;
    int32_t changed; /* 1: its state is another one than told before */
    int32_t ended;   /* 1: it stands, and its time is out */
    char states
        [BORG_STATES_BYTES]; /* all that it went through, with spaces between; the last one is the present one */
} borg_robot_report;

/* Which robot, and what it does. */
typedef struct {
    uint8_t chunk[BORG_CHUNK_BYTES_MAX];
    size_t bytes;
    uint32_t script; /* its number */
    uint16_t incarnation;
    int32_t unit;
    int32_t index; /* of all robots of the script, from 0 */
} borg_robot_task;

/* What a broker keeps of a group: its script's hash, how many robots are in the groups before it, and its chunk. */
#define BORG_KEPT_BYTES(chunk_bytes) ((chunk_bytes) + 8)
size_t borg_robot_task_write(uint8_t bytes[BORG_KEPT_BYTES(BORG_CHUNK_BYTES_MAX)],
                             const borg_robot_task *task);

/* 1: *task is that of a unit; 0: what came is none, or has no such unit. */
int borg_robot_task_read(borg_robot_task *task, const uint8_t *bytes, size_t count, int32_t unit);

/* Runs it to its end, or until a signal asks to end. told(user, report): whenever its state changes, and at the end.
 * Complains; returns an exit code. */
int borg_robot_run(const borg_robot_task *task, const borg_run_wishes *wishes, team_link *link,
                   void (*told)(void *user, const borg_robot_report *report), void *user);

#endif
