/* Line following: pictures whose line is known by formula. States, memory, and hostile input: follow_states.c. */
#include "floor.h"

static floor_picture picture;
static iris_follow_result result;

static void straight_lines_of_every_lean(void **state)
{
    (void)state;
    for (int lean = -50; lean <= 50; lean += 5) {
        double x = 80 - lean * 0.9;
        paint_floor(&picture, 200, 8, 1);
        paint_tape(&picture, x, lean, 14 / cos(lean * 0.0174533), 0, FLOOR_H - 1);
        look(&result, &picture, NULL);
        assert_int_equal(result.state, IRIS_LINE_FOUND);
        assert_near(degrees(result.angle), lean, 1.5);
        assert_near(fraction(result.offset_q16), (x - 79.5) / 80, 0.03);
        assert_int_equal(result.has_next, 0);
        double ahead = x + (FLOOR_H - 1 - 39) * tan(lean * 0.0174533);
        assert_near(fraction(result.lookahead_offset_q16), (ahead - 79.5) / 80, 0.03);
        assert_true(result.confidence_permil > 800 && result.confidence_permil <= 1000);
    }
}

static void rows_have_the_tape_and_its_width(void **state)
{
    (void)state;
    paint_floor(&picture, 180, 0, 1);
    for (int y = 0; y < FLOOR_H; y++) {
        paint_run(&picture, y, 60 + y / 4, 75 + y / 4, 0.2);
    }
    look(&result, &picture, NULL);
    for (int y = 0; y < FLOOR_H; y++) {
        assert_int_equal(result.rows[y].left, 60 + y / 4);
        assert_int_equal(result.rows[y].right, 75 + y / 4);
    }
    assert_int_equal(result.width_px, 16);
    assert_int_equal(result.segment_count, 1);
    assert_int_equal(result.segments[0].y0, FLOOR_H - 1);
    assert_int_equal(result.segments[0].y1, 0);
}

static void bright_line_is_the_dark_one_upside_down(void **state)
{
    (void)state;
    iris_follow_config config;
    iris_follow_result dark;
    iris_follow_defaults(&config);
    config.kind = IRIS_FOLLOW_BRIGHT;
    paint_floor(&picture, 180, 9, 0.5);
    paint_tape(&picture, 50, 20, 15, 0, FLOOR_H - 1);
    look(&dark, &picture, NULL);
    iris_span middle = dark.rows[60];
    for (int y = 0; y < FLOOR_H; y++) {
        for (int x = 0; x < FLOOR_W; x++) {
            picture.pixels[y][x] = (uint8_t)(255 - picture.pixels[y][x]);
        }
    }
    look(&result, &picture, &config);
    assert_int_equal(result.state, IRIS_LINE_FOUND);
    assert_int_equal(result.angle, dark.angle);
    assert_int_equal(result.offset_q16, dark.offset_q16);
    assert_int_equal(result.rows[60].left, middle.left);
    assert_int_equal(result.rows[60].right, middle.right);
    look(&result, &picture, NULL);
    assert_int_equal(result.state, IRIS_LINE_LOST);
}

static void uneven_light_noise_and_glare(void **state)
{
    (void)state;
    for (int k = 0; k < 8; k++) {
        paint_floor(&picture, 220, 14, k % 2 ? 0.3 : 1);
        paint_tape(&picture, 60, 12, 16, 0, FLOOR_H - 1);
        for (int y = 46; y < 70 && k >= 4; y++) { /* a lamp's reflection, wider than the tape */
            double half = sqrt(144 - (y - 58) * (y - 58)) * 2;
            paint_run(&picture, y, 72 - half, 72 + half, 100);
        }
        if (k % 4 >= 2) {
            mirror(&picture);
        }
        look(&result, &picture, NULL);
        assert_int_equal(result.state, IRIS_LINE_FOUND);
        assert_near(degrees(result.angle), k % 4 >= 2 ? -12 : 12, 1.5);
        assert_near(fraction(result.offset_q16), (k % 4 >= 2 ? 19.5 : -19.5) / 80, 0.04);
    }
}

static void crossing_line_is_ignored(void **state)
{
    (void)state;
    iris_follow_result alone;
    paint_floor(&picture, 200, 6, 1);
    paint_tape(&picture, 70, 10, 14, 0, FLOOR_H - 1);
    look(&alone, &picture, NULL);
    for (int y = 55; y < 70; y++) {
        paint_run(&picture, y, 0, FLOOR_W - 1, 0.2);
    }
    look(&result, &picture, NULL);
    assert_int_equal(result.has_next, 0);
    assert_near(degrees(result.angle), degrees(alone.angle), 1);
    assert_near(fraction(result.offset_q16), fraction(alone.offset_q16), 0.02);
    double center = 70 + (FLOOR_H - 1 - 62) * tan(10 * 0.0174533);
    assert_near((result.rows[62].left + result.rows[62].right) / 2.0, center, 2.5);
}

static void line_across_alone_is_reported(void **state)
{
    (void)state;
    paint_floor(&picture, 200, 6, 1);
    for (int y = 40; y < 56; y++) {
        paint_run(&picture, y, 0, FLOOR_W - 1, 0.2);
    }
    look(&result, &picture, NULL);
    assert_int_equal(result.state, IRIS_LINE_FOUND);
    assert_near(fabs(degrees(result.angle)), 90, 2);
    assert_int_equal(result.rows[48].left, 0);
    assert_int_equal(result.rows[48].right, FLOOR_W - 1);
    assert_near(fraction(result.offset_q16), 0, 0.05);
    assert_true(result.rows[20].right < result.rows[20].left);
    for (int y = 90; y < FLOOR_H; y++) { /* the robot's own shadow is not one, nor does it hide one */
        paint_run(&picture, y, 0, FLOOR_W - 1, 0.3);
    }
    look(&result, &picture, NULL);
    assert_int_equal(result.state, IRIS_LINE_FOUND);
    assert_int_equal(result.rows[48].right, FLOOR_W - 1);
    paint_floor(&picture, 200, 6, 1);
    for (int y = 90; y < FLOOR_H; y++) {
        paint_run(&picture, y, 0, FLOOR_W - 1, 0.3);
    }
    look(&result, &picture, NULL);
    assert_int_equal(result.state, IRIS_LINE_LOST);
}

static void sharp_bend_gives_the_next_direction(void **state)
{
    (void)state;
    for (int side = 0; side < 2; side++) {
        paint_floor(&picture, 200, 6, 1);
        paint_tape(&picture, 60, 0, 14, 40, FLOOR_H - 1);
        for (int y = 40; y < 54; y++) {
            paint_run(&picture, y, 53, FLOOR_W - 1, 0.2);
        }
        if (side) {
            mirror(&picture);
        }
        look(&result, &picture, NULL);
        assert_int_equal(result.state, IRIS_LINE_FOUND);
        assert_near(degrees(result.angle), 0, 2);
        assert_int_equal(result.has_next, 1);
        assert_near(degrees(result.next_angle), side ? -90 : 90, 5);
        assert_true(result.segment_count >= 2);
    }
}

static void curve_comes_as_segments_near_to_far(void **state)
{
    (void)state;
    paint_floor(&picture, 200, 6, 1);
    for (int y = 0; y < FLOOR_H;
         y++) { /* circle of radius 130 around (180, 119): straight ahead at the bottom */
        double up = FLOOR_H - 1 - y;
        double x = 180 - sqrt(130 * 130 - up * up);
        paint_run(&picture, y, x - 7, x + 7, 0.2);
    }
    look(&result, &picture, NULL);
    assert_int_equal(result.state, IRIS_LINE_FOUND);
    assert_true(result.segment_count >= 2);
    double last = -90;
    for (int i = 0; i < result.segment_count; i++) {
        const iris_segment *s = &result.segments[i];
        double lean = atan2(s->x1 - s->x0, s->y0 - s->y1) * 57.29578;
        assert_true(s->y0 > s->y1 && lean > last);
        last = lean;
        for (int k = 0; k <= 4; k++) { /* on the circle, to within two pixels */
            double x = s->x0 + (s->x1 - s->x0) * k / 4.0, y = s->y0 + (s->y1 - s->y0) * k / 4.0;
            assert_near(hypot(x - 180, y - 119), 130, 3.5);
        }
    }
    assert_true(degrees(result.angle) > 0 && degrees(result.angle) < 25);
    assert_true(result.lookahead_offset_q16 > result.offset_q16);
}

static void gaps_and_dashes_are_one_line(void **state)
{
    (void)state;
    paint_floor(&picture, 200, 6, 1);
    paint_tape(&picture, 50, 18, 14, 0, 50);
    paint_tape(&picture, 50, 18, 14, 72, FLOOR_H - 1);
    look(&result, &picture, NULL);
    assert_near(degrees(result.angle), 18, 2);
    assert_true(result.rows[60].right < result.rows[60].left);
    assert_true(result.rows[20].right > result.rows[20].left);

    paint_floor(&picture, 200, 6, 1);
    for (int y = 4; y < FLOOR_H; y += 29) {
        paint_tape(&picture, 50, 18, 16, y, y + 15);
    }
    look(&result, &picture, NULL);
    assert_int_equal(result.state, IRIS_LINE_FOUND);
    assert_near(degrees(result.angle), 18, 3);
    assert_near(fraction(result.offset_q16), (50 - 79.5) / 80, 0.05);
}

static void empty_floors_are_never_found(void **state)
{
    (void)state;
    for (int k = 0; k < 40; k++) {
        paint_floor(&picture, 40 + 5 * k, k % 20, k % 3 ? 1 : 0.3);
        picture.random += (uint32_t)k;
        for (int stone = 0; stone < 45 && k >= 20; stone++) { /* terrazzo: spots of half the brightness */
            int x = noise(&picture, FLOOR_W / 2) + FLOOR_W / 2,
                y = noise(&picture, FLOOR_H / 2) + FLOOR_H / 2;
            for (int row = 0; row < 5; row++) {
                paint_run(&picture, y + row, x, x + 5, 0.55);
            }
        }
        look(&result, &picture, NULL);
        assert_int_equal(result.state, IRIS_LINE_LOST);
        assert_null(result.rows);
    }
}

static void shadow_is_not_a_line(void **state)
{
    (void)state;
    paint_floor(&picture, 200, 6, 1);
    for (int y = 0; y < FLOOR_H; y++) {
        paint_run(&picture, y, 90, 130, 0.7);
    }
    look(&result, &picture, NULL);
    assert_int_equal(result.state, IRIS_LINE_LOST);
    paint_tape(&picture, 85, 0, 14, 0, FLOOR_H - 1);
    look(&result, &picture, NULL);
    assert_int_equal(result.state, IRIS_LINE_FOUND);
    assert_near(fraction(result.offset_q16), (85 - 79.5) / 80, 0.04);
}

/* Each gray level as a color: tape pixels yellow, the rest gray. */
static void colored_line_in_every_format(void **state)
{
    (void)state;
    static uint8_t rgb[FLOOR_H][FLOOR_W * 3], other[FLOOR_H][FLOOR_W * 3];
    static test_follower follower;
    iris_follow_config config;
    iris_follow_defaults(&config);
    config.kind = IRIS_FOLLOW_COLOR;
    config.color = (iris_hsl_range){40, 80, 40, 100, 20, 80};
    paint_floor(&picture, 250, 0, 1);
    paint_tape(&picture, 60, 15, 14, 0, FLOOR_H - 1);
    for (int y = 0; y < FLOOR_H; y++) {
        for (int x = 0; x < FLOOR_W; x++) {
            int tape = picture.pixels[y][x] < 100;
            rgb[y][3 * x] = tape ? 200 : 90;
            rgb[y][3 * x + 1] = tape ? 190 : 90;
            rgb[y][3 * x + 2] = tape ? 20 : 90;
            other[y][3 * x] = rgb[y][3 * x + 2];
            other[y][3 * x + 1] = rgb[y][3 * x + 1];
            other[y][3 * x + 2] = rgb[y][3 * x];
        }
    }
    const iris_format formats[] = {IRIS_RGB888, IRIS_BGR888};
    for (int k = 0; k < 2; k++) {
        iris_image frame;
        config.format = formats[k];
        start(&follower, &config);
        assert_int_equal(iris_image_wrap(&frame, k ? other : rgb, sizeof rgb, (iris_size){FLOOR_W, FLOOR_H},
                                         0, formats[k]),
                         IRIS_OK);
        assert_int_equal(iris_follow_frame(&result, &follower.follow, &frame, 0), IRIS_OK);
        assert_int_equal(result.state, IRIS_LINE_FOUND);
        assert_near(degrees(result.angle), 15, 1);
        assert_near(fraction(result.offset_q16), (60 - 79.5) / 80, 0.02);
    }
}

static void lane_is_the_middle_between_two_lines(void **state)
{
    (void)state;
    iris_follow_config config;
    iris_follow_defaults(&config);
    config.lane = 1;
    for (int side = 0; side < 2; side++) {
        paint_floor(&picture, 200, 6, 1);
        paint_tape(&picture, 20, 15, 10, 0, FLOOR_H - 1);
        paint_tape(&picture, 110, 15, 10, 0, FLOOR_H - 1);
        if (side) {
            mirror(&picture);
        }
        look(&result, &picture, &config);
        assert_int_equal(result.state, IRIS_LINE_FOUND);
        assert_near(degrees(result.angle), side ? -15 : 15, 2);
        assert_near(fraction(result.offset_q16), (side ? 14.5 : -14.5) / 80, 0.04);
        assert_near(result.rows[100].right - result.rows[100].left + 1, 80, 3);
    }
    paint_floor(&picture, 200, 6, 1);
    paint_tape(&picture, 20, 15, 10, 0, FLOOR_H - 1);
    look(&result, &picture, &config);
    assert_int_equal(result.state, IRIS_LINE_LOST); /* one line is no lane */
}

static void hough_estimator_agrees_and_needs_its_memory(void **state)
{
    (void)state;
    static test_follower follower;
    static IRIS_SCRATCH_BUFFER(votes, IRIS_FOLLOW_HOUGH_BYTES);
    iris_scratch scratch;
    for (int lean = -50; lean <= 50; lean += 5) {
        double x = 80 - lean * 0.9;
        paint_floor(&picture, 200, 8, 1);
        paint_tape(&picture, x, lean, 14 / cos(lean * 0.0174533), 0, FLOOR_H - 1);
        start(&follower, NULL);
        assert_int_equal(iris_scratch_init(&scratch, votes.memory, sizeof votes.memory - 1), IRIS_OK);
        assert_int_equal(iris_follow_use_hough(&follower.follow, &scratch), IRIS_ERR_SCRATCH);
        assert_int_equal(iris_scratch_init(&scratch, votes.memory, sizeof votes.memory), IRIS_OK);
        assert_int_equal(iris_follow_use_hough(&follower.follow, &scratch), IRIS_OK);
        assert_int_equal(scratch.peak, sizeof votes.memory);
        feed(&result, &follower, &picture, 0);
        assert_int_equal(result.state, IRIS_LINE_FOUND);
        assert_near(degrees(result.angle), lean, 1);
        assert_near(fraction(result.offset_q16), (x - 79.5) / 80, 0.02);
    }
    iris_follow blank = {.y = -1};
    assert_int_equal(iris_follow_use_hough(&blank, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_follow_use_hough(NULL, &scratch), IRIS_ERR_ARG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(straight_lines_of_every_lean),
        cmocka_unit_test(rows_have_the_tape_and_its_width),
        cmocka_unit_test(bright_line_is_the_dark_one_upside_down),
        cmocka_unit_test(uneven_light_noise_and_glare),
        cmocka_unit_test(crossing_line_is_ignored),
        cmocka_unit_test(line_across_alone_is_reported),
        cmocka_unit_test(sharp_bend_gives_the_next_direction),
        cmocka_unit_test(curve_comes_as_segments_near_to_far),
        cmocka_unit_test(gaps_and_dashes_are_one_line),
        cmocka_unit_test(empty_floors_are_never_found),
        cmocka_unit_test(shadow_is_not_a_line),
        cmocka_unit_test(colored_line_in_every_format),
        cmocka_unit_test(hough_estimator_agrees_and_needs_its_memory),
        cmocka_unit_test(lane_is_the_middle_between_two_lines),
    };
    return cmocka_run_group_tests_name("follow", tests, NULL, NULL);
}
