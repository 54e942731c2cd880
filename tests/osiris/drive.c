/* Drives beside their kinematics in doubles. */
#include "iris/osiris/drive.h"

#include <math.h>

#include "random_within.h"
#include "test.h"

static const double turn = 6.28318530717958648;

static osiris_drive_config made(osiris_drive_kind kind)
{
    osiris_drive_config config;
    osiris_drive_defaults(&config, kind);
    config.track_mm = random_within(50, 1500);
    config.wheelbase_mm = random_within(50, 1500);
    config.radius_mm = random_within(50, 1500);
    config.wheels = random_within(3, 4);
    config.speed_max_mms = 4000;
    config.turn_rate_max = 200000;
    return config;
}

/* What the wheels of the header's formulas do, mm/s; Ackermann's steering in angle units as the third. */
static void true_wheels(double *wheels, const osiris_drive_config *c, double v, double side, double w)
{
    if (c->kind == OSIRIS_OMNI) {
        for (int i = 0; i < c->wheels; i++) {
            const double a = (2 * i + 1) * turn / 2 / c->wheels;
            wheels[i] = -sin(a) * v + cos(a) * side - w * c->radius_mm;
        }
        return;
    }
    wheels[0] = v + w * c->track_mm / 2;
    wheels[1] = v - w * c->track_mm / 2;
    wheels[2] = v == 0 ? 0 : atan(w * c->wheelbase_mm / v) / turn * 65536;
}

static void wheels_and_back(void **state)
{
    (void)state;
    for (int i = 0; i < 900; i++) {
        const osiris_drive_config config = made((osiris_drive_kind)(i % 3));
        osiris_velocity v = {random_within(-2000 * 65536, 2000 * 65536),
                             config.kind == OSIRIS_OMNI ? random_within(-2000 * 65536, 2000 * 65536) : 0,
                             random_within(-200000 * 256, 200000 * 256)};
        osiris_velocity again;
        osiris_wheels wheels;
        double truth[4];
        if (config.kind == OSIRIS_ACKERMANN) {
            assert_int_equal(osiris_drive_limit(&v, &config), IRIS_OK);
        }
        true_wheels(truth, &config, v.ahead_q16 / 65536.0, v.left_q16 / 65536.0,
                    v.turn_q8 / 256.0 / 65536 * turn);
        assert_int_equal(osiris_drive_wheels(&wheels, &config, &v), IRIS_OK);
        assert_int_equal(wheels.count, config.kind == OSIRIS_OMNI ? config.wheels : 2);
        assert_int_equal(osiris_drive_velocity(&again, &config, &wheels), IRIS_OK);
        for (int k = 0; k < wheels.count && config.kind != OSIRIS_ACKERMANN; k++) {
            /* 2 pi and the steps of a wheel's speed */
            assert_true(fabs(wheels.speed_q16[k] - truth[k] * 65536) < 2 + fabs(v.turn_q8 * 1.0) * 4e-5);
        }
        assert_true(abs(again.ahead_q16 - v.ahead_q16) <= 2 && abs(again.left_q16 - v.left_q16) <= 2);
        if (config.kind == OSIRIS_ACKERMANN) {
            const double slope = tan(wheels.steering / 65536.0 * turn),
                         w = v.ahead_q16 / 65536.0 * slope / config.wheelbase_mm / turn * 65536;
            assert_true(fabs(wheels.steering - truth[2]) < 1.1);
            assert_true(fabs(again.turn_q8 / 256.0 - w) < 0.02);
            assert_true(fabs(wheels.speed_q16[0] / 65536.0 - v.ahead_q16 / 65536.0 -
                             w / 65536 * turn * config.track_mm / 2) < 0.01);
        } else {
            assert_true(abs(again.turn_q8 - v.turn_q8) <= 3);
        }
    }
}

static void limits_keep_the_curve(void **state)
{
    (void)state;
    for (int i = 0; i < 900; i++) {
        osiris_drive_config config = made((osiris_drive_kind)(i % 3));
        config.speed_max_mms = random_within(50, 1000);
        config.turn_rate_max = random_within(1000, 100000);
        const osiris_velocity wish = {random_within(-3000 * 65536, 3000 * 65536),
                                      random_within(-3000 * 65536, 3000 * 65536),
                                      random_within(-200000 * 256, 200000 * 256)};
        osiris_velocity v = wish;
        osiris_wheels wheels;
        assert_int_equal(osiris_drive_limit(&v, &config), IRIS_OK);
        assert_int_equal(osiris_drive_wheels(&wheels, &config, &v), IRIS_OK);
        for (int k = 0; k < wheels.count; k++) {
            assert_true(abs(wheels.speed_q16[k]) <= config.speed_max_mms * 65536 + 70);
        }
        assert_true(abs(v.turn_q8) <= config.turn_rate_max * 256 * 1.001 + 2);
        if (config.kind == OSIRIS_ACKERMANN) {
            assert_true(abs(wheels.steering) <= config.steering_max);
        } else { /* the same share of both */
            const double all = (double)wish.turn_q8 * v.ahead_q16, other = (double)v.turn_q8 * wish.ahead_q16;
            assert_true(fabs(all - other) <
                        4.0 * (fabs((double)wish.turn_q8) + fabs((double)wish.ahead_q16)));
        }
        assert_true(config.kind == OSIRIS_OMNI || v.left_q16 == 0);
    }
}

static void ramps(void **state)
{
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        osiris_drive_config config;
        osiris_drive drive;
        osiris_drive_defaults(&config, (osiris_drive_kind)kind);
        assert_int_equal(osiris_drive_init(&drive, &config), IRIS_OK);
        const osiris_velocity ahead = {200 * 65536, 0, 6000 * 256}, none = {0, 0, 0};
        int32_t last = 0, ms = 0;
        while (drive.velocity.ahead_q16 < 200 * 65536 && ms < 1000) {
            assert_int_equal(osiris_drive_step(&drive, &ahead, 7), IRIS_OK);
            assert_true(drive.velocity.ahead_q16 - last <= 1000 * 65536 / 1000 * 7 + 1);
            last = drive.velocity.ahead_q16;
            ms += 7;
        }
        assert_true(ms >= 200 && ms <= 207); /* 200 mm/s at 1000 mm/s^2 */
        for (int i = 0; i < 100; i++) {
            assert_int_equal(osiris_drive_step(&drive, &ahead, 7), IRIS_OK);
        }
        assert_true(abs(drive.velocity.turn_q8 - 6000 * 256) < 60 * 256); /* the steering's steps */
        for (ms = 0; drive.velocity.ahead_q16 != 0 && ms < 1000; ms += 5) {
            assert_int_equal(osiris_drive_step(&drive, &none, 5), IRIS_OK);
        }
        assert_int_equal(ms, 200);
        assert_int_equal(osiris_drive_step(&drive, &ahead, 50), IRIS_OK);
        osiris_drive_halt(&drive);
        assert_int_equal(drive.velocity.ahead_q16, 0);
        assert_int_equal(drive.velocity.turn_q8, 0);
    }
}

/* On the spot, to either side: the heading goes there, steadily enough, and the place stays. */
static void all_turn_on_the_spot(void **state)
{
    (void)state;
    for (int i = 0; i < 6; i++) {
        osiris_drive_config config;
        osiris_drive drive;
        osiris_drive_defaults(&config, (osiris_drive_kind)(i / 2));
        assert_int_equal(osiris_drive_init(&drive, &config), IRIS_OK);
        const osiris_velocity wish = {0, 0, i % 2 ? 16384 * 256 : -16384 * 256};
        osiris_track track = {0, 0, 0};
        double heading = 0;
        for (int k = 0; k < 3000; k++) {
            const uint32_t before = track.heading_q16;
            assert_int_equal(osiris_drive_step(&drive, &wish, 10), IRIS_OK);
            osiris_track_move(&track, &drive.velocity, 10);
            heading += (int32_t)(track.heading_q16 - before) / 65536.0;
            assert_true(hypot((double)track.x_q16, (double)track.y_q16) < 200.0 * 65536);
        }
        assert_true((i % 2 ? -heading : heading) > (config.kind == OSIRIS_ACKERMANN ? 65536 : 16384 * 29));
        assert_true((i % 2 ? -heading : heading) <= 16384.0 * 30);
    }
}

static void refuses(void **state)
{
    (void)state;
    osiris_drive_config config = {0}, bad = {0};
    osiris_drive drive;
    osiris_wheels wheels = {3, {0}, 0};
    osiris_velocity v = {0, 0, 0};
    osiris_drive_defaults(NULL, OSIRIS_OMNI);
    osiris_drive_halt(NULL);
    for (int kind = 0; kind < 3; kind++) {
        osiris_drive_defaults(&config, (osiris_drive_kind)kind);
        assert_int_equal(osiris_drive_check(&config), IRIS_OK);
        int32_t *const numbers[] = {&bad.speed_max_mms, &bad.turn_rate_max, &bad.acceleration_mms2,
                                    kind == OSIRIS_OMNI ? &bad.wheels : &bad.track_mm,
                                    kind == OSIRIS_ACKERMANN ? &bad.steering_max : &bad.turn_acceleration};
        for (int i = 0; i < 5; i++) {
            for (int32_t value = -1; value <= 0; value++) {
                bad = config;
                *numbers[i] = value;
                assert_int_equal(osiris_drive_check(&bad), IRIS_ERR_ARG);
                assert_int_equal(osiris_drive_wheels(&wheels, &bad, &v), IRIS_ERR_ARG);
                assert_int_equal(osiris_drive_velocity(&v, &bad, &wheels), IRIS_ERR_ARG);
                assert_int_equal(osiris_drive_limit(&v, &bad), IRIS_ERR_ARG);
                assert_int_equal(osiris_drive_init(&drive, &bad), IRIS_ERR_ARG);
            }
        }
    }
    assert_int_equal(osiris_drive_check(NULL), IRIS_ERR_ARG);
    osiris_drive_defaults(&config, OSIRIS_DIFFERENTIAL);
    assert_int_equal(osiris_drive_velocity(&v, &config, &wheels), IRIS_ERR_ARG); /* three wheels */
    assert_int_equal(osiris_drive_init(&drive, &config), IRIS_OK);
    assert_int_equal(osiris_drive_step(&drive, NULL, 10), IRIS_ERR_ARG);
    assert_int_equal(osiris_drive_step(NULL, &v, 10), IRIS_ERR_ARG);
    assert_int_equal(osiris_drive_radius_min(&config), 0);
    osiris_drive_defaults(&config, OSIRIS_ACKERMANN);
    assert_int_equal(osiris_drive_radius_min(&config), 277); /* 160 / tan 30 degrees */
}

static void extremes(void **state)
{
    (void)state;
    const int32_t ends[] = {INT32_MIN, INT32_MIN + 1, -1, 0, 1, INT32_MAX};
    for (int kind = 0; kind < 3; kind++) {
        osiris_drive_config config = made((osiris_drive_kind)kind);
        config.track_mm = config.wheelbase_mm = config.radius_mm = kind ? OSIRIS_SIDE_MAX_MM : 1;
        for (int i = 0; i < 216; i++) {
            osiris_drive drive;
            osiris_wheels wheels = {kind == OSIRIS_OMNI ? config.wheels : 2, {0}, 0};
            osiris_velocity v = {ends[i % 6], ends[i / 6 % 6], ends[i / 36]};
            for (int k = 0; k < 4; k++) {
                wheels.speed_q16[k] = ends[(i >> k) % 6];
            }
            wheels.steering = INT16_MIN;
            assert_int_equal(osiris_drive_init(&drive, &config), IRIS_OK);
            assert_int_equal(osiris_drive_step(&drive, &v, INT32_MAX), IRIS_OK);
            assert_int_equal(osiris_drive_step(&drive, &v, INT32_MIN), IRIS_OK);
            assert_int_equal(osiris_drive_velocity(&v, &config, &wheels), IRIS_OK);
            assert_int_equal(osiris_drive_wheels(&wheels, &config, &v), IRIS_OK);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wheels_and_back), cmocka_unit_test(limits_keep_the_curve),
        cmocka_unit_test(ramps),           cmocka_unit_test(all_turn_on_the_spot),
        cmocka_unit_test(refuses),         cmocka_unit_test(extremes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
