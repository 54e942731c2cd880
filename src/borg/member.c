#include "iris/borg/member.h"

#include "chunk_walk.h"
#include "iris/fixed.h"

enum { MESSAGES_MAX = 32 }; /* heard in one step */
enum { TOLD_NOTHING, TOLD_WON, TOLD_LOST };

typedef enum {
    WAITING = 0,
    FOLLOWING,
    EXPLORING,
    MAPPING,
    DETECTING,
    TURNING,
    GOING,
    REACHED,
    STOPPED,
    FAILED
} state;

const char *borg_member_state(const borg_member *member)
{
    static const char *const words[] = {"waiting", "following", "exploring", "mapping", "detecting",
                                        "turning", "going",     "reached",   "stopped", "failed"};
    return words[member && member->state <= FAILED ? member->state : WAITING];
}

/* Whether all of the chunk's elections find room. */
static iris_status check_elections(const borg_member_config *config)
{
    const int32_t units = borg_chunk_units(config->chunk);
    const int32_t count = borg_chunk_elections(config->chunk);
    if (count > 0 && (count > BORG_MEMBER_ELECTIONS_MAX || units > BORG_ELECTION_UNITS_MAX ||
                      count * units > config->bidder_count)) {
        return IRIS_ERR_RANGE;
    }
    return count > 0 && !config->bidders ? IRIS_ERR_ARG : IRIS_OK;
}

static void init_contests(borg_member *m, const borg_member_config *config, uint32_t now_ms)
{
    static const borg_contest empty;
    const uint8_t units = (uint8_t)borg_chunk_units(config->chunk);
    borg_walk w;
    borg_walk_start(&w, config->chunk);
    m->contest_count = 0;
    while (borg_walk_next(&w)) {
        if (w.handler.winners && m->contest_count < BORG_MEMBER_ELECTIONS_MAX) {
            const borg_election_config rules = {m->me, (uint8_t)w.index, units, w.handler.winners};
            borg_contest *const c = &m->contests[m->contest_count];
            *c = empty;
            (void)borg_election_init(&c->election, config->bidders + m->contest_count * units, &rules,
                                     now_ms);
            m->contest_count++;
        }
    }
}

iris_status borg_member_init(borg_member *member, const borg_member_config *config, uint32_t now_ms)
{
    if (!member || !config || !config->senders || config->sender_count < 1) {
        return IRIS_ERR_ARG;
    }
    if (config->sender_count > BORG_POST_SENDERS_MAX) {
        return IRIS_ERR_RANGE;
    }
    iris_status status = borg_chunk_check(config->chunk, config->bytes);
    if (status == IRIS_OK) {
        status = check_elections(config);
    }
    if (status == IRIS_OK) {
        status = borg_machine_init(&member->machine, config->chunk, config->bytes, config->unit);
    }
    if (status != IRIS_OK) {
        return status;
    }
    member->me =
        (borg_address){config->script, borg_chunk_ref(config->chunk), config->incarnation, config->unit};
    member->now_ms = now_ms;
    member->x_mm = member->y_mm = member->battery_percent = 0;
    member->state = WAITING;
    member->elsewhere = 0;
    init_contests(member, config, now_ms);
    return borg_post_init(&member->post, config->senders, config->sender_count, &member->me);
}

static iris_status notice(borg_member *m, uint8_t kind, int32_t x, int32_t y)
{
    const borg_signal signal = {kind, m->me.unit, 0, x, y};
    return borg_machine_signal(&m->machine, &signal);
}

iris_status borg_member_start(borg_member *member)
{
    return member ? notice(member, BORG_START, 0, 0) : IRIS_ERR_ARG;
}

iris_status borg_member_place(borg_member *member, int32_t x_mm, int32_t y_mm, int32_t battery_percent)
{
    const int32_t far = BORG_PLACE_MAX_MM, full = 100;
    if (!member) {
        return IRIS_ERR_ARG;
    }
    if (x_mm > far || x_mm < -far || y_mm > far || y_mm < -far || battery_percent < 0 ||
        battery_percent > full) {
        return IRIS_ERR_RANGE;
    }
    member->x_mm = x_mm;
    member->y_mm = y_mm;
    member->battery_percent = battery_percent;
    return IRIS_OK;
}

/* ---- elections ---- */

/* The machine learns how they stand; those that it has ended are left. */
static void settle(borg_member *m)
{
    for (int32_t i = 0; i < m->contest_count; i++) {
        borg_contest *const c = &m->contests[i];
        const int32_t number = c->election.config.handler;
        const uint8_t told = c->told;
        if (!c->begun) {
            continue;
        }
        if (!borg_machine_is_open(&m->machine, number)) {
            borg_election_leave(&c->election, m->now_ms);
            c->begun = 0;
        } else if (borg_election_won(&c->election)) {
            c->told = TOLD_WON;
        } else if (told == TOLD_WON || m->now_ms - c->begun_ms >= BORG_MEMBER_LOST_MS) {
            c->told = TOLD_LOST;
        }
        if (c->begun && c->told != told) {
            (void)borg_machine_vote(&m->machine, number, c->told == TOLD_WON);
        }
    }
}

static int32_t distance_mm(const borg_member *m, const borg_output *out)
{
    return out->has_target ? (int32_t)iris_hypot(out->signal.x - m->x_mm, out->signal.y - m->y_mm) : 0;
}

/* Rounds are counted by each machine; who has missed some goes on with the others' count. */
static void begin(borg_member *m, const borg_output *out)
{
    for (int32_t i = 0; i < m->contest_count; i++) {
        borg_contest *const c = &m->contests[i];
        if (c->election.config.handler != out->election) {
            continue;
        }
        c->round++;
        if ((uint8_t)(c->heard - c->round) < 128) {
            c->round = c->heard;
        }
        c->begun = 1;
        c->told = TOLD_NOTHING;
        c->begun_ms = m->now_ms;
        borg_election_begin(&c->election, c->round, borg_bid(distance_mm(m, out), m->battery_percent),
                            m->now_ms);
    }
}

/* ---- the network ---- */

static void count_up(uint16_t *count)
{
    *count = (uint16_t)(*count + (*count < UINT16_MAX));
}

/* The post's clock, which stands still while the network is away. */
static uint32_t post_ms(const borg_member *m)
{
    return m->now_ms - m->away_ms;
}

static void hear(borg_member *m, const borg_message *message)
{
    borg_signal signal;
    if (message->from.script != m->me.script) {
        return;
    }
    if (message->from.ref == m->me.ref && message->from.unit == m->me.unit) {
        const uint16_t later = (uint16_t)(message->from.incarnation - m->me.incarnation);
        if (later > 0 && later < 0x8000) {
            count_up(&m->elsewhere);
        }
        return;
    }
    if (borg_post_hear(&m->post, message, post_ms(m), &signal)) {
        (void)borg_machine_signal(&m->machine, &signal);
    }
    for (int32_t i = 0; i < m->contest_count; i++) {
        borg_contest *const c = &m->contests[i];
        const int is_round = borg_message_is_vote(message) && message->kind != BORG_MESSAGE_ALIVE &&
                             message->from.ref == m->me.ref &&
                             message->is.vote.handler == c->election.config.handler;
        if (is_round && (uint8_t)(message->is.vote.round - c->heard) < 128) {
            c->heard = message->is.vote.round;
        }
        borg_election_hear(&c->election, message, m->now_ms);
    }
}

static iris_status receive(borg_member *m, const borg_transport *transport)
{
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
    borg_message message;
    for (int32_t i = 0; i < MESSAGES_MAX; i++) {
        size_t count = 0;
        const iris_status status = transport->receive(transport->context, bytes, sizeof bytes, &count);
        if (status != IRIS_OK || count == 0) {
            return status;
        }
        if (count <= sizeof bytes && borg_message_read(&message, bytes, count) == IRIS_OK) {
            hear(m, &message);
        }
    }
    return IRIS_OK;
}

static void send(const borg_transport *transport, const borg_message *message, iris_status *status)
{
    uint8_t bytes[BORG_MESSAGE_BYTES];
    if (borg_message_write(bytes, message) == IRIS_OK) {
        const iris_status now = transport->send(transport->context, bytes, sizeof bytes);
        *status = now == IRIS_OK ? *status : now;
    }
}

iris_status borg_member_step(borg_member *member, const borg_transport *transport, uint32_t now_ms)
{
    borg_message message;
    if (!member || !transport) {
        return IRIS_ERR_ARG;
    }
    member->away_ms += member->is_away ? now_ms - member->now_ms : 0;
    member->now_ms = now_ms;
    iris_status status = receive(member, transport);
    for (int32_t i = 0; i < member->contest_count; i++) {
        if (borg_election_step(&member->contests[i].election, now_ms, &message)) {
            send(transport, &message, &status);
        }
    }
    settle(member);
    for (int32_t i = 0; i < MESSAGES_MAX && borg_post_next(&member->post, post_ms(member), &message); i++) {
        send(transport, &message, &status);
    }
    member->is_away = status == IRIS_ERR_IO;
    return status;
}

/* ---- the robot ---- */

static int32_t least(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

/* 65536 are 360 degrees, 8192 are 45; rounded half up. degrees: -32768 to 32767, made positive by 729 times 45. */
static int32_t units_of_degrees(int32_t degrees)
{
    return (int32_t)(((uint32_t)(degrees + 729 * 45) * 8192 + 22) / 45) - 729 * 8192;
}

static iris_order order_of(const borg_action *a)
{
    const int32_t speed = least(a->a, IRIS_ORDER_SPEED_MAX_MMS);
    switch (a->verb) {
    case BORG_LINE_FOLLOW:
        return (iris_order){IRIS_ORDER_FOLLOW_LINE, speed, 0};
    case BORG_OBJ_DETECT:
        return (iris_order){IRIS_ORDER_DETECT, 0, 0};
    case BORG_AUTO_EXPLORE:
        return (iris_order){IRIS_ORDER_EXPLORE, speed, 0};
    case BORG_MAP_BUILD:
        return (iris_order){IRIS_ORDER_MAP, 0, 0};
    case BORG_GO:
        return (iris_order){IRIS_ORDER_GO_TO, a->a, a->b};
    case BORG_TURN:
        return (iris_order){IRIS_ORDER_TURN, units_of_degrees(a->a), 0};
    case BORG_RESET_TIME:
        return (iris_order){IRIS_ORDER_RESET_TIME, 0, 0};
    default:
        return (iris_order){IRIS_ORDER_STOP, 0, 0};
    }
}

static uint8_t state_after(uint8_t was, iris_order_verb verb)
{
    const int still = was == WAITING || was == MAPPING || was == DETECTING;
    switch (verb) {
    case IRIS_ORDER_FOLLOW_LINE:
        return FOLLOWING;
    case IRIS_ORDER_EXPLORE:
        return EXPLORING;
    case IRIS_ORDER_GO_TO:
        return GOING;
    case IRIS_ORDER_TURN:
        return TURNING;
    case IRIS_ORDER_MAP:
        return still ? MAPPING : was;
    case IRIS_ORDER_DETECT:
        return still ? DETECTING : was;
    case IRIS_ORDER_STOP:
        return was == REACHED ? REACHED : STOPPED;
    default:
        return was;
    }
}

int borg_member_order_next(borg_member *member, iris_order *order)
{
    borg_output out;
    if (!member || !order) {
        return 0;
    }
    while (borg_machine_step(&out, &member->machine, member->now_ms) == IRIS_OK &&
           out.what != BORG_DO_NOTHING) {
        settle(member);
        if (out.what == BORG_DO_ELECT) {
            begin(member, &out);
        } else if (out.what == BORG_DO_MULTICAST) {
            borg_post_send(&member->post, &out.signal, post_ms(member));
        } else {
            *order = order_of(&out.action);
            member->state = state_after(member->state, order->verb);
            return 1;
        }
    }
    settle(member);
    return 0;
}

static void fail(borg_member *m)
{
    m->state = FAILED;
    for (int32_t i = 0; i < m->contest_count; i++) {
        if (m->contests[i].told == TOLD_WON) {
            borg_election_leave(&m->contests[i].election, m->now_ms);
        }
    }
    settle(m);
}

iris_status borg_member_event(borg_member *member, const iris_event *event)
{
    if (!member || !event) {
        return IRIS_ERR_ARG;
    }
    switch (event->kind) {
    case IRIS_EVENT_OBJECT_DETECTED:
        return notice(member, BORG_OBJ_DETECT_TRUE, event->x, event->y);
    case IRIS_EVENT_OBJECT_LOST:
        return notice(member, BORG_OBJ_DETECT_FALSE, event->x, event->y);
    case IRIS_EVENT_REACHED:
        if (member->state == GOING) {
            member->state = REACHED;
            return notice(member, BORG_REACHED, event->x, event->y);
        }
        member->state = member->state == TURNING ? STOPPED : member->state;
        return IRIS_OK;
    case IRIS_EVENT_LINE_END:
        return notice(member, BORG_LINE_END, event->x, event->y);
    case IRIS_EVENT_BUMPED:
        return notice(member, BORG_BUMPED, event->x, event->y);
    case IRIS_EVENT_BATTERY_LOW:
        return notice(member, BORG_BATTERY_LOW, 0, 0);
    case IRIS_EVENT_STOPPED:
        member->state = state_after(member->state, IRIS_ORDER_STOP);
        return notice(member, BORG_STOPPED, 0, 0);
    case IRIS_EVENT_FAILED:
        if (event->x == IRIS_ORDER_GO_TO && member->state == GOING) {
            fail(member);
        }
        return IRIS_OK;
    default:
        return IRIS_OK;
    }
}
