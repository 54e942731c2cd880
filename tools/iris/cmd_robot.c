#include <stdlib.h>
#include <string.h>

#include "args.h"
#include "commands.h"
#include "complain.h"
#include "iris/osiris/robot.h"
#include "iris/osiris/simulated.h"
#include "json.h"
#include "robot_file.h"
#include "robot_picture.h"

static const char help[] =
    "usage: iris robot FILE [--check] [--world WORLD] [--json] [-o PICTURE]\n\n"
    "A robot file, checked and shown: its body, drive, and devices, and what looks where; with a world, "
    "what\n"
    "it answers where that world has its first start.\n\n"
    "  --check        only says whether the file is good, or what is wrong in which line\n"
    "  --world WORLD  puts a simulated one there, and asks it: what is ahead, what it sees, the line, its "
    "battery\n"
    "  --json         one JSON object: name, drive, length, width, devices (name, kind, driver, channel, x, "
    "y, facing,\n"
    "                 cone, from, to, rate), radius (of its tightest curve), with --world also answers; mm "
    "and degrees\n"
    "  -o PICTURE     the robot from above: ahead is up; cones of what sees far are shown up to 900 mm\n\n"
    "  robot NAME                     body LENGTH WIDTH [ahead MM]\n"
    "  driver NAME simulated | serial PATH [rate BAUD] | camera PATH |\n"
    "              gpio CHIP left-dir N left-pwm N right-dir N right-pwm N [rate HZ]\n"
    "  drive differential track MM | ackermann track MM wheelbase MM steering DEGREES [steering-rate "
    "DEGREES] |\n"
    "        omni wheels 3|4 radius MM,  with  speed MM/S turn DEGREES/S acceleration N turn-acceleration N "
    "by DRIVER\n"
    "  KIND NAME [at X Y] [height MM] [facing DEGREES] [cone DEGREES] [from N] [to N] [step N] [noise N]\n"
    "       [error PERCENT] [rate HZ] [latency MS] [by DRIVER] [channel N] [calibrate RAW VALUE ...]\n"
    "  KIND: camera range line bump odometry heading battery steering gripper light sound; # begins a "
    "comment\n\n"
    "example: iris robot examples/robots/rover.robot --world examples/worlds/room.world -o rover.bmp\n";

static osiris_plan plan;
static osiris_device devices[OSIRIS_DEVICES_MAX];
static osiris_reading readings[OSIRIS_DEVICES_MAX];
static osiris_world_memory memory;
static osiris_robot robot;

static double degrees(int32_t units)
{
    return units * 360.0 / 65536;
}

static const char *drive_name(void)
{
    static const char *const names[] = {"differential", "ackermann", "omni"};
    return names[plan.drive.kind];
}

static int has_place(const osiris_device *d)
{
    return d->kind <= OSIRIS_BUMP || d->place.x_mm != 0 || d->place.y_mm != 0;
}

static void print_device(const osiris_device *d)
{
    printf("  %-9s%s:", osiris_kind_name(d->kind), d->name);
    if (has_place(d)) {
        printf(" at %d, %d facing %.4g", (int)d->place.x_mm, (int)d->place.y_mm, degrees(d->place.heading));
    }
    if (d->kind == OSIRIS_CAMERA || d->kind == OSIRIS_RANGE) {
        printf(", cone %.4g, %d to %d mm", degrees(d->width), (int)d->least, (int)d->most);
    }
    if (d->kind == OSIRIS_BATTERY) {
        printf(" %d to %d mV", (int)d->least, (int)d->most);
    }
    if (osiris_kind_is_sensor(d->kind)) {
        printf("%s %.4g a second", has_place(d) || d->kind == OSIRIS_BATTERY ? "," : "",
               1000.0 / d->period_ms);
    }
    printf("%s by %s\n", has_place(d) || osiris_kind_is_sensor(d->kind) ? "," : "",
           plan.drivers[d->driver].name);
}

static void print_found(const char *what, const osiris_query *query)
{
    int32_t found[OSIRIS_DEVICES_MAX], count = 0;
    (void)osiris_robot_find(found, OSIRIS_DEVICES_MAX, &count, &robot, query);
    printf("%s:", what);
    for (int32_t i = 0; i < count; i++) {
        printf(" %s", devices[found[i]].name);
        if (readings[found[i]].validity == OSIRIS_VALID) {
            printf(" (%d mm)", (int)readings[found[i]].values[0]);
        }
    }
    printf(count == 0 ? " none\n" : "\n");
}

static void print_text(const char *path)
{
    const osiris_query forward = {OSIRIS_RANGE, 0, 5461};
    const int32_t radius = osiris_drive_radius_min(&plan.drive);
    printf("%s: %s, %dx%d mm, %s, %d mm/s, ", path, plan.name, (int)plan.length_mm, (int)plan.width_mm,
           drive_name(), (int)plan.drive.speed_max_mms);
    if (radius > 0) {
        printf("curves from %d mm\n", (int)radius);
    } else {
        printf("turns on the spot\n");
    }
    for (int32_t i = 0; i < plan.device_count; i++) {
        print_device(&devices[i]);
    }
    print_found("ranges that look ahead within 30 degrees", &forward);
}

/* --- what it answers in a world --- */

static void print_answers(void)
{
    osiris_obstacle obstacle;
    osiris_sight sight;
    osiris_line line;
    int32_t permil;
    if (osiris_robot_obstacle(&obstacle, &robot, 0) == IRIS_OK) {
        printf(obstacle.seen ? "nearest obstacle ahead: %d mm (%s)\n" : "nothing ahead within %d mm (%s)\n",
               (int)obstacle.distance_mm, devices[obstacle.device].name);
    } else {
        printf("obstacles ahead: nobody knows\n");
    }
    if (osiris_robot_object(&sight, &robot) == IRIS_OK) {
        printf("sees an object of color %06X at %d, %d, %d mm away\n", (unsigned)sight.color, (int)sight.x_mm,
               (int)sight.y_mm, (int)sight.distance_mm);
    } else {
        printf("sees no object\n");
    }
    if (osiris_robot_line(&line, &robot) == IRIS_OK) {
        printf("line: %d mm to the %s\n", abs((int)line.offset_mm), line.offset_mm < 0 ? "left" : "right");
    } else {
        printf("line: none\n");
    }
    if (osiris_robot_battery(&permil, &robot) == IRIS_OK) {
        printf("battery: %d %%\n", (int)(permil + 5) / 10);
    }
}

static void add_answers(json_writer *json)
{
    osiris_obstacle obstacle;
    osiris_sight sight;
    osiris_line line;
    int32_t permil;
    json_key(json, "answers");
    json_open(json, '{');
    if (osiris_robot_obstacle(&obstacle, &robot, 0) == IRIS_OK) {
        json_key(json, obstacle.seen ? "obstacle" : "free");
        json_integer(json, obstacle.distance_mm);
    }
    if (osiris_robot_object(&sight, &robot) == IRIS_OK) {
        json_key(json, "object");
        json_open(json, '[');
        json_integer(json, sight.x_mm);
        json_integer(json, sight.y_mm);
        json_close(json, ']');
    }
    if (osiris_robot_line(&line, &robot) == IRIS_OK) {
        json_key(json, "line");
        json_integer(json, line.offset_mm);
    }
    if (osiris_robot_battery(&permil, &robot) == IRIS_OK) {
        json_key(json, "battery");
        json_number(json, permil / 1000.0, 3);
    }
    json_close(json, '}');
}

static void add_device(json_writer *json, const osiris_device *d)
{
    const struct {
        const char *key;
        double value;
    } numbers[] = {{"channel", d->channel},
                   {"x", d->place.x_mm},
                   {"y", d->place.y_mm},
                   {"facing", degrees(d->place.heading)},
                   {"cone", degrees(d->width)},
                   {"from", d->least},
                   {"to", d->most},
                   {"rate", 1000.0 / d->period_ms}};
    json_open(json, '{');
    json_key(json, "name");
    json_string(json, d->name);
    json_key(json, "kind");
    json_string(json, osiris_kind_name(d->kind));
    json_key(json, "driver");
    json_string(json, plan.drivers[d->driver].name);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        json_key(json, numbers[i].key);
        json_number(json, numbers[i].value, 2);
    }
    json_close(json, '}');
}

static void print_json(int in_world)
{
    json_writer json = json_to(stdout);
    json_open(&json, '{');
    json_key(&json, "name");
    json_string(&json, plan.name);
    json_key(&json, "drive");
    json_string(&json, drive_name());
    json_key(&json, "length");
    json_integer(&json, plan.length_mm);
    json_key(&json, "width");
    json_integer(&json, plan.width_mm);
    json_key(&json, "radius");
    json_integer(&json, osiris_drive_radius_min(&plan.drive));
    json_key(&json, "devices");
    json_open(&json, '[');
    for (int32_t i = 0; i < plan.device_count; i++) {
        add_device(&json, &devices[i]);
    }
    json_close(&json, ']');
    if (in_world) {
        add_answers(&json);
    }
    json_close(&json, '}');
}

/* Simulated, whatever drives it otherwise, for as long as its slowest sensor takes. */
static int stand_in(const char *path)
{
    static osiris_world world;
    static osiris_simulated simulated;
    static osiris_simulated_device states[OSIRIS_DEVICES_MAX];
    const osiris_pose origin = {0, 0, 0};
    uint32_t ms = 0;
    if (!world_file_read(&world, &memory, path)) {
        return 0;
    }
    const osiris_pose start = world.start_count > 0 ? world.starts[0] : origin;
    if (osiris_simulated_init(&simulated, states, &plan, &world, start, 1) != IRIS_OK) {
        complain(path, "no world for this robot");
        return 0;
    }
    for (int32_t i = 0; i < plan.driver_count; i++) {
        (void)osiris_robot_bind(&robot, i, &osiris_simulated_driver, &simulated, 0);
    }
    for (int32_t i = 0; i < plan.device_count; i++) {
        const uint32_t takes = (uint32_t)(devices[i].latency_ms + 20);
        ms = takes > ms ? takes : ms;
    }
    (void)osiris_simulated_step(&simulated, ms);
    (void)osiris_robot_sense(&robot, ms);
    (void)osiris_robot_place(&robot, start);
    return 1;
}

int cmd_robot(int argc, char **argv)
{
    const char *output = NULL, *world = NULL;
    int check = 0, as_json = 0;
    const args_option options[] = {{"check", 0, &check, NULL},
                                   {"json", 0, &as_json, NULL},
                                   {"world", 0, NULL, &world},
                                   {"output", 'o', NULL, &output}};
    arguments args = {.help = help, .options = options, .option_count = sizeof options / sizeof options[0]};
    const int code = args_parse(&args, argc, argv);
    if (code != ARGS_GO) {
        return code;
    }
    if (args.operand_count != 1) {
        complain(NULL, "one robot file is needed (see --help)");
        return EXIT_BAD_CALL;
    }
    if (check && (as_json || world || output)) {
        complain("--check", "not with --json, --world, or -o");
        return EXIT_BAD_CALL;
    }
    if (!robot_file_read(&plan, devices, args.operands[0]) ||
        osiris_robot_init(&robot, readings, &plan) != IRIS_OK || (world && !stand_in(world))) {
        return EXIT_BAD_DATA;
    }
    if (check) {
        printf("%s: %d devices, nothing wrong\n", args.operands[0], (int)plan.device_count);
        return EXIT_DONE;
    }
    if (as_json) {
        print_json(world != NULL);
    } else {
        print_text(args.operands[0]);
        if (world) {
            print_answers();
        }
    }
    return output && !robot_picture_write(output, &plan) ? EXIT_BAD_DATA : EXIT_DONE;
}
