/* Of run_session*.c: what a live session and a replayed one do alike.
 */
#ifndef IRIS_TOOL_RUN_SESSION_PARTS_H
#define IRIS_TOOL_RUN_SESSION_PARTS_H

#include "run_session.h"

/* Lines of the journal that are the tool's own: which robot file, and where the robot began. */
#define RUN_FILE  'F'
#define RUN_START 'P'

/* Begins with a journal that records, replays, or does neither. */
void run_session_begin(run_session *s, osiris_pose start);

/* A reading, recorded or replayed. */
void run_session_sense(run_session *s, int32_t device, const osiris_raw *raw);

/* Counts what is another command than before. 1: it is one. */
int run_session_note_command(run_session *s);

/* 1 when one of them says that all stands at once. */
int run_session_take_events(run_session *s, uint32_t now_ms);

void run_session_walk(run_session *s, osiris_pose pose);

#endif
