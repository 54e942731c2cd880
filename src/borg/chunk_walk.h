/* All handlers of a chunk in their order, those in elections with them, and what they name. */
#ifndef IRIS_BORG_CHUNK_WALK_H
#define IRIS_BORG_CHUNK_WALK_H

#include "iris/borg/chunk.h"

typedef struct {
    borg_reader top, inner;
    borg_handler handler; /* the one that was taken last */
    int32_t index;        /* its number, from 0 */
    int32_t parent;       /* of the election that it is in; -1: at the top */
    int32_t election;     /* the last one */
} borg_walk;

void borg_walk_start(borg_walk *w, const uint8_t *chunk);
int borg_walk_next(borg_walk *w); /* 0: there are no more */
int borg_walk_to(borg_walk *w, const uint8_t *chunk, int32_t index);

/* How many elections a chunk has. */
int32_t borg_chunk_elections(const uint8_t *chunk);

/* The signals that a chunk asks for: each term, and each target of a Go. */
typedef struct {
    borg_walk walk;
    borg_reader condition, body;
    uint8_t kind, machines;
    uint16_t ref;
} borg_uses;

void borg_uses_start(borg_uses *u, const uint8_t *chunk);
int borg_uses_next(borg_uses *u);

#endif
