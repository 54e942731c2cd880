#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "args.h"
#include "commands.h"
#include "complain.h"
#include "json.h"
#include "picture_write.h"
#include "run_picture.h"
#include "run_session.h"
#include "serial_orders.h"

static const char help[] =
    "usage: iris run --robot FILE [--world FILE | --real] [--script FILE] [--console] [--serial DEV] "
    "[--lease S]\n"
    "                [--time S] [--speed N] [--seed N] [--journal FILE] [--json] [-o PICTURE]\n"
    "       iris run --robot FILE --replay FILE [--json] [-o PICTURE]\n\n"
    "A robot that does what it is ordered: by a script, a person, and a gamepad's sentences, all "
    "at once. A\n"
    "person is obeyed before the gamepad, and that before the script; stop wins, whoever says it.\n\n"
    "  --robot FILE    what the robot is like: examples/robots\n"
    "  --world FILE    walls, lines, and things around it: examples/worlds (default: an open floor)\n"
    "  --real          the robot itself, not a simulated one: by the serial ports and GPIO lines that FILE "
    "names\n"
    "  --script FILE   timed orders: lines of SECONDS ORDER\n"
    "  --console       orders from standard input, one on a line; its end is a stop for what has no end of "
    "its own\n"
    "  --serial DEV    command sentences ($PIRIS, iris follow writes them) at 115200 baud; each is good for "
    "0.5 s\n"
    "  --lease S       an order of script and console that has no end of its own is good for S seconds only, "
    "until\n"
    "                  the next line from there, which may be empty; then all stops\n"
    "  --time S        ends after so many seconds, standing (default: when all is done, 600 at most)\n"
    "  --speed N       times as fast as the clock, 1 to 1000 (default: 1 with --console or --serial, else as "
    "fast\n"
    "                  as it goes)\n"
    "  --seed N        of the sensors' noise (default 1): the same seed is the same run\n"
    "  --journal FILE  all that comes in is written there, as it comes\n"
    "  --replay FILE   a journal again, without world and orders: the same commands come out, bit for bit, "
    "and are\n"
    "                  printed (seconds, mm/s, 65536ths of a turn a second, positive to the right); or the "
    "line\n"
    "                  is named where they differ, or where the journal is damaged or ends early\n"
    "  --json          one JSON object: time_s, orders, commands, check (of all commands), x_mm, y_mm, "
    "heading,\n"
    "                  events (at_s, event, and x, y where it has a place), and of a replay: same\n"
    "  -o PICTURE      the driven path from above; with what was ordered to be mapped\n\n"
    "  stop               everything, at once                  follow [MM/S]      the line\n"
    "  go MM [MM/S]       ahead, or back                       lock [MM/S]        on to the thing that it "
    "sees\n"
    "  turn DEGREES       to the right                         explore [MM/S]     what it has not seen\n"
    "  drive MM/S DEGREES/S                                    map, detect        beside what drives\n"
    "  goto X Y           around what is in the way            reset              the mission's time\n\n"
    "example: iris run --robot examples/robots/rover.robot --world examples/worlds/room.world --console\n";

typedef struct {
    const char *robot, *world, *script, *serial, *journal, *replay, *output;
    int console, json, real;
    int32_t lease_ms, time_s, speed, seed;
} wishes;

static int has_place(iris_event_kind kind)
{
    return kind == IRIS_EVENT_OBJECT_DETECTED || kind == IRIS_EVENT_OBJECT_LOST ||
           kind == IRIS_EVENT_REACHED || kind == IRIS_EVENT_LINE_END || kind == IRIS_EVENT_BUMPED;
}

static void write_events(json_writer *json, const run_session *s)
{
    json_key(json, "events");
    json_open(json, '[');
    for (int32_t i = 0; i < s->event_count; i++) {
        const run_event *e = &s->events[i];
        json_open(json, '{');
        json_key(json, "at_s");
        json_number(json, e->at_ms / 1000.0, 3);
        json_key(json, "event");
        json_string(json, iris_event_name((int32_t)e->event.kind));
        if (has_place(e->event.kind)) {
            json_key(json, "x");
            json_integer(json, e->event.x);
            json_key(json, "y");
            json_integer(json, e->event.y);
        }
        json_close(json, '}');
    }
    json_close(json, ']');
}

static osiris_pose end_of(const run_session *s)
{
    return s->path_count > 0 ? s->path[s->path_count - 1] : s->senses.pose;
}

static void write_json(const run_session *s, const wishes *w, int code)
{
    char check[9];
    json_writer json = json_to(stdout);
    const osiris_pose end = end_of(s);
    const struct {
        const char *key;
        int32_t value;
    } numbers[] = {{"orders", s->orders}, {"commands", s->commands}, {"x_mm", end.x_mm}, {"y_mm", end.y_mm}};
    snprintf(check, sizeof check, "%08lX", (unsigned long)s->check);
    json_open(&json, '{');
    json_key(&json, "time_s");
    json_number(&json, s->now_ms / 1000.0, 3);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        json_key(&json, numbers[i].key);
        json_integer(&json, numbers[i].value);
    }
    json_key(&json, "heading");
    json_number(&json, iris_angle_to_centidegrees(end.heading) / 100.0, 2);
    json_key(&json, "check");
    json_string(&json, check);
    if (w->replay) {
        json_key(&json, "same");
        json_integer(&json, code == EXIT_DONE);
    }
    write_events(&json, s);
    json_close(&json, '}');
}

static void tell(const run_session *s, const wishes *w, int code)
{
    const osiris_pose end = end_of(s);
    if (w->json) {
        write_json(s, w, code);
    } else if (!w->replay) {
        printf("%.3f s, %d orders, %d commands, check %08lX; at (%d, %d), %.2f degrees\n", s->now_ms / 1000.0,
               (int)s->orders, (int)s->commands, (unsigned long)s->check, (int)end.x_mm, (int)end.y_mm,
               iris_angle_to_centidegrees(end.heading) / 100.0);
    }
}

static int run_live(run_session *s, const wishes *w, run_script *script)
{
    if ((w->script && !run_script_read(script, w->script)) ||
        !(w->real ? run_body_open(&s->body) : run_body_place(&s->body, w->world, (uint32_t)w->seed)) ||
        (w->serial && !serial_orders_open(w->serial))) {
        return EXIT_BAD_DATA;
    }
    if (w->journal && !(s->record = fopen(w->journal, "wb"))) {
        complain(w->journal, "%s", strerror(errno));
        return EXIT_BAD_DATA;
    }
    s->script = w->script ? script : NULL;
    s->has_console = w->console;
    s->has_serial = w->serial != NULL;
    s->lease_ms = w->lease_ms;
    s->limit_ms = (uint32_t)w->time_s * 1000;
    s->speed = w->speed > 0 ? w->speed : w->console || w->serial || w->real ? 1 : 0;
    int code = run_session_live(s);
    run_body_close(&s->body, s->now_ms);
    if (s->record && fclose(s->record) != 0) {
        complain(w->journal, "%s", strerror(errno));
        code = EXIT_BAD_DATA;
    }
    serial_orders_close();
    return code;
}

static int run(const wishes *w)
{
    static run_session s;
    run_script script = {NULL, 0};
    s.is_quiet = w->json;
    if (!run_body_read(&s.body, w->robot)) {
        return EXIT_BAD_DATA;
    }
    int code = w->replay ? run_session_replay(&s, w->replay) : run_live(&s, w, &script);
    if (code == EXIT_DONE || s.path_count > 0) {
        tell(&s, w, code);
        if (w->output && !run_picture_write(w->output, &s)) {
            code = EXIT_BAD_DATA;
        }
    }
    free(script.lines);
    run_session_free(&s);
    return code;
}

/* Seconds with up to three places. 1, or 0. */
static int read_lease(wishes *w, const char *text)
{
    int32_t q16 = 0;
    if (text && !args_q16(&q16, 66, 60 * 65536, text)) {
        complain("--lease", "seconds are needed, 0.001 to 60, not %s", text);
        return 0;
    }
    w->lease_ms = (int32_t)(((int64_t)q16 * 1000 + 32768) / 65536);
    return 1;
}

static int are_good(const wishes *w)
{
    if (!w->robot) {
        complain("--robot", "a robot file is needed (see --help)");
    } else if (w->replay && (w->world || w->script || w->console || w->serial || w->journal || w->lease_ms)) {
        complain("--replay", "what came in is in the journal: only --robot, --json, and -o go with it");
    } else if (w->real && (w->world || w->speed || w->replay)) {
        complain("--real", "the world is what it is: not with --world, --speed, or --replay");
    } else if (!w->replay && !w->script && !w->console && !w->serial) {
        complain(NULL, "nobody gives orders: --script, --console, or --serial is needed (see --help)");
    } else if (w->output && picture_container_of(w->output) == CONTAINER_UNKNOWN) {
        complain(w->output, "a picture's name ends with .bmp, .ppm, .pgm, or .pnm");
    } else {
        return 1;
    }
    return 0;
}

int cmd_run(int argc, char **argv)
{
    wishes w = {.time_s = 600, .seed = 1};
    const char *lease = NULL, *time = NULL, *speed = NULL, *seed = NULL;
    const args_option options[] = {
        {"robot", 0, NULL, &w.robot},     {"world", 0, NULL, &w.world},    {"script", 0, NULL, &w.script},
        {"console", 0, &w.console, NULL}, {"serial", 0, NULL, &w.serial},  {"lease", 0, NULL, &lease},
        {"time", 0, NULL, &time},         {"speed", 0, NULL, &speed},      {"seed", 0, NULL, &seed},
        {"journal", 0, NULL, &w.journal}, {"replay", 0, NULL, &w.replay},  {"json", 0, &w.json, NULL},
        {"real", 0, &w.real, NULL},       {"output", 'o', NULL, &w.output}};
    arguments args = {.help = help, .options = options, .option_count = sizeof options / sizeof options[0]};
    const int code = args_parse(&args, argc, argv);
    if (code != ARGS_GO) {
        return code;
    }
    const args_whole numbers[] = {{"--time", time, &w.time_s, 1, 86400},
                                  {"--speed", speed, &w.speed, 1, 1000},
                                  {"--seed", seed, &w.seed, 0, INT32_MAX}};
    if (args.operand_count > 0) {
        complain(args.operands[0], "iris run takes no operands (see --help)");
        return EXIT_BAD_CALL;
    }
    if (!args_wholes(numbers, 3) || !read_lease(&w, lease) || !are_good(&w)) {
        return EXIT_BAD_CALL;
    }
    return run(&w);
}
