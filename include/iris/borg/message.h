/* IRIS - messages between the machines of a team: datagrams of 48 bytes, the same on every transport.
 *
 * All numbers with the lowest byte first:
 *
 *     'B' 'M', version 1, kind (1 byte), script (4), line of the sender's group (2), its unit (1), its incarnation (2),
 *     sequence (2), payload by kind (29, what it does not need is 0), check (4): FNV-1a over all bytes before it
 *     SIGNAL   kind of signal, unit, line of the group that it comes from (2), x (4), y (4)
 *     ACK      count (1 to 3), and for each: line (2), unit, incarnation (2), sequence (2), earlier ones as bits (2)
 *     ALIVE, BID, CLAIM, ACT (election.h)
 *              handler, round, bid (4), stamp (2), granted units as bits (2), for each the stamp answered (2), 8 at most
 *     DEATH    nothing: the sender is gone (a broker's last will, made by the sender when it connected)
 *     CHUNK    line of the group that it is for (2), its bytes (2), place of this piece (2), bytes here (1 to 22), bytes
 *
 * Who a sender is: the line of its group in the script and its number there, from 1. Its incarnation grows with each of
 * its starts and wraps: a count that is kept, or seconds of a clock. The script is told apart by a 32-bit hash of it;
 * messages of other scripts are for others.
 */
#ifndef IRIS_BORG_MESSAGE_H
#define IRIS_BORG_MESSAGE_H

#include <stddef.h>
#include <stdint.h>

#include "iris/borg/signal.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define BORG_MESSAGE_BYTES 48
#define BORG_ACKS_MAX      3
#define BORG_GRANTS_MAX    8  /* told in one message */
#define BORG_PIECE_BYTES   22 /* of a chunk */

typedef enum {
    BORG_MESSAGE_SIGNAL = 1,
    BORG_MESSAGE_ACK,
    BORG_MESSAGE_ALIVE, /* takes no part itself, but its grants count */
    BORG_MESSAGE_BID,   /* would act, and waits */
    BORG_MESSAGE_CLAIM, /* asks all for their grants */
    BORG_MESSAGE_ACT,   /* acts */
    BORG_MESSAGE_DEATH,
    BORG_MESSAGE_CHUNK
} borg_message_kind;

typedef struct {
    uint32_t script;
    uint16_t ref; /* line of its group, from 1 */
    uint16_t incarnation;
    uint8_t unit; /* in its group, from 1 */
} borg_address;

/* Signals of a machine that have arrived: that one, and bit i: the one i + 1 before it. */
typedef struct {
    uint16_t ref, incarnation, sequence, before;
    uint8_t unit;
} borg_ack;

typedef struct {
    uint32_t bid; /* borg_bid() */
    uint16_t stamp;
    uint16_t granted;                  /* bit unit - 1; BORG_GRANTS_MAX at most */
    uint16_t answers[BORG_GRANTS_MAX]; /* one for each bit, the lowest first; 0 behind them */
    uint8_t handler, round;
} borg_vote;

typedef struct {
    uint16_t ref, total, at;
    uint8_t count;
    uint8_t bytes[BORG_PIECE_BYTES]; /* 0 behind `count` */
} borg_piece;

typedef struct {
    uint8_t kind;  /* borg_message_kind: which of the payloads */
    uint8_t count; /* of acks */
    uint16_t sequence;
    borg_address from;
    union {
        borg_signal signal;
        borg_ack acks[BORG_ACKS_MAX];
        borg_vote vote;
        borg_piece piece;
    } is;
} borg_message;

/* Whether it is one of an election. */
static inline int borg_message_is_vote(const borg_message *message)
{
    return message->kind >= BORG_MESSAGE_ALIVE && message->kind <= BORG_MESSAGE_ACT;
}

/* Writes the BORG_MESSAGE_BYTES bytes of a message; the places that its kind says have to be 0 need not be.
 * IRIS_ERR_ARG: null pointer. IRIS_ERR_DATA: a message that would not be read again. O(1). */
iris_status borg_message_write(uint8_t *bytes, const borg_message *message);

/* Reads one; any bytes may come. What is accepted gives the same bytes when it is written again.
 * IRIS_ERR_ARG: null pointer. IRIS_ERR_TRUNCATED: fewer bytes; IRIS_ERR_UNSUPPORTED: a later version; IRIS_ERR_DATA:
 * anything else, more bytes with it. The message is touched only when all is well. O(1). */
iris_status borg_message_read(borg_message *message, const uint8_t *bytes, size_t count);

#ifdef __cplusplus
}
#endif

#endif
