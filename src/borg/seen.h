/* What a machine remembers of signals, and whether conditions hold. */
#ifndef IRIS_BORG_SEEN_H
#define IRIS_BORG_SEEN_H

#include "chunk_walk.h"
#include "iris/borg/machine.h"

/* How many more signals the chunk may need than the machine, or null, has seen. */
int32_t borg_seen_missing(const uint8_t *chunk, const borg_machine *m);

/* A signal that has come, ref not 0; once more with ref 0 when it is the machine's own. */
void borg_seen_add(borg_machine *m, const borg_signal *signal);
void borg_seen_forget(borg_machine *m, uint8_t kind, const borg_signal *of_sender);

/* The which-th, from 1; null when there are not so many. */
const borg_signal *borg_seen_find(const borg_machine *m, uint8_t kind, uint16_t ref, int32_t which);

/* That of one machine. */
int32_t borg_seen_index(const borg_machine *m, uint8_t kind, uint16_t ref, uint8_t unit);

int borg_is_own(const borg_machine *m, const borg_signal *signal);

/* Handlers whose condition holds, a bit for each. before: the signal m->now has not come yet. */
uint32_t borg_seen_holding(const borg_machine *m, int before);

#endif
