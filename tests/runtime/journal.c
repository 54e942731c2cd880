#include "iris/runtime/journal.h"

#include "iris/runtime/runtime.h"
#include "test.h"

enum { TEXT_MAX = 60000, STEPS = 400 };

typedef struct {
    char text[TEXT_MAX];
    size_t length;
    int32_t lines, most_lines;
} tape;

static iris_status keep(void *context, const char *line, size_t bytes)
{
    tape *t = context;
    if (t->lines == t->most_lines) {
        return IRIS_ERR_IO;
    }
    assert_true(bytes <= IRIS_JOURNAL_LINE_BYTES && t->length + bytes <= TEXT_MAX && line[bytes - 1] == '\n');
    memcpy(t->text + t->length, line, bytes);
    t->length += bytes;
    t->lines++;
    return IRIS_OK;
}

/* The same on every run: a linear congruence, its better bits. */
static uint32_t random_number(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

/* A robot that does what its sensor says, which is noise: only the journal can tell it again. */
typedef struct {
    iris_journal *journal;
    uint32_t noise;
    int32_t deaf; /* replaying: adds this */
} robot;

static iris_status sense(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event)
{
    robot *r = context;
    int32_t values[3] = {0};
    for (int i = 0; i < 3; i++) {
        values[i] = (int32_t)(random_number(&r->noise)) - (1 << 23);
    }
    (void)now_ms;
    (void)iris_journal_input(r->journal, IRIS_JOURNAL_READING, values, 3);
    motion->speed_mms = values[0] % 500 + r->deaf;
    motion->turn_rate = values[1];
    motion->done = values[2] % 7 == 0;
    if (values[2] % 5 == 0) {
        *event = (iris_event){IRIS_EVENT_OBJECT_DETECTED, values[1], values[2]};
    }
    return values[2] % 31 == 0 ? IRIS_ERR_IO : IRIS_OK;
}

typedef struct {
    robot of;
    iris_journal journal;
    iris_behavior behaviors[IRIS_ORDER_VERBS];
    iris_runtime runtime;
    iris_motion motions[STEPS];
    int32_t steps;
} session;

static const int32_t priorities[3] = {1, 2, 3};

static void begin(session *s, uint32_t seed)
{
    s->of = (robot){&s->journal, seed, 0};
    memset(s->behaviors, 0, sizeof s->behaviors);
    for (int i = IRIS_ORDER_GO; i < IRIS_ORDER_RESET_TIME; i++) {
        s->behaviors[i] = (iris_behavior){NULL, i == IRIS_ORDER_DRIVE ? NULL : sense, &s->of};
    }
    s->steps = 0;
    assert_int_equal(iris_runtime_init(&s->runtime, s->behaviors, priorities, 3, &s->journal, 0xFFFFFF00u),
                     IRIS_OK);
}

static void record(session *s, tape *t, int32_t steps)
{
    uint32_t random = 7;
    t->length = 0;
    t->lines = 0;
    assert_int_equal(iris_journal_record_to(&s->journal, keep, t), IRIS_OK);
    begin(s, 12345);
    for (uint32_t now = 0xFFFFFF00u; s->steps < steps; now += 20) {
        const iris_order order = {(iris_order_verb)(1 + random_number(&random) % 11), 0, 0};
        if (random_number(&random) % 4 == 0) {
            (void)iris_runtime_submit(&s->runtime, (int32_t)(random_number(&random) % 3), &order,
                                      (int32_t)(random_number(&random) % 3) * 70, now);
        }
        if (random_number(&random) % 9 == 0) {
            (void)iris_runtime_renew(&s->runtime, (int32_t)(random_number(&random) % 3), now);
        }
        if (random_number(&random) % 19 == 0) {
            const iris_event event = {IRIS_EVENT_BUMPED, (int32_t)now, 0};
            iris_runtime_tell(&s->runtime, &event);
        }
        (void)iris_runtime_step(&s->runtime, now);
        s->motions[s->steps++] = s->runtime.motion;
    }
    (void)iris_journal_end(&s->journal);
}

/* Replays until it does not go on; the status that says why. */
static iris_status replay(session *s, const char *text, size_t bytes, int32_t deaf)
{
    iris_journal_record next;
    iris_status status = IRIS_OK;
    assert_int_equal(iris_journal_replay_from(&s->journal, text, bytes), IRIS_OK);
    begin(s, 999); /* the sensor says something else now */
    s->of.deaf = deaf;
    while (status == IRIS_OK && !s->journal.differs) {
        status = iris_journal_peek(&next, &s->journal);
        if (status == IRIS_OK) {
            assert_int_equal(iris_runtime_replay(&s->runtime, &next), IRIS_OK);
            if (next.kind == IRIS_JOURNAL_STEP) {
                s->motions[s->steps++] = s->runtime.motion;
            }
        }
    }
    return status;
}

static tape recorded, damaged;
static session first, second;

static void a_replay_is_the_same_bit_for_bit(void **state)
{
    (void)state;
    recorded.most_lines = INT32_MAX;
    record(&first, &recorded, STEPS);
    assert_int_equal(first.journal.status, IRIS_ERR_END);
    assert_int_equal(replay(&second, recorded.text, recorded.length, 0), IRIS_ERR_END);
    assert_int_equal(second.journal.differs, 0);
    assert_int_equal(second.journal.line, recorded.lines - 1);
    assert_int_equal(second.steps, STEPS);
    int32_t moved = 0;
    for (int i = 0; i < STEPS; i++) {
        assert_int_equal(first.motions[i].speed_mms, second.motions[i].speed_mms);
        assert_int_equal(first.motions[i].turn_rate, second.motions[i].turn_rate);
        moved += first.motions[i].speed_mms != 0;
    }
    assert_true(moved > STEPS / 10);
    for (int i = 0; i < IRIS_RUNTIME_EVENTS; i++) {
        assert_int_equal(first.runtime.events[i].kind, second.runtime.events[i].kind);
        assert_int_equal(first.runtime.events[i].x, second.runtime.events[i].x);
        assert_int_equal(first.runtime.events[i].y, second.runtime.events[i].y);
    }
    assert_int_equal(iris_journal_end(&second.journal), IRIS_OK);
}

static void what_differs_is_told_by_its_line(void **state)
{
    (void)state;
    recorded.most_lines = INT32_MAX;
    record(&first, &recorded, 50);
    (void)replay(&second, recorded.text, recorded.length, 1);
    assert_true(second.journal.differs > 1);
    const char *line = recorded.text;
    for (int32_t i = 1; i < second.journal.differs; i++) {
        line = strchr(line, '\n') + 1;
    }
    assert_int_equal(*line, IRIS_JOURNAL_MOTION); /* the first one that a behavior makes */
}

/* Any byte changed, any line left out or doubled: found there. */
static void damage_is_found_by_its_line(void **state)
{
    (void)state;
    recorded.most_lines = INT32_MAX;
    record(&first, &recorded, 30);
    int32_t line = 1;
    for (size_t i = 0; i < recorded.length; i++) {
        recorded.text[i] = (char)(recorded.text[i] ^ 1);
        const iris_status status = replay(&second, recorded.text, recorded.length, 0);
        recorded.text[i] = (char)(recorded.text[i] ^ 1);
        assert_true(status == IRIS_ERR_DATA || (i == recorded.length - 1 && status == IRIS_ERR_TRUNCATED));
        assert_int_equal(second.journal.line + 1, line);
        assert_int_equal(second.journal.differs, 0);
        if (recorded.text[i] == '\n') {
            const size_t behind = recorded.length - i - 1;
            const size_t length = (size_t)(strchr(recorded.text + i + 1, '\n') - (recorded.text + i));
            if (behind == 0 || length > behind) {
                break;
            }
            damaged = recorded;
            memmove(damaged.text + i + 1, recorded.text + i + 1 + length, behind - length);
            const iris_status without = replay(&second, damaged.text, recorded.length - length, 0);
            assert_int_equal(without, behind == length ? IRIS_ERR_TRUNCATED : IRIS_ERR_DATA);
            assert_int_equal(second.journal.line, line);
            line++;
        }
    }
    assert_int_equal(line, recorded.lines);
}

static void a_truncated_journal_is_good_up_to_there(void **state)
{
    (void)state;
    recorded.most_lines = INT32_MAX;
    record(&first, &recorded, 30);
    int32_t lines = 0;
    for (size_t i = 0; i < recorded.length; i++) {
        assert_int_equal(replay(&second, recorded.text, i, 0), IRIS_ERR_TRUNCATED);
        assert_int_equal(second.journal.line, lines);
        assert_int_equal(second.journal.differs, 0);
        lines += recorded.text[i] == '\n';
    }
    damaged = recorded;
    damaged.text[recorded.length] = '\n'; /* and nothing may follow the end */
    assert_int_equal(replay(&second, damaged.text, recorded.length + 1, 0), IRIS_ERR_DATA);
}

static void a_sink_that_fails_ends_the_journal_alone(void **state)
{
    (void)state;
    recorded.most_lines = 40;
    record(&first, &recorded, 100);
    assert_int_equal(first.steps, 100);
    assert_int_equal(first.journal.status, IRIS_ERR_IO);
    assert_int_equal(first.journal.line, 40);
    assert_int_equal(replay(&second, recorded.text, recorded.length, 0), IRIS_ERR_TRUNCATED);
    assert_int_equal(second.journal.line, 40);
}

static void lines_are_as_written(void **state)
{
    (void)state;
    iris_journal journal;
    static tape t;
    t = (tape){.most_lines = INT32_MAX};
    const int32_t begins[2] = {1, INT32_MIN};
    int32_t values[IRIS_JOURNAL_VALUES + 1];
    for (int i = 0; i <= IRIS_JOURNAL_VALUES; i++) {
        values[i] = INT32_MIN + i;
    }
    assert_int_equal(iris_journal_record_to(&journal, keep, &t), IRIS_OK);
    assert_int_equal(iris_journal_output(&journal, IRIS_JOURNAL_BEGIN, begins, 2), IRIS_OK);
    /* FNV-1a of "J 1 -2147483648", after G. Fowler, L. C. Noll, K.-P. Vo */
    assert_memory_equal(t.text, "J 1 -2147483648*EA4AAF58\n", 25);
    assert_int_equal(iris_journal_input(&journal, 'R', values, IRIS_JOURNAL_VALUES),
                     IRIS_OK); /* the longest line */
    assert_int_equal(iris_journal_input(&journal, 'R', values, IRIS_JOURNAL_VALUES + 1), IRIS_ERR_RANGE);
    assert_int_equal(iris_journal_input(&journal, 'R', values, -1), IRIS_ERR_RANGE);
    assert_int_equal(iris_journal_input(&journal, 'r', values, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_journal_input(&journal, 'R', NULL, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_journal_input(NULL, 'R', values, 1), IRIS_OK);
    assert_int_equal(iris_journal_end(&journal), IRIS_OK);
    assert_int_equal(iris_journal_input(&journal, 'R', values, 1), IRIS_ERR_END);
    assert_int_equal(t.lines, 3);

    iris_journal_record record;
    assert_int_equal(iris_journal_peek(&record, &journal), IRIS_ERR_ARG);
    assert_int_equal(iris_journal_replay_from(&journal, t.text, t.length), IRIS_OK);
    assert_int_equal(iris_journal_peek(&record, &journal), IRIS_OK);
    assert_int_equal(record.values[1], INT32_MIN);
    assert_int_equal(iris_journal_output(&journal, IRIS_JOURNAL_BEGIN, begins, 2), IRIS_OK);
    int32_t again[IRIS_JOURNAL_VALUES] = {0};
    assert_int_equal(iris_journal_input(&journal, 'R', again, IRIS_JOURNAL_VALUES), IRIS_OK);
    assert_memory_equal(again, values, sizeof again);
    assert_int_equal(iris_journal_end(&journal), IRIS_OK);
    assert_int_equal(iris_journal_peek(&record, &journal), IRIS_ERR_END);
    assert_int_equal(iris_journal_replay_from(NULL, t.text, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_journal_record_to(&journal, NULL, NULL), IRIS_ERR_ARG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_replay_is_the_same_bit_for_bit),
        cmocka_unit_test(what_differs_is_told_by_its_line),
        cmocka_unit_test(damage_is_found_by_its_line),
        cmocka_unit_test(a_truncated_journal_is_good_up_to_there),
        cmocka_unit_test(a_sink_that_fails_ends_the_journal_alone),
        cmocka_unit_test(lines_are_as_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
