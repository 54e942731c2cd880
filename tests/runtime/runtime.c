#include "iris/runtime/runtime.h"

#include "test.h"

/* A robot whose behaviors count and do as the test says. */
typedef struct {
    int32_t begun[IRIS_ORDER_VERBS], stepped[IRIS_ORDER_VERBS];
    iris_order last;
    int32_t steps_to_go; /* of orders that end, and of MAP */
    iris_status begins_with, steps_with;
} robot;

static iris_status begin_any(void *context, const iris_order *order, uint32_t now_ms)
{
    robot *r = context;
    (void)now_ms;
    r->begun[order->verb]++;
    if (!iris_order_attends(order->verb)) {
        r->last = *order;
    }
    return r->begins_with;
}

static iris_status step_any(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event)
{
    robot *r = context;
    (void)now_ms;
    assert_int_equal(motion->speed_mms, 0);
    assert_int_equal(event->kind, IRIS_EVENT_NONE);
    r->stepped[r->last.verb]++;
    motion->speed_mms = 100 + (int32_t)r->last.verb;
    motion->turn_rate = r->last.a;
    if (iris_order_ends(r->last.verb) && --r->steps_to_go <= 0) {
        motion->done = 1;
        *event = (iris_event){IRIS_EVENT_REACHED, r->last.a, r->last.b};
    }
    return r->steps_with;
}

static iris_status step_attending(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event)
{
    robot *r = context;
    (void)now_ms;
    r->stepped[IRIS_ORDER_DETECT]++;
    *event = (iris_event){IRIS_EVENT_OBJECT_DETECTED, 5, 6};
    motion->speed_mms = 9999; /* is not looked at */
    return IRIS_OK;
}

typedef struct {
    robot of;
    iris_behavior behaviors[IRIS_ORDER_VERBS];
    iris_runtime runtime;
} setting;

enum { SCRIPT = 0, TEAM = 1, PERSON = 2, SOURCES = 3 };
static const int32_t priorities[SOURCES] = {10, 10, 20};

static void make(setting *s, uint32_t now_ms)
{
    memset(s, 0, sizeof *s);
    s->of.steps_to_go = 3;
    for (int i = IRIS_ORDER_GO; i < IRIS_ORDER_RESET_TIME; i++) {
        const int attends = iris_order_attends((iris_order_verb)i);
        s->behaviors[i] = (iris_behavior){begin_any, attends ? step_attending : step_any, &s->of};
    }
    s->behaviors[IRIS_ORDER_DRIVE] = (iris_behavior){NULL, NULL, NULL};
    s->behaviors[IRIS_ORDER_LOCK_ON] = (iris_behavior){NULL, NULL, NULL};
    assert_int_equal(iris_runtime_init(&s->runtime, s->behaviors, priorities, SOURCES, NULL, now_ms),
                     IRIS_OK);
}

static iris_status give(setting *s, int32_t source, iris_order_verb verb, int32_t a, int32_t lease_ms,
                        uint32_t now)
{
    const iris_order order = {verb, a, 0};
    return iris_runtime_submit(&s->runtime, source, &order, lease_ms, now);
}

static void step_to(setting *s, uint32_t now_ms, iris_order_verb drives)
{
    assert_int_equal(iris_runtime_step(&s->runtime, now_ms), IRIS_OK);
    assert_int_equal(s->runtime.driving.order.verb, drives);
}

static void next_event_is(setting *s, iris_event_kind kind, int32_t x, int32_t y)
{
    iris_event event;
    assert_int_equal(iris_runtime_event_next(&event, &s->runtime), 1);
    assert_int_equal(event.kind, kind);
    assert_int_equal(event.x, x);
    assert_int_equal(event.y, y);
}

static void stands(const setting *s)
{
    assert_int_equal(s->runtime.motion.speed_mms, 0);
    assert_int_equal(s->runtime.motion.turn_rate, 0);
}

static void orders_are_done_one_after_the_other(void **state)
{
    (void)state;
    setting s;
    iris_event event;
    make(&s, 0);
    step_to(&s, 0, IRIS_ORDER_NONE);
    stands(&s);
    assert_int_equal(iris_runtime_is_busy(&s.runtime), 0);
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_GO, 500, 0, 0), IRIS_OK);
    assert_int_equal(give(&s, TEAM, IRIS_ORDER_TURN, 90, 0, 0), IRIS_OK);
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_FOLLOW_LINE, 0, 0, 0), IRIS_OK);
    assert_int_equal(iris_runtime_is_busy(&s.runtime), 1);
    step_to(&s, 10, IRIS_ORDER_GO);
    assert_int_equal(s.runtime.motion.speed_mms, 100 + IRIS_ORDER_GO);
    assert_int_equal(s.runtime.motion.turn_rate, 500);
    step_to(&s, 20, IRIS_ORDER_GO);
    step_to(&s, 30, IRIS_ORDER_NONE); /* done in this step */
    stands(&s);
    next_event_is(&s, IRIS_EVENT_REACHED, 500, 0);
    s.of.steps_to_go = 1;
    step_to(&s, 40, IRIS_ORDER_NONE);
    next_event_is(&s, IRIS_EVENT_REACHED, 90, 0);
    step_to(&s, 50, IRIS_ORDER_FOLLOW_LINE);
    step_to(&s, 60, IRIS_ORDER_FOLLOW_LINE);
    assert_int_equal(give(&s, TEAM, IRIS_ORDER_EXPLORE, 0, 0, 60), IRIS_OK); /* gives way to an equal */
    step_to(&s, 70, IRIS_ORDER_EXPLORE);
    assert_int_equal(s.of.begun[IRIS_ORDER_GO], 1);
    assert_int_equal(s.of.begun[IRIS_ORDER_FOLLOW_LINE], 1);
    assert_int_equal(iris_runtime_event_next(&event, &s.runtime), 0);
}

static void attending_goes_on_beside_driving(void **state)
{
    (void)state;
    setting s;
    make(&s, 0);
    assert_int_equal(give(&s, TEAM, IRIS_ORDER_GO, 500, 0, 0), IRIS_OK);
    assert_int_equal(give(&s, TEAM, IRIS_ORDER_DETECT, 0, 0, 0), IRIS_OK);
    assert_int_equal(give(&s, TEAM, IRIS_ORDER_DETECT, 0, 0, 0), IRIS_OK);
    step_to(&s, 1, IRIS_ORDER_GO);
    assert_int_equal(s.runtime.motion.speed_mms, 100 + IRIS_ORDER_GO);
    assert_int_equal(s.of.begun[IRIS_ORDER_DETECT], 2);
    assert_int_equal(s.of.stepped[IRIS_ORDER_DETECT], 1);
    next_event_is(&s, IRIS_EVENT_OBJECT_DETECTED, 5, 6);
    step_to(&s, 2, IRIS_ORDER_GO);
    step_to(&s, 3, IRIS_ORDER_NONE);
    step_to(&s, 4, IRIS_ORDER_NONE);
    stands(&s);
    assert_int_equal(s.of.stepped[IRIS_ORDER_DETECT], 4);
    assert_int_equal(iris_runtime_is_busy(&s.runtime), 1);
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_STOP, 0, 0, 5), IRIS_OK);
    step_to(&s, 6, IRIS_ORDER_NONE);
    assert_int_equal(s.of.stepped[IRIS_ORDER_DETECT], 4);
    assert_int_equal(iris_runtime_is_busy(&s.runtime), 0);
}

static void a_higher_priority_takes_over(void **state)
{
    (void)state;
    setting s;
    make(&s, 0);
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_GO, 500, 0, 0), IRIS_OK);
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_TURN, 7, 0, 0), IRIS_OK);
    step_to(&s, 1, IRIS_ORDER_GO);
    assert_int_equal(give(&s, PERSON, IRIS_ORDER_DRIVE, 200, 0, 1), IRIS_OK);
    step_to(&s, 2, IRIS_ORDER_DRIVE);
    assert_int_equal(s.runtime.motion.speed_mms, 200);
    step_to(&s, 3, IRIS_ORDER_DRIVE); /* what is below waits */
    assert_int_equal(give(&s, PERSON, IRIS_ORDER_GO, 1, 0, 3), IRIS_OK);
    s.of.steps_to_go = 1;
    step_to(&s, 4, IRIS_ORDER_NONE);
    s.of.steps_to_go = 9;
    step_to(&s, 5, IRIS_ORDER_TURN); /* the interrupted GO is gone */
    assert_int_equal(s.of.begun[IRIS_ORDER_GO], 2);
}

static void stop_wins(void **state)
{
    (void)state;
    setting s;
    make(&s, 0);
    assert_int_equal(give(&s, PERSON, IRIS_ORDER_DRIVE, 200, 0, 0), IRIS_OK);
    step_to(&s, 1, IRIS_ORDER_DRIVE);
    assert_int_equal(give(&s, PERSON, IRIS_ORDER_TURN, 9, 0, 1), IRIS_OK);
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_STOP, 0, 0, 1), IRIS_OK); /* over a higher one */
    stands(&s);                                                            /* at once */
    next_event_is(&s, IRIS_EVENT_STOPPED, SCRIPT, 0);
    step_to(&s, 2, IRIS_ORDER_NONE);
    assert_int_equal(give(&s, TEAM, IRIS_ORDER_DRIVE, 100, 0, 2),
                     IRIS_OK); /* one of its priority may go on */
    step_to(&s, 3, IRIS_ORDER_DRIVE);
    assert_int_equal(give(&s, PERSON, IRIS_ORDER_STOP, 0, 0, 3), IRIS_OK);
    for (uint32_t now = 4; now < 100000; now += 9999) {
        assert_int_equal(give(&s, TEAM, IRIS_ORDER_DRIVE, 100, 0, now), IRIS_ERR_FULL); /* it holds */
        assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_RESET_TIME, 0, 0, now), IRIS_ERR_FULL);
        step_to(&s, now, IRIS_ORDER_NONE);
        stands(&s);
    }
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_STOP, 0, 0, 100000), IRIS_OK); /* which lifts nothing */
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_DRIVE, 100, 0, 100000), IRIS_ERR_FULL);
    assert_int_equal(give(&s, PERSON, IRIS_ORDER_RESET_TIME, 0, 0, 100000), IRIS_OK);
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_DRIVE, 100, 0, 100000), IRIS_OK);
    step_to(&s, 100001, IRIS_ORDER_DRIVE);
    assert_int_equal(give(&s, PERSON, IRIS_ORDER_STOP, 0, 50, 100001), IRIS_OK); /* holds for 50 ms */
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_DRIVE, 100, 0, 100050), IRIS_ERR_FULL);
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_DRIVE, 100, 0, 100051), IRIS_OK);
}

static void stop_is_never_refused(void **state)
{
    (void)state;
    setting s;
    make(&s, 0);
    for (int i = 0; i < IRIS_RUNTIME_QUEUE; i++) {
        assert_int_equal(give(&s, i % SOURCES, IRIS_ORDER_GO, i, 0, 0), IRIS_OK);
    }
    assert_int_equal(give(&s, PERSON, IRIS_ORDER_GO, 1, 0, 0), IRIS_ERR_FULL);
    assert_int_equal(give(&s, PERSON, IRIS_ORDER_DETECT, 0, 0, 0), IRIS_ERR_FULL);
    assert_int_equal(s.runtime.waiting_count, IRIS_RUNTIME_QUEUE);
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_STOP, 0, 0, 0), IRIS_OK);
    assert_int_equal(s.runtime.waiting_count, 0);
}

static void a_gamepad_never_fills_the_queue(void **state)
{
    (void)state;
    setting s;
    make(&s, 0);
    for (int i = 0; i < 1000; i++) {
        assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_DRIVE, i, 200, 0), IRIS_OK);
    }
    assert_int_equal(s.runtime.waiting_count, 1);
    step_to(&s, 1, IRIS_ORDER_DRIVE);
    assert_int_equal(s.runtime.motion.speed_mms, 999);
}

static void a_lease_that_ends_stops_the_robot(void **state)
{
    (void)state;
    setting s;
    const uint32_t begin = 0xFFFFFFA0u; /* the clock wraps */
    make(&s, begin);
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_EXPLORE, 0, 0, begin), IRIS_OK);
    assert_int_equal(give(&s, PERSON, IRIS_ORDER_DRIVE, 300, 200, begin), IRIS_OK);
    step_to(&s, begin + 1, IRIS_ORDER_DRIVE);
    step_to(&s, begin + 199, IRIS_ORDER_DRIVE);
    assert_int_equal(iris_runtime_renew(&s.runtime, PERSON, begin + 199), IRIS_OK);
    assert_int_equal(iris_runtime_renew(&s.runtime, SCRIPT, begin + 300),
                     IRIS_OK); /* another's does not help */
    step_to(&s, begin + 398, IRIS_ORDER_DRIVE);
    step_to(&s, begin + 399, IRIS_ORDER_NONE);
    stands(&s);
    next_event_is(&s, IRIS_EVENT_EXPIRED, PERSON, IRIS_ORDER_DRIVE);
    step_to(&s, begin + 500, IRIS_ORDER_NONE); /* EXPLORE, which waited, is gone as well */
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_EXPLORE, 0, 0, begin + 500),
                     IRIS_OK); /* but nothing holds */
    step_to(&s, begin + 501, IRIS_ORDER_EXPLORE);
}

static void waiting_and_attending_leases_end_alone(void **state)
{
    (void)state;
    setting s;
    make(&s, 0);
    s.of.steps_to_go = 1000;
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_GO, 1, 0, 0), IRIS_OK);
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_TURN, 1, 100, 0), IRIS_OK);
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_MAP, 0, 50, 0), IRIS_OK);
    step_to(&s, 1, IRIS_ORDER_GO);
    s.of.last = (iris_order){IRIS_ORDER_GO, 1, 0};
    step_to(&s, 50, IRIS_ORDER_GO);
    next_event_is(&s, IRIS_EVENT_OBJECT_DETECTED, 5, 6); /* of the first step */
    next_event_is(&s, IRIS_EVENT_EXPIRED, SCRIPT, IRIS_ORDER_MAP);
    step_to(&s, 100, IRIS_ORDER_GO);
    next_event_is(&s, IRIS_EVENT_EXPIRED, SCRIPT, IRIS_ORDER_TURN);
    assert_int_equal(s.runtime.waiting_count, 0);
}

static void time_never_goes_back(void **state)
{
    (void)state;
    setting s;
    make(&s, 1000);
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_DRIVE, 100, 50, 1100), IRIS_OK);
    step_to(&s, 1090, IRIS_ORDER_DRIVE);
    assert_int_equal(iris_runtime_time_ms(&s.runtime), 100);
    step_to(&s, 1149, IRIS_ORDER_DRIVE);
    step_to(&s, 0, IRIS_ORDER_DRIVE);
    step_to(&s, 1150, IRIS_ORDER_NONE);
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_RESET_TIME, 0, 0, 1160), IRIS_OK);
    step_to(&s, 1175, IRIS_ORDER_NONE);
    assert_int_equal(iris_runtime_time_ms(&s.runtime), 15);
    assert_int_equal(iris_runtime_time_ms(NULL), 0);
}

static void what_fails_is_told_and_ends(void **state)
{
    (void)state;
    setting s;
    make(&s, 0);
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_LOCK_ON, 0, 0, 0), IRIS_ERR_UNSUPPORTED);
    s.of.begins_with = IRIS_ERR_IO;
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_GO, 4, 0, 0), IRIS_OK);
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_MAP, 0, 0, 0), IRIS_OK);
    step_to(&s, 1, IRIS_ORDER_NONE);
    stands(&s);
    next_event_is(&s, IRIS_EVENT_FAILED, IRIS_ORDER_MAP, IRIS_ERR_IO);
    next_event_is(&s, IRIS_EVENT_FAILED, IRIS_ORDER_GO, IRIS_ERR_IO);
    s.of.begins_with = IRIS_OK;
    s.of.steps_with = IRIS_ERR_TIMEOUT;
    assert_int_equal(give(&s, SCRIPT, IRIS_ORDER_FOLLOW_LINE, 4, 0, 1), IRIS_OK);
    step_to(&s, 2, IRIS_ORDER_NONE);
    stands(&s);
    next_event_is(&s, IRIS_EVENT_FAILED, IRIS_ORDER_FOLLOW_LINE, IRIS_ERR_TIMEOUT);
}

static void the_newest_events_are_kept(void **state)
{
    (void)state;
    setting s;
    iris_event event = {IRIS_EVENT_BUMPED, 0, 0};
    make(&s, 0);
    for (int32_t i = 0; i < IRIS_RUNTIME_EVENTS + 3; i++) {
        event.x = i;
        iris_runtime_tell(&s.runtime, &event);
    }
    assert_int_equal(s.runtime.dropped, 3);
    for (int32_t i = 3; i < IRIS_RUNTIME_EVENTS + 3; i++) {
        next_event_is(&s, IRIS_EVENT_BUMPED, i, 0);
    }
    assert_int_equal(iris_runtime_event_next(&event, &s.runtime), 0);
    event.kind = (iris_event_kind)99;
    iris_runtime_tell(&s.runtime, &event);
    iris_runtime_tell(&s.runtime, NULL);
    iris_runtime_tell(NULL, &event);
    assert_int_equal(iris_runtime_event_next(&event, &s.runtime), 0);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    setting s;
    const int32_t bad[1] = {IRIS_RUNTIME_PRIORITY_MAX + 1};
    make(&s, 0);
    assert_int_equal(iris_runtime_init(NULL, s.behaviors, priorities, 1, NULL, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_runtime_init(&s.runtime, NULL, priorities, 1, NULL, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_runtime_init(&s.runtime, s.behaviors, NULL, 1, NULL, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_runtime_init(&s.runtime, s.behaviors, bad, 1, NULL, 0), IRIS_ERR_RANGE);
    assert_int_equal(iris_runtime_init(&s.runtime, s.behaviors, priorities, 0, NULL, 0), IRIS_ERR_RANGE);
    assert_int_equal(iris_runtime_init(&s.runtime, s.behaviors, priorities, 9, NULL, 0), IRIS_ERR_RANGE);
    assert_int_equal(s.runtime.sources, SOURCES);
    assert_int_equal(give(&s, -1, IRIS_ORDER_STOP, 0, 0, 0), IRIS_ERR_RANGE);
    assert_int_equal(give(&s, SOURCES, IRIS_ORDER_STOP, 0, 0, 0), IRIS_ERR_RANGE);
    assert_int_equal(give(&s, 0, IRIS_ORDER_STOP, 0, -1, 0), IRIS_ERR_RANGE);
    assert_int_equal(give(&s, 0, IRIS_ORDER_STOP, 0, IRIS_RUNTIME_LEASE_MAX_MS + 1, 0), IRIS_ERR_RANGE);
    assert_int_equal(give(&s, 0, IRIS_ORDER_STOP, 1, 0, 0), IRIS_ERR_RANGE);
    assert_int_equal(give(&s, 0, IRIS_ORDER_NONE, 0, 0, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_runtime_submit(&s.runtime, 0, NULL, 0, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_runtime_renew(&s.runtime, SOURCES, 0), IRIS_ERR_RANGE);
    assert_int_equal(iris_runtime_renew(NULL, 0, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_runtime_step(NULL, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_runtime_is_busy(NULL), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(orders_are_done_one_after_the_other),
        cmocka_unit_test(attending_goes_on_beside_driving),
        cmocka_unit_test(a_higher_priority_takes_over),
        cmocka_unit_test(stop_wins),
        cmocka_unit_test(stop_is_never_refused),
        cmocka_unit_test(a_gamepad_never_fills_the_queue),
        cmocka_unit_test(a_lease_that_ends_stops_the_robot),
        cmocka_unit_test(waiting_and_attending_leases_end_alone),
        cmocka_unit_test(time_never_goes_back),
        cmocka_unit_test(what_fails_is_told_and_ends),
        cmocka_unit_test(the_newest_events_are_kept),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
