#include "borg_robot.h"

#include <poll.h>
#include <stdio.h>
#include <string.h>

#include "../complain.h"
#include "../stop_signal.h"
#include "../system.h"
#include "../team_body.h"
#include "../team_world.h"
#include "iris/borg/member.h"

#define STEP_MS  20   /* of the robot's time, from one turn of its loop to the next */
#define BLIND_MS 1000 /* a robot whose program does not answer for so long stands still */
#define STILL_MS                                                                                             \
    4000 /* it has stood for so long with its time out, and the others have what it sent: it is over */
#define APART_MM  500 /* from start to start where the world has none */
#define PLACES_MS 500 /* from one report to the next while its state stays */

typedef struct {
    const borg_robot_task *task;
    const borg_run_wishes *wishes;
    team_link *link;
    team_world world;
    team_body body;
    iris_runtime runtime;
    borg_member member;
    borg_bidder bidders[BORG_MEMBER_BIDDERS_MAX];
    borg_sender senders[BORG_POST_SENDERS_MAX];
    const char *state;
    borg_robot_report report;
    int64_t begun_ms; /* by the system's clock */
    uint32_t now_ms;  /* the robot's time */
    uint32_t moved_ms, told_ms;
    int was_away;
} robot;

/* --- tasks --- */

size_t borg_robot_task_write(uint8_t bytes[BORG_KEPT_BYTES(BORG_CHUNK_BYTES_MAX)],
                             const borg_robot_task *task)
{
    const int32_t before = task->index - (task->unit - 1);
    for (int i = 0; i < 4; i++) {
        bytes[i] = (uint8_t)(task->script >> 8 * i);
        bytes[4 + i] = (uint8_t)((uint32_t)before >> 8 * i);
    }
    memcpy(bytes + 8, task->chunk, task->bytes);
    return BORG_KEPT_BYTES(task->bytes);
}

int borg_robot_task_read(borg_robot_task *task, const uint8_t *bytes, size_t count, int32_t unit)
{
    uint32_t numbers[2] = {0, 0};
    memset(task, 0, sizeof *task);
    if (count < BORG_KEPT_BYTES(BORG_CHUNK_HEADER_BYTES) || count > BORG_KEPT_BYTES(BORG_CHUNK_BYTES_MAX)) {
        return 0;
    }
    for (int i = 0; i < 8; i++) {
        numbers[i / 4] |= (uint32_t)bytes[i] << 8 * (i % 4);
    }
    task->script = numbers[0];
    task->index = (int32_t)(numbers[1] & 0xffff) + unit - 1;
    task->unit = unit;
    task->bytes = count - 8;
    memcpy(task->chunk, bytes + 8, task->bytes);
    return borg_chunk_check(task->chunk, task->bytes) == IRIS_OK && unit <= borg_chunk_units(task->chunk);
}

/* --- what is told --- */

static void add_state(robot *r, const char *state)
{
    const size_t length = strlen(r->report.states);
    r->state = state;
    snprintf(r->report.states + length, sizeof r->report.states - length, "%s%s", length > 0 ? " " : "",
             state);
}

static void report(robot *r, void (*told)(void *user, const borg_robot_report *report), void *user)
{
    const osiris_pose pose = r->body.senses.pose;
    const char *state = borg_member_state(&r->member);
    const int changed = !r->state || strcmp(state, r->state) != 0;
    if (changed) {
        add_state(r, state);
    }
    if (changed || r->report.ended || r->now_ms - r->told_ms >= PLACES_MS) {
        r->told_ms = r->now_ms;
        r->report.at_ms = (int32_t)r->now_ms;
        r->report.changed = changed;
        r->report.x_mm = pose.x_mm;
        r->report.y_mm = pose.y_mm;
        told(user, &r->report);
    }
}

/* A network that is away is said once each time. */
static void look_at_network(robot *r, iris_status status)
{
    const int is_away = status == IRIS_ERR_IO;
    char who[32];
    if (is_away != r->was_away) {
        snprintf(who, sizeof who, "robot %d/%d", (int)r->report.ref, (int)r->report.unit);
        if (is_away) {
            complain(who, "its network is away, and it goes on alone: %s",
                     r->link->option.is_mqtt ? iris_mqtt_problem(&r->link->mqtt)
                                             : iris_udp_error(&r->link->udp));
        } else {
            complain(who, "its network is back");
        }
    }
    r->was_away = is_away;
}

/* --- time --- */

/* The body moves on as it was told while its program did something else, up to a second. */
static void move(robot *r, uint32_t now_ms)
{
    const uint32_t since = now_ms - r->now_ms;
    static const iris_motion standing = {0, 0, 0};
    for (uint32_t passed = 0; passed < since;) {
        passed = since - passed > STEP_MS ? passed + STEP_MS : since;
        const int is_blind = passed > BLIND_MS;
        passed = is_blind ? since : passed;
        team_body_step(&r->body, is_blind ? &standing : &r->runtime.motion, r->now_ms + passed);
    }
    r->now_ms = now_ms;
}

static void think(robot *r)
{
    iris_event event;
    iris_order order;
    (void)iris_runtime_step(&r->runtime, r->now_ms);
    while (iris_runtime_event_next(&event, &r->runtime)) {
        (void)borg_member_event(&r->member, &event);
    }
    (void)borg_member_place(&r->member, r->body.senses.pose.x_mm, r->body.senses.pose.y_mm,
                            robot_battery_permil(&r->body.senses) / 10);
    look_at_network(r, borg_member_step(&r->member, &r->link->transport, r->now_ms));
    while (borg_member_order_next(&r->member, &order)) {
        (void)iris_runtime_submit(&r->runtime, 0, &order, 0, r->now_ms);
    }
    if (iris_runtime_is_busy(&r->runtime) || borg_member_clock_runs(&r->member)) {
        r->moved_ms = r->now_ms;
    }
}

/* --- a robot --- */

static int is_joined(const team_link *link)
{
    return !link->option.is_mqtt || link->mqtt.connected;
}

/* The mission of a robot begins when it hears the others: a broker answers first. */
static int await_network(robot *r)
{
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
    size_t count;
    int said = 0;
    const int64_t begun = system_clock_ms();
    while (!is_joined(r->link) && !stop_signal_came()) {
        (void)r->link->transport.receive(r->link->transport.context, bytes, sizeof bytes, &count);
        if (!said && system_clock_ms() - begun > 3000) {
            complain("--transport", "%s: waiting for it", iris_mqtt_problem(&r->link->mqtt));
            said = 1;
        }
        (void)poll(NULL, 0, 5);
    }
    return is_joined(r->link);
}

/* Of names with commas between the one that is this robot's; null: none was named. */
static const char *robot_file(char *name, size_t capacity, const char *names, int32_t index)
{
    int32_t count = 1;
    if (!names) {
        return NULL;
    }
    for (const char *c = names; *c; c++) {
        count += *c == ',';
    }
    for (int32_t i = index % count; i > 0; i--) {
        names = strchr(names, ',') + 1;
    }
    snprintf(name, capacity, "%.*s", (int)strcspn(names, ","), names);
    return name;
}

static int make(robot *r)
{
    const borg_robot_task *task = r->task;
    const int32_t priority = 0;
    const uint32_t seed = (uint32_t)r->wishes->seed * 977u + (uint32_t)task->index;
    const borg_member_config config = {.chunk = task->chunk,
                                       .bytes = task->bytes,
                                       .script = task->script,
                                       .incarnation = task->incarnation,
                                       .unit = (uint8_t)task->unit,
                                       .bidders = r->bidders,
                                       .bidder_count = BORG_MEMBER_BIDDERS_MAX,
                                       .senders = r->senders,
                                       .sender_count = BORG_POST_SENDERS_MAX};
    char file[1024];
    if (!team_world_read(&r->world, r->wishes->world) ||
        !team_body_read(&r->body, robot_file(file, sizeof file, r->wishes->robots, task->index))) {
        return 0;
    }
    const osiris_world *world = &r->world.is;
    const osiris_pose start = task->index < world->start_count
                                  ? world->starts[task->index]
                                  : (osiris_pose){(task->index - world->start_count) * APART_MM, 0, 0};
    if (team_body_place(&r->body, world, start, seed) != IRIS_OK) {
        complain(r->wishes->world, "robot %d cannot start there", (int)task->index + 1);
        return 0;
    }
    if (iris_runtime_init(&r->runtime, r->body.behaviors.table, &priority, 1, NULL, 0) != IRIS_OK ||
        borg_member_init(&r->member, &config, 0) != IRIS_OK) {
        complain(r->wishes->script, "the chunk of line %d needs more than a robot has", (int)r->report.ref);
        return 0;
    }
    return borg_member_start(&r->member) == IRIS_OK;
}

int borg_robot_run(const borg_robot_task *task, const borg_run_wishes *wishes, team_link *link,
                   void (*told)(void *user, const borg_robot_report *report), void *user)
{
    static robot r;
    r.task = task;
    r.wishes = wishes;
    r.link = link;
    r.report.ref = borg_chunk_ref(task->chunk);
    r.report.unit = task->unit;
    if (!make(&r)) {
        return EXIT_BAD_DATA;
    }
    if (!await_network(&r)) {
        return EXIT_DONE;
    }
    r.begun_ms = system_clock_ms();
    while (r.now_ms - r.moved_ms < STILL_MS && !stop_signal_came()) {
        const int64_t since = (system_clock_us() / 1000 - r.begun_ms) * wishes->speed;
        if ((uint32_t)since - r.now_ms >= STEP_MS) {
            move(&r, (uint32_t)since);
            think(&r);
            report(&r, told, user);
        }
        (void)poll(NULL, 0, 1 + STEP_MS / 2 / wishes->speed);
    }
    r.report.ended = 1;
    report(&r, told, user);
    return EXIT_DONE;
}
