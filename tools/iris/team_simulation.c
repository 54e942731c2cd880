#include "team_simulation.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "complain.h"
#include "iris/borg/member.h"
#include "progress.h"
#include "team_body.h"
#include "team_network.h"

#define PLACE_MS   100  /* from one recorded place to the next */
#define STILL_MS   6000 /* all stood for so long, and nothing is under way: it is over */
#define HEARD      32   /* signals that came last */
#define BODY_SIDES 8
#define APART_MM   500 /* from start to start where the world has none */

typedef struct {
    int32_t index;
    struct simulation *simulation;
    team_body body;
    iris_runtime runtime;
    borg_member member;
    borg_bidder bidders[BORG_MEMBER_BIDDERS_MAX];
    borg_sender senders[TEAM_ENDS_MAX];
    borg_transport transport;
    const char *state;
    uint32_t still_since_ms;
    osiris_world world; /* as this robot meets it: with the others in it */
    osiris_segment *walls;
    uint32_t won, lost; /* elections */
    uint64_t heard[HEARD];
    int32_t heard_count;
    int32_t clock_runs;
} team_machine;

typedef struct simulation {
    const team_setup *setup;
    team_record *record;
    team_machine *machines;
    osiris_segment *walls; /* of all */
    int32_t machine_count;
    team_network network;
    uint32_t now_ms;
    int out_of_memory;
} simulation;

/* --- signals --- */

static void note(team_machine *m, borg_signal signal)
{
    simulation *s = m->simulation;
    const team_signal one = {s->now_ms, m->index, signal};
    s->out_of_memory |= !team_record_signal(s->record, one);
}

static void note_own(team_machine *m, borg_signal_kind kind, int32_t x, int32_t y)
{
    note(m, (borg_signal){(uint8_t)kind, 0, 0, x, y});
}

/* A signal is sent again and again: once is enough. */
static void signal_came(void *user, const borg_message *message)
{
    team_machine *m = user;
    const uint64_t number =
        (uint64_t)message->from.ref << 32 | (uint64_t)message->from.unit << 16 | (uint64_t)message->sequence;
    for (int32_t i = 0; i < HEARD; i++) {
        if (m->heard[i] == number) {
            return;
        }
    }
    m->heard[m->heard_count++ % HEARD] = number;
    note(m, message->is.signal);
}

/* What a robot's program tells its machine. */
static void note_event(team_machine *m, const iris_event *event)
{
    static const int16_t kinds[IRIS_EVENT_KINDS] = {
        [IRIS_EVENT_NONE] = -1,
        [IRIS_EVENT_OBJECT_DETECTED] = BORG_OBJ_DETECT_TRUE,
        [IRIS_EVENT_OBJECT_LOST] = BORG_OBJ_DETECT_FALSE,
        [IRIS_EVENT_REACHED] = BORG_REACHED,
        [IRIS_EVENT_LINE_END] = BORG_LINE_END,
        [IRIS_EVENT_BUMPED] = BORG_BUMPED,
        [IRIS_EVENT_BATTERY_LOW] = BORG_BATTERY_LOW,
        [IRIS_EVENT_FAILED] = -1,
        [IRIS_EVENT_STOPPED] = BORG_STOPPED,
        [IRIS_EVENT_EXPIRED] = -1,
    };
    if (kinds[event->kind] >= 0) {
        note_own(m, (borg_signal_kind)kinds[event->kind], event->x, event->y);
    }
}

/* What its machine told itself since the last step. */
static void note_machine(team_machine *m)
{
    const borg_machine *machine = &m->member.machine;
    uint32_t won = 0, lost = 0;
    for (int32_t i = 0; i < m->member.contest_count; i++) {
        won |= (uint32_t)(m->member.contests[i].told == 1) << i;
        lost |= (uint32_t)(m->member.contests[i].told == 2) << i;
    }
    if (m->clock_runs && !machine->clock_runs) {
        note_own(m, BORG_TIME_OUT, 0, 0);
    }
    if (won & ~m->won) {
        note_own(m, BORG_VOTE_WIN, 0, 0);
    }
    if (lost & ~m->lost) {
        note_own(m, BORG_VOTE_LOST, 0, 0);
    }
    m->won = won;
    m->lost = lost;
    m->clock_runs = machine->clock_runs;
}

static void note_state(team_machine *m)
{
    simulation *s = m->simulation;
    const char *state = borg_member_state(&m->member);
    if (state != m->state) {
        m->state = state;
        s->out_of_memory |= !team_record_change(s->record, (team_change){s->now_ms, m->index, state});
    }
}

/* --- time --- */

/* A robot's body, as the walls of a box with BODY_SIDES sides. */
static void put_body(osiris_segment *walls, const team_body *body)
{
    const osiris_pose middle =
        osiris_pose_after(osiris_track_pose(&body->body.track), (osiris_pose){body->plan.ahead_mm, 0, 0});
    const int32_t radius = robot_radius_mm(&body->senses);
    for (int32_t k = 0; k < BODY_SIDES; k++) {
        osiris_segment *wall = &walls[k];
        const int32_t turn = 65536 / BODY_SIDES;
        const iris_angle from = iris_angle_wrap(turn * k), to = iris_angle_wrap(turn * (k + 1));
        wall->x0_mm = middle.x_mm + (int32_t)(((int64_t)iris_cos_q30(from) * radius) >> 30);
        wall->y0_mm = middle.y_mm + (int32_t)(((int64_t)iris_sin_q30(from) * radius) >> 30);
        wall->x1_mm = middle.x_mm + (int32_t)(((int64_t)iris_cos_q30(to) * radius) >> 30);
        wall->y1_mm = middle.y_mm + (int32_t)(((int64_t)iris_sin_q30(to) * radius) >> 30);
    }
}

/* The others stand in the way of each one where they are now. */
static void meet(simulation *s)
{
    for (int32_t i = 0; i < s->machine_count; i++) {
        osiris_segment *to = s->machines[i].walls + s->setup->world->wall_count;
        for (int32_t k = 0; k < s->machine_count; k++) {
            if (k != i) {
                put_body(to, &s->machines[k].body);
                to += BODY_SIDES;
            }
        }
    }
}

static void let_think(team_machine *m)
{
    simulation *s = m->simulation;
    iris_event event;
    iris_order order;
    (void)iris_runtime_step(&m->runtime, s->now_ms);
    while (iris_runtime_event_next(&event, &m->runtime)) {
        note_event(m, &event);
        (void)borg_member_event(&m->member, &event);
    }
    (void)borg_member_place(&m->member, m->body.senses.pose.x_mm, m->body.senses.pose.y_mm,
                            robot_battery_permil(&m->body.senses) / 10);
    (void)borg_member_step(&m->member, &m->transport, s->now_ms);
    while (borg_member_order_next(&m->member, &order)) {
        (void)iris_runtime_submit(&m->runtime, 0, &order, 0, s->now_ms);
    }
    note_machine(m);
    note_state(m);
}

static void step(simulation *s)
{
    meet(s);
    for (int32_t i = 0; i < s->record->robot_count; i++) {
        team_machine *m = &s->machines[i];
        team_body_step(&m->body, &m->runtime.motion, s->now_ms);
        if (iris_runtime_is_busy(&m->runtime)) {
            m->still_since_ms = s->now_ms;
        }
    }
    for (int32_t i = 0; i < s->record->robot_count; i++) {
        let_think(&s->machines[i]);
    }
}

static void record_places(simulation *s)
{
    for (int32_t i = 0; i < s->record->robot_count; i++) {
        team_robot *robot = &s->record->robots[i];
        const osiris_pose pose = osiris_track_pose(&s->machines[i].body.body.track);
        s->out_of_memory |= !team_record_place(robot, (team_place){pose.x_mm, pose.y_mm});
        robot->heading_deg = (int32_t)(pose.heading * 360L / 65536);
        robot->state = s->machines[i].state;
    }
}

/* All have nothing to do for so long that nobody will tell them anything more. */
static int is_over(const simulation *s)
{
    for (int32_t i = 0; i < s->record->robot_count; i++) {
        if (s->now_ms - s->machines[i].still_since_ms < STILL_MS) {
            return 0;
        }
    }
    return 1;
}

/* All that begins before a time-out has ended at the next one. */
static uint32_t longest_ms(const simulation *s)
{
    const team_script *script = s->setup->script;
    uint32_t longest = 0;
    for (int32_t g = 0; g < script->count; g++) {
        const uint32_t seconds = (uint32_t)borg_chunk_timeout_s(script->chunks[g]);
        longest = seconds > longest ? seconds : longest;
    }
    return (longest < TEAM_TIME_MAX ? 2 * longest : 2 * TEAM_TIME_MAX) * 1000 + 2 * STILL_MS;
}

static int run(simulation *s)
{
    const uint32_t most = longest_ms(s);
    for (s->now_ms = 0; s->now_ms <= most && !s->out_of_memory; s->now_ms += TEAM_STEP_MS) {
        if (s->now_ms > 0) {
            step(s);
        }
        if (s->now_ms % PLACE_MS == 0) {
            record_places(s);
        }
        if (s->now_ms % 1000 == 0) {
            progress_show("swarm", (int)(s->now_ms / 1000), 0, "simulated seconds");
        }
        if (is_over(s)) {
            break;
        }
    }
    progress_clear();
    s->record->time_ms = s->now_ms;
    if (s->out_of_memory) {
        complain(NULL, "not enough memory");
    }
    return !s->out_of_memory;
}

/* --- the team --- */

static osiris_pose start_of(const simulation *s, int32_t robot)
{
    const osiris_world *world = s->setup->world;
    return robot < world->start_count ? world->starts[robot]
                                      : (osiris_pose){(robot - world->start_count) * APART_MM, 0, 0};
}

/* The name of its robot file, in static storage; null: none was named. */
static const char *robot_file(const simulation *s, int32_t robot)
{
    static char name[1024];
    const char *at = s->setup->robots;
    int32_t count = 1;
    if (!at) {
        return NULL;
    }
    for (const char *c = at; *c; c++) {
        count += *c == ',';
    }
    for (int32_t i = robot % count; i > 0; i--) {
        at = strchr(at, ',') + 1;
    }
    snprintf(name, sizeof name, "%.*s", (int)strcspn(at, ","), at);
    return name;
}

static int make_machine(simulation *s, int32_t robot, int32_t group, int32_t unit)
{
    team_machine *m = &s->machines[robot];
    const team_script *script = s->setup->script;
    const int32_t priority = 0;
    const uint32_t seed = s->setup->seed * 977u + (uint32_t)robot;
    const borg_member_config config = {
        script->chunks[group],   script->bytes[group], script->number, 1, (uint8_t)unit, m->bidders,
        BORG_MEMBER_BIDDERS_MAX, m->senders,           TEAM_ENDS_MAX};
    m->index = robot;
    m->simulation = s;
    s->record->robots[robot] = (team_robot){.ref = borg_chunk_ref(script->chunks[group]), .unit = unit};
    m->world = *s->setup->world;
    m->world.walls = m->walls;
    if (!team_body_read(&m->body, robot_file(s, robot)) ||
        team_body_place(&m->body, &m->world, start_of(s, robot), seed) != IRIS_OK) {
        return 0;
    }
    m->world.wall_count += BODY_SIDES * (s->machine_count - 1);
    m->transport = team_network_transport(&s->network, robot, signal_came, m);
    int good = iris_runtime_init(&m->runtime, m->body.behaviors.table, &priority, 1, NULL, 0) == IRIS_OK &&
               borg_member_init(&m->member, &config, 0) == IRIS_OK;
    if (good) {
        (void)borg_member_start(&m->member);
        note_own(m, BORG_START, 0, 0);
    }
    return good;
}

static int make_walls(simulation *s)
{
    const size_t own = (size_t)s->setup->world->wall_count;
    const size_t all = own + BODY_SIDES * (size_t)s->machine_count;
    s->walls = calloc(all * (size_t)s->machine_count, sizeof *s->walls);
    for (int32_t i = 0; s->walls && i < s->machine_count; i++) {
        s->machines[i].walls = s->walls + all * (size_t)i;
        if (own > 0) {
            memcpy(s->machines[i].walls, s->setup->world->walls, own * sizeof *s->walls);
        }
    }
    return s->walls != NULL;
}

static int make_team(simulation *s)
{
    const team_script *script = s->setup->script;
    int32_t count = 0;
    for (int32_t g = 0; g < script->count; g++) {
        count += borg_chunk_units(script->chunks[g]);
    }
    if (count < 1 || count > TEAM_ENDS_MAX) {
        complain(NULL, "%d robots: 1 to %d can be simulated", (int)count, TEAM_ENDS_MAX);
        return 0;
    }
    s->machine_count = count;
    s->machines = calloc((size_t)count, sizeof *s->machines);
    s->record->robots = calloc((size_t)count, sizeof *s->record->robots);
    if (!s->machines || !s->record->robots || !make_walls(s)) {
        complain(NULL, "not enough memory");
        return 0;
    }
    team_network_init(&s->network, count, s->setup->loss_percent, s->setup->seed);
    for (int32_t g = 0; g < script->count; g++) {
        for (int32_t unit = 1; unit <= borg_chunk_units(script->chunks[g]); unit++) {
            if (!make_machine(s, s->record->robot_count, g, unit)) {
                return 0;
            }
            s->record->robot_count++;
        }
    }
    return 1;
}

int team_simulate(team_record *record, const team_setup *setup)
{
    static simulation s;
    memset(&s, 0, sizeof s);
    s.setup = setup;
    s.record = record;
    record->step_ms = PLACE_MS;
    const int good = make_team(&s) && run(&s);
    free(s.machines);
    free(s.walls);
    return good;
}
