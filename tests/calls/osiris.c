/* Robots: poses, drives, models, worlds, texts, telemetry, and what a robot is asked. */
#include "iris/osiris/robot.h"
#include "iris/osiris/robot_text.h"
#include "iris/osiris/simulated.h"
#include "iris/osiris/telemetry.h"
#include "iris/osiris/world_text.h"

#include <string.h>

#include "calls.h"

enum { DEVICES = 6 };

static osiris_drive_config any_drive(void)
{
    osiris_drive_config made;
    osiris_drive_defaults(&made, (osiris_drive_kind)draw_within(0, 2));
    if (draw_chance(4)) {
        int32_t *numbers[] = {&made.track_mm,         &made.wheelbase_mm,  &made.radius_mm,
                              &made.wheels,           &made.steering_max,  &made.steering_rate,
                              &made.speed_max_mms,    &made.turn_rate_max, &made.acceleration_mms2,
                              &made.turn_acceleration};
        *numbers[draw_below(10)] = draw_int(1, 4000);
    }
    return made;
}

static osiris_velocity any_velocity(void)
{
    osiris_velocity v = {draw_int(-2000 * 65536, 2000 * 65536), draw_int(-2000 * 65536, 2000 * 65536),
                         draw_int(-100000 * 256, 100000 * 256)};
    return v;
}

/* ---- drive.h ---- */

static void wheels(void)
{
    const osiris_drive_config made = any_drive();
    const osiris_velocity v = any_velocity();
    osiris_wheels *to = OR_NULL(draw_results(sizeof *to));
    const osiris_drive_config *config = OR_NULL(draw_given(&made, sizeof made));
    const osiris_velocity *velocity = OR_NULL(draw_given(&v, sizeof v));
    CALL(osiris_drive_wheels(to, config, velocity));
}

static void velocity(void)
{
    const osiris_drive_config made = any_drive();
    osiris_wheels w = {draw_within(2, 4), {0, 0, 0, 0}, (iris_angle)draw_within(-32768, 32767)};
    w.count = draw_chance(4) ? draw_int(2, 4) : made.kind == OSIRIS_OMNI ? made.wheels : 2;
    for (int i = 0; i < OSIRIS_WHEELS_MAX; i++) {
        w.speed_q16[i] = draw_int(-1000 * 65536, 1000 * 65536);
    }
    osiris_velocity *to = OR_NULL(draw_results(sizeof *to));
    const osiris_drive_config *config = OR_NULL(draw_given(&made, sizeof made));
    const osiris_wheels *from = OR_NULL(draw_given(&w, sizeof w));
    CALL(osiris_drive_velocity(to, config, from));
}

static void limit(void)
{
    const osiris_drive_config made = any_drive();
    const osiris_velocity v = any_velocity();
    osiris_velocity *to = draw_results(sizeof *to);
    *to = v;
    const osiris_drive_config *config = OR_NULL(draw_given(&made, sizeof made));
    to = OR_NULL(to);
    CALL(osiris_drive_limit(to, config));
}

static void step(void)
{
    const osiris_drive_config made = any_drive();
    const osiris_velocity v = any_velocity();
    osiris_drive begun;
    memset(&begun, 0, sizeof begun);
    (void)osiris_drive_init(&begun, &made);
    begun.config = made;
    osiris_drive *drive = OR_NULL(draw_state(&begun, sizeof begun));
    const osiris_velocity *wanted = OR_NULL(draw_given(&v, sizeof v));
    const int32_t ms = draw_int(0, 1000);
    CALL(osiris_drive_step(drive, wanted, ms));
}

/* ---- model.h ---- */

static osiris_device any_device(osiris_kind kind)
{
    osiris_device made;
    osiris_device_defaults(&made, kind);
    made.place.x_mm = draw_within(-200, 200);
    made.place.heading = (iris_angle)draw_within(-32768, 32767);
    if (draw_chance(3)) {
        int32_t *numbers[] = {&made.place.x_mm, &made.place.y_mm, &made.height_mm,    &made.width,
                              &made.least,      &made.most,       &made.resolution,   &made.deviation,
                              &made.period_ms,  &made.latency_ms, &made.error_permil, &made.channel};
        *numbers[draw_below(12)] = draw_int(0, 3000);
    }
    if (draw_chance(4)) {
        made.calibration.count = draw_int(2, OSIRIS_CALIBRATION_MAX);
        for (int i = 0; i < OSIRIS_CALIBRATION_MAX; i++) {
            made.calibration.raw[i] = i * 100 + draw_within(0, 99);
            made.calibration.value[i] = draw_int(-5000, 5000);
        }
    }
    return made;
}

static osiris_kind any_kind(void)
{
    return (osiris_kind)draw_within(OSIRIS_CAMERA, OSIRIS_SOUND);
}

static void model_read(void)
{
    const osiris_device made = any_device(any_kind());
    osiris_raw said = {made.kind, (osiris_validity)draw_within(0, 3), 0, {0, 0, 0, 0}};
    for (int i = 0; i < OSIRIS_VALUES; i++) {
        said.values[i] = draw_int(-3000, 3000);
    }
    osiris_reading *reading = OR_NULL(draw_results(sizeof *reading));
    const osiris_device *device = OR_NULL(draw_given(&made, sizeof made));
    const osiris_raw *raw = OR_NULL(draw_given(&said, sizeof said));
    CALL(osiris_model_read(reading, device, raw));
}

static void model_write(void)
{
    const osiris_device made = any_device(any_kind());
    int32_t told[OSIRIS_VALUES];
    for (int i = 0; i < OSIRIS_VALUES; i++) {
        told[i] = draw_int(-3000, 3000);
    }
    osiris_raw *raw = OR_NULL(draw_results(sizeof *raw));
    const osiris_device *device = OR_NULL(draw_given(&made, sizeof made));
    const int32_t *values = OR_NULL(draw_given(told, sizeof told));
    CALL(osiris_model_write(raw, device, values, draw_below(60000)));
}

/* ---- texts ---- */

static const char *any_text(size_t *bytes, const char *good)
{
    char *text = draw_results(strlen(good));
    *bytes = strlen(good);
    memcpy(text, good, *bytes);
    for (int i = draw_chance(3) ? draw_within(0, 4) : 0; i > 0; i--) {
        text[draw_below((uint32_t)*bytes)] = (char)draw_within(-128, 127);
    }
    const char *given = draw_given(text, *bytes);
    return OR_NULL(given);
}

static void robot_text(void)
{
    size_t bytes = 0;
    const int32_t capacity = draw_int(0, DEVICES);
    const size_t room = (size_t)(capacity < 0 ? 0 : capacity > DEVICES ? OSIRIS_DEVICES_MAX : capacity);
    osiris_plan *plan = OR_NULL(draw_state(NULL, sizeof *plan));
    osiris_device *devices = OR_NULL(draw_state(NULL, room * sizeof *devices));
    osiris_problem *problem = OR_NULL(draw_state(NULL, sizeof *problem));
    const char *text =
        any_text(&bytes, "robot r\nbody 100 90\ndrive omni wheels 3 radius 90\nrange a to 500 by "
                         "simulated\ncamera b cone 90\n");
    CALL(osiris_robot_read_text(plan, devices, capacity, problem, text, bytes));
}

static void world_text(void)
{
    size_t bytes = 0;
    osiris_world *world = OR_NULL(draw_state(NULL, sizeof *world));
    osiris_world_memory *memory = OR_NULL(draw_state(NULL, sizeof *memory));
    osiris_problem *problem = OR_NULL(draw_state(NULL, sizeof *problem));
    const char *text =
        any_text(&bytes, "wall 1 2 3 4 5 6\nobject 1 2 radius 5 color red\nstart 0 0 facing 90\n");
    CALL(osiris_world_read_text(world, memory, problem, text, bytes));
}

static void telemetry_format(void)
{
    osiris_telemetry made = {
        draw_int(0, 9999), draw_int(0, 255), {any_kind(), OSIRIS_VALID, 0, {0, 0, 0, 0}}};
    made.raw.validity = (osiris_validity)draw_within(0, 4);
    for (int i = 0; i < OSIRIS_VALUES; i++) {
        made.raw.values[i] = draw_int(-3000, 3000);
    }
    const size_t capacity = draw_chance(3) ? draw_below(OSIRIS_TELEMETRY_BYTES) : OSIRIS_TELEMETRY_BYTES;
    char *sentence = OR_NULL(draw_results(capacity));
    size_t *length = OR_NULL(draw_results(sizeof *length));
    const osiris_telemetry *telemetry = OR_NULL(draw_given(&made, sizeof made));
    CALL(osiris_telemetry_format(sentence, capacity, length, telemetry));
}

/* ---- robot.h ---- */

/* A robot of some devices, with readings of any kind; rarely null. */
static osiris_robot *any_robot(void)
{
    osiris_plan *plan = draw_state(NULL, sizeof *plan);
    osiris_device *devices = draw_state(NULL, DEVICES * sizeof *devices);
    osiris_reading *readings = draw_state(NULL, DEVICES * sizeof *readings);
    osiris_robot *robot = draw_state(NULL, sizeof *robot);
    memset(plan, 0, sizeof *plan);
    memset(robot, 0, sizeof *robot);
    plan->length_mm = draw_within(1, 500);
    plan->width_mm = draw_within(1, 500);
    plan->driver_count = 1;
    plan->device_count = draw_within(0, DEVICES);
    plan->devices = devices;
    osiris_drive_defaults(&plan->drive, (osiris_drive_kind)draw_within(0, 2));
    for (int32_t i = 0; i < DEVICES; i++) {
        const osiris_kind kind = draw_chance(3) ? any_kind() : OSIRIS_RANGE;
        osiris_device_defaults(&devices[i], kind);
        devices[i].channel = i;
        devices[i].place.x_mm = draw_within(-300, 300);
        devices[i].place.y_mm = draw_within(-300, 300);
        devices[i].place.heading = (iris_angle)draw_within(-32768, 32767);
        devices[i].width = draw_within(0, 65536);
    }
    (void)osiris_robot_init(robot, readings, plan);
    for (int32_t i = 0; i < plan->device_count; i++) {
        readings[i].validity = (osiris_validity)draw_within(0, 4);
        for (int k = 0; k < OSIRIS_VALUES; k++) {
            readings[i].values[k] = draw_int(-2000, 2000);
        }
    }
    return OR_NULL(robot);
}

static void find(void)
{
    const osiris_query made = {draw_chance(2) ? OSIRIS_RANGE : any_kind(),
                               (iris_angle)draw_within(-32768, 32767), draw_int(0, 32768)};
    const int32_t capacity = draw_within(-1, DEVICES);
    const osiris_robot *robot = any_robot();
    int32_t *found = OR_NULL(draw_state(NULL, (size_t)(capacity < 0 ? 0 : capacity) * sizeof *found));
    int32_t *count = OR_NULL(draw_state(NULL, sizeof *count));
    const osiris_query *query = OR_NULL(draw_given(&made, sizeof made));
    CALL(osiris_robot_find(found, capacity, count, robot, query));
}

static void obstacle(void)
{
    const osiris_robot *robot = any_robot();
    osiris_obstacle *to = OR_NULL(draw_results(sizeof *to));
    CALL(osiris_robot_obstacle(to, robot, (iris_angle)draw_within(-32768, 32767)));
}

static void object(void)
{
    const osiris_robot *robot = any_robot();
    osiris_sight *to = OR_NULL(draw_results(sizeof *to));
    CALL(osiris_robot_object(to, robot));
}

static void line(void)
{
    const osiris_robot *robot = any_robot();
    osiris_line *to = OR_NULL(draw_results(sizeof *to));
    CALL(osiris_robot_line(to, robot));
}

static void place(void)
{
    osiris_robot *robot = any_robot();
    const osiris_pose pose = {draw_int(-1000, 1000), draw_int(-1000, 1000),
                              (iris_angle)draw_within(-32768, 32767)};
    CALL(osiris_robot_place(robot, pose));
}

static void pose(void)
{
    const osiris_robot *robot = any_robot();
    osiris_pose *to = OR_NULL(draw_results(sizeof *to));
    CALL(osiris_robot_pose(to, robot));
}

static void battery(void)
{
    const osiris_robot *robot = any_robot();
    int32_t *to = OR_NULL(draw_results(sizeof *to));
    CALL(osiris_robot_battery(to, robot));
}

static void heading(void)
{
    const osiris_robot *robot = any_robot();
    iris_angle *to = OR_NULL(draw_results(sizeof *to));
    CALL(osiris_robot_heading(to, robot));
}

static void bumped(void)
{
    const osiris_robot *robot = any_robot();
    int32_t *to = OR_NULL(draw_results(sizeof *to));
    const iris_angle direction = (iris_angle)draw_within(-32768, 32767);
    CALL(osiris_robot_bumped(to, robot, direction, draw_int(0, 32768)));
}

const random_call calls_osiris[] = {{"osiris_drive_wheels", wheels},
                                    {"osiris_drive_velocity", velocity},
                                    {"osiris_drive_limit", limit},
                                    {"osiris_drive_step", step},
                                    {"osiris_model_read", model_read},
                                    {"osiris_model_write", model_write},
                                    {"osiris_robot_read_text", robot_text},
                                    {"osiris_world_read_text", world_text},
                                    {"osiris_telemetry_format", telemetry_format},
                                    {"osiris_robot_find", find},
                                    {"osiris_robot_obstacle", obstacle},
                                    {"osiris_robot_object", object},
                                    {"osiris_robot_line", line},
                                    {"osiris_robot_place", place},
                                    {"osiris_robot_pose", pose},
                                    {"osiris_robot_battery", battery},
                                    {"osiris_robot_heading", heading},
                                    {"osiris_robot_bumped", bumped},
                                    {NULL, NULL}};
