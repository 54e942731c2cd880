#include "iris/borg/machine.h"

#include "seen.h"

/* The actions that are left to run: none. */
static void end_actions(borg_machine *m)
{
    m->firing = 0;
    m->at = m->end = 0;
}

iris_status borg_machine_init(borg_machine *machine, const uint8_t *chunk, size_t bytes, int32_t unit)
{
    if (!machine) {
        return IRIS_ERR_ARG;
    }
    const iris_status status = borg_chunk_check(chunk, bytes);
    if (status != IRIS_OK) {
        return status;
    }
    if (unit < 1 || unit > borg_chunk_units(chunk) || borg_seen_missing(chunk, NULL) > BORG_SEEN_MAX) {
        return IRIS_ERR_RANGE;
    }
    *machine = (borg_machine){.chunk = chunk, .unit = (uint8_t)unit};
    return IRIS_OK;
}

static void count_up(uint16_t *count)
{
    *count = (uint16_t)(*count + (*count < UINT16_MAX));
}

/* Of the elections first to last; -1: the top. */
static uint32_t handlers_in(const borg_machine *m, int32_t first, int32_t last)
{
    uint32_t bits = 0;
    borg_walk w;
    borg_walk_start(&w, m->chunk);
    while (borg_walk_next(&w)) {
        bits |= w.parent >= first && w.parent <= last ? (uint32_t)1 << w.index : 0;
    }
    return bits;
}

static void end_elections(borg_machine *m)
{
    m->open = m->won = m->must_win = m->must_lose = 0;
    m->armed &= ~handlers_in(m, 0, BORG_HANDLERS_MAX);
}

/* The mission begins anew. What is left of it is for the next step. */
static void put_start(borg_machine *m, const borg_signal *signal)
{
    end_actions(m);
    m->seen_count = 0;
    end_elections(m);
    m->clock_runs = m->time_is_out = m->must_stop = 0;
    m->has_started = 1;
    m->waiting[0] = *signal;
    m->waiting_count = 1;
    m->armed = handlers_in(m, -1, -1);
}

static void take_out(borg_machine *m, int32_t index)
{
    m->waiting_count--;
    for (int32_t i = index; i < m->waiting_count; i++) {
        m->waiting[i] = m->waiting[i + 1];
    }
}

/* The oldest signal that may be dropped: all but START and the machine's own STOPPED, of which one waits at most. */
static int32_t oldest(const borg_machine *m)
{
    int32_t i = 0;
    while (i < BORG_WAITING_MAX - 1 &&
           (m->waiting[i].kind == BORG_START || m->waiting[i].kind == BORG_STOPPED) &&
           borg_is_own(m, &m->waiting[i])) {
        i++;
    }
    return i;
}

/* Makes room for a signal; of the machine's own STOPPED none is needed when one waits already. */
static int make_room(borg_machine *m, const borg_signal *signal)
{
    for (int32_t i = 0; signal->kind == BORG_STOPPED && borg_is_own(m, signal) && i < m->waiting_count; i++) {
        if (m->waiting[i].kind == BORG_STOPPED && borg_is_own(m, &m->waiting[i])) {
            return 0;
        }
    }
    if (m->waiting_count == BORG_WAITING_MAX) {
        take_out(m, oldest(m));
        count_up(&m->dropped);
    }
    return 1;
}

static int is_far(int32_t mm)
{
    return mm > BORG_PLACE_MAX_MM || mm < -BORG_PLACE_MAX_MM;
}

iris_status borg_machine_signal(borg_machine *machine, const borg_signal *signal)
{
    if (!machine || !signal || signal->kind >= BORG_SIGNAL_KINDS || (signal->ref != 0 && signal->unit == 0)) {
        return IRIS_ERR_ARG;
    }
    if (is_far(signal->x) || is_far(signal->y)) {
        return IRIS_ERR_RANGE;
    }
    borg_signal known = *signal;
    const int own = borg_is_own(machine, signal);
    if (own) {
        known.ref = borg_chunk_ref(machine->chunk);
        known.unit = machine->unit;
    }
    if (own && (known.kind == BORG_VOTE_WIN || known.kind == BORG_VOTE_LOST)) {
        return IRIS_ERR_ARG;
    }
    if (own && known.kind == BORG_START) {
        put_start(machine, &known);
    } else if (own && known.kind == BORG_TIME_OUT) {
        machine->time_is_out = machine->has_started;
    } else if (machine->has_started && make_room(machine, &known)) {
        machine->waiting[machine->waiting_count++] = known;
    }
    return IRIS_OK;
}

iris_status borg_machine_vote(borg_machine *machine, int32_t election, int won)
{
    if (!machine) {
        return IRIS_ERR_ARG;
    }
    if (election < 0 || election >= BORG_HANDLERS_MAX || !(machine->open >> election & 1)) {
        return IRIS_ERR_RANGE;
    }
    const uint32_t bit = (uint32_t)1 << election;
    machine->must_win = won ? machine->must_win | bit : machine->must_win & ~bit;
    machine->must_lose = won ? machine->must_lose & ~bit : machine->must_lose | bit;
    return IRIS_OK;
}

static int32_t lowest(uint32_t bits)
{
    int32_t i = 0;
    while (!(bits >> i & 1)) {
        i++;
    }
    return i;
}

/* A signal comes: whose condition becomes true by it? */
static void arrive(borg_machine *m)
{
    const uint32_t before = borg_seen_holding(m, 1);
    if (m->now.kind == BORG_OBJ_DETECT_FALSE) {
        borg_seen_forget(m, BORG_OBJ_DETECT_TRUE, &m->now);
    }
    borg_seen_add(m, &m->now);
    m->firing = borg_seen_holding(m, 0) & ~before;
}

static void arrive_vote(borg_machine *m, int won)
{
    const int32_t election = lowest(won ? m->must_win : m->must_lose);
    const uint32_t bit = (uint32_t)1 << election, inside = handlers_in(m, election, election);
    m->must_win &= ~bit;
    m->must_lose &= ~bit;
    m->must_stop = !won && (m->won & bit);
    m->now =
        (borg_signal){won ? BORG_VOTE_WIN : BORG_VOTE_LOST, m->unit, borg_chunk_ref(m->chunk), election, 0};
    if (won) {
        m->won |= bit;
        m->armed |= inside;
        arrive(m);
    } else {
        m->won &= ~bit;
        arrive(m);
        m->armed &= ~inside;
    }
}

/* Takes what comes next: the time, votes, and then the buffer. 0: nothing. */
static int take_signal(borg_machine *m, uint32_t now_ms)
{
    if (m->clock_runs && now_ms - m->reset_at_ms >= (uint32_t)borg_chunk_timeout_s(m->chunk) * 1000) {
        m->clock_runs = 0;
        m->time_is_out = 1;
    }
    if (m->time_is_out) {
        m->time_is_out = 0;
        m->now = (borg_signal){BORG_TIME_OUT, m->unit, borg_chunk_ref(m->chunk), 0, 0};
        arrive(m);
    } else if (m->must_win | m->must_lose) {
        arrive_vote(m, m->must_win != 0);
    } else if (m->waiting_count > 0) {
        m->now = m->waiting[0];
        take_out(m, 0);
        arrive(m);
    } else {
        return 0;
    }
    return 1;
}

static int only_stops(const borg_handler *h)
{
    borg_reader body = h->body;
    borg_action action;
    int all = !h->winners;
    while (all && borg_action_next(&action, &body)) {
        all = action.verb == BORG_STOP;
    }
    return all;
}

/* The first place that winners are sent to. */
static void put_target(borg_output *out, const borg_machine *m, borg_reader handlers)
{
    borg_handler h;
    borg_action action;
    while (borg_handler_next(&h, &handlers)) {
        while (!out->has_target && borg_action_next(&action, &h.body)) {
            const borg_signal *target = action.verb == BORG_GO_TARGET
                                            ? borg_seen_find(m, action.kind, action.ref, action.which)
                                            : NULL;
            if (target || action.verb == BORG_GO) {
                out->has_target = 1;
                out->signal.x = target ? target->x : action.a;
                out->signal.y = target ? target->y : action.b;
            }
        }
    }
}

/* The next handler that fires: its actions are run then, or its election opens. 1: that is to be done. */
static int fire(borg_output *out, borg_machine *m)
{
    borg_walk w;
    const int32_t index = lowest(m->firing);
    const uint32_t bit = (uint32_t)1 << index;
    m->firing &= ~bit;
    if (!borg_walk_to(&w, m->chunk, index)) {
        return 0;
    }
    if (!w.handler.repeats && !(m->now.kind == BORG_TIME_OUT && only_stops(&w.handler))) {
        m->armed &= ~bit;
    }
    m->is_inside = w.parent >= 0;
    if (!w.handler.winners) {
        m->at = (uint16_t)(w.handler.body.at - m->chunk);
        m->end = (uint16_t)(w.handler.body.end - m->chunk);
        return 0;
    }
    m->must_stop = (m->won & bit) != 0;
    m->won &= ~bit;
    m->armed &= ~handlers_in(m, index, index);
    m->open |= bit;
    out->what = BORG_DO_ELECT;
    out->winners = w.handler.winners;
    out->election = (uint8_t)index;
    put_target(out, m, w.handler.body);
    return 1;
}

/* What a Multicast tells; 0: it is not the machine's own. */
static int tell(borg_output *out, const borg_machine *m, const borg_action *action)
{
    const borg_signal *const held = borg_seen_find(m, action->kind, 0, 1);
    const borg_signal *const from = m->now.kind == action->kind ? &m->now : held;
    if (!borg_is_own(m, &m->now)) {
        return 0;
    }
    out->what = BORG_DO_MULTICAST;
    out->signal = (borg_signal){action->kind, m->unit, action->ref, from ? from->x : 0, from ? from->y : 0};
    return 1;
}

/* The next action; 0: nothing comes of it. */
static int act(borg_output *out, borg_machine *m, uint32_t now_ms)
{
    borg_reader r = {m->chunk + m->at, m->chunk + m->end};
    borg_action action;
    if (!borg_action_next(&action, &r)) {
        m->at = m->end;
        return 0;
    }
    m->at = (uint16_t)(r.at - m->chunk);
    if (action.unit != 0 && action.unit != m->unit) {
        return 0;
    }
    if (action.verb == BORG_MULTICAST) {
        return tell(out, m, &action);
    }
    if (action.verb == BORG_RESET_TIME) {
        m->reset_at_ms = now_ms;
        m->clock_runs = 1;
    }
    if (action.verb == BORG_STOP && !m->is_inside) {
        end_elections(m);
    }
    if (action.verb == BORG_GO_TARGET) {
        const borg_signal *const target = borg_seen_find(m, action.kind, action.ref, action.which);
        if (!target) {
            count_up(&m->skipped);
            return 0;
        }
        action = (borg_action){.verb = BORG_GO, .unit = action.unit, .a = target->x, .b = target->y};
    }
    out->what = BORG_DO_ACTION;
    out->action = action;
    return 1;
}

iris_status borg_machine_step(borg_output *output, borg_machine *machine, uint32_t now_ms)
{
    static const borg_output nothing;
    if (!output || !machine) {
        return IRIS_ERR_ARG;
    }
    borg_output out = nothing;
    for (;;) {
        if (machine->must_stop) {
            machine->must_stop = 0;
            out.what = BORG_DO_ACTION;
            out.action.verb = BORG_STOP;
            break;
        }
        if (machine->at < machine->end) {
            if (act(&out, machine, now_ms)) {
                break;
            }
        } else if (machine->firing) {
            if (fire(&out, machine)) {
                break;
            }
        } else if (!take_signal(machine, now_ms)) {
            break;
        }
    }
    *output = out;
    return IRIS_OK;
}
