/* Places on the floor, beside doubles. */
#include "iris/osiris/pose.h"

#include <math.h>

#include "random_within.h"
#include "test.h"

static const double turn = 6.28318530717958648;

static void steps_lead_there_and_back(void **state)
{
    (void)state;
    for (int i = 0; i < 2000; i++) {
        const osiris_pose a = {random_within(-100000, 100000), random_within(-100000, 100000),
                               (iris_angle)random_within(-32768, 32767)};
        const osiris_pose b = {random_within(-100000, 100000), random_within(-100000, 100000),
                               (iris_angle)random_within(-32768, 32767)};
        const osiris_pose step = osiris_pose_step(a, b), again = osiris_pose_after(a, step);
        const double angle = a.heading / 65536.0 * turn;
        const double x = (b.x_mm - a.x_mm) * cos(angle) + (b.y_mm - a.y_mm) * sin(angle);
        const double y = (b.y_mm - a.y_mm) * cos(angle) - (b.x_mm - a.x_mm) * sin(angle);
        assert_true(fabs(step.x_mm - x) < 0.51 && fabs(step.y_mm - y) < 0.51);
        assert_true(abs(again.x_mm - b.x_mm) <= 1 && abs(again.y_mm - b.y_mm) <= 1);
        assert_int_equal(again.heading, b.heading);
    }
}

static void by_hand(void **state)
{
    (void)state;
    const osiris_pose north = {100, 200, 16384}, step = {30, 5, -16384};
    const osiris_pose there = osiris_pose_after(north, step);
    assert_int_equal(there.x_mm, 95); /* what is to the left of north is west */
    assert_int_equal(there.y_mm, 230);
    assert_int_equal(there.heading, 0);
    const osiris_pose far = {INT32_MAX, INT32_MIN, 0}, on = {INT32_MAX, INT32_MIN, -32768};
    const osiris_pose most = osiris_pose_after(far, on);
    assert_int_equal(most.x_mm, INT32_MAX);
    assert_int_equal(most.y_mm, INT32_MIN);
}

/* An arc has a circle to be on. */
static void a_track_is_an_arc(void **state)
{
    (void)state;
    for (int i = 0; i < 60; i++) {
        const double v = random_within(-500, 500), w = random_within(1000, 60000) * (i % 2 ? 1 : -1);
        const osiris_velocity velocity = {(iris_q16)(v * 65536), 0, (int32_t)(w * 256)};
        const osiris_pose start = {1000, -2000, (iris_angle)random_within(-32768, 32767)};
        osiris_track track = osiris_track_from(start);
        for (int k = 0; k < 100; k++) {
            osiris_track_move(&track, &velocity, 30);
        }
        const double from = start.heading / 65536.0 * turn, rate = -w / 65536 * turn, to = from + rate * 3;
        const double x = 1000 + v / rate * (sin(to) - sin(from)),
                     y = -2000 - v / rate * (cos(to) - cos(from));
        const double heading = start.heading * 65536.0 - w * 3 * 65536;
        assert_true(hypot(track.x_q16 / 65536.0 - x, track.y_q16 / 65536.0 - y) < 0.2);
        assert_true(fabs(remainder(track.heading_q16 - heading, 4294967296.0)) < 300);
    }
}

static void right_is_right(void **state)
{
    (void)state;
    const osiris_velocity right = {100 * 65536, 0, 16384 * 256}, left = {0, 100 * 65536, 0};
    const osiris_pose start = {0, 0, 0};
    osiris_track track = osiris_track_from(start);
    osiris_track_move(&track, &right, 1000); /* a quarter turn */
    assert_true(track.y_q16 < 0);
    assert_int_equal(osiris_track_pose(&track).heading, -16384);
    track = osiris_track_from(start);
    osiris_track_move(&track, &left, 500);
    assert_int_equal(osiris_track_pose(&track).y_mm, 50);
    osiris_track_move(&track, &left, -5);
    osiris_track_move(NULL, &left, 5);
    osiris_track_move(&track, NULL, 5);
    assert_int_equal(osiris_track_pose(&track).y_mm, 50);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_lead_there_and_back),
        cmocka_unit_test(by_hand),
        cmocka_unit_test(a_track_is_an_arc),
        cmocka_unit_test(right_is_right),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
