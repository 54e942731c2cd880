/* IRIS - the runtime: one robot, any number of interfaces that control it, and one rule for who is obeyed (the report's
 * section 6.2.2).
 *
 * Each control interface is a source with a number and a priority. It submits orders, which wait in a queue of
 * IRIS_RUNTIME_QUEUE; a step begins the next one and lets behaviors work, which are functions that the caller
 * names, one for each verb. What is to be done with the wheels is in `motion` after each step.
 *
 * Who is obeyed. One order drives at a time. The next one is of the highest priority that waits, of equals the oldest.
 *   - A higher priority takes over at once. What it interrupts is dropped; what waits below it waits on.
 *   - Among equals an order that ends by itself (iris_order_ends) is finished first, one that does not gives way at once.
 *     Where a source's newest waiting order would give way to its next one, that takes its place: a gamepad never fills the queue.
 *   - Orders that attend, one for each verb, go on beside what drives.
 *   - STOP wins, from any source: it empties the queue, ends all orders, and motion is 0 when submit returns.
 *     It holds: until a source of that priority or a higher one gives an order, or the STOP's lease ends, all below are refused.
 *   - Leases. An order that was given with one must be renewed before it ends, by iris_runtime_renew. When an order that
 *     drives is not, who gave it is gone: all stops, as by a STOP that holds nobody. One that attends or waits is dropped.
 *
 * Time is any clock of the caller's in milliseconds, and may wrap; one that goes back stands still. Step at least once in
 * 20 days. The same calls with the same numbers give the same motion, bit for bit (journal.h).
 */
#ifndef IRIS_RUNTIME_RUNTIME_H
#define IRIS_RUNTIME_RUNTIME_H

#include "iris/runtime/event.h"
#include "iris/runtime/journal.h"
#include "iris/runtime/order.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_RUNTIME_SOURCES      8
#define IRIS_RUNTIME_QUEUE        16 /* orders that wait, of all sources together */
#define IRIS_RUNTIME_EVENTS       8  /* that wait to be taken: the oldest goes when there are more */
#define IRIS_RUNTIME_PRIORITY_MAX 1000
#define IRIS_RUNTIME_LEASE_MAX_MS 600000

/* What a behavior wants of the drive. */
typedef struct {
    int32_t speed_mms; /* negative: back */
    int32_t turn_rate; /* angle units a second, positive to the right */
    uint8_t done;      /* 1: the order is done; the robot stands */
} iris_motion;

/* How orders of one verb are done. Neither function waits. `begin` may be null: nothing to prepare. A status but IRIS_OK ends the
 * order, and is told as IRIS_EVENT_FAILED. *motion and *event are zeroed before each step; the motion of what attends is
 * not looked at, but for `done`. */
typedef struct {
    iris_status (*begin)(void *context, const iris_order *order, uint32_t now_ms);
    iris_status (*step)(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event);
    void *context;
} iris_behavior;

typedef struct {
    iris_order order; /* verb NONE: nothing */
    uint32_t given_ms;
    int32_t lease_ms; /* 0: without one */
    uint8_t source;
} iris_runtime_order;

/* Read motion, driving, dropped; the rest belongs to the functions. */
typedef struct {
    iris_motion motion;                             /* what the drive is to do until the next step */
    iris_runtime_order driving;                     /* verb NONE: no order drives */
    uint32_t dropped;                               /* events that nobody took in time */
    iris_runtime_order attending[2];                /* MAP, DETECT */
    iris_runtime_order waiting[IRIS_RUNTIME_QUEUE]; /* the oldest first */
    iris_event events[IRIS_RUNTIME_EVENTS];
    int32_t waiting_count, event_count, event_first;
    int32_t priorities[IRIS_RUNTIME_SOURCES];
    int32_t sources;
    iris_runtime_order stop; /* STOP: it holds */
    uint32_t now_ms, reset_ms;
    const iris_behavior *behaviors;
    iris_journal *journal;
} iris_runtime;

/* A robot that stands, for this many sources with their priorities.
 *   behaviors    IRIS_ORDER_VERBS of them, by verb; must outlive *runtime. One without `step` cannot do its verb; STOP and
 *                RESET_TIME are the runtime's own, and so is DRIVE where the table has nothing for it
 *   priorities   0..IRIS_RUNTIME_PRIORITY_MAX each; higher is obeyed first
 *   sources      1..IRIS_RUNTIME_SOURCES
 *   journal      where all that comes in is recorded; null: nowhere; must outlive *runtime
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: sources or priorities; *runtime is untouched. O(1). */
iris_status iris_runtime_init(iris_runtime *runtime, const iris_behavior *behaviors,
                              const int32_t *priorities, int32_t sources, iris_journal *journal,
                              uint32_t now_ms);

/* Gives an order.
 *   lease_ms  0..IRIS_RUNTIME_LEASE_MAX_MS: it has to be renewed within this time; 0: it needs not. Of a STOP: how long it holds,
 *             0 without end
 * IRIS_ERR_FULL: the queue is full (never for a STOP), or a STOP of a higher priority holds; IRIS_ERR_UNSUPPORTED: no
 * behavior does that; IRIS_ERR_RANGE: no such source, or lease_ms; others as iris_order_check. In these cases nothing has
 * happened. O(IRIS_RUNTIME_QUEUE). */
iris_status iris_runtime_submit(iris_runtime *runtime, int32_t source, const iris_order *order,
                                int32_t lease_ms, uint32_t now_ms);

/* This source is still there: the leases of its orders begin anew, those without one stay without. IRIS_ERR_ARG: null
 * pointer; IRIS_ERR_RANGE: no such source. O(IRIS_RUNTIME_QUEUE). */
iris_status iris_runtime_renew(iris_runtime *runtime, int32_t source, uint32_t now_ms);

/* Time has come to now_ms: leases end, the next order begins, behaviors work; runtime->motion is what to do now.
 * IRIS_ERR_ARG: null pointer. O(IRIS_RUNTIME_QUEUE) and what the behaviors take. */
iris_status iris_runtime_step(iris_runtime *runtime, uint32_t now_ms);

/* Takes the oldest event. 0: there is none (or a null pointer). O(1). */
int iris_runtime_event_next(iris_event *event, iris_runtime *runtime);

/* Tells an event that no behavior does: a bump, a battery that runs low. Null pointers and no such kind do nothing. O(1). */
void iris_runtime_tell(iris_runtime *runtime, const iris_event *event);

/* Replaying (iris_journal_replay_from): makes the one call that the record is of, ORDER, LEASE, TOLD, or STEP; what came in
 * and what was made of it follow it in the journal. IRIS_ERR_UNSUPPORTED: another kind, which is for the caller to take by
 * iris_journal_input; IRIS_ERR_DATA: values that no call has; IRIS_ERR_ARG: null pointer. What the call itself returned
 * is compared, not returned. As the call. */
iris_status iris_runtime_replay(iris_runtime *runtime, const iris_journal_record *record);

/* Milliseconds from the last RESET_TIME, or the beginning, to the last step; wraps. Null: 0. O(1). */
uint32_t iris_runtime_time_ms(const iris_runtime *runtime);

/* Does anything drive, attend, or wait? O(1). */
int iris_runtime_is_busy(const iris_runtime *runtime);

#ifdef __cplusplus
}
#endif

#endif
