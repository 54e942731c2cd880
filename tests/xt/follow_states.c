/* Line following over time, in pieces, in exact memory, and under hostile input. */
#include "floor.h"

static floor_picture picture;
static iris_follow_result result;
static test_follower follower;

static void found_then_stale_then_lost(void **state)
{
    (void)state;
    start(&follower, NULL);
    paint_floor(&picture, 200, 6, 1);
    feed(&result, &follower, &picture, 1000);
    assert_int_equal(result.state, IRIS_LINE_LOST); /* nothing to repeat yet */
    paint_tape(&picture, 60, 10, 14, 0, FLOOR_H - 1);
    feed(&result, &follower, &picture, 1033);
    assert_int_equal(result.state, IRIS_LINE_FOUND);
    iris_follow_result found = result;

    paint_floor(&picture, 200, 6, 1);
    for (uint32_t ms = 1066; ms <= 1233; ms += 167) {
        feed(&result, &follower, &picture, ms);
        assert_int_equal(result.state, IRIS_LINE_STALE);
        assert_int_equal(result.angle, found.angle);
        assert_int_equal(result.offset_q16, found.offset_q16);
        assert_int_equal(result.segment_count, found.segment_count);
        assert_null(result.rows);
    }
    feed(&result, &follower, &picture, 1234);
    assert_int_equal(result.state, IRIS_LINE_LOST);
    assert_int_equal(result.angle, 0);
    assert_int_equal(result.segment_count, 0);
    feed(&result, &follower, &picture, 1100); /* a clock that goes back revives nothing */
    assert_int_equal(result.state, IRIS_LINE_LOST);
}

static void forgets_and_survives_a_wrapping_clock(void **state)
{
    (void)state;
    start(&follower, NULL);
    paint_floor(&picture, 200, 6, 1);
    paint_tape(&picture, 60, 10, 14, 0, FLOOR_H - 1);
    feed(&result, &follower, &picture, UINT32_MAX - 50);
    paint_floor(&picture, 200, 6, 1);
    feed(&result, &follower, &picture, 49);
    assert_int_equal(result.state, IRIS_LINE_STALE);
    iris_follow_forget(&follower.follow);
    feed(&result, &follower, &picture, 50);
    assert_int_equal(result.state, IRIS_LINE_LOST);
    iris_follow_forget(NULL);
}

static void rows_as_they_arrive_are_the_frame(void **state)
{
    (void)state;
    static test_follower by_rows;
    iris_follow_result other;
    start(&follower, NULL);
    start(&by_rows, NULL);
    paint_floor(&picture, 200, 12, 0.4);
    paint_tape(&picture, 60, 25, 14, 10, FLOOR_H - 1);
    feed(&result, &follower, &picture, 0);
    assert_int_equal(iris_follow_begin(&by_rows.follow), IRIS_OK);
    assert_int_equal(iris_follow_row(&by_rows.follow, picture.pixels[50]), IRIS_OK);
    assert_int_equal(iris_follow_begin(&by_rows.follow), IRIS_OK); /* starts over */
    for (int y = 0; y < FLOOR_H; y++) {
        uint8_t row[FLOOR_W + 3]; /* not aligned, and gone after the call */
        memcpy(row + 1 + y % 3, picture.pixels[y], FLOOR_W);
        assert_int_equal(iris_follow_row(&by_rows.follow, row + 1 + y % 3), IRIS_OK);
        memset(row, 0, sizeof row);
    }
    assert_int_equal(iris_follow_row(&by_rows.follow, picture.pixels[0]), IRIS_ERR_RANGE);
    assert_int_equal(iris_follow_end(&other, &by_rows.follow, 0), IRIS_OK);
    assert_memory_equal(result.rows, other.rows, FLOOR_H * sizeof(iris_span));
    result.rows = other.rows = NULL;
    assert_memory_equal(&result, &other, sizeof result);
    assert_int_equal(iris_follow_end(&other, &by_rows.follow, 0), IRIS_ERR_RANGE);
    assert_int_equal(iris_follow_row(&by_rows.follow, picture.pixels[0]), IRIS_ERR_RANGE);
}

static void a_frame_that_ends_early_has_no_line_below(void **state)
{
    (void)state;
    start(&follower, NULL);
    paint_floor(&picture, 200, 6, 1);
    paint_tape(&picture, 70, 5, 14, 0, FLOOR_H - 1);
    feed(&result, &follower, &picture, 0); /* the memory is full of an earlier frame */
    assert_int_equal(iris_follow_begin(&follower.follow), IRIS_OK);
    for (int y = 0; y < 60; y++) {
        assert_int_equal(iris_follow_row(&follower.follow, picture.pixels[y]), IRIS_OK);
    }
    assert_int_equal(iris_follow_end(&result, &follower.follow, 33), IRIS_OK);
    assert_int_equal(result.state, IRIS_LINE_FOUND);
    assert_near(degrees(result.angle), 5, 1.5);
    for (int y = 0; y < FLOOR_H; y++) {
        assert_int_equal(result.rows[y].right >= result.rows[y].left, y < 60);
    }
    assert_int_equal(iris_follow_begin(&follower.follow), IRIS_OK);
    assert_int_equal(iris_follow_end(&result, &follower.follow, 66), IRIS_OK);
    assert_int_equal(result.state, IRIS_LINE_STALE);
}

static void views_of_any_stride(void **state)
{
    (void)state;
    static uint8_t big[FLOOR_H + 9][FLOOR_W + 31];
    iris_image whole, part;
    iris_follow_result other;
    paint_floor(&picture, 200, 9, 0.5);
    paint_tape(&picture, 60, -20, 14, 0, FLOOR_H - 1);
    start(&follower, NULL);
    feed(&result, &follower, &picture, 0);
    memset(big, 7, sizeof big);
    for (int y = 0; y < FLOOR_H; y++) { /* bottom-up, and inside of a larger picture */
        memcpy(&big[FLOOR_H + 3 - y][5], picture.pixels[y], FLOOR_W);
    }
    assert_int_equal(iris_image_wrap(&whole, big, sizeof big, (iris_size){FLOOR_W + 31, FLOOR_H + 9},
                                     -(FLOOR_W + 31), IRIS_GRAY8),
                     IRIS_OK);
    assert_int_equal(iris_image_crop(&part, &whole, (iris_rect){5, 5, FLOOR_W, FLOOR_H}), IRIS_OK);
    start(&follower, NULL);
    assert_int_equal(iris_follow_frame(&other, &follower.follow, &part, 0), IRIS_OK);
    result.rows = other.rows = NULL;
    assert_memory_equal(&result, &other, sizeof result);
}

static void memory_is_exact(void **state)
{
    (void)state;
    const iris_size sizes[] = {{160, 120}, {8, 8}, {33, 9}, {321, 57}, {640, 480}};
    static IRIS_SCRATCH_BUFFER(memory, IRIS_FOLLOW_FULL_SCRATCH_BYTES(640, 480));
    static iris_follow kept, made;
    iris_scratch scratch;
    for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; k++) {
        size_t gray = IRIS_FOLLOW_SCRATCH_BYTES(sizes[k].w, sizes[k].h);
        size_t color = IRIS_FOLLOW_FULL_SCRATCH_BYTES(sizes[k].w, sizes[k].h);
        assert_int_equal(iris_scratch_init(&scratch, memory.memory, gray), IRIS_OK);
        assert_int_equal(iris_follow_init(&made, sizes[k], NULL, &scratch), IRIS_OK);
        assert_int_equal(scratch.peak, gray);
        assert_int_equal(iris_scratch_init(&scratch, memory.memory, color), IRIS_OK);
        assert_int_equal(iris_follow_init_full(&made, sizes[k], NULL, &scratch), IRIS_OK);
        assert_int_equal(scratch.peak, color);
        made = kept;
        assert_int_equal(iris_scratch_init(&scratch, memory.memory, gray - 1), IRIS_OK);
        assert_int_equal(iris_follow_init(&made, sizes[k], NULL, &scratch), IRIS_ERR_SCRATCH);
        assert_int_equal(scratch.used, 0);
        assert_int_equal(iris_scratch_init(&scratch, memory.memory, color - 1), IRIS_OK);
        assert_int_equal(iris_follow_init_full(&made, sizes[k], NULL, &scratch), IRIS_ERR_SCRATCH);
        assert_int_equal(scratch.used, 0);
        assert_memory_equal(&made, &kept, sizeof made);
    }
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    const iris_size size = {FLOOR_W, FLOOR_H};
    iris_scratch scratch;
    iris_image frame;
    assert_int_equal(iris_scratch_init(&scratch, follower.memory.memory, sizeof follower.memory.memory),
                     IRIS_OK);
    assert_int_equal(iris_follow_init(NULL, size, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_follow_init(&follower.follow, size, NULL, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_follow_init(&follower.follow, (iris_size){7, 100}, NULL, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(
        iris_follow_init(&follower.follow, (iris_size){100, IRIS_FOLLOW_SIDE_MAX + 1}, NULL, &scratch),
        IRIS_ERR_RANGE);
    for (int k = 0; k < 12; k++) {
        iris_follow_config config;
        iris_follow_defaults(&config);
        int32_t *fields[] = {&config.lane, &config.contrast_permil, &config.min_width_permil,
                             &config.lookahead_permil, &config.hold_ms};
        const int32_t outside[][2] = {{-1, 2}, {99, 901}, {0, 501}, {-1, 1001}, {-1, 60001}};
        if (k < 10) {
            *fields[k / 2] = outside[k / 2][k % 2];
        } else {
            config.kind = (iris_follow_kind)(k == 10 ? 3 : -1);
        }
        assert_int_equal(iris_follow_init(&follower.follow, size, &config, &scratch), IRIS_ERR_ARG);
        assert_int_equal(iris_follow_init_full(&follower.follow, size, &config, &scratch), IRIS_ERR_ARG);
    }
    iris_follow_config config;
    iris_follow_defaults(&config);
    config.format = IRIS_RGB888;
    assert_int_equal(iris_follow_init(&follower.follow, size, &config, &scratch), IRIS_ERR_FORMAT);
    config.format = IRIS_MASK1;
    assert_int_equal(iris_follow_init_full(&follower.follow, size, &config, &scratch), IRIS_ERR_FORMAT);
    config.format = IRIS_YUYV;
    assert_int_equal(iris_follow_init_full(&follower.follow, (iris_size){33, 20}, &config, &scratch),
                     IRIS_ERR_RANGE);
    config.kind = IRIS_FOLLOW_COLOR;
    config.color = (iris_hsl_range){0, 361, 0, 100, 0, 100};
    assert_int_equal(iris_follow_init_full(&follower.follow, size, &config, &scratch), IRIS_ERR_ARG);

    start(&follower, NULL);
    paint_floor(&picture, 200, 6, 1);
    assert_int_equal(iris_image_wrap(&frame, picture.pixels, sizeof picture.pixels,
                                     (iris_size){FLOOR_W, FLOOR_H - 1}, 0, IRIS_GRAY8),
                     IRIS_OK);
    assert_int_equal(iris_follow_frame(&result, &follower.follow, &frame, 0), IRIS_ERR_RANGE);
    frame.h = FLOOR_H;
    frame.format = IRIS_BAYER8_RGGB;
    assert_int_equal(iris_follow_frame(&result, &follower.follow, &frame, 0), IRIS_ERR_FORMAT);
    assert_int_equal(iris_follow_frame(NULL, &follower.follow, &frame, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_follow_frame(&result, NULL, &frame, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_follow_frame(&result, &follower.follow, NULL, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_follow_begin(NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_follow_row(&follower.follow, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_follow_end(NULL, &follower.follow, 0), IRIS_ERR_ARG);
    iris_follow_defaults(NULL);
}

/* Blocky random pictures of every size: whatever is answered must be within its documented range. */
static void any_picture_of_any_size_is_answered(void **state)
{
    (void)state;
    static IRIS_SCRATCH_BUFFER(memory, IRIS_FOLLOW_FULL_SCRATCH_BYTES(80, 80));
    static uint8_t pixels[80 * 80];
    static iris_follow tried;
    uint32_t random = 1;
    int found = 0;
    for (int trial = 0; trial < 6000; trial++) {
        iris_size size = {8 + trial % 71, 8 + trial * 7 % 67};
        int block = 1 << trial % 6;
        for (int i = 0; i < size.w * size.h; i++) {
            int cell = i / size.w / block * 80 + i % size.w / block;
            random = (uint32_t)(cell + 1) * 2654435761u ^ (uint32_t)trial * 40503u;
            random ^= random >> 15;
            pixels[i] = (uint8_t)((random * 2246822519u >> 24) & (trial % 5 ? 255 : 192));
        }
        iris_follow_config config;
        iris_scratch scratch;
        iris_image frame;
        iris_follow_defaults(&config);
        config.kind = trial % 2 ? IRIS_FOLLOW_BRIGHT : IRIS_FOLLOW_DARK;
        config.lane = trial % 3 == 0;
        config.min_width_permil = 1 + trial % 60;
        config.lookahead_permil = trial % 1001;
        assert_int_equal(iris_scratch_init(&scratch, memory.memory, sizeof memory.memory), IRIS_OK);
        assert_int_equal(iris_follow_init_full(&tried, size, &config, &scratch), IRIS_OK);
        assert_int_equal(iris_image_wrap(&frame, pixels, sizeof pixels, size, 0, IRIS_GRAY8), IRIS_OK);
        assert_int_equal(iris_follow_frame(&result, &tried, &frame, 0), IRIS_OK);
        found += result.state == IRIS_LINE_FOUND;
        if (result.state == IRIS_LINE_FOUND) {
            assert_true(result.angle >= -16384 && result.angle <= 16384);
            assert_true(result.offset_q16 >= -131072 && result.offset_q16 <= 131072);
            assert_true(result.confidence_permil >= 0 && result.confidence_permil <= 1000);
            assert_true(result.segment_count >= 1 && result.segment_count <= IRIS_FOLLOW_SEGMENTS_MAX);
            for (int y = 0; y < size.h; y++) {
                iris_span row = result.rows[y];
                assert_true(row.right < row.left || (row.left >= 0 && row.right < size.w));
            }
        }
    }
    assert_true(found > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(found_then_stale_then_lost),
        cmocka_unit_test(forgets_and_survives_a_wrapping_clock),
        cmocka_unit_test(rows_as_they_arrive_are_the_frame),
        cmocka_unit_test(a_frame_that_ends_early_has_no_line_below),
        cmocka_unit_test(views_of_any_stride),
        cmocka_unit_test(memory_is_exact),
        cmocka_unit_test(wrong_calls_are_refused),
        cmocka_unit_test(any_picture_of_any_size_is_answered),
    };
    return cmocka_run_group_tests_name("follow_states", tests, NULL, NULL);
}
