/* A simulated robot in worlds made by hand. */
#include "iris/osiris/simulated.h"

#include <math.h>

#include "test.h"

static const osiris_segment walls[] = {
    {0, 0, 4000, 0}, {4000, 0, 4000, 3000}, {4000, 3000, 0, 3000}, {0, 3000, 0, 0}};
static const osiris_segment lines[] = {{0, 1000, 4000, 1000}};
static const osiris_object objects[] = {{3000, 2000, 50, 0xFF8000}};
static const osiris_world room = {walls, lines, objects, NULL, 4, 1, 1, 0};

enum { RANGE, CAMERA, LINE, BUMP, ODOMETRY, COMPASS, BATTERY, DRIVE, LIGHT, COUNT };
static osiris_device devices[COUNT];
static osiris_simulated_device states[COUNT];
static osiris_plan plan;
static osiris_simulated robot;

static void begin(osiris_drive_kind kind, int32_t x, int32_t y, int32_t degrees, uint32_t seed)
{
    static const osiris_kind kinds[COUNT] = {OSIRIS_RANGE,   OSIRIS_CAMERA,   OSIRIS_LINE,
                                             OSIRIS_BUMP,    OSIRIS_ODOMETRY, OSIRIS_HEADING,
                                             OSIRIS_BATTERY, OSIRIS_DRIVE,    OSIRIS_LIGHT};
    for (int i = 0; i < COUNT; i++) {
        osiris_device_defaults(&devices[i], kinds[i]);
        devices[i].place.x_mm = i == RANGE || i == LINE ? 80 : 0;
    }
    memset(&plan, 0, sizeof plan);
    plan.length_mm = plan.width_mm = 200;
    plan.driver_count = 1;
    plan.devices = devices;
    plan.device_count = COUNT;
    osiris_drive_defaults(&plan.drive, kind);
    const osiris_pose start = {x, y, iris_angle_from_degrees(degrees)};
    assert_int_equal(osiris_simulated_init(&robot, states, &plan, &room, start, seed), IRIS_OK);
    assert_int_equal(osiris_simulated_driver.open(&robot, 0), IRIS_OK);
}

static iris_status read_one(osiris_raw *raw, int device)
{
    return osiris_simulated_driver.read(&robot, raw, &devices[device], robot.now_ms);
}

static void tell(int32_t mms, int32_t left, int32_t turn)
{
    const osiris_raw raw = {
        OSIRIS_DRIVE, OSIRIS_VALID, robot.now_ms, {mms * 65536, left * 65536, turn * 256, 0}};
    assert_int_equal(osiris_simulated_driver.write(&robot, &devices[DRIVE], &raw, robot.now_ms), IRIS_OK);
}

static void drives_as_told(void **state)
{
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        begin((osiris_drive_kind)kind, 1000, 1500, 0, 1);
        for (uint32_t ms = 0; ms < 2000; ms += 50) {
            tell(300, 0,
                 -8192); /* an eighth of a turn a second to the left: a quarter circle of 382 mm radius */
            assert_int_equal(osiris_simulated_step(&robot, ms + 50), IRIS_OK);
        }
        const osiris_pose pose = osiris_track_pose(&robot.track);
        assert_true(abs(pose.heading - 16384) < 40);
        assert_true(abs(pose.x_mm - 1382) <= 2 && abs(pose.y_mm - 1882) <= 2);
        assert_int_equal(robot.way_q16 / 65536, 600);
    }
    begin(OSIRIS_OMNI, 1000, 1500, 90, 1);
    tell(0, 200, 0);
    osiris_simulated_step(&robot, 400);
    assert_int_equal(osiris_track_pose(&robot.track).x_mm, 920);
    begin(OSIRIS_DIFFERENTIAL, 1000, 1500, 90, 1);
    tell(0, 200, 0); /* cannot */
    osiris_simulated_step(&robot, 400);
    assert_int_equal(osiris_track_pose(&robot.track).x_mm, 1000);
}

static void stands_still_when_left_alone(void **state)
{
    (void)state;
    begin(OSIRIS_DIFFERENTIAL, 1000, 1500, 0, 1);
    tell(200, 0, 0);
    osiris_simulated_step(&robot, 3000);
    assert_int_equal(osiris_track_pose(&robot.track).x_mm, 1100); /* for half a second */
    tell(200, 0, 0);
    osiris_simulated_step(&robot, 3100);
    osiris_simulated_driver.close(&robot, 3100);
    osiris_simulated_step(&robot, 3400);
    assert_int_equal(osiris_track_pose(&robot.track).x_mm, 1120);
}

static void senses(void **state)
{
    (void)state;
    osiris_raw raw;
    begin(OSIRIS_DIFFERENTIAL, 2500, 1980, 0, 1);
    devices[RANGE].width = 0;
    osiris_simulated_step(&robot, 0);
    assert_int_equal(read_one(&raw, RANGE), IRIS_OK);
    assert_int_equal(raw.validity, OSIRIS_VALID);
    assert_true(abs(raw.values[0] - (500 - 80 - 46)) <= 1); /* the thing, 20 mm aside of its middle */
    assert_int_equal(read_one(&raw, RANGE), IRIS_ERR_TIMEOUT);
    assert_int_equal(read_one(&raw, CAMERA), IRIS_OK);
    assert_int_equal(raw.values[0], 500);
    assert_int_equal(raw.values[1], 20);
    assert_int_equal(raw.values[2], 0xFF8000);
    assert_int_equal(raw.values[3], 50);
    assert_int_equal(read_one(&raw, LINE), IRIS_OK);
    assert_int_equal(raw.validity, OSIRIS_BEYOND);
    assert_int_equal(read_one(&raw, BUMP), IRIS_OK);
    assert_int_equal(raw.values[0], 0);
    assert_int_equal(read_one(&raw, BATTERY), IRIS_OK);
    assert_int_equal(raw.values[0], 8400);
    assert_int_equal(read_one(&raw, COMPASS), IRIS_OK);
    assert_int_equal(raw.values[0], 0);
    assert_int_equal(read_one(&raw, LIGHT), IRIS_ERR_UNSUPPORTED);
    begin(OSIRIS_DIFFERENTIAL, 2500, 1980, 180, 1); /* looks the other way, at the wall 2420 mm away */
    osiris_simulated_step(&robot, 10);
    assert_int_equal(read_one(&raw, RANGE), IRIS_OK);
    assert_int_equal(raw.validity, OSIRIS_BEYOND);
    assert_int_equal(read_one(&raw, CAMERA), IRIS_OK);
    assert_int_equal(raw.validity, OSIRIS_BEYOND);
    begin(OSIRIS_DIFFERENTIAL, 1000, 1030, 0, 1);
    osiris_simulated_step(&robot, 10);
    assert_int_equal(read_one(&raw, LINE), IRIS_OK);
    assert_int_equal(raw.validity, OSIRIS_VALID);
    assert_int_equal(raw.values[0], 30);
    assert_int_equal(raw.values[1], 0);
    robot.endurance_s = 100;
    osiris_simulated_step(&robot, 50000);
    assert_int_equal(read_one(&raw, BATTERY), IRIS_OK);
    assert_int_equal(raw.values[0], 7400);
}

static void walls_stop_it(void **state)
{
    (void)state;
    osiris_raw raw;
    begin(OSIRIS_DIFFERENTIAL, 3500, 1500, 0, 1);
    for (uint32_t ms = 0; ms < 2000; ms += 100) {
        tell(400, 0, 0);
        osiris_simulated_step(&robot, ms + 100);
    }
    const osiris_pose pose = osiris_track_pose(&robot.track);
    assert_true(pose.x_mm >= 3894 && pose.x_mm <= 3900);
    assert_int_equal(robot.touches, 1);
    assert_int_equal(robot.touched, 1);
    assert_int_equal(read_one(&raw, BUMP), IRIS_OK);
    assert_int_equal(raw.values[0], 1);
    assert_int_equal(read_one(&raw, ODOMETRY), IRIS_OK);
    assert_int_equal(raw.values[0], pose.x_mm - 3500); /* wheels stand, too */
    tell(-400, 0, 0);                                  /* away from it */
    osiris_simulated_step(&robot, 2200);
    assert_int_equal(robot.touches, 0);
    assert_true(osiris_track_pose(&robot.track).x_mm < 3830);
    assert_int_equal(read_one(&raw, BUMP), IRIS_OK);
    assert_int_equal(raw.values[0], 0);
}

/* Rate and latency: what was true so long ago, so often. */
static void time_of_readings(void **state)
{
    (void)state;
    osiris_raw raw;
    int count = 0;
    begin(OSIRIS_DIFFERENTIAL, 1000, 500, 0, 1);
    devices[ODOMETRY].period_ms = 100;
    devices[ODOMETRY].latency_ms = 30;
    for (uint32_t ms = 0; ms < 2000; ms += 10) {
        tell(100, 0, 0);
        osiris_simulated_step(&robot, ms);
        if (read_one(&raw, ODOMETRY) == IRIS_OK) {
            assert_int_equal(raw.time_ms % 100, 30);
            assert_int_equal(raw.values[0], (raw.time_ms - 30) / 10);
            count++;
        }
    }
    assert_int_equal(count, 20);
}

static void noise_is_as_said(void **state)
{
    (void)state;
    osiris_raw raw;
    double sum = 0, squares = 0;
    int32_t first[400] = {0};
    for (int run = 0; run < 2; run++) {
        begin(OSIRIS_DIFFERENTIAL, 2000, 500, 0, 77);
        devices[RANGE].width = 0;
        devices[RANGE].deviation = 20;
        devices[RANGE].resolution = 5;
        devices[RANGE].error_permil = 10;
        for (int i = 0; i < 400; i++) {
            osiris_simulated_step(&robot, (uint32_t)i * 50);
            assert_int_equal(read_one(&raw, RANGE), IRIS_OK);
            assert_int_equal(raw.values[0] % 5, 0);
            assert_true(run == 0 || raw.values[0] == first[i]);
            first[i] = raw.values[0];
            sum += run ? 0 : raw.values[0];
            squares += run ? 0 : (double)raw.values[0] * raw.values[0];
        }
    }
    const double mean = sum / 400, deviation = sqrt(squares / 400 - mean * mean);
    assert_true(fabs(mean - 1920) < 8);      /* 3920 - 2000 */
    assert_true(fabs(deviation - 39.2) < 5); /* 20 and 1 % of 1920 */
}

static void refuses(void **state)
{
    (void)state;
    const osiris_pose start = {0, 0, 0}, far = {OSIRIS_PLACE_MAX_MM, 0, 0};
    osiris_plan bad;
    begin(OSIRIS_DIFFERENTIAL, 1000, 500, 0, 1);
    bad = plan;
    assert_int_equal(osiris_simulated_init(NULL, states, &plan, &room, start, 0), IRIS_ERR_ARG);
    assert_int_equal(osiris_simulated_init(&robot, NULL, &plan, &room, start, 0), IRIS_ERR_ARG);
    assert_int_equal(osiris_simulated_init(&robot, states, NULL, &room, start, 0), IRIS_ERR_ARG);
    assert_int_equal(osiris_simulated_init(&robot, states, &plan, NULL, start, 0), IRIS_ERR_ARG);
    assert_int_equal(osiris_simulated_init(&robot, states, &plan, &room, far, 0), IRIS_ERR_RANGE);
    assert_int_equal(osiris_simulated_step(NULL, 0), IRIS_ERR_ARG);
    osiris_simulated_begin(NULL, 0);
    bad.driver_count = 0;
    assert_int_equal(osiris_plan_check(&bad), IRIS_ERR_ARG);
    bad = plan;
    bad.width_mm = 0;
    assert_int_equal(osiris_plan_check(&bad), IRIS_ERR_ARG);
    devices[LIGHT].kind = OSIRIS_RANGE; /* a second one of this channel */
    assert_int_equal(osiris_plan_check(&plan), IRIS_ERR_ARG);
    devices[LIGHT].channel = 1;
    assert_int_equal(osiris_plan_check(&plan), IRIS_OK);
    strcpy(devices[LIGHT].name, "eye");
    strcpy(devices[BUMP].name, "eye");
    assert_int_equal(osiris_plan_check(&plan), IRIS_ERR_ARG);
    strcpy(devices[BUMP].name, "nose");
    assert_int_equal(osiris_plan_check(&plan), IRIS_OK);
    assert_int_equal(osiris_plan_find(&plan, "nose"), BUMP);
    assert_int_equal(osiris_plan_find(&plan, "no"), -1);
    assert_int_equal(osiris_plan_find(&plan, ""), -1);
    devices[LIGHT].driver = 1;
    assert_int_equal(osiris_plan_check(&plan), IRIS_ERR_ARG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drives_as_told),   cmocka_unit_test(stands_still_when_left_alone),
        cmocka_unit_test(senses),           cmocka_unit_test(walls_stop_it),
        cmocka_unit_test(time_of_readings), cmocka_unit_test(noise_is_as_said),
        cmocka_unit_test(refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
