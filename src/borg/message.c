#include "iris/borg/message.h"

#include "iris/borg/chunk.h"

enum { AT_CHECK = 44 };

/* One walk for both ways: a field is written, or read, and the next one follows. */
typedef struct {
    uint8_t *out;
    const uint8_t *in;
} cursor;

static uint32_t pass(cursor *c, uint32_t value, int32_t bytes)
{
    uint32_t got = 0;
    for (int32_t i = 0; i < bytes; i++) {
        if (c->out) {
            *c->out++ = (uint8_t)(value >> 8 * i);
        } else {
            got |= (uint32_t)*c->in++ << 8 * i;
        }
    }
    return c->out ? value : got;
}

static void pass_1(cursor *c, uint8_t *value)
{
    *value = (uint8_t)pass(c, *value, 1);
}

static void pass_2(cursor *c, uint16_t *value)
{
    *value = (uint16_t)pass(c, *value, 2);
}

static void pass_signed(cursor *c, int32_t *value)
{
    const uint32_t bits = pass(c, (uint32_t)*value, 4);
    *value = bits <= INT32_MAX ? (int32_t)bits : (int32_t)(bits - INT32_MAX - 1) + INT32_MIN;
}

static int pass_signal(cursor *c, borg_signal *s)
{
    pass_1(c, &s->kind);
    pass_1(c, &s->unit);
    pass_2(c, &s->ref);
    pass_signed(c, &s->x);
    pass_signed(c, &s->y);
    return s->kind < BORG_SIGNAL_KINDS && s->ref != 0 && s->unit != 0;
}

static int pass_acks(cursor *c, borg_message *m)
{
    pass_1(c, &m->count);
    if (m->count == 0 || m->count > BORG_ACKS_MAX) {
        return 0;
    }
    int good = 1;
    for (int32_t i = 0; i < m->count; i++) {
        borg_ack *a = &m->is.acks[i];
        pass_2(c, &a->ref);
        pass_1(c, &a->unit);
        pass_2(c, &a->incarnation);
        pass_2(c, &a->sequence);
        pass_2(c, &a->before);
        good = good && a->ref != 0 && a->unit != 0;
    }
    return good;
}

static int pass_vote(cursor *c, borg_vote *v)
{
    pass_1(c, &v->handler);
    pass_1(c, &v->round);
    v->bid = pass(c, v->bid, 4);
    pass_2(c, &v->stamp);
    pass_2(c, &v->granted);
    int32_t count = 0;
    for (uint32_t bits = v->granted; bits != 0; bits &= bits - 1) {
        count++;
    }
    for (int32_t i = 0; i < BORG_GRANTS_MAX && i < count; i++) {
        pass_2(c, &v->answers[i]);
    }
    return count <= BORG_GRANTS_MAX;
}

static int pass_piece(cursor *c, borg_piece *p)
{
    pass_2(c, &p->ref);
    pass_2(c, &p->total);
    pass_2(c, &p->at);
    pass_1(c, &p->count);
    if (p->count == 0 || p->count > BORG_PIECE_BYTES) {
        return 0;
    }
    for (int32_t i = 0; i < p->count; i++) {
        pass_1(c, &p->bytes[i]);
    }
    return p->ref != 0 && p->total <= BORG_CHUNK_BYTES_MAX && p->at + p->count <= p->total;
}

/* All between the version and the check. Whether it is a message. */
static int pass_message(cursor *c, borg_message *m)
{
    pass_1(c, &m->kind);
    m->from.script = pass(c, m->from.script, 4);
    pass_2(c, &m->from.ref);
    pass_1(c, &m->from.unit);
    pass_2(c, &m->from.incarnation);
    pass_2(c, &m->sequence);
    if (m->from.ref == 0 || m->from.unit == 0) {
        return 0;
    }
    switch (m->kind) {
    case BORG_MESSAGE_SIGNAL:
        return pass_signal(c, &m->is.signal);
    case BORG_MESSAGE_ACK:
        return pass_acks(c, m);
    case BORG_MESSAGE_ALIVE:
    case BORG_MESSAGE_BID:
    case BORG_MESSAGE_CLAIM:
    case BORG_MESSAGE_ACT:
        return pass_vote(c, &m->is.vote);
    case BORG_MESSAGE_DEATH:
        return 1;
    case BORG_MESSAGE_CHUNK:
        return pass_piece(c, &m->is.piece);
    default:
        return 0;
    }
}

/* FNV-1a. */
static uint32_t sum(const uint8_t *bytes)
{
    uint32_t hash = 2166136261u;
    for (int32_t i = 0; i < AT_CHECK; i++) {
        hash = (hash ^ bytes[i]) * 16777619u;
    }
    return hash;
}

iris_status borg_message_write(uint8_t *bytes, const borg_message *message)
{
    if (!bytes || !message) {
        return IRIS_ERR_ARG;
    }
    borg_message copy = *message;
    uint8_t made[BORG_MESSAGE_BYTES] = {'B', 'M', 1};
    cursor c = {made + 3, NULL};
    if (!pass_message(&c, &copy)) {
        return IRIS_ERR_DATA;
    }
    c.out = made + AT_CHECK;
    (void)pass(&c, sum(made), 4);
    for (int32_t i = 0; i < BORG_MESSAGE_BYTES; i++) {
        bytes[i] = made[i];
    }
    return IRIS_OK;
}

iris_status borg_message_read(borg_message *message, const uint8_t *bytes, size_t count)
{
    if (!message || !bytes) {
        return IRIS_ERR_ARG;
    }
    if (count < BORG_MESSAGE_BYTES) {
        return IRIS_ERR_TRUNCATED;
    }
    if (bytes[0] != 'B' || bytes[1] != 'M' || bytes[2] == 0) {
        return IRIS_ERR_DATA;
    }
    if (bytes[2] != 1) {
        return IRIS_ERR_UNSUPPORTED;
    }
    borg_message made = {0};
    cursor check = {NULL, bytes + AT_CHECK}, c = {NULL, bytes + 3};
    if (count != BORG_MESSAGE_BYTES || pass(&check, 0, 4) != sum(bytes) || !pass_message(&c, &made)) {
        return IRIS_ERR_DATA;
    }
    while (c.in < bytes + AT_CHECK) {
        if (*c.in++ != 0) {
            return IRIS_ERR_DATA;
        }
    }
    *message = made;
    return IRIS_OK;
}
