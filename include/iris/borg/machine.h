/* IRIS - the machine of BorgCode: does what a chunk says (chunk.h; the report's section 6.2.3).
 *
 * Signals go into a buffer, from the robot's own program and from others alike; each step takes at most one thing to do
 * out of the machine. What signals mean is said in chunk.h; beyond that:
 *
 * - START is the machine's own. It empties the buffer, ends elections, stops the clock, and arms the handlers at the
 *   top. Before the first one nothing fires.
 * - A signal of the machine's own is one of its group, too: it holds in Signal(REACHED) and in Signal(REACHED,020).
 * - A handler that multicasts fires by the machine's own signals alone.
 * - The clock runs from ResetTime; when the chunk's seconds have passed, TIME_OUT comes before all that waits, once. A
 *   handler that only stops stays armed for it, so that what begins after a time-out ends as well.
 * - An election begins each time that its handler fires. VOTE_WIN arms the handlers in it, and is theirs alone;
 *   VOTE_LOST disarms them, and a machine that had won stops; so it does when the same election begins again. A Stop
 *   outside of elections ends all of them for this machine.
 * - Go to the target of a signal that is not there does nothing, and is counted.
 *
 * One machine is some 450 bytes, and the chunk's bytes, which stay where they are.
 */
#ifndef IRIS_BORG_MACHINE_H
#define IRIS_BORG_MACHINE_H

#include "iris/borg/chunk.h"

#ifdef __cplusplus
extern "C" {
#endif

#define BORG_WAITING_MAX 8 /* signals in the buffer */
#define BORG_SEEN_MAX                                                                                        \
    24 /* signals that are remembered, one for each machine, kind, and line that the chunk names */

typedef enum {
    BORG_DO_NOTHING = 0,
    BORG_DO_ACTION,    /* action: all but BORG_GO_TARGET, which is a BORG_GO here, and BORG_MULTICAST */
    BORG_DO_MULTICAST, /* signal: for everybody */
    BORG_DO_ELECT      /* choose `winners` machines of the group, and say so to borg_machine_vote */
} borg_what;

typedef struct {
    uint8_t what;       /* borg_what */
    uint8_t winners;    /* of an election */
    uint8_t election;   /* its number: that of its handler */
    uint8_t has_target; /* of an election: its winners go to (signal.x, signal.y) */
    borg_action action;
    borg_signal signal;
} borg_output;

/* Its fields are the machine's own. */
typedef struct {
    const uint8_t *chunk;
    borg_signal waiting[BORG_WAITING_MAX]; /* the oldest first */
    borg_signal seen[BORG_SEEN_MAX];       /* in the order in which they came; ref 0: the machine's own */
    borg_signal now;                       /* whose handlers are being run; its ref is never 0 */
    uint32_t reset_at_ms;
    uint32_t armed, firing;       /* handlers: bit i is number i, in the order of the chunk */
    uint32_t open, won;           /* elections */
    uint32_t must_win, must_lose; /* elections whose VOTE_WIN or VOTE_LOST waits */
    uint16_t at, end;             /* actions that are being run: bytes of the chunk */
    uint16_t dropped, skipped;    /* signals, and Gos; they stay at 65535 */
    uint8_t unit, waiting_count, seen_count;
    uint8_t has_started, clock_runs, time_is_out, must_stop, is_inside;
} borg_machine;

/* A machine that waits for START. chunk: `bytes` bytes, which must stay as they are for as long as the machine is used;
 * unit: which machine of the group, from 1. IRIS_ERR_ARG: a null pointer; IRIS_ERR_RANGE: no such unit, or the chunk
 * needs more than BORG_SEEN_MAX signals at once; others as borg_chunk_check. O(terms^2). */
iris_status borg_machine_init(borg_machine *machine, const uint8_t *chunk, size_t bytes, int32_t unit);

/* A signal for the buffer; ref 0, or that of the group with this machine's unit: its own. When the buffer is full, the
 * oldest one is dropped and counted, but never the machine's own START, STOPPED, or TIME_OUT.
 * IRIS_ERR_ARG: a null pointer; no such kind; unit 0 with a ref; VOTE_WIN or VOTE_LOST of its own, which are for
 * borg_machine_vote; IRIS_ERR_RANGE: a place beyond BORG_PLACE_MAX_MM. O(BORG_WAITING_MAX). */
iris_status borg_machine_signal(borg_machine *machine, const borg_signal *signal);

/* How an election went, or goes now: won may come after lost, when a winner is replaced, and lost after won.
 * IRIS_ERR_ARG: a null pointer; IRIS_ERR_RANGE: that election is not open. O(1). */
iris_status borg_machine_vote(borg_machine *machine, int32_t election, int won);

/* The next thing to do at this time, any clock that wraps; BORG_DO_NOTHING: nothing for now. To be called until it is.
 * IRIS_ERR_ARG: a null pointer. O(length of the chunk * BORG_SEEN_MAX). */
iris_status borg_machine_step(borg_output *output, borg_machine *machine, uint32_t now_ms);

/* Whether an election, 0 to BORG_HANDLERS_MAX - 1, has begun and is not over for this machine. */
static inline int borg_machine_is_open(const borg_machine *machine, int32_t election)
{
    return (int)(machine->open >> election & 1);
}

/* How many signals were dropped, and Gos skipped. */
static inline int32_t borg_machine_dropped(const borg_machine *machine)
{
    return machine->dropped;
}

static inline int32_t borg_machine_skipped(const borg_machine *machine)
{
    return machine->skipped;
}

#ifdef __cplusplus
}
#endif

#endif
