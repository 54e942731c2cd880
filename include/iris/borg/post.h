/* IRIS - post: signals that reach every machine once, over a network that loses, doubles, and reorders messages.
 *
 *     borg_post_init(&post, senders, count, &me);
 *     borg_post_send(&post, &signal, now_ms);                              a signal for all others
 *     if (borg_post_hear(&post, &message, now_ms, &signal)) take(&signal); for each message that comes
 *     while (borg_post_next(&post, now_ms, &message)) send(&message);      in each turn of the loop
 *
 * A signal is sent again every PERIOD until all machines that are known have acknowledged it, then more seldom until
 * LEAST after its first time, for those that have not been heard yet; in any case no longer than MOST. With half of all
 * messages lost, one machine of a million is missed in LEAST, and none in MOST that anybody will see. Known is who was
 * heard within MOST, with a message of any kind. A machine that starts anew gets again what is still being sent.
 *
 * Each signal is given to hear's caller once: it is told apart by who sent it, its incarnation, and its sequence, of
 * which the last 17 are remembered of each sender. Not a second time, as long as no datagram takes longer than MOST: who
 * was silent for so long may be forgotten, when its place is needed by another one. A sender for whom there is no place
 * is ignored until there is. Signals may arrive in another order than they were sent in.
 */
#ifndef IRIS_BORG_POST_H
#define IRIS_BORG_POST_H

#include <stdint.h>

#include "iris/borg/message.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define BORG_POST_SLOTS       4 /* signals that are being sent at once; a fifth one takes the oldest one's place */
#define BORG_POST_SENDERS_MAX 64

#define BORG_POST_TICK_MS   16
#define BORG_POST_PERIOD_MS 96
#define BORG_POST_SELDOM_MS 480
#define BORG_POST_LEAST_MS  1920
#define BORG_POST_MOST_MS   9600

/* What is known of another machine; belongs to the functions. 16 bytes. */
typedef struct {
    uint16_t ref; /* 0: this place is free */
    uint16_t incarnation;
    uint16_t sequence, before; /* as in an acknowledgment */
    uint16_t heard;
    uint8_t unit;
    uint8_t acknowledged; /* which of the slots: bits */
    uint8_t has;          /* sent a signal */
    uint8_t owed;         /* an acknowledgment */
    uint8_t gone;
} borg_sender;

typedef struct {
    borg_signal signal;
    uint16_t sequence, first, last;
    uint8_t used, sent;
} borg_post_slot;

/* Read `dropped`; the rest belongs to the functions. */
typedef struct {
    borg_sender *senders;
    int32_t count;
    borg_address me;
    uint16_t sequence; /* of the last signal */
    uint16_t
        dropped; /* signals that were not sent any longer, as newer ones came; stays at the highest count */
    borg_post_slot slots[BORG_POST_SLOTS];
} borg_post;

/* Makes *post ready.
 *   senders  places for `count` other machines, 1 to BORG_POST_SENDERS_MAX, which stay the post's
 *   me       whose signals it sends
 * IRIS_ERR_ARG: null pointer, the count, or a line or unit 0. O(count). */
iris_status borg_post_init(borg_post *post, borg_sender *senders, int32_t count, const borg_address *me);

/* Sends a signal to all others. When all slots are taken, the signal that has been sent the longest is dropped.
 * A signal that no message may have is ignored. O(count). */
void borg_post_send(borg_post *post, const borg_signal *signal, uint32_t now_ms);

/* A message that came, of any kind. 1: *signal is one that has not been heard before. O(count). */
int borg_post_hear(borg_post *post, const borg_message *message, uint32_t now_ms, borg_signal *signal);

/* The next message to send now; 0: none. At least once in ten minutes. O(count). */
int borg_post_next(borg_post *post, uint32_t now_ms, borg_message *message);

#ifdef __cplusplus
}
#endif

#endif
