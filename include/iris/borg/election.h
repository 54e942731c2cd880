/* IRIS - elections: which k of a group's n machines act, found by each one for itself, over a network that loses
 * messages.
 *
 *     borg_election_init(&e, bidders, &config, now_ms);                      when the machine starts
 *     borg_election_begin(&e, round, borg_bid(distance_mm, percent), now_ms);  would act, like the others of its group
 *     borg_election_hear(&e, &message, now_ms);                             for each message that comes
 *     if (borg_election_step(&e, now_ms, &message)) send(&message);         in each turn of the loop
 *     if (borg_election_won(&e)) act();                                      else it does not, or no longer
 *
 * A machine acts only with the grants of all machines of its group that it knows to be alive, and its own. Each machine
 * has k grants to give. A grant is a lease: who gave it keeps it for LEASE after the last message of the one that holds
 * it; who holds it counts from when it sent the message that was answered, and ends MARGIN earlier. So a
 * grant that is held is always kept, whatever is lost, late, doubled, or out of order. Who should have one is for the
 * bids to say: the smallest distance first, then the fullest battery, then the lowest unit; and those that act before
 * all others.
 * A machine that knows of k better ones asks nobody, and gives back what it has.
 *
 * Promised, whatever the network does, as long as clocks differ by less than 2 %, step is called in time,
 * and no datagram to a machine's earlier start comes to it LEASE after the next one:
 *   - For every machine x, of the machines that have heard x within ALIVE, at most k act at once; x may be one of them.
 *     So no more than k act in a group whose machines hear each other; groups that are apart choose for themselves.
 *   - But where x was not heard for ALIVE, or started anew, and is heard again by one that acts: that one may go on for
 *     GRACE without x's grant. So when a group that was apart is whole again, each part may act with its k until then
 *     at most: the worse ones stop as soon as they hear of k better ones that act, and who has heard of k that act does
 *     not begin.
 *   - A machine that starts gives no grant and does not act for LEASE: what it granted before it may have forgotten.
 * Not promised, but likely:
 *   - That machines that are together hear each other within ALIVE: that takes one of 33 messages. With half of all
 *     lost, a silence so long begins once in 1.7e10 messages; then they are apart, as far as anyone can tell.
 *   - That k act: within a second of BEGIN when nothing is lost and all are alive; with half of all messages lost
 *     within about three; ALIVE later where one does not answer, LEASE and a little later where a winner dies.
 *   - That the best k act: those whose bids have not come within SETTLE are not waited for, and a machine that acts is
 *     not replaced by a better one that comes late.
 *   - That a machine that acts keeps its grants: one that is not renewed within LEASE is lost; then it stops, and asks
 *     again. So it does where x hears it no longer and it still hears x.
 * Not possible: that two machines that cannot hear each other agree, or that one that hears x, but is not heard by it,
 * acts: it has no grant of x, and must not go without.
 *
 * The method is that of G. Ricart and A. K. Agrawala (An optimal algorithm for mutual exclusion, 1981) with k entries
 * (K. Raymond, 1989) and leases (C. Gray and D. Cheriton, 1989). tests/borg/election.pml is its model: all states of
 * four machines that choose one, and of three that choose two, are looked at there.
 */
#ifndef IRIS_BORG_ELECTION_H
#define IRIS_BORG_ELECTION_H

#include <stdint.h>

#include "iris/borg/message.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define BORG_ELECTION_UNITS_MAX 16

/* All are multiples of the clock's step, BORG_ELECTION_TICK_MS. */
#define BORG_ELECTION_TICK_MS   16
#define BORG_ELECTION_PERIOD_MS 96   /* between two messages of a machine, while anybody would act */
#define BORG_ELECTION_SETTLE_MS 960  /* so long bids are waited for */
#define BORG_ELECTION_ALIVE_MS  3200 /* who was not heard for so long is gone */
#define BORG_ELECTION_LEASE_MS  4800
#define BORG_ELECTION_MARGIN_MS 256
#define BORG_ELECTION_GRACE_MS  8000

/* What is known of another machine; belongs to the functions. 16 bytes. */
typedef struct {
    uint32_t bid;
    uint16_t incarnation, stamp; /* of its last message */
    uint16_t heard;              /* when that came */
    uint16_t answered;           /* own stamp that its grant answers */
    uint16_t appeared;           /* when it was heard again, while this one acted */
    uint8_t kind, round;
} borg_bidder;

typedef struct {
    borg_address me;
    uint8_t handler; /* place of the election in the chunk: tells apart elections of one group */
    uint8_t units;   /* machines of the group, 1 to BORG_ELECTION_UNITS_MAX */
    uint8_t winners; /* 1 to units */
} borg_election_config;

/* Belongs to the functions. Times are in ticks of the caller's clock, and wrap; sets have bit unit - 1. */
typedef struct {
    borg_bidder *bidders; /* of all units */
    borg_election_config config;
    uint32_t bid;
    uint16_t alive;    /* heard within ALIVE, or not yet known to be gone */
    uint16_t known;    /* heard within LEASE: only newer messages count */
    uint16_t promised; /* to whom it gave its grants */
    uint16_t granted;  /* who gave it theirs */
    uint16_t graced;   /* whose grants it may still be without */
    uint16_t booted, begun, sent, yielded;
    uint8_t kind; /* BORG_MESSAGE_ALIVE, _BID, _CLAIM, or _ACT */
    uint8_t round;
    uint8_t mute, settled, active, due;
    uint8_t told; /* which of many promises come next */
} borg_election;

/* A bid, the smaller the better: distance to the target (below 0: 0; at most 16 km count), then battery (0 to 100; more
 * is 100). O(1). */
static inline uint32_t borg_bid(int32_t distance_mm, int32_t battery_percent)
{
    const int32_t far = 0xFFFFFF, full = 100;
    const int32_t distance = distance_mm < 0 ? 0 : distance_mm > far ? far : distance_mm;
    const int32_t battery = battery_percent < 0 ? 0 : battery_percent > full ? full : battery_percent;
    return (uint32_t)distance << 8 | (uint32_t)(full - battery);
}

/* Makes *e ready; for one start of the machine, not for one round: after it, it is mute for LEASE.
 *   bidders  config->units of them, which stay the election's
 * IRIS_ERR_ARG: null pointer, or the config: units, winners, a unit that is none of them, a line 0. O(units). */
iris_status borg_election_init(borg_election *e, borg_bidder *bidders, const borg_election_config *config,
                               uint32_t now_ms);

/* This machine would act. Who began the same election in the same round is compared by its bid. A machine that acts or
 * waits since an earlier round gives up what it has, and begins anew. O(units). */
void borg_election_begin(borg_election *e, uint8_t round, uint32_t bid, uint32_t now_ms);

/* It would act no longer (done, stopped, broken): the next one may. It still grants what others ask for. O(1). */
void borg_election_leave(borg_election *e, uint32_t now_ms);

/* A message that came; those that are not of this election are ignored. O(units). */
void borg_election_hear(borg_election *e, const borg_message *message, uint32_t now_ms);

/* Lets time pass: at least every 100 ms, as a machine stops acting here. 1: *message is to be sent to all, complete but
 * for nothing. Between elections it sends nothing. O(units). */
int borg_election_step(borg_election *e, uint32_t now_ms, borg_message *message);

/* Whether this machine acts, since the last step. O(1). */
static inline int borg_election_won(const borg_election *e)
{
    return e->kind == BORG_MESSAGE_ACT;
}

#ifdef __cplusplus
}
#endif

#endif
