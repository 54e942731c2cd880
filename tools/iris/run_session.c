#include "run_session.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "complain.h"
#include "console_input.h"
#include "run_session_parts.h"
#include "serial_orders.h"
#include "stop_signal.h"
#include "system.h"

enum { TICK_MS = 20, SERIAL_LEASE_MS = 500, LINE_MAX_BYTES = 200, READING = 7 };

static const int32_t priorities[RUN_SOURCES] = {100, 200, 300};
static const char *const source_names[RUN_SOURCES] = {"script", "serial", "console"};

/* --- what both ways do --- */

void run_session_begin(run_session *s, osiris_pose start)
{
    int32_t at[3] = {start.x_mm, start.y_mm, start.heading};
    const int32_t check = (int32_t)s->body.check;
    s->check = 2166136261u;
    (void)iris_runtime_init(&s->runtime, s->behaviors.table, priorities, RUN_SOURCES, &s->journal, 0);
    (void)iris_journal_output(&s->journal, RUN_FILE, &check, 1);
    (void)iris_journal_input(&s->journal, RUN_START, at, 3);
    start = (osiris_pose){at[0], at[1], iris_angle_wrap(at[2])};
    robot_senses_init(&s->senses, &s->body.plan, start);
    robot_behaviors_init(&s->behaviors, &s->senses);
}

/* One reading, through the journal. */
void run_session_sense(run_session *s, int32_t device, const osiris_raw *raw)
{
    int32_t values[READING] = {device,         (int32_t)raw->validity, (int32_t)raw->time_ms, raw->values[0],
                               raw->values[1], raw->values[2],         raw->values[3]};
    if (s->journal.status == IRIS_OK || s->journal.sink) {
        (void)iris_journal_input(&s->journal, IRIS_JOURNAL_READING, values, READING);
    }
    if (values[0] < 0 || values[0] >= s->body.plan.device_count || values[1] < OSIRIS_NEVER ||
        values[1] > OSIRIS_BROKEN) {
        return;
    }
    const osiris_raw taken = {s->body.plan.devices[values[0]].kind,
                              (osiris_validity)values[1],
                              (uint32_t)values[2],
                              {values[3], values[4], values[5], values[6]}};
    robot_senses_take(&s->senses, values[0], &taken);
}

static void mix(uint32_t *check, uint32_t value)
{
    for (int k = 0; k < 32; k += 8) {
        *check = (*check ^ (value >> k & 255)) * 16777619u;
    }
}

int run_session_note_command(run_session *s)
{
    const iris_motion motion = s->runtime.motion;
    const int is_new = motion.speed_mms != s->command.speed_mms || motion.turn_rate != s->command.turn_rate;
    if (is_new) {
        mix(&s->check, s->now_ms);
        mix(&s->check, (uint32_t)motion.speed_mms);
        mix(&s->check, (uint32_t)motion.turn_rate);
        s->command = motion;
        s->commands++;
    }
    return is_new;
}

static void print_event(const run_event *e)
{
    const iris_event *event = &e->event;
    printf("%9.3f s  ", e->at_ms / 1000.0);
    if (event->kind == IRIS_EVENT_FAILED) {
        printf("failed: %s, %s\n", iris_order_name(event->x), iris_status_text((iris_status)event->y));
    } else if (event->kind == IRIS_EVENT_EXPIRED) {
        printf("expired: %s of %s; all stops\n", iris_order_name(event->y),
               source_names[event->x % RUN_SOURCES]);
    } else if (event->kind == IRIS_EVENT_STOPPED) {
        printf("stopped by %s\n", source_names[event->x % RUN_SOURCES]);
    } else if (event->kind == IRIS_EVENT_BATTERY_LOW) {
        printf("battery low: %d permil\n", (int)event->x);
    } else {
        printf("%s at (%d, %d)\n", iris_event_name((int32_t)event->kind), (int)event->x, (int)event->y);
    }
}

/* 1 when one of them says that all stands at once. */
int run_session_take_events(run_session *s, uint32_t now_ms)
{
    iris_event event;
    int stands = 0;
    while (iris_runtime_event_next(&event, &s->runtime)) {
        run_event *more = realloc(s->events, (size_t)(s->event_count + 1) * sizeof *more);
        if (!more) {
            s->has_failed = 1;
            return stands;
        }
        s->events = more;
        s->events[s->event_count] = (run_event){now_ms, event};
        if (!s->is_quiet) {
            print_event(&s->events[s->event_count]);
        }
        s->event_count++;
        stands |= event.kind == IRIS_EVENT_STOPPED || event.kind == IRIS_EVENT_EXPIRED;
    }
    return stands;
}

void run_session_walk(run_session *s, osiris_pose pose)
{
    if (s->path_count % 1024 == 0) {
        osiris_pose *more = realloc(s->path, (size_t)(s->path_count + 1024) * sizeof *more);
        if (!more) {
            s->has_failed = 1;
            return;
        }
        s->path = more;
    }
    s->path[s->path_count++] = pose;
}

void run_session_free(run_session *s)
{
    free(s->events);
    free(s->path);
}

/* --- live --- */

typedef struct {
    char line[LINE_MAX_BYTES];
    size_t length;
    int is_open, is_long;
} console;

static iris_status write_record(void *context, const char *line, size_t bytes)
{
    return fwrite(line, 1, bytes, context) == bytes && fflush(context) == 0 ? IRIS_OK : IRIS_ERR_IO;
}

static void submit(run_session *s, int32_t source, const iris_order *order, int32_t lease_ms)
{
    char text[IRIS_ORDER_TEXT_BYTES];
    size_t length = 0;
    const iris_status status = iris_runtime_submit(&s->runtime, source, order, lease_ms, s->now_ms);
    s->orders += status == IRIS_OK;
    (void)run_session_note_command(s); /* a STOP is one at once */
    if (status != IRIS_OK) {
        (void)iris_order_write(text, sizeof text, &length, order);
        complain(text, "%s",
                 status == IRIS_ERR_FULL ? "refused: a stop holds, or too many orders wait"
                                         : iris_status_text(status));
    }
}

/* An order that ends by itself needs nobody to stay. */
static int32_t lease_of(const run_session *s, const iris_order *order)
{
    return iris_order_ends(order->verb) || order->verb == IRIS_ORDER_STOP ? 0 : s->lease_ms;
}

static void take_line(run_session *s, console *c)
{
    iris_order order;
    int32_t column = 0;
    const iris_status status =
        c->is_long ? IRIS_ERR_DATA : iris_order_read(&order, &column, c->line, c->length);
    (void)iris_runtime_renew(&s->runtime, RUN_CONSOLE, s->now_ms);
    if (status == IRIS_OK) {
        submit(s, RUN_CONSOLE, &order, lease_of(s, &order));
    } else if (status != IRIS_ERR_END) {
        complain("console",
                 "%.60s: column %d: expected an order, such as go 500, turn 90, drive 200 30, or stop",
                 c->is_long ? "a long line" : c->line, (int)column);
    }
    memset(c, 0, offsetof(console, is_open));
    c->is_long = 0;
}

static void take_console(run_session *s, console *c)
{
    char bytes[256];
    int count = 0;
    while (c->is_open && (count = console_input(bytes, sizeof bytes)) > 0) {
        for (int i = 0; i < count; i++) {
            if (bytes[i] == '\n') {
                take_line(s, c);
            } else if (c->length < sizeof c->line - 1) {
                c->line[c->length++] = bytes[i];
            } else {
                c->is_long = 1;
            }
        }
    }
    if (c->is_open && count < 0) {
        c->is_open = 0;
        if (c->length > 0) {
            take_line(s, c);
        }
    }
}

/* Nobody is there any more to end what has no end of its own. */
static void end_for_console(run_session *s, const console *c)
{
    const iris_order stop = {IRIS_ORDER_STOP, 0, 0};
    const iris_order_verb drives = s->runtime.driving.order.verb;
    if (s->has_console && !c->is_open && !s->script && !s->has_serial && drives != IRIS_ORDER_NONE &&
        !iris_order_ends(drives) && s->runtime.waiting_count == 0) {
        submit(s, RUN_CONSOLE, &stop, 0);
    }
}

static void take_serial(run_session *s)
{
    iris_command command;
    iris_order order;
    const osiris_drive_config *drive = &s->body.plan.drive;
    if (s->has_serial && serial_orders_next(&command, s->now_ms) &&
        iris_order_of_command(&order, &command, drive->speed_max_mms, drive->turn_rate_max) == IRIS_OK) {
        submit(s, RUN_SERIAL, &order, SERIAL_LEASE_MS);
    }
}

static void take_readings(run_session *s)
{
    for (int32_t i = 0; i < s->body.plan.device_count; i++) {
        osiris_raw raw;
        if (run_body_sense(&s->body, &raw, i, s->now_ms)) {
            run_session_sense(s, i, &raw);
        }
    }
    if (robot_bumps_now(&s->senses)) {
        const iris_event bumped = {IRIS_EVENT_BUMPED, s->senses.pose.x_mm, s->senses.pose.y_mm};
        iris_runtime_tell(&s->runtime, &bumped);
    }
    if (robot_gets_low_now(&s->senses)) {
        const iris_event low = {IRIS_EVENT_BATTERY_LOW, robot_battery_permil(&s->senses), 0};
        iris_runtime_tell(&s->runtime, &low);
    }
}

static void step(run_session *s)
{
    osiris_pose pose;
    run_body_pass(&s->body, s->now_ms);
    take_readings(s);
    robot_behaviors_sense(&s->behaviors);
    (void)iris_runtime_step(&s->runtime, s->now_ms);
    (void)run_session_note_command(s);
    if (run_session_take_events(s, s->now_ms)) {
        run_body_halt(&s->body, s->now_ms);
    }
    run_body_drive(&s->body, s->runtime.motion.speed_mms, s->runtime.motion.turn_rate, TICK_MS, s->now_ms);
    run_session_walk(s, run_body_pose(&s->body, &pose) ? pose : s->senses.pose);
}

/* In its own time. */
static void wait_for(const run_session *s, int64_t began_us)
{
    if (s->speed > 0) {
        const int64_t due = began_us + (int64_t)(s->now_ms * 1000.0 / s->speed);
        while (system_clock_us() < due && !stop_signal_came()) {
            const int64_t run_us = s->body.is_real ? real_robot_run(system_clock_us() - began_us) : 10000;
            if (run_us >= 2000) {
                system_sleep_ms(due - system_clock_us() > 2000 ? 2 : 1);
            }
        }
    }
}

static void stop_for_good(run_session *s)
{
    const iris_order stop = {IRIS_ORDER_STOP, 0, 0};
    submit(s, RUN_CONSOLE, &stop, 0);
    step(s);
}

int run_session_live(run_session *s)
{
    console c = {.is_open = s->has_console};
    int32_t next = 0;
    const int32_t lines = s->script ? s->script->count : 0;
    const int64_t began_us = system_clock_us();
    if (s->record) {
        (void)iris_journal_record_to(&s->journal, write_record, s->record);
    } else {
        s->journal = (iris_journal){.status = IRIS_ERR_END, .sink = write_record};
    }
    run_session_begin(s, run_body_start(&s->body));
    stop_signal_catch();
    for (;; s->now_ms += TICK_MS) {
        wait_for(s, began_us);
        for (; next < lines && s->script->lines[next].at_ms <= s->now_ms; next++) {
            submit(s, RUN_SCRIPT, &s->script->lines[next].order, lease_of(s, &s->script->lines[next].order));
        }
        take_serial(s);
        take_console(s, &c);
        end_for_console(s, &c);
        if (stop_signal_came() || s->now_ms >= s->limit_ms) {
            stop_for_good(s);
            break;
        }
        step(s);
        const int stands = s->body.drive.velocity.ahead_q16 == 0 && s->body.drive.velocity.turn_q8 == 0;
        if (next == lines && !c.is_open && !s->has_serial && stands && !iris_runtime_is_busy(&s->runtime)) {
            break;
        }
    }
    if (s->record && iris_journal_end(&s->journal) != IRIS_OK) {
        complain("--journal", "%s", strerror(errno));
        s->has_failed = 1;
    }
    return s->has_failed ? EXIT_BAD_DATA : EXIT_DONE;
}
