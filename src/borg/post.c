#include "iris/borg/post.h"

#include <stddef.h>

enum {
    PERIOD = BORG_POST_PERIOD_MS / BORG_POST_TICK_MS,
    SELDOM = BORG_POST_SELDOM_MS / BORG_POST_TICK_MS,
    LEAST = BORG_POST_LEAST_MS / BORG_POST_TICK_MS,
    MOST = BORG_POST_MOST_MS / BORG_POST_TICK_MS,
    REMEMBERED = 16 /* before the last one */
};

static uint16_t tick_of(uint32_t now_ms)
{
    return (uint16_t)(now_ms / BORG_POST_TICK_MS);
}

static int32_t since(uint16_t then, uint16_t now)
{
    return (uint16_t)(now - then);
}

static int is_newer(uint16_t a, uint16_t b)
{
    const uint16_t ahead = (uint16_t)(a - b);
    return ahead != 0 && ahead < 0x8000;
}

/* ---- senders ---- */

/* Who was silent for long is not waited for, and its place may be taken. */
static void forget(borg_post *post, uint16_t now)
{
    for (int32_t i = 0; i < post->count; i++) {
        borg_sender *s = &post->senders[i];
        if (s->ref != 0 && since(s->heard, now) > MOST) {
            s->gone = 1;
            s->heard = (uint16_t)(now - MOST - 1); /* so long ago that it does not matter how long */
        }
    }
}

static int is_of(const borg_sender *s, const borg_address *from)
{
    return s->ref == from->ref && s->unit == from->unit;
}

/* Its place, its own or one that it may take; null: there is none. */
static borg_sender *place_of(borg_post *post, const borg_address *from, uint16_t now)
{
    borg_sender *found = NULL;
    for (int32_t i = 0; i < post->count; i++) {
        borg_sender *s = &post->senders[i];
        if (is_of(s, from)) {
            return s;
        }
        const int free = s->ref == 0, silent = !free && since(s->heard, now) > MOST;
        if (free ? !found || found->ref != 0 : silent && !found) {
            found = s;
        }
    }
    return found;
}

/* Who sent a message, when it counts. */
static borg_sender *sender_of(borg_post *post, const borg_address *from, uint16_t now)
{
    borg_sender *s = place_of(post, from, now);
    if (!s) {
        return NULL;
    }
    const int same = is_of(s, from) && s->incarnation == from->incarnation;
    if (is_of(s, from) && !same && since(s->heard, now) <= MOST &&
        !is_newer(from->incarnation, s->incarnation)) {
        return NULL;
    }
    if (!same) {
        *s = (borg_sender){.ref = from->ref, .incarnation = from->incarnation, .unit = from->unit};
    }
    s->heard = now;
    s->gone = 0;
    return s;
}

/* Whether a signal is new. */
static int is_first(borg_sender *s, uint16_t sequence)
{
    if (!s->has) {
        s->has = 1;
        s->sequence = sequence;
        s->before = 0;
        return 1;
    }
    if (is_newer(sequence, s->sequence)) {
        const int32_t step = (uint16_t)(sequence - s->sequence);
        s->before = (uint16_t)(step > REMEMBERED ? 0 : (s->before << 1 | 1) << (step - 1));
        s->sequence = sequence;
        return 1;
    }
    const int32_t ago = (uint16_t)(s->sequence - sequence);
    if (ago == 0 || ago > REMEMBERED || (s->before >> (ago - 1) & 1)) {
        return 0;
    }
    s->before = (uint16_t)(s->before | 1u << (ago - 1));
    return 1;
}

static void take_acks(borg_post *post, borg_sender *s, const borg_message *message)
{
    for (int32_t i = 0; i < message->count && i < BORG_ACKS_MAX; i++) {
        const borg_ack *ack = &message->is.acks[i];
        if (ack->ref != post->me.ref || ack->unit != post->me.unit ||
            ack->incarnation != post->me.incarnation) {
            continue;
        }
        for (int32_t slot = 0; slot < BORG_POST_SLOTS; slot++) {
            const int32_t ago = (uint16_t)(ack->sequence - post->slots[slot].sequence);
            if (ago == 0 || (ago <= REMEMBERED && (ack->before >> (ago - 1) & 1))) {
                s->acknowledged = (uint8_t)(s->acknowledged | 1u << slot);
            }
        }
    }
}

int borg_post_hear(borg_post *post, const borg_message *message, uint32_t now_ms, borg_signal *signal)
{
    if (!post || !message || !signal || message->from.script != post->me.script || message->from.ref == 0 ||
        message->from.unit == 0 ||
        (message->from.ref == post->me.ref && message->from.unit == post->me.unit)) {
        return 0;
    }
    const uint16_t now = tick_of(now_ms);
    forget(post, now);
    borg_sender *s = sender_of(post, &message->from, now);
    if (!s) {
        return 0;
    }
    switch (message->kind) {
    case BORG_MESSAGE_SIGNAL:
        s->owed = 1;
        if (is_first(s, message->sequence)) {
            *signal = message->is.signal;
            return 1;
        }
        return 0;
    case BORG_MESSAGE_ACK:
        take_acks(post, s, message);
        return 0;
    case BORG_MESSAGE_DEATH:
        s->gone = 1;
        return 0;
    default:
        return 0;
    }
}

/* ---- what is sent ---- */

iris_status borg_post_init(borg_post *post, borg_sender *senders, int32_t count, const borg_address *me)
{
    if (!post || !senders || !me || count < 1 || count > BORG_POST_SENDERS_MAX || me->ref == 0 ||
        me->unit == 0) {
        return IRIS_ERR_ARG;
    }
    *post = (borg_post){.senders = senders, .count = count, .me = *me};
    for (int32_t i = 0; i < count; i++) {
        senders[i] = (borg_sender){0};
    }
    return IRIS_OK;
}

/* A free slot, or that of the oldest. What is further back than others remember would not be taken any more. */
static int32_t slot_for_one_more(borg_post *post)
{
    int32_t best = 0;
    for (int32_t i = 0; i < BORG_POST_SLOTS; i++) {
        borg_post_slot *slot = &post->slots[i];
        if (slot->used && (uint16_t)(post->sequence + 1 - slot->sequence) > REMEMBERED) {
            slot->used = 0;
            post->dropped = (uint16_t)(post->dropped + (post->dropped < UINT16_MAX));
        }
        const borg_post_slot *other = &post->slots[best];
        if (other->used && (!slot->used || is_newer(other->sequence, slot->sequence))) {
            best = i;
        }
    }
    post->dropped = (uint16_t)(post->dropped + (post->slots[best].used && post->dropped < UINT16_MAX));
    return best;
}

void borg_post_send(borg_post *post, const borg_signal *signal, uint32_t now_ms)
{
    if (!post || !signal || signal->kind >= BORG_SIGNAL_KINDS || signal->ref == 0 || signal->unit == 0) {
        return;
    }
    const int32_t at = slot_for_one_more(post);
    post->sequence++;
    post->slots[at] =
        (borg_post_slot){.signal = *signal, .sequence = post->sequence, .first = tick_of(now_ms), .used = 1};
    for (int32_t i = 0; i < post->count; i++) {
        post->senders[i].acknowledged = (uint8_t)(post->senders[i].acknowledged & ~(1u << at));
    }
}

/* Acknowledgments that are owed, as many as a message holds. */
static int acknowledge(borg_post *post, borg_message *message)
{
    *message = (borg_message){.kind = BORG_MESSAGE_ACK, .from = post->me};
    for (int32_t i = 0; i < post->count && message->count < BORG_ACKS_MAX; i++) {
        borg_sender *s = &post->senders[i];
        if (s->owed) {
            message->is.acks[message->count++] =
                (borg_ack){s->ref, s->incarnation, s->sequence, s->before, s->unit};
            s->owed = 0;
        }
    }
    return message->count > 0;
}

/* How many are known, and how many of them have not acknowledged a slot. */
static int32_t missing(const borg_post *post, int32_t at, int32_t *known)
{
    int32_t count = 0;
    *known = 0;
    for (int32_t i = 0; i < post->count; i++) {
        const borg_sender *s = &post->senders[i];
        if (s->ref != 0 && !s->gone) {
            (*known)++;
            count += !(s->acknowledged >> at & 1);
        }
    }
    return count;
}

/* Whether a slot's signal is to be sent now. */
static int is_due(borg_post *post, int32_t at, uint16_t now)
{
    borg_post_slot *slot = &post->slots[at];
    int32_t known;
    if (!slot->used) {
        return 0;
    }
    const int32_t left = missing(post, at, &known), age = since(slot->first, now);
    if (slot->sent && (age > MOST || (age > LEAST && left == 0))) {
        slot->used = 0;
        return 0;
    }
    const int32_t wait = known > 0 && left == 0 ? SELDOM : PERIOD;
    return !slot->sent || since(slot->last, now) >= wait;
}

int borg_post_next(borg_post *post, uint32_t now_ms, borg_message *message)
{
    if (!post || !message) {
        return 0;
    }
    const uint16_t now = tick_of(now_ms);
    forget(post, now);
    if (acknowledge(post, message)) {
        return 1;
    }
    for (int32_t i = 0; i < BORG_POST_SLOTS; i++) {
        borg_post_slot *slot = &post->slots[i];
        if (is_due(post, i, now)) {
            slot->last = now;
            slot->sent = 1;
            *message =
                (borg_message){.kind = BORG_MESSAGE_SIGNAL, .sequence = slot->sequence, .from = post->me};
            message->is.signal = slot->signal;
            return 1;
        }
    }
    return 0;
}
