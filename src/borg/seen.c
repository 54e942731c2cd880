#include "seen.h"

int borg_is_own(const borg_machine *m, const borg_signal *signal)
{
    return signal->ref == 0 || (signal->ref == borg_chunk_ref(m->chunk) && signal->unit == m->unit);
}

int32_t borg_seen_index(const borg_machine *m, uint8_t kind, uint16_t ref, uint8_t unit)
{
    for (int32_t i = 0; i < m->seen_count; i++) {
        if (m->seen[i].kind == kind && m->seen[i].ref == ref && m->seen[i].unit == unit) {
            return i;
        }
    }
    return -1;
}

const borg_signal *borg_seen_find(const borg_machine *m, uint8_t kind, uint16_t ref, int32_t which)
{
    for (int32_t i = 0; i < m->seen_count; i++) {
        if (m->seen[i].kind == kind && m->seen[i].ref == ref && --which == 0) {
            return &m->seen[i];
        }
    }
    return NULL;
}

static int32_t count_of(const borg_machine *m, uint8_t kind, uint16_t ref)
{
    int32_t count = 0;
    while (borg_seen_find(m, kind, ref, count + 1)) {
        count++;
    }
    return count;
}

/* How many of these signals the chunk asks for at once; *first: where it does so first. */
static int32_t most_asked(const uint8_t *chunk, uint8_t kind, uint16_t ref, int32_t *first)
{
    borg_uses u;
    int32_t most = 0, i = 0;
    *first = -1;
    for (borg_uses_start(&u, chunk); borg_uses_next(&u); i++) {
        if (u.kind == kind && u.ref == ref) {
            most = u.machines > most ? u.machines : most;
            *first = *first < 0 ? i : *first;
        }
    }
    return most;
}

int32_t borg_seen_missing(const uint8_t *chunk, const borg_machine *m)
{
    borg_uses u;
    int32_t missing = 0, i = 0, first;
    for (borg_uses_start(&u, chunk); borg_uses_next(&u); i++) {
        const int32_t seen = m ? count_of(m, u.kind, u.ref) : 0;
        const int32_t more = most_asked(chunk, u.kind, u.ref, &first) - seen;
        missing += i == first && more > 0 ? more : 0;
    }
    return missing;
}

/* What the chunk asks for always finds room. That more machines see the object is remembered where there is room
 * beyond that: when the first one loses it, another one still sees it. */
static void add(borg_machine *m, const borg_signal *signal, uint16_t ref)
{
    int32_t first;
    int32_t i = borg_seen_index(m, signal->kind, ref, signal->unit);
    if (i < 0) {
        const int32_t asked = most_asked(m->chunk, signal->kind, ref, &first);
        const int is_more = count_of(m, signal->kind, ref) >= asked;
        if (asked == 0 || (is_more && (signal->kind != BORG_OBJ_DETECT_TRUE ||
                                       m->seen_count + borg_seen_missing(m->chunk, m) >= BORG_SEEN_MAX))) {
            return;
        }
        if (m->seen_count >= BORG_SEEN_MAX) {
            return;
        }
        i = m->seen_count++;
    }
    m->seen[i] = *signal;
    m->seen[i].ref = ref;
}

void borg_seen_add(borg_machine *m, const borg_signal *signal)
{
    add(m, signal, signal->ref);
    if (borg_is_own(m, signal)) {
        add(m, signal, 0);
    }
}

static void forget(borg_machine *m, int32_t index)
{
    if (index >= 0) {
        m->seen_count--;
        for (int32_t i = index; i < m->seen_count; i++) {
            m->seen[i] = m->seen[i + 1];
        }
    }
}

void borg_seen_forget(borg_machine *m, uint8_t kind, const borg_signal *of_sender)
{
    forget(m, borg_seen_index(m, kind, of_sender->ref, of_sender->unit));
    if (borg_is_own(m, of_sender)) {
        forget(m, borg_seen_index(m, kind, 0, of_sender->unit));
    }
}

/* What is known of the handler whose condition is looked at. */
typedef struct {
    int32_t election; /* that it is in; -1: none */
    int own_alone;    /* it multicasts */
} standing;

static int multicasts(const borg_handler *h)
{
    borg_reader body = h->body;
    borg_action action;
    while (!h->winners && borg_action_next(&action, &body)) {
        if (action.verb == BORG_MULTICAST) {
            return 1;
        }
    }
    return 0;
}

/* The votes of an election are its handlers' alone. */
static int is_vote(const borg_term *t, const standing *s)
{
    return s->election >= 0 && t->ref == 0 && (t->op == BORG_VOTE_WIN || t->op == BORG_VOTE_LOST);
}

/* Whether m->now is what this term waits for, and so did not hold before it came. */
static int is_news(const borg_machine *m, const borg_term *t, const standing *s)
{
    const int own = borg_is_own(m, &m->now);
    if (t->op != m->now.kind || (t->ref != m->now.ref && !(t->ref == 0 && own))) {
        return 0;
    }
    if (is_vote(t, s)) {
        return m->now.x == s->election;
    }
    return t->op != BORG_OBJ_DETECT_TRUE ||
           (s->own_alone && borg_seen_index(m, t->op, m->now.ref, m->now.unit) < 0);
}

static int term_holds(const borg_machine *m, const borg_term *t, const standing *s, int before)
{
    if (before && is_news(m, t, s)) {
        return 0;
    }
    if (is_vote(t, s)) {
        return (int)(m->won >> s->election & 1) == (t->op == BORG_VOTE_WIN);
    }
    return borg_seen_find(m, t->op, t->ref, t->machines) != NULL;
}

static int condition_holds(const borg_machine *m, borg_reader condition, const standing *s, int before)
{
    uint32_t stack = 0; /* the top is bit 0; BORG_STACK_MAX are used */
    borg_term t;
    while (borg_term_next(&t, &condition)) {
        if (t.op < BORG_SIGNAL_KINDS) {
            stack = stack << 1 | (uint32_t)term_holds(m, &t, s, before);
        } else if (t.op == BORG_NOT) {
            stack ^= 1;
        } else {
            const uint32_t top = stack & 1;
            stack >>= 1;
            stack = t.op == BORG_AND ? stack & (top | ~(uint32_t)1) : stack | top;
        }
    }
    return (int)(stack & 1);
}

uint32_t borg_seen_holding(const borg_machine *m, int before)
{
    const int own = borg_is_own(m, &m->now);
    uint32_t holding = 0;
    borg_walk w;
    borg_walk_start(&w, m->chunk);
    while (borg_walk_next(&w)) {
        const standing s = {w.parent, multicasts(&w.handler)};
        const int may = w.index < BORG_HANDLERS_MAX && (m->armed >> w.index & 1) && (own || !s.own_alone);
        if (may && condition_holds(m, w.handler.condition, &s, before)) {
            holding |= (uint32_t)1 << w.index;
        }
    }
    return holding;
}
