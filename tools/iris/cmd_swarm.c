#include <stdlib.h>
#include <string.h>

#include "args.h"
#include "commands.h"
#include "complain.h"
#include "file_name.h"
#include "json.h"
#include "picture_write.h"
#include "team_paths.h"
#include "team_simulation.h"
#include "team_timeline.h"
#include "team_world.h"

static const char help[] =
    "usage: iris swarm SCRIPT --simulate [--robots FILES] [--world FILE] [--timeout S] [--seed N]\n"
    "                  [--loss PERCENT] [--json] [-o PICTURE] [--timeline PICTURE|FILE]\n\n"
    "A whole team of robots, as a script of BorgCode has it, in a simulated world: what each robot does, "
    "where it\n"
    "goes, and what they tell each other.\n\n"
    "  --simulate       in a simulated world, in one process (over a network: iris borg run)\n"
    "  --robots FILES   robot files with commas between, one robot each in the order of the script's\n"
    "                   lines, over and over (default: a small robot with two wheels)\n"
    "  --world FILE     walls, painted lines, objects, and where robots start (default: a room of 6 by 4 "
    "meters)\n"
    "  --timeout S      seconds until a time-out where the script names none (default 60)\n"
    "  --seed N         of all noise and of what is lost (default 1): the same seed is the same run\n"
    "  --loss PERCENT   of what robots tell each other, lost on the way to each of them, 0 to 90 (default "
    "0);\n"
    "                   elections are made for up to 50\n"
    "  --json           one JSON object\n"
    "  -o PICTURE       the paths from above\n"
    "  --timeline PICTURE|FILE\n"
    "                   signals and what robots do, over time: a picture (.bmp, .ppm, ...), JSON (.json), or "
    "a text\n\n"
    "JSON has robots, each with unit (of its group), ref (its group's line), state (following, exploring, "
    "going,\n"
    "reached, stopped, ...), x_mm, y_mm, heading (degrees counterclockwise from x), and path, places each "
    "path_step_s;\n"
    "time_s; and signals, each with at_s, unit and ref of who took it, from and from_unit (0: its own), and "
    "signal.\n\n"
    "It ends when all robots have stood still for 6 s, or after twice the longest time-out and 12 s.\n\n"
    "example: iris swarm examples/scripts/explore.borg --simulate -o paths.bmp --timeline signals.bmp\n";

#define PATH_EVERY 5 /* of the record's places one is in JSON */

typedef struct {
    const char *script, *output, *timeline, *robots, *world;
    int32_t timeout_s, seed, loss;
    int json;
} wishes;

static void write_path(json_writer *json, const team_robot *robot)
{
    json_key(json, "path");
    json_open(json, '[');
    for (int32_t i = 0; i < robot->path_count; i += PATH_EVERY) {
        json_open(json, '[');
        json_integer(json, robot->path[i].x);
        json_integer(json, robot->path[i].y);
        json_close(json, ']');
    }
    json_close(json, ']');
}

static void write_robot(json_writer *json, const team_robot *robot)
{
    const team_place end = robot->path[robot->path_count - 1];
    json_open(json, '{');
    json_key(json, "unit");
    json_integer(json, robot->unit);
    json_key(json, "ref");
    json_integer(json, robot->ref);
    json_key(json, "state");
    json_string(json, robot->state);
    json_key(json, "x_mm");
    json_integer(json, end.x);
    json_key(json, "y_mm");
    json_integer(json, end.y);
    json_key(json, "heading");
    json_integer(json, robot->heading_deg);
    write_path(json, robot);
    json_close(json, '}');
}

static void write_json(const team_record *record)
{
    json_writer json = json_to(stdout);
    json_open(&json, '{');
    json_key(&json, "robots");
    json_open(&json, '[');
    for (int32_t i = 0; i < record->robot_count; i++) {
        write_robot(&json, &record->robots[i]);
    }
    json_close(&json, ']');
    json_key(&json, "time_s");
    json_number(&json, record->time_ms / 1000.0, 3);
    json_key(&json, "path_step_s");
    json_number(&json, PATH_EVERY * record->step_ms / 1000.0, 3);
    json_key(&json, "signals");
    team_signals_json(&json, record);
    json_close(&json, '}');
}

static void tell(const team_record *record)
{
    for (int32_t i = 0; i < record->robot_count; i++) {
        const team_robot *robot = &record->robots[i];
        const team_place end = robot->path[robot->path_count - 1];
        char name[32];
        team_robot_name(name, robot);
        printf("%-8s %-10s at (%d, %d) mm\n", name, robot->state, (int)end.x, (int)end.y);
    }
    printf("%.1f s, %d signals\n", record->time_ms / 1000.0, (int)record->signal_count);
}

static int run(const wishes *w)
{
    static team_script script;
    team_record record = {.title = file_name(w->script)};
    static team_world world;
    const team_setup setup = {&script, &world.is, w->robots, (uint32_t)w->seed, w->loss};
    int good = team_script_read(&script, w->script, w->timeout_s) && team_world_read(&world, w->world) &&
               team_simulate(&record, &setup);
    if (good && w->output) {
        good = team_paths_write(w->output, &record, &world.is);
    }
    if (good && w->timeline) {
        good = team_timeline_write(w->timeline, &record);
    }
    if (good && w->json) {
        write_json(&record);
    } else if (good) {
        tell(&record);
    }
    team_record_free(&record);
    return good ? EXIT_DONE : EXIT_BAD_DATA;
}

int cmd_swarm(int argc, char **argv)
{
    wishes w = {.timeout_s = BORG_TIMEOUT_S, .seed = 1};
    const char *timeout = NULL, *seed = NULL, *loss = NULL;
    int simulate = 0;
    const args_option options[] = {{"simulate", 0, &simulate, NULL},  {"robots", 0, NULL, &w.robots},
                                   {"world", 0, NULL, &w.world},      {"timeout", 0, NULL, &timeout},
                                   {"seed", 0, NULL, &seed},          {"loss", 0, NULL, &loss},
                                   {"json", 0, &w.json, NULL},        {"output", 'o', NULL, &w.output},
                                   {"timeline", 0, NULL, &w.timeline}};
    arguments args = {.help = help, .options = options, .option_count = sizeof options / sizeof options[0]};
    const int code = args_parse(&args, argc, argv);
    if (code != ARGS_GO) {
        return code;
    }
    const args_whole numbers[] = {{"--timeout", timeout, &w.timeout_s, 1, 3600},
                                  {"--seed", seed, &w.seed, 0, INT32_MAX},
                                  {"--loss", loss, &w.loss, 0, 90}};
    if (!args_wholes(numbers, sizeof numbers / sizeof numbers[0])) {
        return EXIT_BAD_CALL;
    }
    if (args.operand_count != 1) {
        complain(NULL, "one script is needed (see --help)");
        return EXIT_BAD_CALL;
    }
    if (!simulate) {
        complain("--simulate", "is needed: a team over a network is run by iris borg run");
        return EXIT_BAD_CALL;
    }
    if (w.output && picture_container_of(w.output) == CONTAINER_UNKNOWN) {
        complain(w.output, "a picture's name ends with .bmp, .ppm, .pgm, or .pnm");
        return EXIT_BAD_CALL;
    }
    w.script = args.operands[0];
    return run(&w);
}
