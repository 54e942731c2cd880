/* A session of `iris run`: interfaces that give orders, the runtime, behaviors, and the journal; or a journal replayed.
 */
#ifndef IRIS_TOOL_RUN_SESSION_H
#define IRIS_TOOL_RUN_SESSION_H

#include <stdio.h>

#include "robot_behaviors.h"
#include "run_body.h"
#include "run_script.h"

/* Who gives orders, and their priorities: the person is obeyed first. */
enum { RUN_SCRIPT = 0, RUN_SERIAL, RUN_CONSOLE, RUN_SOURCES };

typedef struct {
    uint32_t at_ms;
    iris_event event;
} run_event;

typedef struct {
    run_body body;
    robot_senses senses;
    robot_behaviors behaviors;
    iris_runtime runtime;
    iris_journal journal;

    const run_script *script; /* null: none */
    int has_console, has_serial, is_quiet;
    int32_t lease_ms; /* of orders by script and console that have no end of their own; 0: none */
    uint32_t limit_ms;
    double speed; /* seconds in one second; 0: as fast as it goes */
    FILE *record; /* the journal is written there; null: nowhere */

    uint32_t now_ms;
    run_event *events;
    int32_t event_count;
    osiris_pose *path;
    int32_t path_count;
    iris_motion command; /* the last one */
    int32_t orders, commands;
    uint32_t check; /* FNV-1a over all commands */
    int has_failed; /* no more memory, or a journal that cannot be written */
} run_session;

/* The body is read and placed before. Complains; returns an exit code. */
int run_session_live(run_session *session);

/* Prints each command, and at the end that they are the same, or where they are not. */
int run_session_replay(run_session *session, const char *path);

void run_session_free(run_session *session);

#endif
