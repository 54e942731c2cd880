/* IRIS - one machine of a team: its chunk (machine.h), its elections, and its post, over any transport, as orders for its
 * robot's runtime and events from there.
 *
 *     borg_member_init(&member, &config, now_ms);
 *     borg_member_start(&member);                                   when the mission begins
 *     in each turn of the loop, at least ten times a second:
 *         borg_member_place(&member, x_mm, y_mm, battery_percent);  for its bids
 *         borg_member_step(&member, &transport, now_ms);
 *         while (borg_member_order_next(&member, &order)) submit(&order);
 *         while (event comes) borg_member_event(&member, &event);
 *
 * What a chunk says and orders do not: an object that is seen or lost, the end of a Go, of a line, a bump, a low battery,
 * and a stop become signals of the machine's own. The end of a Turn is none. A winner whose Go fails leaves its election,
 * so that another one is chosen. While the transport says that the network is away (IRIS_ERR_IO), time stands still for the post:
 * signals wait until it is back, however long that takes. VOTE_LOST comes to who has not won within BORG_MEMBER_LOST_MS, and it may win later, in
 * place of a machine that fails.
 */
#ifndef IRIS_BORG_MEMBER_H
#define IRIS_BORG_MEMBER_H

#include "iris/borg/election.h"
#include "iris/borg/machine.h"
#include "iris/borg/post.h"
#include "iris/borg/transport.h"
#include "iris/runtime/event.h"
#include "iris/runtime/order.h"

#ifdef __cplusplus
extern "C" {
#endif

#define BORG_MEMBER_ELECTIONS_MAX 4    /* UNITS=k [ ... ] in a chunk */
#define BORG_MEMBER_LOST_MS       6000 /* an election takes less, even with half of all messages lost */

typedef struct {
    const uint8_t *chunk; /* stays as it is for as long as the member is used */
    size_t bytes;
    uint32_t script; /* number of the script, the same in all of the team: borg_chunk_number */
    uint16_t
        incarnation; /* more than at the last start of this machine: a count that is kept, or a clock's seconds */
    uint8_t unit;         /* which machine of the chunk's group, from 1 */
    borg_bidder *bidders; /* elections of the chunk * units of the group; none without elections */
    int32_t bidder_count;
    borg_sender *senders; /* other machines of the team, of all groups */
    int32_t sender_count;
} borg_member_config;

/* As many as any chunk and group may need. */
#define BORG_MEMBER_BIDDERS_MAX (BORG_MEMBER_ELECTIONS_MAX * BORG_ELECTION_UNITS_MAX)

typedef struct {
    borg_election election;
    uint32_t begun_ms;
    uint8_t begun, told; /* told: 0 nothing, 1 won, 2 lost */
    uint8_t round;       /* of this machine */
    uint8_t heard;       /* the latest one of others */
} borg_contest;

/* Read `elsewhere`; the rest belongs to the functions. Some 800 bytes where pointers have four. */
typedef struct {
    borg_machine machine;
    borg_post post;
    borg_contest contests[BORG_MEMBER_ELECTIONS_MAX];
    borg_address me;
    uint32_t now_ms;
    uint32_t away_ms; /* in all that the network was away */
    int32_t x_mm, y_mm, battery_percent;
    uint8_t contest_count;
    uint8_t state;
    uint8_t is_away; /* 1: the network was, at the last step */
    uint16_t
        elsewhere; /* messages of a later machine with this one's number: two robots have it; stays at 65535 */
} borg_member;

/* A machine that waits for START. IRIS_ERR_ARG: a null pointer (that of bidders with elections only), no senders;
 * IRIS_ERR_RANGE: more than BORG_MEMBER_ELECTIONS_MAX elections, these in a group of more than BORG_ELECTION_UNITS_MAX,
 * too few bidders, more than BORG_POST_SENDERS_MAX senders; others as borg_machine_init. */
iris_status borg_member_init(borg_member *member, const borg_member_config *config, uint32_t now_ms);

/* The mission begins, or begins anew. IRIS_ERR_ARG: null pointer. */
iris_status borg_member_start(borg_member *member);

/* Where its robot is, in the frame of all robots, and how full its battery is, 0 to 100. IRIS_ERR_ARG: null pointer;
 * IRIS_ERR_RANGE: beyond BORG_PLACE_MAX_MM, or such a battery; what was said before stays. O(1). */
iris_status borg_member_place(borg_member *member, int32_t x_mm, int32_t y_mm, int32_t battery_percent);

/* Hears others, answers, and sends what is to be sent; 32 messages at most. IRIS_ERR_ARG: null pointer, or what the
 * transport reported last, after all else was done: the next call goes on. O(messages * team). */
iris_status borg_member_step(borg_member *member, const borg_transport *transport, uint32_t now_ms);

/* The next order for the robot, at the time of the last step; 0: none. What of this is for others is sent by the next step.
 * A null pointer: 0. */
int borg_member_order_next(borg_member *member, iris_order *order);

/* What the robot tells back. IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: an object beyond BORG_PLACE_MAX_MM. O(1). */
iris_status borg_member_event(borg_member *member, const iris_event *event);

/* In a word: "waiting" (for START), "following", "exploring", "mapping", "detecting", "turning", "going", "reached" (until
 * it drives again), "stopped", or "failed". Static storage; never null. O(1). */
const char *borg_member_state(const borg_member *member);

/* 1 from each ResetTime until the TIME_OUT that follows it, else 0; member is not null. O(1). */
static inline int borg_member_clock_runs(const borg_member *member)
{
    return member->machine.clock_runs;
}

#ifdef __cplusplus
}
#endif

#endif
