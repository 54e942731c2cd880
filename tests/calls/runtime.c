/* Orders, the runtime, and its journal. */
#include "iris/runtime/runtime.h"

#include <string.h>

#include "calls.h"

static iris_order any_order(void)
{
    const iris_order order = {(iris_order_verb)draw_int(IRIS_ORDER_NONE, IRIS_ORDER_VERBS),
                              draw_chance(2) ? 0 : draw_int(-20000, 20000),
                              draw_chance(2) ? 0 : draw_int(-2000, 2000)};
    return order;
}

static void check(void)
{
    const iris_order order = any_order();
    const iris_order *given = OR_NULL(draw_given(&order, sizeof order));
    CALL(iris_order_check(given));
}

static void order_write(void)
{
    const iris_order order = any_order();
    const size_t capacity = draw_chance(3) ? draw_below(IRIS_ORDER_TEXT_BYTES) : IRIS_ORDER_TEXT_BYTES;
    char *text = OR_NULL(draw_results(capacity + 1));
    size_t *length = OR_NULL(draw_results(sizeof *length));
    const iris_order *given = OR_NULL(draw_given(&order, sizeof order));
    CALL(iris_order_write(text, capacity, length, given));
}

static void order_read(void)
{
    static const char *const texts[] = {"stop",         "go 500",   "turn -12.5 # left",
                                        "drive 200 30", "goto 1 2", "explore x"};
    const char *written = texts[draw_below(6)];
    const size_t length = draw_chance(3) ? draw_below((uint32_t)strlen(written)) : strlen(written);
    iris_order *order = OR_NULL(draw_results(sizeof *order));
    int32_t *column = OR_NULL(draw_state(NULL, sizeof *column));
    const char *text =
        OR_NULL(draw_chance(4) ? draw_given(NULL, length + 1) : draw_given(written, length + 1));
    CALL(iris_order_read(order, column, text, length));
}

static void of_command(void)
{
    const iris_command command = {1, IRIS_LINE_FOUND, draw_int(-1000, 1000), draw_int(0, 1000), 0, 0, 0};
    iris_order *order = OR_NULL(draw_results(sizeof *order));
    const iris_command *given = OR_NULL(draw_given(&command, sizeof command));
    CALL(iris_order_of_command(order, given, draw_int(1, IRIS_ORDER_SPEED_MAX_MMS),
                               draw_int(0, IRIS_ORDER_TURN_RATE_MAX)));
}

static iris_status step_any(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event)
{
    (void)context;
    motion->speed_mms = (int32_t)(now_ms & 1023u);
    motion->done = now_ms % 5 == 0;
    event->kind = now_ms % 7 == 0 ? IRIS_EVENT_REACHED : IRIS_EVENT_NONE;
    return now_ms % 11 == 0 ? IRIS_ERR_IO : IRIS_OK;
}

static iris_behavior table[IRIS_ORDER_VERBS];

static iris_status sink(void *context, const char *line, size_t bytes)
{
    int32_t *left = context;
    (void)line;
    return bytes > IRIS_JOURNAL_LINE_BYTES || --*left < 0 ? IRIS_ERR_IO : IRIS_OK;
}

/* A runtime that has done some things. */
static iris_runtime *any_runtime(void)
{
    static iris_journal journal;
    static int32_t left;
    const int32_t priorities[2] = {draw_within(0, 3), draw_within(0, 3)};
    iris_runtime runtime;
    for (int i = IRIS_ORDER_GO; i < IRIS_ORDER_RESET_TIME; i++) {
        table[i].step = draw_chance(8) ? NULL : step_any;
    }
    left = draw_within(0, 60);
    (void)iris_journal_record_to(&journal, sink, &left);
    (void)iris_runtime_init(&runtime, table, priorities, 2, draw_chance(2) ? &journal : NULL, 0);
    for (int32_t i = draw_within(0, 40); i > 0; i--) {
        const iris_order order = any_order();
        (void)iris_runtime_submit(&runtime, draw_within(0, 1), &order, draw_within(0, 3) * 50,
                                  (uint32_t)(1000 - 20 * i));
        if (draw_chance(3)) {
            (void)iris_runtime_step(&runtime, (uint32_t)(1000 - 20 * i));
        }
    }
    return draw_state(&runtime, sizeof runtime);
}

static void init(void)
{
    const int32_t priorities[2] = {draw_int(0, IRIS_RUNTIME_PRIORITY_MAX),
                                   draw_int(0, IRIS_RUNTIME_PRIORITY_MAX)};
    iris_runtime *runtime = OR_NULL(draw_results(sizeof *runtime));
    const iris_behavior *behaviors = OR_NULL(draw_given(table, sizeof table));
    const int32_t *given = OR_NULL(draw_given(priorities, sizeof priorities));
    CALL(iris_runtime_init(runtime, behaviors, given, draw_chance(5) ? draw_within(-1, 0) : draw_within(1, 2),
                           NULL, draw_below(5)));
}

static void submit(void)
{
    const iris_order order = any_order();
    iris_runtime *runtime = OR_NULL(any_runtime());
    const iris_order *given = OR_NULL(draw_given(&order, sizeof order));
    CALL(iris_runtime_submit(runtime, draw_int(0, 1), given, draw_int(0, IRIS_RUNTIME_LEASE_MAX_MS),
                             draw_below(3000)));
}

static void renew(void)
{
    iris_runtime *runtime = OR_NULL(any_runtime());
    CALL(iris_runtime_renew(runtime, draw_int(0, 1), draw_below(3000)));
}

static void step(void)
{
    iris_runtime *runtime = OR_NULL(any_runtime());
    CALL(iris_runtime_step(runtime, draw_below(3000)));
}

static void replay(void)
{
    static const char kinds[] = "OLTSRMEZJx";
    iris_journal_record record = {kinds[draw_below(10)], draw_within(0, IRIS_JOURNAL_VALUES), {0}};
    for (int i = 0; i < IRIS_JOURNAL_VALUES; i++) {
        record.values[i] = draw_int(0, 11);
    }
    iris_runtime *runtime = OR_NULL(any_runtime());
    const iris_journal_record *given = OR_NULL(draw_given(&record, sizeof record));
    CALL(iris_runtime_replay(runtime, given));
}

static const char text[] = "J 1 -2147483648*EA4AAF58\nS 5*00000000\n";

/* One that records, or replays; the memory of what it replays stays. */
static iris_journal *any_journal(void)
{
    static int32_t left;
    iris_journal journal;
    left = draw_within(0, 2);
    if (draw_chance(2)) {
        (void)iris_journal_record_to(&journal, sink, &left);
    } else {
        (void)iris_journal_replay_from(&journal, text,
                                       draw_chance(2) ? sizeof text - 1 : draw_below(sizeof text));
    }
    return draw_state(&journal, sizeof journal);
}

static void record_to(void)
{
    static int32_t left;
    iris_journal *journal = OR_NULL(draw_results(sizeof *journal));
    CALL(iris_journal_record_to(journal, draw_chance(9) ? NULL : sink, &left));
}

static void replay_from(void)
{
    iris_journal *journal = OR_NULL(draw_results(sizeof *journal));
    const char *given = OR_NULL(draw_given(text, sizeof text));
    CALL(iris_journal_replay_from(journal, given, draw_below(sizeof text)));
}

static void input(void)
{
    iris_journal *journal = OR_NULL(any_journal());
    int32_t *values = OR_NULL(draw_state(NULL, IRIS_JOURNAL_VALUES * sizeof *values));
    const char kind = draw_chance(9)   ? (char)draw_below(128)
                      : draw_chance(2) ? IRIS_JOURNAL_BEGIN
                                       : IRIS_JOURNAL_STEP;
    CALL(iris_journal_input(journal, kind, values, draw_chance(3) ? draw_int(0, IRIS_JOURNAL_VALUES) : 2));
}

static void output(void)
{
    iris_journal *journal = OR_NULL(any_journal());
    const int32_t *values = OR_NULL(draw_given(NULL, IRIS_JOURNAL_VALUES * sizeof *values));
    const char kind = draw_chance(9)   ? (char)draw_below(128)
                      : draw_chance(2) ? IRIS_JOURNAL_BEGIN
                                       : IRIS_JOURNAL_STEP;
    CALL(iris_journal_output(journal, kind, values, draw_chance(3) ? draw_int(0, IRIS_JOURNAL_VALUES) : 2));
}

static void end(void)
{
    iris_journal *journal = OR_NULL(any_journal());
    CALL(iris_journal_end(journal));
}

static void peek(void)
{
    iris_journal *journal = OR_NULL(any_journal());
    iris_journal_record *record = OR_NULL(draw_results(sizeof *record));
    CALL(iris_journal_peek(record, journal));
}

const random_call calls_runtime[] = {
    {"iris_journal_record_to", record_to},
    {"iris_journal_replay_from", replay_from},
    {"iris_journal_input", input},
    {"iris_journal_output", output},
    {"iris_journal_end", end},
    {"iris_journal_peek", peek},
    {"iris_order_check", check},
    {"iris_order_write", order_write},
    {"iris_order_read", order_read},
    {"iris_order_of_command", of_command},
    {"iris_runtime_init", init},
    {"iris_runtime_submit", submit},
    {"iris_runtime_renew", renew},
    {"iris_runtime_step", step},
    {"iris_runtime_replay", replay},
    {NULL, NULL},
};
