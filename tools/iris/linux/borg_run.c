/* iris borg run: the processes of a team. The main one takes the script apart, starts one for each robot, has a broker keep
 * the chunks for those that come late, and gathers what became of all. */
#include "../borg_run.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "../complain.h"
#include "../json.h"
#include "../stop_signal.h"
#include "../system.h"
#include "../team_script.h"
#include "borg_robot.h"
#include "iris/borg/message.h"

#define ROBOTS_MAX  64
#define LOOK_MS     20   /* from one look at the processes to the next */
#define HINT_MS     300  /* after a signal, until the robots are asked to end, too */
#define PATIENCE_MS 5000 /* that they have to end then */

typedef struct {
    pid_t process; /* 0: ended */
    int pipe;      /* its reports; -1: closed */
    int failed;
    borg_robot_report report;
} machine;

typedef struct {
    const borg_run_wishes *wishes;
    team_link_option option;
    team_script script;
    uint32_t number; /* of the script */
    machine machines[ROBOTS_MAX];
    int32_t count;
    team_link link; /* the main process's, for what a broker keeps */
    uint32_t connects;
    int32_t kept; /* groups whose chunks the broker keeps now */
} team;

/* --- what is told --- */

static const char *state_of(const borg_robot_report *report)
{
    const char *last = strrchr(report->states, ' ');
    return last ? last + 1 : report->states;
}

static void write_states(json_writer *json, const char *states)
{
    char copy[BORG_STATES_BYTES], *rest = copy;
    memcpy(copy, states, sizeof copy);
    json_open(json, '[');
    for (char *word = strtok_r(copy, " ", &rest); word; word = strtok_r(NULL, " ", &rest)) {
        json_string(json, word);
    }
    json_close(json, ']');
}

static void write_json(const team *t)
{
    json_writer json = json_to(stdout);
    json_open(&json, '{');
    json_key(&json, "robots");
    json_open(&json, '[');
    for (int32_t i = 0; i < t->count; i++) {
        const borg_robot_report *report = &t->machines[i].report;
        json_open(&json, '{');
        json_key(&json, "unit");
        json_integer(&json, report->unit);
        json_key(&json, "ref");
        json_integer(&json, report->ref);
        json_key(&json, "state");
        json_string(&json, t->machines[i].failed ? "gone" : state_of(report));
        json_key(&json, "states");
        write_states(&json, report->states);
        json_key(&json, "x_mm");
        json_integer(&json, report->x_mm);
        json_key(&json, "y_mm");
        json_integer(&json, report->y_mm);
        json_close(&json, '}');
    }
    json_close(&json, ']');
    json_close(&json, '}');
}

static void write_text(const team *t)
{
    for (int32_t i = 0; i < t->count; i++) {
        const borg_robot_report *report = &t->machines[i].report;
        printf("%d/%d at (%d, %d) mm: %s%s\n", (int)report->ref, (int)report->unit, (int)report->x_mm,
               (int)report->y_mm, report->states, t->machines[i].failed ? ", and gone" : "");
    }
    fflush(stdout);
}

/* A change of a state, when it happens. */
static void tell_change(const team *t, const borg_robot_report *report)
{
    if (!t->wishes->json && report->changed) {
        printf("%.1f s, %d/%d: %s\n", report->at_ms / 1000.0, (int)report->ref, (int)report->unit,
               state_of(report));
        fflush(stdout);
    }
}

static void tell(const team *t)
{
    if (t->wishes->json) {
        write_json(t);
    } else {
        write_text(t);
    }
}

/* --- one robot --- */

static size_t write_will(uint8_t will[BORG_MESSAGE_BYTES], const borg_address *me)
{
    borg_message message;
    memset(&message, 0, sizeof message);
    message.kind = BORG_MESSAGE_DEATH;
    message.from = *me;
    return borg_message_write(will, &message) == IRIS_OK ? BORG_MESSAGE_BYTES : 0;
}

/* A robot in this process, on the network. */
static int run_robot(const team *t, const borg_robot_task *task,
                     void (*told)(void *, const borg_robot_report *), void *user)
{
    static team_link link;
    uint8_t will[BORG_MESSAGE_BYTES];
    const borg_address me = {task->script, borg_chunk_ref(task->chunk), task->incarnation,
                             (uint8_t)task->unit};
    if (!team_link_open(&link, &t->option, will, write_will(will, &me), -1)) {
        return EXIT_BAD_DATA;
    }
    const int code = borg_robot_run(task, t->wishes, &link, told, user);
    team_link_close(&link);
    return code;
}

static void keep_report(void *user, const borg_robot_report *report)
{
    team *t = user;
    t->machines[0].report = *report;
    tell_change(t, report);
}

static void send_report(void *user, const borg_robot_report *report)
{
    const int *pipe = user;
    while (write(*pipe, report, sizeof *report) < 0 && errno == EINTR) {
    }
}

/* The task of a robot by its place among all of the script. */
static borg_robot_task task_of(const team *t, int32_t group, int32_t unit)
{
    borg_robot_task task;
    memset(&task, 0, sizeof task);
    memcpy(task.chunk, t->script.chunks[group], t->script.bytes[group]);
    task.bytes = t->script.bytes[group];
    task.script = t->number;
    task.unit = unit;
    task.incarnation = (uint16_t)time(NULL); /* grows with each start */
    task.index = unit - 1;
    for (int32_t i = 0; i < group; i++) {
        task.index += borg_chunk_units(t->script.chunks[i]);
    }
    return task;
}

/* --- the main process --- */

static int start_robot(team *t, int32_t group, int32_t unit)
{
    machine *m = &t->machines[t->count];
    int ends[2];
    if (pipe(ends) != 0) {
        complain(NULL, "no more robots can be started: %s", strerror(errno));
        return 0;
    }
    m->report.ref = borg_chunk_ref(t->script.chunks[group]);
    m->report.unit = unit;
    const pid_t parent = getpid();
    m->process = fork();
    if (m->process == 0) {
        const borg_robot_task task = task_of(t, group, unit);
        close(ends[0]);
        (void)prctl(PR_SET_PDEATHSIG, SIGTERM);
        _exit(getppid() != parent ? EXIT_BAD_DATA : run_robot(t, &task, send_report, &ends[1]));
    }
    close(ends[1]);
    m->pipe = ends[0];
    if (m->process < 0) {
        m->process = 0;
        complain(NULL, "no more robots can be started: %s", strerror(errno));
        return 0;
    }
    t->count++;
    return 1;
}

static void read_reports(const team *t, machine *m)
{
    struct pollfd look = {m->pipe, POLLIN, 0};
    while (m->pipe >= 0 && poll(&look, 1, 0) > 0) {
        borg_robot_report report;
        const ssize_t got = read(m->pipe, &report, sizeof report);
        if (got == (ssize_t)sizeof report) {
            m->report = report;
            tell_change(t, &report);
        } else if (got >= 0 || errno != EINTR) {
            close(m->pipe);
            m->pipe = -1;
        }
    }
}

/* Looks at all processes; how many are left. */
static int32_t look(team *t)
{
    int32_t left = 0;
    for (int32_t i = 0; i < t->count; i++) {
        machine *m = &t->machines[i];
        int status = 0;
        if (m->process > 0 && waitpid(m->process, &status, WNOHANG) == m->process) {
            m->process = 0;
            m->failed = !WIFEXITED(status) || WEXITSTATUS(status) != EXIT_DONE;
        }
        read_reports(t, m);
        left += m->process > 0;
    }
    return left;
}

/* Has the broker keep all chunks, anew whenever it was away: it may have forgotten them. */
static void keep_chunks(team *t)
{
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX], kept[BORG_KEPT_BYTES(BORG_CHUNK_BYTES_MAX)];
    size_t count = 1;
    if (!t->option.is_mqtt) {
        return;
    }
    while (t->link.transport.receive(t->link.transport.context, bytes, sizeof bytes, &count) == IRIS_OK &&
           count > 0) {
    }
    if (t->link.mqtt.connects != t->connects) {
        t->connects = t->link.mqtt.connects;
        t->kept = 0;
    }
    while (t->kept < t->script.count) {
        const borg_robot_task task = task_of(t, t->kept, 1);
        const size_t length = borg_robot_task_write(kept, &task);
        if (iris_mqtt_keep(&t->link.mqtt, borg_chunk_ref(task.chunk), kept, length) != IRIS_OK) {
            return;
        }
        t->kept++;
    }
}

/* The mission is over: who comes now has nothing to do. */
static void forget_chunks(team *t)
{
    const uint8_t nothing = 0;
    for (int32_t i = 0; t->option.is_mqtt && i < t->script.count; i++) {
        (void)iris_mqtt_keep(&t->link.mqtt, borg_chunk_ref(t->script.chunks[i]), &nothing, 0);
    }
}

static void end_all(team *t, int number)
{
    for (int32_t i = 0; i < t->count; i++) {
        if (t->machines[i].process > 0) {
            (void)kill(t->machines[i].process, number);
        }
    }
}

static int wait_for_all(team *t)
{
    int64_t asked = 0; /* when this process was asked to end; often all of them are */
    int tried = 0;     /* 1: the others were asked to end, 2: they were made to */
    while (look(t) > 0) {
        keep_chunks(t);
        asked = asked == 0 && stop_signal_came() ? system_clock_ms() : asked;
        if (asked != 0 && tried < 2 && system_clock_ms() - asked > (tried == 0 ? HINT_MS : PATIENCE_MS)) {
            end_all(t, tried == 0 ? SIGTERM : SIGKILL);
            tried++;
        }
        (void)poll(NULL, 0, LOOK_MS);
    }
    int code = EXIT_DONE;
    for (int32_t i = 0; i < t->count; i++) {
        code = t->machines[i].failed ? EXIT_BAD_DATA : code;
    }
    return code;
}

/* For robots that are started elsewhere. */
static int serve(team *t)
{
    if (!t->option.is_mqtt) {
        complain("--serve", "only a broker keeps chunks: --transport mqtt://HOST is needed");
        return EXIT_BAD_CALL;
    }
    if (!team_link_open(&t->link, &t->option, NULL, 0, -1)) {
        return EXIT_BAD_DATA;
    }
    while (!stop_signal_came()) {
        keep_chunks(t);
        (void)poll(NULL, 0, LOOK_MS);
    }
    forget_chunks(t);
    team_link_close(&t->link);
    return EXIT_DONE;
}

static int run_team(team *t)
{
    int good = team_link_open(&t->link, &t->option, NULL, 0, -1); /* what is wrong is said once */
    team_link_close(&t->link);
    if (!good) {
        return EXIT_BAD_DATA;
    }
    for (int32_t g = 0; good && g < t->script.count; g++) {
        for (int32_t unit = 1; good && unit <= borg_chunk_units(t->script.chunks[g]); unit++) {
            if (t->count == ROBOTS_MAX) {
                complain(t->wishes->script,
                         "more than %d robots for one machine: start them by --ref and --unit", ROBOTS_MAX);
                good = 0;
            } else {
                good = start_robot(t, g, unit);
            }
        }
    }
    if (!good || !team_link_open(&t->link, &t->option, NULL, 0, -1)) {
        good = 0;
        end_all(t, SIGTERM);
    }
    const int code = wait_for_all(t);
    forget_chunks(t);
    team_link_close(&t->link);
    if (good) {
        tell(t);
    }
    return good ? code : EXIT_BAD_DATA;
}

/* --- one robot alone --- */

static int find_task(borg_robot_task *task, const team *t)
{
    for (int32_t g = 0; g < t->script.count; g++) {
        const uint8_t *chunk = t->script.chunks[g];
        if (borg_chunk_ref(chunk) == t->wishes->ref && t->wishes->unit <= borg_chunk_units(chunk)) {
            *task = task_of(t, g, t->wishes->unit);
            return 1;
        }
    }
    complain(t->wishes->script, "there is no unit %d of line %d", (int)t->wishes->unit, (int)t->wishes->ref);
    return 0;
}

/* Waits for what the broker keeps of this robot's group. 0: it complained. */
static int await_task(borg_robot_task *task, const team *t)
{
    static team_link link;
    int good = 0, refused = 0;
    if (!t->option.is_mqtt) {
        complain("run", "a script is needed: only a broker keeps chunks for robots that come without one");
        return 0;
    }
    if (!team_link_open(&link, &t->option, NULL, 0, t->wishes->ref)) {
        return 0;
    }
    while (!good && !refused && !stop_signal_came()) {
        uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
        size_t count = 0;
        (void)link.transport.receive(link.transport.context, bytes, sizeof bytes, &count);
        if (link.mqtt.kept_count > 0) {
            good = borg_robot_task_read(task, link.mqtt.kept_bytes, link.mqtt.kept_count, t->wishes->unit);
            refused = !good;
        }
        (void)poll(NULL, 0, count > 0 ? 0 : LOOK_MS);
    }
    if (refused) {
        complain("--transport", "what the broker keeps for line %d is no chunk with a unit %d",
                 (int)t->wishes->ref, (int)t->wishes->unit);
    }
    team_link_close(&link);
    return good;
}

static int run_one(team *t)
{
    borg_robot_task task;
    if (!(t->wishes->script ? find_task(&task, t) : await_task(&task, t))) {
        return stop_signal_came() ? EXIT_DONE : EXIT_BAD_DATA;
    }
    t->count = 1;
    t->machines[0].report.ref = t->wishes->ref;
    t->machines[0].report.unit = t->wishes->unit;
    const int code = run_robot(t, &task, keep_report, t);
    if (code == EXIT_DONE) {
        tell(t);
    }
    return code;
}

int borg_run(const borg_run_wishes *wishes)
{
    static team t;
    t.wishes = wishes;
    if (!team_link_read(&t.option, wishes->transport)) {
        return EXIT_BAD_CALL;
    }
    if (wishes->script && !team_script_read(&t.script, wishes->script, wishes->timeout_s)) {
        return EXIT_BAD_DATA;
    }
    for (int32_t g = 0; g < t.script.count; g++) {
        t.number = borg_chunk_number(t.number, t.script.chunks[g], t.script.bytes[g]);
    }
    stop_signal_catch();
    (void)setvbuf(stderr, NULL, _IOLBF, BUFSIZ); /* lines of several processes stay whole */
    return wishes->serve ? serve(&t) : wishes->ref ? run_one(&t) : run_team(&t);
}
