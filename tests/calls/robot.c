/* Robots that are made, bound to drivers, sensed, and driven; simulated ones, and those at the other end of a line. */
#include "iris/osiris/robot.h"
#include "iris/osiris/simulated.h"
#include "iris/osiris/telemetry.h"

#include <string.h>

#include "calls.h"

enum { DEVICES = 4 };

static int32_t *one_of(int32_t **numbers, uint32_t count)
{
    return numbers[draw_below(count)];
}

/* Good mostly; its devices are given. */
static osiris_plan plan_of(osiris_device *devices)
{
    osiris_plan made;
    memset(&made, 0, sizeof made);
    made.length_mm = draw_within(1, 500);
    made.width_mm = draw_within(1, 500);
    made.driver_count = draw_within(1, 2);
    made.drivers[0].rate = made.drivers[1].rate = 100;
    made.device_count = draw_within(1, DEVICES);
    osiris_drive_defaults(&made.drive, (osiris_drive_kind)draw_within(0, 2));
    for (int32_t i = 0; i < DEVICES; i++) {
        osiris_device_defaults(&devices[i],
                               i == 0 ? OSIRIS_DRIVE : (osiris_kind)draw_within(OSIRIS_CAMERA, OSIRIS_SOUND));
        devices[i].channel = i;
    }
    if (draw_chance(12)) {
        int32_t *numbers[] = {&made.length_mm,    &made.width_mm,     &made.ahead_mm,
                              &made.driver_count, &made.device_count, &made.drive.wheels};
        *one_of(numbers, 6) = draw_chance(2) ? draw_within(INT32_MIN, -5000) : draw_within(5000, INT32_MAX);
    }
    return made;
}

static const osiris_plan *any_plan(void)
{
    osiris_device devices[DEVICES];
    osiris_plan made = plan_of(devices);
    made.devices = draw_given(devices, sizeof devices);
    made.devices = OR_NULL(made.devices);
    return OR_NULL(draw_given(&made, sizeof made));
}

static osiris_pose any_pose(void)
{
    osiris_pose pose = {draw_int(-2000, 2000), draw_int(-2000, 2000), (iris_angle)draw_within(-32768, 32767)};
    return pose;
}

/* ---- what is made ---- */

static void device_check(void)
{
    osiris_device made;
    osiris_device_defaults(&made, (osiris_kind)draw_within(-1, OSIRIS_KINDS));
    int32_t *numbers[] = {&made.least, &made.most, &made.calibration.count, &made.width, &made.period_ms};
    *one_of(numbers, 5) = draw_int(1, 4);
    const osiris_device *device = OR_NULL(draw_given(&made, sizeof made));
    CALL(osiris_device_check(device));
}

static void drive_check(void)
{
    osiris_drive_config made;
    osiris_drive_defaults(&made, (osiris_drive_kind)draw_within(-1, 3));
    int32_t *numbers[] = {&made.wheels, &made.track_mm, &made.speed_max_mms, &made.steering_max};
    *one_of(numbers, 4) = draw_int(3, 4000);
    const osiris_drive_config *config = OR_NULL(draw_given(&made, sizeof made));
    CALL(osiris_drive_check(config));
}

static void drive_init(void)
{
    osiris_drive_config made;
    osiris_drive_defaults(&made, (osiris_drive_kind)draw_within(0, 3));
    osiris_drive *drive = OR_NULL(draw_results(sizeof *drive));
    const osiris_drive_config *config = OR_NULL(draw_given(&made, sizeof made));
    CALL(osiris_drive_init(drive, config));
}

static void plan_check(void)
{
    const osiris_plan *plan = any_plan();
    CALL(osiris_plan_check(plan));
}

static void robot_init(void)
{
    const osiris_plan *plan = any_plan();
    osiris_robot *robot = OR_NULL(draw_results(sizeof *robot));
    osiris_reading *readings = OR_NULL(draw_results(DEVICES * sizeof *readings));
    CALL(osiris_robot_init(robot, readings, plan));
}

/* ---- a driver that says anything ---- */

static iris_status say(void)
{
    static const iris_status answers[] = {IRIS_OK, IRIS_OK, IRIS_ERR_TIMEOUT, IRIS_ERR_IO,
                                          IRIS_ERR_UNSUPPORTED};
    const iris_status status = answers[draw_below(5)];
    return status == IRIS_ERR_TIMEOUT && draw_chance(2) ? IRIS_OK : status;
}

static iris_status noise_open(void *context, uint32_t now_ms)
{
    (void)context;
    (void)now_ms;
    return draw_chance(2) ? IRIS_OK : IRIS_ERR_IO;
}

static iris_status noise_read(void *context, osiris_raw *raw, const osiris_device *device, uint32_t now_ms)
{
    const osiris_raw made = {device->kind,
                             (osiris_validity)draw_within(0, 4),
                             now_ms,
                             {draw_int(-3000, 3000), draw_int(-3000, 3000), draw_int(0, 9), draw_int(0, 9)}};
    (void)context;
    *raw = made;
    return say();
}

static iris_status noise_write(void *context, const osiris_device *device, const osiris_raw *raw,
                               uint32_t now_ms)
{
    (void)context;
    (void)now_ms;
    return device->kind == raw->kind && draw_chance(4) ? IRIS_ERR_IO : IRIS_OK;
}

static void noise_close(void *context, uint32_t now_ms)
{
    (void)context;
    (void)now_ms;
}

static const osiris_driver noise_driver = {noise_open, noise_read, noise_write, noise_close};

/* Made of a good plan, and mostly with a driver; rarely null. */
static osiris_robot *any_robot(void)
{
    osiris_device devices[DEVICES];
    osiris_plan made = plan_of(devices);
    osiris_plan *plan = draw_state(NULL, sizeof *plan);
    osiris_reading *readings = draw_state(NULL, DEVICES * sizeof *readings);
    osiris_robot *robot = draw_state(NULL, sizeof *robot);
    made.devices = draw_given(devices, sizeof devices);
    *plan = made;
    if (osiris_robot_init(robot, readings, plan) != IRIS_OK) {
        return NULL;
    }
    if (!draw_chance(6)) {
        (void)osiris_robot_bind(robot, 0, &noise_driver, NULL, 0);
    }
    return OR_NULL(robot);
}

static void bind(void)
{
    osiris_robot *robot = any_robot();
    const osiris_driver *driver = OR_NULL(draw_given(&noise_driver, sizeof noise_driver));
    CALL(osiris_robot_bind(robot, draw_int(0, 1), driver, NULL, 5));
}

static void sense(void)
{
    osiris_robot *robot = any_robot();
    CALL(osiris_robot_sense(robot, draw_below(60000)));
}

static void drive(void)
{
    osiris_robot *robot = any_robot();
    (void)osiris_robot_drive(robot, 100, 100, 0);
    const int32_t speed = draw_int(-1000, 1000), turn = draw_int(-70000, 70000);
    CALL(osiris_robot_drive(robot, speed, turn, draw_below(1000)));
}

static void glide(void)
{
    osiris_robot *robot = any_robot();
    const int32_t speed = draw_int(-1000, 1000), left = draw_int(-1000, 1000), turn = draw_int(-70000, 70000);
    CALL(osiris_robot_glide(robot, speed, left, turn, draw_below(1000)));
}

static void stop(void)
{
    osiris_robot *robot = any_robot();
    CALL(osiris_robot_stop(robot, draw_below(1000)));
}

static void tell(void)
{
    const int32_t made[OSIRIS_VALUES] = {draw_int(-1000, 1000), draw_int(-1000, 1000), 0, 0};
    osiris_robot *robot = any_robot();
    const int32_t device = draw_int(0, DEVICES - 1);
    const int32_t *values = OR_NULL(draw_given(made, sizeof made));
    CALL(osiris_robot_tell(robot, device, values, draw_below(1000)));
}

/* ---- worlds, simulated robots ---- */

static osiris_world any_world(void)
{
    osiris_segment walls[2];
    osiris_object thing = {draw_int(-2000, 2000), draw_int(-2000, 2000), draw_within(1, 500), 0xFF0000};
    osiris_pose start = any_pose();
    for (int i = 0; i < 2; i++) {
        const osiris_segment s = {draw_within(-2000, 2000), draw_within(-2000, 2000),
                                  draw_within(-2000, 2000), draw_int(-2000, 2000)};
        walls[i] = s;
    }
    osiris_world made = {
        NULL, NULL, NULL, NULL, draw_within(0, 2), draw_within(0, 1), draw_within(0, 1), draw_within(0, 1)};
    made.walls = draw_given(walls, sizeof walls);
    made.lines = draw_given(walls, sizeof walls);
    made.objects = draw_given(&thing, sizeof thing);
    made.starts = draw_given(&start, sizeof start);
    if (draw_chance(20)) {
        int32_t *numbers[] = {&made.wall_count, &made.line_count, &made.object_count, &made.start_count};
        *one_of(numbers, 4) = draw_within(INT32_MIN, -1);
    }
    return made;
}

static void world_check(void)
{
    const osiris_world made = any_world();
    const osiris_world *world = OR_NULL(draw_given(&made, sizeof made));
    CALL(osiris_world_check(world));
}

static void simulated_init(void)
{
    const osiris_world made = any_world();
    const osiris_plan *plan = any_plan();
    const osiris_world *world = OR_NULL(draw_given(&made, sizeof made));
    osiris_simulated *robot = OR_NULL(draw_results(sizeof *robot));
    osiris_simulated_device *devices = OR_NULL(draw_results(DEVICES * sizeof *devices));
    CALL(osiris_simulated_init(robot, devices, plan, world, any_pose(), draw_below(1000)));
}

static void simulated_step(void)
{
    osiris_device made_devices[DEVICES];
    osiris_plan made = plan_of(made_devices);
    const osiris_world made_world = any_world();
    osiris_simulated *robot = draw_state(NULL, sizeof *robot);
    osiris_simulated_device *devices = draw_state(NULL, DEVICES * sizeof *devices);
    made.devices = draw_given(made_devices, sizeof made_devices);
    const osiris_plan *plan = draw_given(&made, sizeof made);
    const osiris_world *world = draw_given(&made_world, sizeof made_world);
    if (osiris_simulated_init(robot, devices, plan, world, any_pose(), 1) != IRIS_OK) {
        robot = NULL;
    } else {
        const osiris_raw raw = {
            OSIRIS_DRIVE,
            OSIRIS_VALID,
            0,
            {draw_int(-65536000, 65536000), draw_int(-65536000, 65536000), draw_int(-9999999, 9999999), 0}};
        (void)osiris_simulated_driver.write(robot, &plan->devices[0], &raw, 0);
    }
    robot = OR_NULL(robot);
    CALL(osiris_simulated_step(robot, draw_below(700)));
}

/* ---- telemetry.h ---- */

static void telemetry_parse(void)
{
    static const char sentence[] = "$PIRIV,42,range,0,V,1234*00\r";
    osiris_telemetry_parser made;
    memset(&made, 0, sizeof made);
    made.length = (uint8_t)(sizeof sentence - 1);
    memcpy(made.text, sentence, sizeof sentence - 1);
    for (int i = draw_within(0, 2); i > 0; i--) {
        made.text[draw_below(made.length)] = (char)draw_within(0, 127);
    }
    osiris_telemetry_parser *parser = OR_NULL(draw_state(&made, sizeof made));
    osiris_telemetry *telemetry = OR_NULL(draw_results(sizeof *telemetry));
    CALL(osiris_telemetry_parse(telemetry, parser, draw_chance(2) ? '\n' : (char)draw_within(0, 127)));
}

static void remote_init(void)
{
    const osiris_plan *plan = any_plan();
    osiris_remote *remote = OR_NULL(draw_results(sizeof *remote));
    osiris_remote_device *devices = OR_NULL(draw_results(DEVICES * sizeof *devices));
    CALL(osiris_remote_init(remote, devices, plan, draw_int(0, 1)));
}

/* Of a good plan; rarely null. Its plan's device i is *device. */
static osiris_remote *any_remote(const osiris_device **device)
{
    osiris_device made_devices[DEVICES];
    osiris_plan made = plan_of(made_devices);
    osiris_remote *remote = draw_state(NULL, sizeof *remote);
    osiris_remote_device *devices = draw_state(NULL, DEVICES * sizeof *devices);
    const osiris_device *given = draw_given(made_devices, sizeof made_devices);
    made.devices = given;
    const osiris_plan *plan = draw_given(&made, sizeof made);
    *device = given + draw_below(DEVICES);
    return osiris_remote_init(remote, devices, plan, 0) == IRIS_OK ? OR_NULL(remote) : NULL;
}

static void remote_take(void)
{
    static const char sentence[] = "$PIRIV,42,range,1,V,1234*2E\r\n";
    const osiris_device *device;
    osiris_remote *remote = any_remote(&device);
    const size_t count = draw_below(sizeof sentence);
    const void *bytes = OR_NULL(draw_given(draw_chance(2) ? sentence : NULL, count));
    CALL(osiris_remote_take(remote, bytes, count, 5));
}

static void remote_read(void)
{
    const osiris_device *device;
    osiris_remote *remote = any_remote(&device);
    if (remote && draw_chance(2)) {
        remote->devices[draw_below((uint32_t)remote->plan->device_count)].is_new = 1;
    }
    osiris_raw *raw = OR_NULL(draw_results(sizeof *raw));
    CALL(osiris_remote_read(remote, raw, OR_NULL(device)));
}

static void remote_tell(void)
{
    const osiris_device *device;
    const osiris_raw made = {OSIRIS_DRIVE,
                             OSIRIS_VALID,
                             0,
                             {draw_int(-65536000, 65536000), draw_int(-99, 99), draw_int(-9999999, 9999999),
                              draw_int(-5000, 5000)}};
    osiris_remote *remote = any_remote(&device);
    char *sentences = OR_NULL(draw_results(OSIRIS_REMOTE_BYTES));
    size_t *length = OR_NULL(draw_results(sizeof *length));
    const osiris_raw *raw = OR_NULL(draw_given(&made, sizeof made));
    CALL(osiris_remote_tell(sentences, length, remote, OR_NULL(device), raw));
}

const random_call calls_robot[] = {{"osiris_device_check", device_check},
                                   {"osiris_drive_check", drive_check},
                                   {"osiris_drive_init", drive_init},
                                   {"osiris_plan_check", plan_check},
                                   {"osiris_robot_init", robot_init},
                                   {"osiris_robot_bind", bind},
                                   {"osiris_robot_sense", sense},
                                   {"osiris_robot_drive", drive},
                                   {"osiris_robot_glide", glide},
                                   {"osiris_robot_stop", stop},
                                   {"osiris_robot_tell", tell},
                                   {"osiris_world_check", world_check},
                                   {"osiris_simulated_init", simulated_init},
                                   {"osiris_simulated_step", simulated_step},
                                   {"osiris_telemetry_parse", telemetry_parse},
                                   {"osiris_remote_init", remote_init},
                                   {"osiris_remote_take", remote_take},
                                   {"osiris_remote_read", remote_read},
                                   {"osiris_remote_tell", remote_tell},
                                   {NULL, NULL}};
