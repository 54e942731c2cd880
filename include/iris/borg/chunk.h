/* IRIS - chunks of BorgCode: what the machines of one group do, as bytecode of at most 512 bytes.
 *
 * A chunk is a header and handlers, all numbers with the lowest byte first:
 *
 *     'B' 'C', version 1, units n (1 byte), line of the group (2), time-out in seconds (2), length of all (2),
 *     handlers at the top (1), 0, check (4): FNV-1a over all other bytes
 *     handler: flags (1: repeats), winners k (1; 0: no election), bytes of the condition (1), bytes of the body (2),
 *              condition, body
 *     condition, postfix: kind of signal, line of its group (2; 0: own), machines (1) | 64 AND | 65 OR | 66 NOT
 *     body: actions, or with an election the handlers of those that won it
 *     action: what (1), unit (1; 0: all), and by what it is: speed in mm/s (2) of LineFollow and AutoExplore (0: the
 *             robot's own), degrees (2) of Turn, x and y in mm (4 each) of a Go, signal (1), line (2), and which
 *             machine (1) of a Go to a signal's target, signal (1) and line (2) of a Multicast
 *
 * What a chunk means: a machine remembers which signals it has seen. A signal in a condition holds once `machines`
 * different machines of that group have sent it (1: the first), until START, and OBJ_DETECT_TRUE until
 * OBJ_DETECT_FALSE; all but OBJ_DETECT_TRUE that arrive again count as new ones. A handler fires when a signal arrives
 * with which its condition becomes true: once, or each time when it repeats; START arms all anew, after all signals
 * were forgotten. So NOT x fires when x stops being true, and not because it has never been. Handlers fire in their
 * order. An election chooses k machines of the group; what they do is in handlers of their own, which are armed by
 * VOTE_WIN. TIME_OUT is the machine's own, so many seconds after ResetTime. A Multicast tells others what this machine
 * itself noticed; what came from another one is not sent again.
 */
#ifndef IRIS_BORG_CHUNK_H
#define IRIS_BORG_CHUNK_H

#include <stddef.h>
#include <stdint.h>

#include "iris/borg/signal.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define BORG_CHUNK_BYTES_MAX    512
#define BORG_CHUNK_HEADER_BYTES 16
#define BORG_HANDLERS_MAX       32 /* in a chunk, with those inside of elections */
#define BORG_STACK_MAX          16 /* values that a condition's evaluation keeps at once: one bit each */
#define BORG_UNITS_MAX          255
#define BORG_PLACE_MAX_MM       10000000 /* of Go, either side of 0 */
#define BORG_TIMEOUT_S          60       /* where a script names none */

enum { BORG_AND = 64, BORG_OR, BORG_NOT }; /* below: a borg_signal_kind */

typedef enum {
    BORG_LINE_FOLLOW = 0, /* a: mm/s */
    BORG_OBJ_DETECT,
    BORG_AUTO_EXPLORE, /* a: mm/s */
    BORG_MAP_BUILD,
    BORG_GO,        /* to (a, b) mm */
    BORG_GO_TARGET, /* of signal `kind` of group `ref`, its machine `which` in the order of their signals */
    BORG_TURN,      /* a: degrees, to the right */
    BORG_STOP,
    BORG_RESET_TIME,
    BORG_MULTICAST /* signal `kind` as of group `ref` */
} borg_verb;

#define BORG_VERBS 10

typedef struct {
    uint8_t verb; /* borg_verb */
    uint8_t unit; /* for this machine of the group alone; 0: for all */
    uint8_t kind, which;
    uint16_t ref;
    int32_t a, b;
} borg_action;

typedef struct {
    uint8_t op; /* borg_signal_kind, BORG_AND, ... */
    uint8_t machines;
    uint16_t ref;
} borg_term;

/* Part of a chunk that is left to read. */
typedef struct {
    const uint8_t *at, *end;
} borg_reader;

typedef struct {
    uint8_t repeats;
    uint8_t winners;       /* of an election; 0: none */
    borg_reader condition; /* terms */
    borg_reader body;      /* actions; with an election: handlers */
} borg_handler;

/* Whether `bytes` bytes are a whole chunk, after which all readers below stay inside of it, all kinds, verbs, and
 * counts are
 * valid, no evaluation needs more than BORG_STACK_MAX values, and elections have no elections in them.
 * IRIS_ERR_ARG: chunk is null. IRIS_ERR_TRUNCATED: fewer bytes than it says; IRIS_ERR_UNSUPPORTED: a later version;
 * IRIS_ERR_RANGE: longer than BORG_CHUNK_BYTES_MAX; IRIS_ERR_DATA: anything else, bytes behind its end with it.
 * O(bytes). */
iris_status borg_chunk_check(const uint8_t *chunk, size_t bytes);

/* The number of a script, by which the machines of its team know each other: of the chunks of all its groups, one after
 * the other. before: 0 with the first one, then what this returned. So it differs with everything that machines do, and
 * not with comments. FNV-1a; a null pointer changes nothing. O(bytes). */
uint32_t borg_chunk_number(uint32_t before, const uint8_t *chunk, size_t bytes);

/* ---- readers of a chunk that was checked; O(1) each ---- */

static inline uint16_t borg_chunk_two(const uint8_t *at)
{
    return (uint16_t)(at[0] | at[1] << 8);
}

static inline int32_t borg_chunk_units(const uint8_t *chunk)
{
    return chunk[3];
}

static inline uint16_t borg_chunk_ref(const uint8_t *chunk)
{
    return borg_chunk_two(chunk + 4);
}

static inline int32_t borg_chunk_timeout_s(const uint8_t *chunk)
{
    return borg_chunk_two(chunk + 6);
}

static inline size_t borg_chunk_length(const uint8_t *chunk)
{
    return borg_chunk_two(chunk + 8);
}

/* All handlers of a chunk. */
static inline borg_reader borg_chunk_handlers(const uint8_t *chunk)
{
    borg_reader r;
    r.at = chunk + BORG_CHUNK_HEADER_BYTES;
    r.end = chunk + borg_chunk_length(chunk);
    return r;
}

/* Each takes the next one; 0 when there is none. They stay inside of [at, end) whatever stands there. */
int borg_handler_next(borg_handler *handler, borg_reader *r);
int borg_term_next(borg_term *term, borg_reader *r);
int borg_action_next(borg_action *action, borg_reader *r);

#ifdef __cplusplus
}
#endif

#endif
