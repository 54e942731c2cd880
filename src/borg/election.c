#include "iris/borg/election.h"

#include <stddef.h>

enum {
    PERIOD = BORG_ELECTION_PERIOD_MS / BORG_ELECTION_TICK_MS,
    SETTLE = BORG_ELECTION_SETTLE_MS / BORG_ELECTION_TICK_MS,
    ALIVE = BORG_ELECTION_ALIVE_MS / BORG_ELECTION_TICK_MS,
    LEASE = BORG_ELECTION_LEASE_MS / BORG_ELECTION_TICK_MS,
    MARGIN = BORG_ELECTION_MARGIN_MS / BORG_ELECTION_TICK_MS,
    GRACE = BORG_ELECTION_GRACE_MS / BORG_ELECTION_TICK_MS
};

static uint16_t tick_of(uint32_t now_ms)
{
    return (uint16_t)(now_ms / BORG_ELECTION_TICK_MS);
}

/* Ticks since then. What is older than 17 minutes has been forgotten before. */
static int32_t since(uint16_t then, uint16_t now)
{
    return (uint16_t)(now - then);
}

static int is_newer(uint16_t a, uint16_t b)
{
    const uint16_t ahead = (uint16_t)(a - b);
    return ahead != 0 && ahead < 0x8000;
}

static uint16_t bit_of(int32_t unit)
{
    return (uint16_t)(1u << (unit - 1));
}

static int32_t count_of(uint32_t set)
{
    int32_t count = 0;
    for (; set != 0; set &= set - 1) {
        count++;
    }
    return count;
}

static void take(uint16_t *set, uint16_t bits)
{
    *set = (uint16_t)(*set & ~bits);
}

static void put(uint16_t *set, uint16_t bits)
{
    *set = (uint16_t)(*set | bits);
}

static uint16_t my_bit(const borg_election *e)
{
    return bit_of(e->config.me.unit);
}

/* ---- time ---- */

static void forget(borg_election *e, uint16_t now)
{
    for (int32_t u = 1; u <= e->config.units; u++) {
        const borg_bidder *b = &e->bidders[u - 1];
        const uint16_t bit = bit_of(u);
        const int32_t silent = since(b->heard, now);
        if (bit == my_bit(e)) {
            continue;
        }
        if (silent > ALIVE) {
            take(&e->alive, bit);
            take(&e->graced, bit);
        }
        if (silent > LEASE) {
            take(&e->known, bit);
            take(&e->promised, bit);
        }
        if (since(b->answered, now) >= LEASE - MARGIN) {
            take(&e->granted, bit);
        }
        if (since(b->appeared, now) > GRACE) {
            take(&e->graced, bit);
        }
    }
    if (since(e->booted, now) > LEASE) {
        e->mute = 0;
    }
    if (since(e->yielded, now) > LEASE) {
        e->yielded = (uint16_t)(now - LEASE); /* older answers do not count anyway */
    }
}

/* Who has not been heard lately may be there: all have been silent. */
static void activate(borg_election *e, uint16_t now)
{
    if (e->active) {
        return;
    }
    for (int32_t u = 1; u <= e->config.units; u++) {
        borg_bidder *b = &e->bidders[u - 1];
        if (!(e->alive & bit_of(u))) {
            b->heard = now;
            b->kind = BORG_MESSAGE_ALIVE;
        }
    }
    e->alive = (uint16_t)((1u << e->config.units) - 1);
    e->active = 1;
    e->due = 1;
}

static void deactivate(borg_election *e)
{
    int wanted = e->kind != BORG_MESSAGE_ALIVE;
    for (int32_t u = 1; u <= e->config.units; u++) {
        wanted |= (e->alive & ~my_bit(e) & bit_of(u)) && e->bidders[u - 1].kind != BORG_MESSAGE_ALIVE;
    }
    e->active = (uint8_t)wanted;
}

/* ---- what this machine would do ---- */

/* What was granted until now counts no longer: answers must be to what is sent from here on. */
static void give_back(borg_election *e, uint8_t kind, uint16_t now)
{
    e->kind = kind;
    take(&e->promised, my_bit(e));
    e->granted = 0;
    e->graced = 0;
    e->yielded = now;
    e->due = 1;
}

/* How many are to act before this one. */
static int32_t ahead(const borg_election *e)
{
    const int acts = e->kind == BORG_MESSAGE_ACT;
    int32_t count = 0;
    for (int32_t u = 1; u <= e->config.units; u++) {
        const borg_bidder *b = &e->bidders[u - 1];
        const int other_acts = b->kind == BORG_MESSAGE_ACT;
        if (!(e->alive & ~my_bit(e) & bit_of(u)) || b->kind == BORG_MESSAGE_ALIVE) {
            continue;
        }
        if (other_acts != acts) {
            count += other_acts;
        } else if (acts || b->round == e->round) {
            count += b->bid < e->bid || (b->bid == e->bid && u < e->config.me.unit);
        }
    }
    return count;
}

static int all_have_bid(const borg_election *e)
{
    for (int32_t u = 1; u <= e->config.units; u++) {
        const borg_bidder *b = &e->bidders[u - 1];
        if ((e->alive & ~my_bit(e) & bit_of(u)) && (b->kind == BORG_MESSAGE_ALIVE || b->round != e->round)) {
            return 0;
        }
    }
    return 1;
}

static void bid_or_claim(borg_election *e, uint16_t now)
{
    if (e->mute) {
        return;
    }
    if (!e->settled && (all_have_bid(e) || since(e->begun, now) >= SETTLE)) {
        e->settled = 1;
    }
    if (e->settled && ahead(e) < e->config.winners) {
        e->kind = BORG_MESSAGE_CLAIM;
        e->due = 1;
    }
}

static void claim_or_act(borg_election *e, uint16_t now)
{
    if (ahead(e) >= e->config.winners) {
        give_back(e, BORG_MESSAGE_BID, now);
        return;
    }
    if (count_of(e->promised) < e->config.winners) {
        put(&e->promised, my_bit(e));
    }
    if ((e->promised & my_bit(e)) && !(e->alive & ~my_bit(e) & ~e->granted)) {
        e->kind = BORG_MESSAGE_ACT;
        e->graced = 0;
        e->due = 1;
    }
}

static void act_or_stop(borg_election *e, uint16_t now)
{
    const int lost = (e->alive & ~my_bit(e) & ~e->granted & ~e->graced) != 0;
    if (lost || ahead(e) >= e->config.winners) {
        give_back(e, BORG_MESSAGE_BID, now);
    }
}

static void decide(borg_election *e, uint16_t now)
{
    switch (e->kind) {
    case BORG_MESSAGE_BID:
        bid_or_claim(e, now);
        break;
    case BORG_MESSAGE_CLAIM:
        claim_or_act(e, now);
        break;
    case BORG_MESSAGE_ACT:
        act_or_stop(e, now);
        break;
    default:
        break;
    }
}

/* ---- what others say ---- */

/* Whether a message is the newest of its sender; then what is known of an earlier start of it is forgotten. */
static int accept(borg_election *e, const borg_message *m, uint16_t now)
{
    const uint16_t bit = bit_of(m->from.unit);
    borg_bidder *b = &e->bidders[m->from.unit - 1];
    const int again = (e->known & bit) && b->incarnation != m->from.incarnation;
    if (again ? !is_newer(m->from.incarnation, b->incarnation)
              : (e->known & bit) && !is_newer(m->is.vote.stamp, b->stamp)) {
        return 0;
    }
    if (again) {
        take(&e->promised, bit);
    }
    if (again || !(e->alive & bit)) {
        take(&e->granted, bit);
        if (e->kind == BORG_MESSAGE_ACT) {
            put(&e->graced, bit);
            b->appeared = now;
        }
    }
    put(&e->alive, bit);
    put(&e->known, bit);
    b->incarnation = m->from.incarnation;
    b->stamp = m->is.vote.stamp;
    b->heard = now;
    b->kind = m->kind;
    b->round = m->is.vote.round;
    b->bid = m->is.vote.bid;
    return 1;
}

/* Its grant for this machine, if the message has one. */
static void be_granted(borg_election *e, const borg_message *m, uint16_t now)
{
    const uint16_t bit = bit_of(m->from.unit);
    borg_bidder *b = &e->bidders[m->from.unit - 1];
    const int32_t place = count_of(m->is.vote.granted & (my_bit(e) - 1u));
    if (!(m->is.vote.granted & my_bit(e)) || place >= BORG_GRANTS_MAX || e->kind < BORG_MESSAGE_CLAIM) {
        return;
    }
    const uint16_t answer = m->is.vote.answers[place];
    if (is_newer(answer, e->yielded) && since(answer, now) < LEASE - MARGIN) {
        b->answered = answer;
        put(&e->granted, bit);
        take(&e->graced, bit);
    }
}

static void promise(borg_election *e, const borg_message *m)
{
    const uint16_t bit = bit_of(m->from.unit);
    if (m->kind != BORG_MESSAGE_CLAIM && m->kind != BORG_MESSAGE_ACT) {
        take(&e->promised, bit);
    } else if (!e->mute && count_of(e->promised) < e->config.winners) {
        put(&e->promised, bit);
    }
}

void borg_election_hear(borg_election *e, const borg_message *message, uint32_t now_ms)
{
    if (!e || !message || message->from.ref != e->config.me.ref ||
        message->from.script != e->config.me.script || message->from.unit == 0 ||
        message->from.unit > e->config.units || message->from.unit == e->config.me.unit) {
        return;
    }
    const uint16_t now = tick_of(now_ms), bit = bit_of(message->from.unit);
    forget(e, now);
    if (message->kind == BORG_MESSAGE_DEATH) {
        if ((e->known & bit) && e->bidders[message->from.unit - 1].incarnation == message->from.incarnation) {
            take(&e->alive, bit);
            take(&e->graced, bit);
        }
        return;
    }
    if (!borg_message_is_vote(message) || message->is.vote.handler != e->config.handler) {
        return;
    }
    if (message->kind != BORG_MESSAGE_ALIVE) {
        activate(e, now);
    }
    if (accept(e, message, now)) {
        be_granted(e, message, now);
        promise(e, message);
    }
}

/* ---- the caller's ---- */

iris_status borg_election_init(borg_election *e, borg_bidder *bidders, const borg_election_config *config,
                               uint32_t now_ms)
{
    if (!e || !bidders || !config || config->units == 0 || config->units > BORG_ELECTION_UNITS_MAX ||
        config->winners == 0 || config->winners > config->units || config->me.unit == 0 ||
        config->me.unit > config->units || config->me.ref == 0) {
        return IRIS_ERR_ARG;
    }
    const uint16_t now = tick_of(now_ms);
    *e = (borg_election){.bidders = bidders,
                         .config = *config,
                         .kind = BORG_MESSAGE_ALIVE,
                         .booted = now,
                         .yielded = now,
                         .mute = 1};
    for (int32_t u = 0; u < config->units; u++) {
        bidders[u] = (borg_bidder){.kind = BORG_MESSAGE_ALIVE};
    }
    return IRIS_OK;
}

void borg_election_begin(borg_election *e, uint8_t round, uint32_t bid, uint32_t now_ms)
{
    if (!e) {
        return;
    }
    const uint16_t now = tick_of(now_ms);
    forget(e, now);
    activate(e, now);
    give_back(e, BORG_MESSAGE_BID, now);
    e->round = round;
    e->bid = bid;
    e->begun = now;
    e->settled = 0;
}

void borg_election_leave(borg_election *e, uint32_t now_ms)
{
    if (e && e->kind != BORG_MESSAGE_ALIVE) {
        give_back(e, BORG_MESSAGE_ALIVE, tick_of(now_ms));
    }
}

/* To whom it is granted, at most so many as there is room for; the next message tells of the others. */
static void tell_grants(borg_election *e, borg_vote *vote)
{
    const uint32_t others = (uint32_t)(e->promised & ~my_bit(e));
    int32_t count = 0;
    for (int32_t i = 0; i < e->config.units && count < BORG_GRANTS_MAX; i++) {
        const int32_t at = (e->told + i) % e->config.units;
        if (others & bit_of(at + 1)) {
            put(&vote->granted, bit_of(at + 1));
            if (++count == BORG_GRANTS_MAX) {
                e->told = (uint8_t)(at + 1);
            }
        }
    }
    count = 0;
    for (int32_t u = 1; u <= e->config.units; u++) {
        if (vote->granted & bit_of(u)) {
            vote->answers[count++] = e->bidders[u - 1].stamp;
        }
    }
}

int borg_election_step(borg_election *e, uint32_t now_ms, borg_message *message)
{
    if (!e || !message) {
        return 0;
    }
    const uint16_t now = tick_of(now_ms);
    forget(e, now);
    decide(e, now);
    if (e->active) {
        deactivate(e);
    }
    /* A last message says that nobody is asked any more. Two of one tick could not be told apart. */
    const int32_t passed = since(e->sent, now);
    if (!(e->due ? passed > 0 : e->active && passed >= PERIOD)) {
        return 0;
    }
    *message = (borg_message){.kind = e->kind, .sequence = now, .from = e->config.me};
    message->is.vote.handler = e->config.handler;
    message->is.vote.round = e->round;
    message->is.vote.bid = e->bid;
    message->is.vote.stamp = now;
    tell_grants(e, &message->is.vote);
    e->sent = now;
    e->due = 0;
    return 1;
}
