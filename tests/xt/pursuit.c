/* Pure pursuit against the formula: lines drawn through a camera in double precision. */
#include "iris/xt/pursuit.h"

#include "xt/floor_camera.h"

/* A camera that looks straight ahead, 200 mm above the floor, 45 degrees down. */
static test_camera plain_camera(void)
{
    return (test_camera){.w = 640,
                         .h = 480,
                         .focal = 400,
                         .cx = 319.5,
                         .cy = 239.5,
                         .height = 200,
                         .ahead = 40,
                         .tilt = 0.7853981634};
}

static iris_segment segment_of(const test_camera *c, double x0, double y0, double x1, double y1)
{
    double u0 = 0, v0 = 0, u1 = 0, v1 = 0;
    assert_true(camera_sees(&u0, &v0, c, x0, y0) > 0 && camera_sees(&u1, &v1, c, x1, y1) > 0);
    return (iris_segment){(int32_t)lround(u0), (int32_t)lround(v0), (int32_t)lround(u1), (int32_t)lround(v1)};
}

static iris_follow_result line_of(const iris_segment *segments, int32_t count)
{
    iris_follow_result line = {
        .state = IRIS_LINE_FOUND, .confidence_permil = 900, .width_px = 30, .segment_count = count};
    memcpy(line.segments, segments, (size_t)count * sizeof *segments);
    return line;
}

static double mm(iris_q16 value)
{
    return value / 65536.0;
}

static void near_to(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance)) {
        print_error("%g is not within %g of %g\n", value, tolerance, expected);
        fail();
    }
}

static void straight_lines(void **state)
{
    (void)state;
    test_camera c = plain_camera();
    iris_floor plane = true_floor(&c);
    for (int k = 0; k < 400; k++) {
        double x0 = uniform(-60, 60), y0 = 140, x1 = x0 + uniform(-150, 150), y1 = uniform(350, 600);
        iris_segment segment = segment_of(&c, x0, y0, x1, y1);
        iris_follow_result line = line_of(&segment, 1);
        iris_pursuit_config config = {.lookahead_mm = (int32_t)uniform(170, 300),
                                      .radius_mm = (int32_t)uniform(40, 150),
                                      .axle_mm = (int32_t)uniform(-60, 60)};
        iris_pursuit_goal goal;
        assert_int_equal(iris_pursuit_find(&goal, &plane, &line, 0, &config), IRIS_OK);
        assert_int_equal(goal.found, 1);
        double low = 0, high = 1; /* where the line is as far from the axle as wanted */
        for (int i = 0; i < 50; i++) {
            double t = (low + high) / 2;
            if (hypot(x0 + t * (x1 - x0), y0 + t * (y1 - y0) - config.axle_mm) < config.lookahead_mm) {
                low = t;
            } else {
                high = t;
            }
        }
        double x = x0 + low * (x1 - x0), y = y0 + low * (y1 - y0) - config.axle_mm;
        near_to(mm(goal.goal.x_q16), x, 1.0); /* segments have whole pixels */
        near_to(mm(goal.goal.y_q16), y + config.axle_mm, 1.5);
        near_to(mm(goal.offset_q16), x, 1.0);
        near_to(mm(goal.distance_q16), hypot(x, y), 1.5);
        near_to(goal.heading * 360.0 / 65536, atan2(x1 - x0, y1 - y0) * 57.29578, 0.5);
        double steer = 1000 * config.radius_mm * 2 * mm(goal.goal.x_q16) / pow(mm(goal.distance_q16), 2);
        near_to(goal.steer_permil, steer, 2 + fabs(steer) / 500);
    }
}

/* Around a corner the goal goes on along the second piece; where the line ends, it stays at its end. */
static void corners_and_ends(void **state)
{
    (void)state;
    test_camera c = plain_camera();
    iris_floor plane = true_floor(&c);
    const iris_segment pieces[2] = {segment_of(&c, 0, 140, 0, 180), segment_of(&c, 0, 180, 150, 180)};
    iris_follow_result line = line_of(pieces, 2);
    iris_pursuit_config config = {.lookahead_mm = 200, .radius_mm = 75};
    iris_pursuit_goal goal;
    assert_int_equal(iris_pursuit_find(&goal, &plane, &line, 0, &config), IRIS_OK);
    near_to(mm(goal.goal.x_q16), sqrt(200 * 200 - 180 * 180), 2);
    near_to(mm(goal.goal.y_q16), 180, 1);
    near_to(goal.heading, 0, 100);
    config.lookahead_mm = 400;
    assert_int_equal(iris_pursuit_find(&goal, &plane, &line, 0, &config), IRIS_OK);
    near_to(mm(goal.goal.x_q16), 150, 1);
    near_to(mm(goal.distance_q16), hypot(150, 180), 1);
    config.lookahead_mm = 100; /* nearer than the line is seen: its near end */
    assert_int_equal(iris_pursuit_find(&goal, &plane, &line, 0, &config), IRIS_OK);
    near_to(mm(goal.goal.y_q16), 140, 1);

    line = line_of(pieces + 1, 1); /* only what lies across: which way is known from the bend */
    config.lookahead_mm = 220;
    for (int32_t side = -1; side <= 1; side++) {
        const double expected = side < 0 ? 0 : sqrt(220 * 220 - 180 * 180);
        assert_int_equal(iris_pursuit_find(&goal, &plane, &line, side, &config), IRIS_OK);
        near_to(mm(goal.goal.x_q16), side < 0 ? 150 : expected, 2);
        near_to(goal.heading * 360.0 / 65536, side < 0 ? -90 : 90, 0.5);
    }
}

static void the_command(void **state)
{
    (void)state;
    test_camera c = plain_camera();
    iris_floor plane = true_floor(&c);
    const iris_segment segment = segment_of(&c, 20, 140, 20, 400);
    iris_follow_result line = line_of(&segment, 1);
    iris_pursuit_config config = {.lookahead_mm = 200, .radius_mm = 75};
    iris_pursuit by = {&plane, &config};
    iris_steer steer, plain;
    iris_command command, other;
    iris_pursuit_goal goal;
    assert_int_equal(iris_steer_init(&steer, NULL), IRIS_OK);
    plain = steer;
    assert_int_equal(iris_pursuit_update(&command, &goal, &steer, &line, &by, 0), IRIS_OK);
    assert_int_equal(iris_steer_update(&other, &plain, &line, 0), IRIS_OK);
    near_to(command.steer_permil, 2000.0 * 75 * 20 / 40000, 3);
    assert_int_equal(command.steer_permil, goal.steer_permil);
    assert_int_equal(command.speed_permil, other.speed_permil);
    assert_int_equal(command.state, IRIS_LINE_FOUND);

    int32_t kept =
        command.steer_permil; /* a line that is lost: the steering is kept, then it is searched on its side */
    line.state = IRIS_LINE_LOST;
    assert_int_equal(iris_pursuit_update(&command, &goal, &steer, &line, &by, 100), IRIS_OK);
    assert_int_equal(command.steer_permil, kept);
    assert_int_equal(goal.found, 0);
    assert_int_equal(iris_pursuit_update(&command, &goal, &steer, &line, &by, 400), IRIS_OK);
    assert_int_equal(command.steer_permil, 1000);

    iris_steer_config narrow; /* its limit holds */
    iris_steer_defaults(&narrow);
    narrow.limit_permil = 50;
    assert_int_equal(iris_steer_init(&steer, &narrow), IRIS_OK);
    line.state = IRIS_LINE_FOUND;
    assert_int_equal(iris_pursuit_update(&command, &goal, &steer, &line, &by, 0), IRIS_OK);
    assert_int_equal(command.steer_permil, 50);

    line.segments[0].y1 = -4000; /* above the horizon: steered by the picture */
    assert_int_equal(iris_steer_init(&steer, NULL), IRIS_OK);
    plain = steer;
    assert_int_equal(iris_pursuit_update(&command, &goal, &steer, &line, &by, 0), IRIS_OK);
    assert_int_equal(iris_steer_update(&other, &plain, &line, 0), IRIS_OK);
    assert_int_equal(goal.found, 0);
    assert_memory_equal(&command, &other, sizeof command);
}

static void any_numbers_stay_harmless(void **state)
{
    (void)state;
    for (int k = 0; k < 20000; k++) {
        test_camera c = any_camera();
        iris_floor plane = true_floor(&c);
        iris_follow_result line = {.state = IRIS_LINE_FOUND, .segment_count = (int32_t)uniform(-3, 12)};
        double reach = k % 3 ? 2000 : 2147483647.0;
        for (int i = 0; i < IRIS_FOLLOW_SEGMENTS_MAX; i++) {
            line.segments[i] =
                (iris_segment){(int32_t)uniform(-reach, reach), (int32_t)uniform(-reach, reach),
                               (int32_t)uniform(-reach, reach), (int32_t)uniform(-reach, reach)};
        }
        if (k % 5 == 0) {
            line.segment_count = INT32_MAX;
        }
        iris_pursuit_config config = {(int32_t)uniform(10, 10000), (int32_t)uniform(1, 100000),
                                      (int32_t)uniform(-10000, 10000)};
        iris_pursuit_goal goal;
        assert_int_equal(iris_pursuit_find(&goal, &plane, &line, k % 3 - 1, &config), IRIS_OK);
        assert_true(goal.steer_permil <= 100000 && goal.steer_permil >= -100000);
    }
}

static void arguments_are_checked(void **state)
{
    (void)state;
    test_camera c = plain_camera();
    iris_floor plane = true_floor(&c);
    iris_follow_result line = {.state = IRIS_LINE_LOST};
    iris_pursuit_goal goal;
    iris_pursuit_config config;
    iris_steer steer;
    iris_command command;
    iris_pursuit by = {&plane, NULL}, none = {NULL, NULL}, bad = {&plane, &config};
    static const iris_pursuit_config wrong[] = {{9, 75, 0},       {10001, 75, 0},    {200, 0, 0},
                                                {200, 100001, 0}, {200, 75, -10001}, {200, 75, 10001}};
    iris_pursuit_defaults(NULL);
    assert_int_equal(iris_steer_init(&steer, NULL), IRIS_OK);
    assert_int_equal(iris_pursuit_find(NULL, &plane, &line, 0, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_pursuit_find(&goal, NULL, &line, 0, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_pursuit_find(&goal, &plane, NULL, 0, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_pursuit_find(&goal, &plane, &line, 0, NULL), IRIS_OK);
    assert_int_equal(goal.found, 0);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        config = wrong[i];
        assert_int_equal(iris_pursuit_find(&goal, &plane, &line, 0, &config), IRIS_ERR_ARG);
        assert_int_equal(iris_pursuit_update(&command, &goal, &steer, &line, &bad, 0), IRIS_ERR_ARG);
    }
    assert_int_equal(iris_pursuit_update(NULL, &goal, &steer, &line, &by, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_pursuit_update(&command, NULL, &steer, &line, &by, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_pursuit_update(&command, &goal, NULL, &line, &by, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_pursuit_update(&command, &goal, &steer, NULL, &by, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_pursuit_update(&command, &goal, &steer, &line, NULL, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_pursuit_update(&command, &goal, &steer, &line, &none, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_pursuit_update(&command, &goal, &steer, &line, &by, 0), IRIS_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(straight_lines),        cmocka_unit_test(corners_and_ends),
        cmocka_unit_test(the_command),           cmocka_unit_test(any_numbers_stay_harmless),
        cmocka_unit_test(arguments_are_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
