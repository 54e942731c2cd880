#include "iris/runtime/runtime.h"

#include <string.h>

static const iris_motion standing = {0, 0, 0};
static const iris_runtime_order nothing = {{IRIS_ORDER_NONE, 0, 0}, 0, 0, 0};

iris_status iris_runtime_init(iris_runtime *runtime, const iris_behavior *behaviors,
                              const int32_t *priorities, int32_t sources, iris_journal *journal,
                              uint32_t now_ms)
{
    if (!runtime || !behaviors || !priorities) {
        return IRIS_ERR_ARG;
    }
    int32_t begins[3 + IRIS_RUNTIME_SOURCES] = {1, (int32_t)now_ms, sources};
    if (sources < 1 || sources > IRIS_RUNTIME_SOURCES) {
        return IRIS_ERR_RANGE;
    }
    for (int32_t i = 0; i < sources; i++) {
        if (priorities[i] < 0 || priorities[i] > IRIS_RUNTIME_PRIORITY_MAX) {
            return IRIS_ERR_RANGE;
        }
        begins[3 + i] = priorities[i];
    }
    memset(runtime, 0, sizeof *runtime);
    memcpy(runtime->priorities, begins + 3, (size_t)sources * sizeof *priorities);
    runtime->sources = sources;
    runtime->behaviors = behaviors;
    runtime->journal = journal;
    runtime->now_ms = runtime->reset_ms = now_ms;
    (void)iris_journal_output(journal, IRIS_JOURNAL_BEGIN, begins, 3 + sources);
    return IRIS_OK;
}

/* A clock that goes back stands still. */
static void set_time(iris_runtime *runtime, uint32_t now_ms)
{
    if ((int32_t)(now_ms - runtime->now_ms) > 0) {
        runtime->now_ms = now_ms;
    }
}

static void keep_event(iris_runtime *runtime, iris_event event)
{
    const int32_t at = (runtime->event_first + runtime->event_count) % IRIS_RUNTIME_EVENTS;
    runtime->events[at] = event;
    if (runtime->event_count < IRIS_RUNTIME_EVENTS) {
        runtime->event_count++;
    } else {
        runtime->event_first = (runtime->event_first + 1) % IRIS_RUNTIME_EVENTS;
        runtime->dropped++;
    }
}

/* What runtime or behaviors tell: made of what came in. */
static void tell(iris_runtime *runtime, iris_event_kind kind, int32_t x, int32_t y)
{
    const int32_t values[3] = {(int32_t)kind, x, y};
    (void)iris_journal_output(runtime->journal, IRIS_JOURNAL_EVENT, values, 3);
    keep_event(runtime, (iris_event){kind, x, y});
}

static void move(iris_runtime *runtime, iris_motion motion)
{
    const int32_t values[2] = {motion.speed_mms, motion.turn_rate};
    if (motion.speed_mms != runtime->motion.speed_mms || motion.turn_rate != runtime->motion.turn_rate) {
        (void)iris_journal_output(runtime->journal, IRIS_JOURNAL_MOTION, values, 2);
    }
    runtime->motion = motion;
}

static int32_t priority_of(const iris_runtime *runtime, const iris_runtime_order *order)
{
    return runtime->priorities[order->source];
}

static void stop_all(iris_runtime *runtime)
{
    runtime->driving = runtime->attending[0] = runtime->attending[1] = nothing;
    runtime->waiting_count = 0;
    move(runtime, standing);
}

static int can_do(const iris_runtime *runtime, iris_order_verb verb)
{
    return verb == IRIS_ORDER_STOP || verb == IRIS_ORDER_RESET_TIME || verb == IRIS_ORDER_DRIVE ||
           runtime->behaviors[verb].step != NULL;
}

static int has_expired(const iris_runtime *runtime, const iris_runtime_order *order)
{
    return order->lease_ms > 0 && runtime->now_ms - order->given_ms >= (uint32_t)order->lease_ms;
}

/* The source's newest waiting order that drives without an end, which the next one would end: its index, or -1. */
static int32_t would_give_way(const iris_runtime *runtime, int32_t source)
{
    for (int32_t i = runtime->waiting_count - 1; i >= 0; i--) {
        const iris_runtime_order *waiting = &runtime->waiting[i];
        if (waiting->source == source && !iris_order_attends(waiting->order.verb)) {
            return iris_order_ends(waiting->order.verb) ? -1 : i;
        }
    }
    return -1;
}

static void take_waiting(iris_runtime *runtime, int32_t i)
{
    runtime->waiting_count--;
    memmove(&runtime->waiting[i], &runtime->waiting[i + 1],
            (size_t)(runtime->waiting_count - i) * sizeof runtime->waiting[0]);
}

static iris_status accept(iris_runtime *runtime, const iris_runtime_order *given)
{
    const iris_order_verb verb = given->order.verb;
    if (verb == IRIS_ORDER_STOP) {
        const int holds_more = runtime->stop.order.verb == IRIS_ORDER_STOP &&
                               !has_expired(runtime, &runtime->stop) &&
                               priority_of(runtime, &runtime->stop) > priority_of(runtime, given);
        runtime->stop = holds_more ? runtime->stop : *given;
        stop_all(runtime);
        tell(runtime, IRIS_EVENT_STOPPED, given->source, 0);
        return IRIS_OK;
    }
    if (runtime->stop.order.verb == IRIS_ORDER_STOP) {
        if (!has_expired(runtime, &runtime->stop) &&
            priority_of(runtime, &runtime->stop) > priority_of(runtime, given)) {
            return IRIS_ERR_FULL;
        }
        runtime->stop = nothing;
    }
    if (verb == IRIS_ORDER_RESET_TIME) {
        runtime->reset_ms = runtime->now_ms;
        return IRIS_OK;
    }
    const int32_t gives_way = iris_order_attends(verb) ? -1 : would_give_way(runtime, given->source);
    if (gives_way >= 0) {
        take_waiting(runtime, gives_way);
    }
    if (runtime->waiting_count == IRIS_RUNTIME_QUEUE) {
        return IRIS_ERR_FULL;
    }
    runtime->waiting[runtime->waiting_count++] = *given;
    return IRIS_OK;
}

iris_status iris_runtime_submit(iris_runtime *runtime, int32_t source, const iris_order *order,
                                int32_t lease_ms, uint32_t now_ms)
{
    if (!runtime || !order) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_order_check(order);
    if (status != IRIS_OK) {
        return status;
    }
    if (source < 0 || source >= runtime->sources || lease_ms < 0 || lease_ms > IRIS_RUNTIME_LEASE_MAX_MS) {
        return IRIS_ERR_RANGE;
    }
    set_time(runtime, now_ms);
    const int32_t values[6] = {(int32_t)now_ms, source, (int32_t)order->verb, order->a, order->b, lease_ms};
    (void)iris_journal_output(runtime->journal, IRIS_JOURNAL_ORDER, values, 6);
    if (!can_do(runtime, order->verb)) {
        return IRIS_ERR_UNSUPPORTED;
    }
    const iris_runtime_order given = {*order, runtime->now_ms, lease_ms, (uint8_t)source};
    return accept(runtime, &given);
}

static void renew(iris_runtime_order *order, int32_t source, uint32_t now_ms)
{
    if (order->source == source) {
        order->given_ms = now_ms;
    }
}

iris_status iris_runtime_renew(iris_runtime *runtime, int32_t source, uint32_t now_ms)
{
    if (!runtime) {
        return IRIS_ERR_ARG;
    }
    if (source < 0 || source >= runtime->sources) {
        return IRIS_ERR_RANGE;
    }
    set_time(runtime, now_ms);
    const int32_t values[2] = {(int32_t)now_ms, source};
    (void)iris_journal_output(runtime->journal, IRIS_JOURNAL_LEASE, values, 2);
    renew(&runtime->driving, source, runtime->now_ms);
    renew(&runtime->attending[0], source, runtime->now_ms);
    renew(&runtime->attending[1], source, runtime->now_ms);
    renew(&runtime->stop, source, runtime->now_ms);
    for (int32_t i = 0; i < runtime->waiting_count; i++) {
        renew(&runtime->waiting[i], source, runtime->now_ms);
    }
    return IRIS_OK;
}

static void tell_expired(iris_runtime *runtime, const iris_runtime_order *order)
{
    tell(runtime, IRIS_EVENT_EXPIRED, order->source, (int32_t)order->order.verb);
}

static void end_leases(iris_runtime *runtime)
{
    if (has_expired(runtime, &runtime->stop)) {
        runtime->stop = nothing;
    }
    if (has_expired(runtime, &runtime->driving)) {
        const iris_runtime_order expired = runtime->driving;
        stop_all(runtime);
        tell_expired(runtime, &expired);
    }
    for (int i = 0; i < 2; i++) {
        if (has_expired(runtime, &runtime->attending[i])) {
            tell_expired(runtime, &runtime->attending[i]);
            runtime->attending[i] = nothing;
        }
    }
    for (int32_t i = 0; i < runtime->waiting_count;) {
        const iris_runtime_order waiting = runtime->waiting[i];
        if (has_expired(runtime, &waiting)) {
            take_waiting(runtime, i);
            tell_expired(runtime, &waiting);
        } else {
            i++;
        }
    }
}

static void fail(iris_runtime *runtime, const iris_runtime_order *order, iris_status status)
{
    tell(runtime, IRIS_EVENT_FAILED, (int32_t)order->order.verb, (int32_t)status);
}

/* 0 when it cannot begin, which is told. */
static int begin(iris_runtime *runtime, const iris_runtime_order *order)
{
    const iris_behavior *behavior = &runtime->behaviors[order->order.verb];
    iris_status status = IRIS_OK;
    if (behavior->step && behavior->begin) {
        status = behavior->begin(behavior->context, &order->order, runtime->now_ms);
    }
    if (status != IRIS_OK) {
        fail(runtime, order, status);
    }
    return status == IRIS_OK;
}

static void begin_attending(iris_runtime *runtime)
{
    for (int32_t i = 0; i < runtime->waiting_count;) {
        const iris_runtime_order waiting = runtime->waiting[i];
        if (iris_order_attends(waiting.order.verb)) {
            iris_runtime_order *place = &runtime->attending[waiting.order.verb == IRIS_ORDER_DETECT];
            take_waiting(runtime, i);
            *place = begin(runtime, &waiting) ? waiting : nothing;
        } else {
            i++;
        }
    }
}

/* Which waiting order drives next, as things are: -1 when none does. */
static int32_t next_to_drive(const iris_runtime *runtime)
{
    int32_t best = -1;
    for (int32_t i = 0; i < runtime->waiting_count; i++) {
        if (best < 0 ||
            priority_of(runtime, &runtime->waiting[i]) > priority_of(runtime, &runtime->waiting[best])) {
            best = i;
        }
    }
    if (best < 0 || runtime->driving.order.verb == IRIS_ORDER_NONE) {
        return best;
    }
    const int32_t more =
        priority_of(runtime, &runtime->waiting[best]) - priority_of(runtime, &runtime->driving);
    return more > 0 || (more == 0 && !iris_order_ends(runtime->driving.order.verb)) ? best : -1;
}

static void begin_driving(iris_runtime *runtime)
{
    int32_t next = next_to_drive(runtime);
    while (next >= 0) {
        const iris_runtime_order order = runtime->waiting[next];
        take_waiting(runtime, next);
        runtime->driving = begin(runtime, &order) ? order : nothing;
        next = next_to_drive(runtime);
    }
}

/* One step of an order's behavior, and what it tells. The order ends when it is done or fails. */
static iris_motion run(iris_runtime *runtime, iris_runtime_order *order)
{
    const iris_behavior *behavior = &runtime->behaviors[order->order.verb];
    iris_motion motion = standing;
    iris_event event = {IRIS_EVENT_NONE, 0, 0};
    if (order->order.verb == IRIS_ORDER_NONE) {
        return standing;
    }
    if (!behavior->step) {
        return (iris_motion){order->order.a, order->order.b, 0}; /* DRIVE */
    }
    const iris_runtime_order as_it_was = *order;
    const iris_status status = behavior->step(behavior->context, runtime->now_ms, &motion, &event);
    if (event.kind != IRIS_EVENT_NONE && iris_event_name((int32_t)event.kind)) {
        tell(runtime, event.kind, event.x, event.y);
    }
    if (status != IRIS_OK) {
        fail(runtime, &as_it_was, status);
    }
    if (motion.done || status != IRIS_OK) {
        *order = nothing;
        return standing;
    }
    return motion;
}

iris_status iris_runtime_step(iris_runtime *runtime, uint32_t now_ms)
{
    if (!runtime) {
        return IRIS_ERR_ARG;
    }
    const int32_t time = (int32_t)now_ms;
    set_time(runtime, now_ms);
    (void)iris_journal_output(runtime->journal, IRIS_JOURNAL_STEP, &time, 1);
    end_leases(runtime);
    begin_attending(runtime);
    begin_driving(runtime);
    move(runtime, run(runtime, &runtime->driving));
    (void)run(runtime, &runtime->attending[0]);
    (void)run(runtime, &runtime->attending[1]);
    return IRIS_OK;
}

int iris_runtime_event_next(iris_event *event, iris_runtime *runtime)
{
    if (!event || !runtime || runtime->event_count == 0) {
        return 0;
    }
    *event = runtime->events[runtime->event_first];
    runtime->event_first = (runtime->event_first + 1) % IRIS_RUNTIME_EVENTS;
    runtime->event_count--;
    return 1;
}

void iris_runtime_tell(iris_runtime *runtime, const iris_event *event)
{
    if (!runtime || !event || !iris_event_name((int32_t)event->kind) || event->kind == IRIS_EVENT_NONE) {
        return;
    }
    const int32_t values[3] = {(int32_t)event->kind, event->x, event->y};
    (void)iris_journal_output(runtime->journal, IRIS_JOURNAL_TOLD, values, 3);
    keep_event(runtime, *event);
}

static iris_status replay_order(iris_runtime *runtime, const int32_t *v)
{
    const iris_order order = {(iris_order_verb)v[2], v[3], v[4]};
    if (v[2] < 0 || v[2] >= IRIS_ORDER_VERBS || iris_order_check(&order) != IRIS_OK || v[1] < 0 ||
        v[1] >= runtime->sources || v[5] < 0 || v[5] > IRIS_RUNTIME_LEASE_MAX_MS) {
        return IRIS_ERR_DATA;
    }
    (void)iris_runtime_submit(runtime, v[1], &order, v[5], (uint32_t)v[0]);
    return IRIS_OK;
}

iris_status iris_runtime_replay(iris_runtime *runtime, const iris_journal_record *record)
{
    if (!runtime || !record) {
        return IRIS_ERR_ARG;
    }
    const int32_t *v = record->values;
    if (record->kind == IRIS_JOURNAL_ORDER) {
        return record->count == 6 ? replay_order(runtime, v) : IRIS_ERR_DATA;
    }
    if (record->kind == IRIS_JOURNAL_LEASE) {
        if (record->count != 2 || v[1] < 0 || v[1] >= runtime->sources) {
            return IRIS_ERR_DATA;
        }
        return iris_runtime_renew(runtime, v[1], (uint32_t)v[0]);
    }
    if (record->kind == IRIS_JOURNAL_TOLD) {
        if (record->count != 3 || v[0] <= IRIS_EVENT_NONE || v[0] >= IRIS_EVENT_KINDS) {
            return IRIS_ERR_DATA;
        }
        const iris_event event = {(iris_event_kind)v[0], v[1], v[2]};
        iris_runtime_tell(runtime, &event);
        return IRIS_OK;
    }
    if (record->kind == IRIS_JOURNAL_STEP) {
        return record->count == 1 ? iris_runtime_step(runtime, (uint32_t)v[0]) : IRIS_ERR_DATA;
    }
    return IRIS_ERR_UNSUPPORTED;
}

uint32_t iris_runtime_time_ms(const iris_runtime *runtime)
{
    return runtime ? runtime->now_ms - runtime->reset_ms : 0;
}

int iris_runtime_is_busy(const iris_runtime *runtime)
{
    return runtime && (runtime->driving.order.verb != IRIS_ORDER_NONE ||
                       runtime->attending[0].order.verb != IRIS_ORDER_NONE ||
                       runtime->attending[1].order.verb != IRIS_ORDER_NONE || runtime->waiting_count > 0);
}
