/* What robots answer, by readings made by hand; and driving, of three kinds of robots in a simulated world. */
#include "iris/osiris/robot.h"

#include <math.h>

#include "iris/osiris/robot_text.h"
#include "iris/osiris/simulated.h"
#include "test.h"

static osiris_plan plan;
static osiris_device devices[OSIRIS_DEVICES_MAX];
static osiris_reading readings[OSIRIS_DEVICES_MAX];
static osiris_robot robot;

/* A driver whose readings are made by hand. */
static osiris_raw hand[OSIRIS_DEVICES_MAX], told;
static iris_status answers;
static int opened;

static iris_status hand_open(void *context, uint32_t now_ms)
{
    (void)context;
    (void)now_ms;
    opened++;
    return answers;
}

static iris_status hand_read(void *context, osiris_raw *raw, const osiris_device *device, uint32_t now_ms)
{
    (void)context;
    (void)now_ms;
    const osiris_raw *found = &hand[device - devices];
    if (answers != IRIS_OK || found->validity == OSIRIS_NEVER) {
        return answers != IRIS_OK ? answers : IRIS_ERR_TIMEOUT;
    }
    *raw = *found;
    raw->kind = device->kind;
    return IRIS_OK;
}

static iris_status hand_write(void *context, const osiris_device *device, const osiris_raw *raw,
                              uint32_t now_ms)
{
    (void)context;
    (void)device;
    (void)now_ms;
    told = *raw;
    return answers;
}

static void hand_close(void *context, uint32_t now_ms)
{
    (void)context;
    (void)now_ms;
    opened--;
}

static const osiris_driver by_hand = {hand_open, hand_read, hand_write, hand_close};

static const char text[] = "robot tester\n"
                           "body 200 160\n"
                           "drive differential track 150\n"                      /* 0 */
                           "range front at 100 0 facing 0 cone 10 to 2000\n"     /* 1 */
                           "range fleft at 90 60 facing 30 cone 10 to 2000\n"    /* 2 */
                           "range fright at 90 -60 facing -30 cone 10 to 2000\n" /* 3 */
                           "range back at -100 0 facing 180 cone 10 to 1000\n"   /* 4 */
                           "camera eye to 3000\n"                                /* 5 */
                           "camera side facing 90 to 3000\n"                     /* 6 */
                           "line tape at 80 0\n"                                 /* 7 */
                           "bump left facing 45 cone 90\n"                       /* 8 */
                           "bump right facing -45 cone 90\n"                     /* 9 */
                           "odometry wheels\n"                                   /* 10 */
                           "heading compass\n"                                   /* 11 */
                           "battery one\nbattery two\n"                          /* 12, 13 */
                           "light lamp\n"                                        /* 14 */
                           "gripper hand\n";                                     /* 15 */

static void begin(const char *of)
{
    osiris_problem problem;
    memset(hand, 0, sizeof hand);
    answers = IRIS_OK;
    opened = 0;
    assert_int_equal(osiris_robot_read_text(&plan, devices, OSIRIS_DEVICES_MAX, &problem, of, strlen(of)),
                     IRIS_OK);
    assert_int_equal(osiris_robot_init(&robot, readings, &plan), IRIS_OK);
    assert_int_equal(osiris_robot_bind(&robot, 0, &by_hand, NULL, 0), IRIS_OK);
}

static void says(int device, int32_t a, int32_t b, int32_t c)
{
    const osiris_raw raw = {OSIRIS_NOTHING, OSIRIS_VALID, 100, {a, b, c, 0}};
    hand[device] = raw;
    assert_int_equal(osiris_robot_sense(&robot, 100), IRIS_OK);
}

static void says_nothing(int device)
{
    says(device, 0, 0, 0);
    hand[device].validity = OSIRIS_BEYOND;
    assert_int_equal(osiris_robot_sense(&robot, 100), IRIS_OK);
}

static void finds_nearest_first(void **state)
{
    (void)state;
    int32_t found[4] = {-1, -1, -1, -1}, count = 0;
    const osiris_query forward = {OSIRIS_RANGE, 0, 5461}, behind = {OSIRIS_RANGE, -32768, 5461},
                       none = {OSIRIS_SOUND, 0, 32768}, any = {OSIRIS_RANGE, 0, 32768};
    begin(text);
    assert_int_equal(osiris_robot_find(found, 4, &count, &robot, &forward), IRIS_OK);
    assert_int_equal(count, 3); /* none knows: the one that looks there first */
    assert_int_equal(found[0], 1);
    says(1, 500, 0, 0);
    says(2, 700, 0, 0);
    says(3, 300, 0, 0);
    assert_int_equal(osiris_robot_find(found, 4, &count, &robot, &forward), IRIS_OK);
    assert_int_equal(count, 3);
    assert_int_equal(found[0], 3);
    assert_int_equal(found[1], 1);
    assert_int_equal(found[2], 2);
    assert_int_equal(osiris_robot_find(found, 2, &count, &robot, &any), IRIS_ERR_FULL);
    assert_int_equal(count, 4);
    assert_int_equal(found[0], 3);
    assert_int_equal(found[1], 1);
    assert_int_equal(osiris_robot_find(found, 4, &count, &robot, &behind), IRIS_OK);
    assert_int_equal(count, 1);
    assert_int_equal(found[0], 4);
    assert_int_equal(osiris_robot_find(found, 4, &count, &robot, &none), IRIS_OK);
    assert_int_equal(count, 0);
    assert_int_equal(osiris_robot_find(NULL, 0, &count, &robot, &any), IRIS_ERR_FULL);
    assert_int_equal(osiris_robot_find(NULL, 4, &count, &robot, &any), IRIS_ERR_ARG);
    assert_int_equal(osiris_robot_find(found, 4, NULL, &robot, &any), IRIS_ERR_ARG);
    assert_int_equal(osiris_robot_find(found, 4, &count, NULL, &any), IRIS_ERR_ARG);
    assert_int_equal(osiris_robot_find(found, 4, &count, &robot, NULL), IRIS_ERR_ARG);
}

static void obstacles(void **state)
{
    (void)state;
    osiris_obstacle o = {0, 0, 0, 0};
    begin(text);
    assert_int_equal(osiris_robot_obstacle(&o, &robot, 0), IRIS_ERR_TIMEOUT);
    assert_int_equal(osiris_robot_obstacle(&o, &robot, 16384), IRIS_ERR_UNSUPPORTED);
    says(1, 500, 0, 0);
    assert_int_equal(osiris_robot_obstacle(&o, &robot, 0), IRIS_OK);
    assert_int_equal(o.seen, 1);
    assert_int_equal(o.distance_mm, 500); /* its place is at the body's edge */
    assert_int_equal(o.device, 1);
    says(2, 400, 0, 0); /* 60 + 200 aside: not in the way */
    assert_int_equal(osiris_robot_obstacle(&o, &robot, 0), IRIS_OK);
    assert_int_equal(o.distance_mm, 500);
    says(3, 100, 0, 0); /* 60 + 50 aside, its cone reaches 9 back: not in 80 */
    assert_int_equal(osiris_robot_obstacle(&o, &robot, 0), IRIS_OK);
    assert_int_equal(o.distance_mm, 500);
    says(3, 40, 0, 0); /* 60 + 20, in it: 90 + 34.6 - 100 ahead */
    assert_int_equal(osiris_robot_obstacle(&o, &robot, 0), IRIS_OK);
    assert_int_equal(o.distance_mm, 25);
    assert_int_equal(o.device, 3);
    says_nothing(1);
    says_nothing(2);
    says(3, 1000, 0, 0);
    assert_int_equal(osiris_robot_obstacle(&o, &robot, 0), IRIS_OK);
    assert_int_equal(o.seen, 0);
    assert_int_equal(o.distance_mm, 856); /* 90 + 866 - 100: so far the right one knows */
    says(4, 300, 0, 0);
    assert_int_equal(osiris_robot_obstacle(&o, &robot, -32768), IRIS_OK);
    assert_int_equal(o.distance_mm, 300);
    assert_int_equal(osiris_robot_obstacle(NULL, &robot, 0), IRIS_ERR_ARG);
    assert_int_equal(osiris_robot_obstacle(&o, NULL, 0), IRIS_ERR_ARG);
}

static void where_things_are(void **state)
{
    (void)state;
    osiris_sight sight;
    osiris_pose pose;
    iris_angle heading;
    const osiris_pose at = {1000, 2000, 16384};
    begin(text);
    assert_int_equal(osiris_robot_pose(&pose, &robot), IRIS_ERR_TIMEOUT);
    assert_int_equal(osiris_robot_place(&robot, at), IRIS_ERR_TIMEOUT);
    says(10, 500, 100, 8192);
    assert_int_equal(osiris_robot_place(&robot, at), IRIS_OK);
    assert_int_equal(osiris_robot_pose(&pose, &robot), IRIS_OK);
    assert_true(abs(pose.x_mm - 1000) <= 1 && abs(pose.y_mm - 2000) <= 1 && pose.heading == 16384);
    says(10, 571, 171, 8192); /* 100 on, as odometry's ahead is */
    assert_int_equal(osiris_robot_pose(&pose, &robot), IRIS_OK);
    assert_true(abs(pose.x_mm - 1000) <= 1 && abs(pose.y_mm - 2100) <= 1);
    assert_int_equal(osiris_robot_object(&sight, &robot), IRIS_ERR_TIMEOUT);
    says_nothing(5);
    assert_int_equal(osiris_robot_object(&sight, &robot), IRIS_ERR_END);
    says(6, 300, 400, 0xFF);
    assert_int_equal(osiris_robot_object(&sight, &robot), IRIS_OK);
    assert_int_equal(sight.distance_mm, 500);
    assert_int_equal(sight.device, 6);
    assert_int_equal(sight.color, 0xFF);
    assert_true(abs(sight.x_mm - 600) <= 2 && abs(sight.y_mm - 2400) <= 2); /* left of north is west */
    assert_true(abs(iris_angle_to_centidegrees(sight.direction) - 5313) <= 1);
    says(5, 200, 0, 0xFF0000);
    assert_int_equal(osiris_robot_object(&sight, &robot), IRIS_OK);
    assert_int_equal(sight.device, 5);
    assert_int_equal(osiris_robot_heading(&heading, &robot), IRIS_ERR_TIMEOUT);
    says(11, 12345, 0, 0);
    assert_int_equal(osiris_robot_heading(&heading, &robot), IRIS_OK);
    assert_int_equal(heading, 12345);
}

static void other_answers(void **state)
{
    (void)state;
    osiris_line line;
    int32_t number = -1;
    begin(text);
    assert_int_equal(osiris_robot_line(&line, &robot), IRIS_ERR_TIMEOUT);
    says_nothing(7);
    assert_int_equal(osiris_robot_line(&line, &robot), IRIS_ERR_END);
    says(7, 25, -2000, 0);
    assert_int_equal(osiris_robot_line(&line, &robot), IRIS_OK);
    assert_int_equal(line.offset_mm, 25);
    assert_int_equal(line.ahead_mm, 80);
    assert_int_equal(line.angle, -2000);
    assert_int_equal(osiris_robot_bumped(&number, &robot, 0, 32768), IRIS_ERR_TIMEOUT);
    says(8, 0, 0, 0);
    says(9, 1, 0, 0);
    assert_int_equal(osiris_robot_bumped(&number, &robot, 0, 32768), IRIS_OK);
    assert_int_equal(number, 1);
    assert_int_equal(osiris_robot_bumped(&number, &robot, 8192, 5000), IRIS_OK);
    assert_int_equal(number, 0);
    assert_int_equal(osiris_robot_bumped(&number, &robot, -32768, 5000), IRIS_ERR_UNSUPPORTED);
    assert_int_equal(osiris_robot_battery(&number, &robot), IRIS_ERR_TIMEOUT);
    says(12, 7400, 0, 0);
    says(13, 6600, 0, 0);
    assert_int_equal(osiris_robot_battery(&number, &robot), IRIS_OK);
    assert_int_equal(number, 100);
    begin("robot bare\ndrive omni wheels 3 radius 100\n");
    osiris_pose pose;
    osiris_sight sight;
    iris_angle heading;
    assert_int_equal(osiris_robot_battery(&number, &robot), IRIS_ERR_UNSUPPORTED);
    assert_int_equal(osiris_robot_line(&line, &robot), IRIS_ERR_UNSUPPORTED);
    assert_int_equal(osiris_robot_object(&sight, &robot), IRIS_ERR_UNSUPPORTED);
    for (uint32_t ms = 0; ms <= 2000; ms += 20) { /* knows where it is by what it was told */
        assert_int_equal(osiris_robot_drive(&robot, 200, 0, ms), IRIS_OK);
    }
    assert_int_equal(osiris_robot_pose(&pose, &robot), IRIS_OK);
    assert_true(abs(pose.x_mm - 380) <= 6); /* 200 mm/s for 2 s, less 0.1 s of the ramp */
    assert_int_equal(osiris_robot_heading(&heading, &robot), IRIS_OK);
    assert_int_equal(heading, 0);
}

static void drivers_fail(void **state)
{
    (void)state;
    begin(text);
    says(1, 500, 0, 0);
    answers = IRIS_ERR_IO;
    assert_int_equal(osiris_robot_sense(&robot, 120), IRIS_ERR_IO);
    assert_int_equal(readings[1].validity, OSIRIS_BROKEN);
    assert_int_equal(osiris_robot_drive(&robot, 100, 0, 120), IRIS_ERR_IO);
    answers = IRIS_OK;
    assert_int_equal(osiris_robot_sense(&robot, 140), IRIS_OK);
    assert_int_equal(readings[1].validity, OSIRIS_VALID);
    hand[1].validity = OSIRIS_NEVER;
    assert_int_equal(osiris_robot_sense(&robot, 10000), IRIS_OK);
    assert_int_equal(readings[1].validity, OSIRIS_STALE);
    assert_int_equal(opened, 1);
    osiris_robot_close(&robot, 10000);
    osiris_robot_close(&robot, 10000);
    osiris_robot_close(NULL, 10000);
    assert_int_equal(opened, 0);
    assert_int_equal(osiris_robot_drive(&robot, 100, 0, 10020), IRIS_ERR_UNSUPPORTED);
    answers = IRIS_ERR_UNSUPPORTED;
    assert_int_equal(osiris_robot_bind(&robot, 0, &by_hand, NULL, 0), IRIS_ERR_UNSUPPORTED);
    assert_int_equal(osiris_robot_stop(&robot, 10040), IRIS_ERR_UNSUPPORTED);
    assert_int_equal(osiris_robot_bind(&robot, 1, &by_hand, NULL, 0), IRIS_ERR_ARG);
    assert_int_equal(osiris_robot_bind(&robot, 0, NULL, NULL, 0), IRIS_ERR_ARG);
}

static void actuators(void **state)
{
    (void)state;
    const int32_t values[OSIRIS_VALUES] = {0x123456, 0, 0, 0}, open[OSIRIS_VALUES] = {5000, 0, 0, 0};
    begin(text);
    assert_int_equal(osiris_robot_tell(&robot, 14, values, 20), IRIS_OK);
    assert_int_equal(told.kind, OSIRIS_LIGHT);
    assert_int_equal(told.values[0], 0x123456);
    assert_int_equal(osiris_robot_tell(&robot, 15, open, 20), IRIS_OK);
    assert_int_equal(told.values[0], 1000);
    assert_int_equal(osiris_robot_tell(&robot, 0, values, 20), IRIS_ERR_ARG); /* the drive */
    assert_int_equal(osiris_robot_tell(&robot, 1, values, 20), IRIS_ERR_ARG); /* a sensor */
    assert_int_equal(osiris_robot_tell(&robot, -1, values, 20), IRIS_ERR_ARG);
    assert_int_equal(osiris_robot_tell(&robot, 16, values, 20), IRIS_ERR_ARG);
    assert_int_equal(osiris_robot_tell(&robot, 14, NULL, 20), IRIS_ERR_ARG);
    for (uint32_t ms = 0; ms < 1000; ms += 50) {
        assert_int_equal(osiris_robot_drive(&robot, 300, 0, ms), IRIS_OK);
    }
    assert_int_equal(told.kind, OSIRIS_DRIVE);
    assert_int_equal(told.values[0], 300 * 65536);
    assert_int_equal(osiris_robot_drive(&robot, 300, 0, 5000), IRIS_OK); /* it stood still meanwhile */
    assert_int_equal(told.values[0], 0);
    assert_int_equal(osiris_robot_drive(&robot, 300, 0, 5050), IRIS_OK);
    assert_int_equal(told.values[0], 50 * 65536);
    assert_int_equal(osiris_robot_stop(&robot, 5100), IRIS_OK);
    assert_int_equal(told.values[0], 0);
}

/* --- one behavior, three drives --- */

static const osiris_segment far_wall[] = {{9000, -9000, 9000, 9000}};
static const osiris_world floor_world = {far_wall, NULL, NULL, NULL, 1, 0, 0, 0};
static osiris_simulated simulated;
static osiris_simulated_device states[OSIRIS_DEVICES_MAX];
static uint32_t now_ms;

static osiris_pose sensed(void)
{
    osiris_pose pose = {0, 0, 0};
    now_ms += 20;
    assert_int_equal(osiris_simulated_step(&simulated, now_ms), IRIS_OK);
    assert_int_equal(osiris_robot_sense(&robot, now_ms), IRIS_OK);
    assert_int_equal(osiris_robot_pose(&pose, &robot), IRIS_OK);
    return pose;
}

/* Goes to a place: turns there where it stands, then drives and keeps to it. */
static void go(int32_t x, int32_t y)
{
    for (int steps = 0; steps < 3000; steps++) {
        const osiris_pose pose = sensed(), there = {x, y, 0};
        const osiris_pose step = osiris_pose_step(pose, there);
        const int32_t aside = iris_atan2_angle(step.y_mm, step.x_mm),
                      far = (int32_t)iris_hypot(step.x_mm, step.y_mm);
        if (far < 15) {
            break;
        }
        const int32_t turn = -aside * 2;
        assert_int_equal(abs(aside) > 5000 ? osiris_robot_drive(&robot, 0, turn, now_ms)
                                           : osiris_robot_drive(&robot, far > 100 ? 250 : 80, turn, now_ms),
                         IRIS_OK);
    }
    for (int steps = 0; steps < 40; steps++) {
        (void)sensed();
        assert_int_equal(osiris_robot_drive(&robot, 0, 0, now_ms), IRIS_OK);
    }
}

static void one_course_by_three_drives(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "robot a\ndrive differential track 150\nodometry wheels\n",
        "robot b\ndrive ackermann track 160 wheelbase 180 steering 30\nodometry wheels\n",
        "robot c\ndrive omni wheels 3 radius 100\nodometry wheels\n"};
    static const int32_t places[][2] = {{1500, 0}, {1500, 1200}, {0, 1200}, {0, 0}};
    const osiris_pose start = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        begin(texts[i]);
        now_ms = 0;
        assert_int_equal(osiris_simulated_init(&simulated, states, &plan, &floor_world, start, 3), IRIS_OK);
        assert_int_equal(osiris_robot_bind(&robot, 0, &osiris_simulated_driver, &simulated, 0), IRIS_OK);
        for (int k = 0; k < 4; k++) {
            go(places[k][0], places[k][1]);
            const osiris_pose pose = osiris_track_pose(&simulated.track);
            assert_true(hypot(pose.x_mm - places[k][0], pose.y_mm - places[k][1]) < 40);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_nearest_first),
        cmocka_unit_test(obstacles),
        cmocka_unit_test(where_things_are),
        cmocka_unit_test(other_answers),
        cmocka_unit_test(drivers_fail),
        cmocka_unit_test(actuators),
        cmocka_unit_test(one_course_by_three_drives),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
