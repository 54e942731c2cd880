/* Steering: signs, sizes, limits, bends, and what happens when the line is lost. Values are worked out by hand. */
#include "iris/xt/steer.h"
#include "test.h"

enum { HALF_Q16 = 32768, DEGREES_45 = 8192, DEGREES_90 = 16384 };

/* A straight line in the middle of a 160x120 image. */
static iris_follow_result found(int32_t offset_q16, iris_angle angle)
{
    iris_follow_result line = {.state = IRIS_LINE_FOUND, .angle = angle, .offset_q16 = offset_q16};
    line.lookahead_offset_q16 = offset_q16;
    line.width_px = 12;
    line.confidence_permil = 800;
    line.segment_count = 1;
    line.segments[0] = (iris_segment){80, 119, 80, 0};
    return line;
}

/* The same with a sharp bend whose corner is `rows` rows above the bottom. */
static iris_follow_result bending(iris_angle next, int32_t rows)
{
    iris_follow_result line = found(0, 0);
    line.has_next = 1;
    line.next_angle = next;
    line.segment_count = 2;
    line.segments[0] = (iris_segment){80, 119, 80, 119 - rows};
    line.segments[1] = (iris_segment){80, 119 - rows, next < 0 ? 0 : 159, 119 - rows};
    return line;
}

static iris_follow_result missing(iris_line_state state, const iris_follow_result *last)
{
    iris_follow_result line = {.state = state};
    if (state == IRIS_LINE_STALE) {
        line = *last;
        line.state = IRIS_LINE_STALE;
    }
    return line;
}

/* Gains that make results easy to work out: no look-ahead, no derivative. */
static iris_steer plain(void)
{
    iris_steer_config config;
    iris_steer steer;
    iris_steer_defaults(&config);
    config.offset_gain_permil = 1000;
    config.angle_gain_permil = 800;
    config.lookahead_permil = 0;
    config.derivative_ms = 0;
    config.cruise_permil = 600;
    config.slow_permil = 200;
    config.curve_permil = 500;
    assert_int_equal(iris_steer_init(&steer, &config), IRIS_OK);
    return steer;
}

static iris_command update(iris_steer *steer, iris_follow_result line, int32_t elapsed_ms)
{
    iris_command command;
    assert_int_equal(iris_steer_update(&command, steer, &line, elapsed_ms), IRIS_OK);
    return command;
}

static void config_is_checked(void **state)
{
    (void)state;
    iris_steer steer;
    iris_steer_config good;
    iris_steer_defaults(&good);
    iris_steer_defaults(NULL);
    assert_int_equal(iris_steer_init(&steer, NULL), IRIS_OK);
    assert_memory_equal(&steer.config, &good, sizeof good);
    assert_int_equal(iris_steer_init(NULL, &good), IRIS_ERR_ARG);
    assert_int_equal(good.full_lock_centideg, 4500);
    for (size_t i = 0; i < sizeof good / sizeof(int32_t); i++) {
        const int32_t wrong[] = {-1, INT32_MIN, INT32_MAX, 60001};
        for (size_t k = 0; k < 4; k++) {
            iris_steer_config bad = good;
            memcpy((char *)&bad + i * sizeof(int32_t), &wrong[k], sizeof(int32_t));
            memset(&steer, 0x55, sizeof steer);
            iris_steer before = steer;
            assert_int_equal(iris_steer_init(&steer, &bad), IRIS_ERR_ARG);
            assert_memory_equal(&steer, &before, sizeof steer);
        }
    }
    good.curve_permil = 0;
    assert_int_equal(iris_steer_init(&steer, &good), IRIS_ERR_ARG);
}

static void update_refuses_null(void **state)
{
    (void)state;
    iris_steer steer = plain();
    iris_follow_result line = found(0, 0);
    iris_command command = {.seq = 77};
    assert_int_equal(iris_steer_update(NULL, &steer, &line, 33), IRIS_ERR_ARG);
    assert_int_equal(iris_steer_update(&command, NULL, &line, 33), IRIS_ERR_ARG);
    assert_int_equal(iris_steer_update(&command, &steer, NULL, 33), IRIS_ERR_ARG);
    assert_int_equal(command.seq, 77);
    assert_int_equal(steer.seq, 0);
}

static void steers_towards_the_line(void **state)
{
    (void)state;
    const struct {
        int32_t offset_q16;
        iris_angle angle;
        int32_t steer, speed; /* speed: 600 - 400 * min(|steer|, 500) / 500 */
    } cases[] = {
        {0, 0, 0, 600},
        {HALF_Q16 / 2, 0, 250, 400}, /* the line is right of the middle: steer right */
        {-HALF_Q16 / 2, 0, -250, 400},
        {0, DEGREES_45, 400, 280}, /* it leans right: 800 permil at 90 degrees */
        {0, -DEGREES_45, -400, 280},
        {HALF_Q16 / 2, -DEGREES_45, -150, 280}, /* left of both, and the angle alone asks for slowness */
        {HALF_Q16, DEGREES_90, 1000, 200},      /* limited */
        {-HALF_Q16, -DEGREES_90, -1000, 200},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        iris_steer steer = plain();
        iris_command command = update(&steer, found(cases[i].offset_q16, cases[i].angle), 33);
        assert_int_equal(command.state, IRIS_LINE_FOUND);
        assert_int_equal(command.steer_permil, cases[i].steer);
        assert_int_equal(command.speed_permil, cases[i].speed);
        assert_int_equal(command.offset_permil, cases[i].offset_q16 * 1000 / 65536);
        assert_int_equal(command.angle_centideg, cases[i].angle * 9000 / 16384);
        assert_int_equal(command.confidence_permil, 800);
    }
}

static void lookahead_has_its_share(void **state)
{
    (void)state;
    iris_steer steer = plain();
    steer.config.lookahead_permil = 250;
    iris_follow_result line = found(HALF_Q16 / 2, 0); /* 0.25, and -0.25 ahead */
    line.lookahead_offset_q16 = -HALF_Q16 / 2;
    assert_int_equal(update(&steer, line, 33).steer_permil, 125);
}

/* The offset grows by 0.25 per second: in 200 ms it will be 0.05 more. */
static void derivative_looks_ahead_in_time(void **state)
{
    (void)state;
    for (int32_t filter_ms = 0; filter_ms <= 100; filter_ms += 100) {
        iris_steer steer = plain();
        steer.config.derivative_ms = 200;
        steer.config.filter_ms = filter_ms;
        iris_command command = update(&steer, found(0, 0), 40);
        assert_int_equal(command.steer_permil, 0);
        command = update(&steer, found(655, 0), 40); /* 0.01 */
        assert_in_range(command.steer_permil, filter_ms == 0 ? 59 : 23, filter_ms == 0 ? 60 : 25);
        for (int32_t k = 2; k < 30; k++) {
            command = update(&steer, found(655 * k, 0), 40);
        }
        assert_in_range(command.steer_permil, 290 + 49, 290 + 51);
        /* a line that comes back somewhere else gives no kick */
        update(&steer, missing(IRIS_LINE_LOST, NULL), 40);
        assert_int_equal(update(&steer, found(-HALF_Q16, 0), 40).steer_permil, -500);
    }
}

static void limit_is_kept(void **state)
{
    (void)state;
    iris_steer steer = plain();
    steer.config.limit_permil = 300;
    assert_int_equal(update(&steer, found(HALF_Q16, 0), 33).steer_permil, 300);
    assert_int_equal(update(&steer, found(-HALF_Q16, 0), 33).steer_permil, -300);
    assert_int_equal(update(&steer, missing(IRIS_LINE_LOST, NULL), 1000).steer_permil, -300);
}

static void bend_is_taken_when_it_is_near(void **state)
{
    (void)state;
    iris_steer steer = plain();
    iris_command far = update(&steer, bending(-DEGREES_90, 60), 33);
    assert_int_equal(far.steer_permil, 0);
    assert_int_equal(far.speed_permil, 200); /* slow already */
    assert_int_equal(update(&steer, bending(-DEGREES_90, 14), 33).steer_permil, 0);
    assert_int_equal(update(&steer, bending(-DEGREES_90, 11), 33).steer_permil, -800);
    assert_int_equal(update(&steer, bending(DEGREES_90, 11), 33).steer_permil, 800);
}

/* Behind a bend to the left the line lies across the image, as 90 or -90 degrees by the noise of a pixel. */
static void line_across_is_entered_on_the_side_of_the_bend(void **state)
{
    (void)state;
    iris_steer steer = plain();
    update(&steer, bending(-DEGREES_90, 11), 33);
    assert_int_equal(update(&steer, found(0, -DEGREES_90), 33).steer_permil, -800);
    assert_int_equal(update(&steer, found(0, DEGREES_90), 33).steer_permil, -800);
    assert_int_equal(update(&steer, found(0, DEGREES_90 - 1024), 33).steer_permil, -850);
    /* once the line is ahead again the bend is forgotten */
    assert_int_equal(update(&steer, found(0, 0), 33).steer_permil, 0);
    assert_int_equal(update(&steer, found(0, DEGREES_90), 33).steer_permil, 800);
    assert_int_equal(update(&steer, found(0, -DEGREES_90), 33).steer_permil, 800);
}

static void lost_line_is_held_searched_and_given_up(void **state)
{
    (void)state;
    iris_steer steer = plain(); /* hold 200 ms, search until 3000 ms */
    iris_follow_result last = found(-HALF_Q16 / 8, 0);
    assert_int_equal(update(&steer, last, 100).steer_permil, -62);
    for (int32_t ms = 100; ms <= 3500; ms += 100) {
        iris_follow_result line = missing(ms <= 200 ? IRIS_LINE_STALE : IRIS_LINE_LOST, &last);
        iris_command command = update(&steer, line, 100);
        assert_int_equal(command.state, line.state);
        assert_int_equal(command.steer_permil, ms <= 200 ? -62 : ms < 3000 ? -1000 : 0);
        assert_int_equal(command.speed_permil, ms < 3000 ? 200 : 0);
        assert_int_equal(command.offset_permil, ms <= 200 ? -62 : 0);
        assert_int_equal(command.confidence_permil, ms <= 200 ? 800 : 0);
    }
    iris_command back = update(&steer, found(HALF_Q16 / 8, 0), 100);
    assert_int_equal(back.steer_permil, 62);
    assert_true(back.speed_permil > 200);
    assert_int_equal(update(&steer, missing(IRIS_LINE_LOST, NULL), 300).steer_permil, 1000);
}

static void line_lost_at_a_bend_is_searched_there_at_once(void **state)
{
    (void)state;
    iris_steer steer = plain();
    iris_follow_result bend = bending(DEGREES_90, 30);
    bend.offset_q16 = -HALF_Q16 / 4;
    assert_true(update(&steer, bend, 33).steer_permil < 0);
    iris_command command = update(&steer, missing(IRIS_LINE_STALE, &bend), 33);
    assert_int_equal(command.steer_permil, 1000);
    assert_int_equal(command.speed_permil, 200);
    assert_int_equal(update(&steer, missing(IRIS_LINE_LOST, NULL), 1000).steer_permil, 1000);
}

static void robot_that_never_saw_a_line_stands_still(void **state)
{
    (void)state;
    iris_steer steer = plain();
    iris_follow_result none = {.state = IRIS_LINE_LOST};
    for (int i = 0; i < 50; i++) {
        iris_command command = update(&steer, none, 33);
        assert_int_equal(command.state, IRIS_LINE_LOST);
        assert_int_equal(command.steer_permil, 0);
        assert_int_equal(command.speed_permil, 0);
    }
}

static void sequence_counts_to_9999(void **state)
{
    (void)state;
    iris_steer steer = plain();
    for (int32_t i = 0; i < 10002; i++) {
        iris_command command = update(&steer, i % 3 ? found(0, 0) : missing(IRIS_LINE_LOST, NULL), 33);
        assert_int_equal(command.seq, i % 10000);
    }
}

static void mirrored_line_gives_mirrored_steering(void **state)
{
    (void)state;
    iris_steer a, b;
    assert_int_equal(iris_steer_init(&a, NULL), IRIS_OK);
    assert_int_equal(iris_steer_init(&b, NULL), IRIS_OK);
    uint32_t random = 12345;
    for (int i = 0; i < 20000; i++) {
        random = random * 1664525u + 1013904223u;
        iris_follow_result left =
            found((int32_t)(random >> 12) % 70000 - 35000, (iris_angle)((random >> 8) % 32769 - 16384));
        left.lookahead_offset_q16 = (int32_t)(random >> 5) % 70000 - 35000;
        left.state = random >> 29 ? IRIS_LINE_FOUND : IRIS_LINE_LOST;
        left.has_next = (random >> 24) % 5 == 0;
        left.next_angle = (iris_angle)((random >> 3) % 32769 - 16384);
        iris_follow_result right = left;
        right.angle = (iris_angle)-left.angle;
        right.next_angle = (iris_angle)-left.next_angle;
        right.offset_q16 = -left.offset_q16;
        right.lookahead_offset_q16 = -left.lookahead_offset_q16;
        iris_command l = update(&a, left, 33), r = update(&b, right, 33);
        assert_int_equal(l.steer_permil, -r.steer_permil);
        assert_int_equal(l.speed_permil, r.speed_permil);
    }
}

/* Whatever comes in, a command goes out that the sentence takes. */
static void extremes_stay_in_range(void **state)
{
    (void)state;
    const int32_t values[] = {INT32_MIN, INT32_MIN + 1, -131073,       -1,       0, 1,
                              40000,     131073,        INT32_MAX - 1, INT32_MAX};
    const int16_t angles[] = {INT16_MIN, -16385, -16384, -10924, 0, 10924, 16384, INT16_MAX};
    iris_steer_config config;
    iris_steer_defaults(&config);
    config.offset_gain_permil = config.angle_gain_permil = config.curve_permil = 10000;
    config.lookahead_permil = config.derivative_ms = 1000;
    config.bend_widths_permil = 20000;
    uint32_t random = 1;
    for (int kind = 0; kind < 2; kind++) {
        iris_steer steer;
        config.filter_ms = kind == 0 ? 0 : 1000;
        assert_int_equal(iris_steer_init(&steer, &config), IRIS_OK);
        for (int i = 0; i < 200000; i++) {
            iris_follow_result line = {.state = (iris_line_state)((random >> 28) % 5)};
            int32_t pick[8];
            for (int k = 0; k < 8; k++) {
                random = random * 1664525u + 1013904223u;
                pick[k] = values[(random >> 16) % 10];
            }
            line.has_next = (random >> 20) % 2;
            line.angle = angles[(random >> 21) % 8];
            line.next_angle = angles[(random >> 24) % 8];
            line.offset_q16 = pick[0];
            line.lookahead_offset_q16 = pick[1];
            line.width_px = pick[2];
            line.confidence_permil = pick[3];
            line.segment_count = pick[4];
            line.segments[0] = line.segments[6] = (iris_segment){pick[5], pick[5], pick[6], pick[6]};
            iris_command command = update(&steer, line, pick[7]);
            char sentence[IRIS_COMMAND_SENTENCE_BYTES];
            size_t length;
            assert_int_equal(iris_command_format(sentence, sizeof sentence, &length, &command), IRIS_OK);
        }
    }
}

static void wheel_angle_is_a_share_of_full_lock(void **state)
{
    (void)state;
    iris_steer steer = plain();
    iris_command command = {.steer_permil = -500};
    assert_int_equal(iris_steer_wheel_centideg(&steer, &command), -2250);
    command.steer_permil = 1000;
    assert_int_equal(iris_steer_wheel_centideg(&steer, &command), 4500);
    command.steer_permil = INT32_MIN;
    assert_int_equal(iris_steer_wheel_centideg(&steer, &command), -4500);
    assert_int_equal(iris_steer_wheel_centideg(NULL, &command), 0);
    assert_int_equal(iris_steer_wheel_centideg(&steer, NULL), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(config_is_checked),
        cmocka_unit_test(update_refuses_null),
        cmocka_unit_test(steers_towards_the_line),
        cmocka_unit_test(lookahead_has_its_share),
        cmocka_unit_test(derivative_looks_ahead_in_time),
        cmocka_unit_test(limit_is_kept),
        cmocka_unit_test(bend_is_taken_when_it_is_near),
        cmocka_unit_test(line_across_is_entered_on_the_side_of_the_bend),
        cmocka_unit_test(lost_line_is_held_searched_and_given_up),
        cmocka_unit_test(line_lost_at_a_bend_is_searched_there_at_once),
        cmocka_unit_test(robot_that_never_saw_a_line_stands_still),
        cmocka_unit_test(sequence_counts_to_9999),
        cmocka_unit_test(mirrored_line_gives_mirrored_steering),
        cmocka_unit_test(extremes_stay_in_range),
        cmocka_unit_test(wheel_angle_is_a_share_of_full_lock),
    };
    return cmocka_run_group_tests_name("steer", tests, NULL, NULL);
}
