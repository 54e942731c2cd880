/* What all sources of frames share, on a source that fails when it is told to. */
#include "fake_source.h"

static iris_capture capture;

static int fresh(void **state)
{
    (void)state;
    memset(&fake, 0, sizeof fake);
    fake.fail_at = NEVER;
    fake.waiting = NEVER;
    fake.grant =
        (iris_capture_grant){{8, 4}, IRIS_GRAY8, 8, 30000, BUFFERS, IRIS_MATRIX_BT601, IRIS_RANGE_FULL};
    memset(&capture, 0, sizeof capture);
    return 0;
}

static void open_with(const iris_capture_config *config)
{
    assert_int_equal(iris_capture_open(&capture, source, "somewhere", config), IRIS_OK);
    assert_true(iris_capture_is_running(&capture));
}

static iris_frame next(void)
{
    iris_frame frame;
    assert_int_equal(iris_capture_next(&frame, &capture, 50), IRIS_OK);
    return frame;
}

static void give(const iris_frame *frame)
{
    assert_int_equal(iris_capture_give(&capture, frame), IRIS_OK);
}

static void next_and_give(uint64_t sequence)
{
    iris_frame frame = next();
    assert_int_equal(frame.sequence, sequence);
    give(&frame);
}

static void arguments_are_checked(void **state)
{
    (void)state;
    static const iris_capture_config wrong[] = {
        {.size = {0, 4}},
        {.size = {4, 0}},
        {.size = {-1, -1}},
        {.size = {IRIS_SIDE_MAX + 1, 1}},
        {.format = -1},
        {.format = IRIS_HSL48 + 1},
        {.format = 99},
        {.format = 101},
        {.rate_millihz = -1},
        {.rate_millihz = 1000001},
        {.stride = -1},
        {.buffers = 1},
        {.buffers = -1},
        {.buffers = IRIS_CAPTURE_BUFFERS_MAX + 1},
        {.reconnect_ms = -1},
        {.reconnect_ms = 60001},
        {.policy = (iris_capture_policy)2},
    };
    iris_frame frame;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(iris_capture_open(&capture, source, "somewhere", &wrong[i]), IRIS_ERR_ARG);
        assert_false(iris_capture_is_running(&capture));
        assert_int_equal(iris_capture_next(&frame, &capture, 0), IRIS_ERR_ARG);
        iris_capture_close(&capture);
    }
    assert_int_equal(iris_capture_open(NULL, source, "somewhere", NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_capture_open(&capture, source, NULL, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_capture_open(&capture, (iris_capture_source){NULL, &fake}, "", NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_capture_open(&capture, (iris_capture_source){&driver, NULL}, "", NULL),
                     IRIS_ERR_ARG);
    assert_int_equal(fake.opens, 0);
    assert_non_null(iris_capture_problem(NULL));
    assert_false(iris_capture_is_running(NULL));
    iris_capture_close(NULL);

    open_with(NULL);
    assert_int_equal(iris_capture_next(NULL, &capture, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_capture_next(&frame, NULL, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_capture_next(&frame, &capture, -1), IRIS_ERR_ARG);
    assert_int_equal(iris_capture_give(&capture, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_capture_give(NULL, &frame), IRIS_ERR_ARG);
    frame = next();
    iris_frame strange = frame;
    strange.buffer = -1;
    assert_int_equal(iris_capture_give(&capture, &strange), IRIS_ERR_ARG);
    strange.buffer = IRIS_CAPTURE_BUFFERS_MAX;
    assert_int_equal(iris_capture_give(&capture, &strange), IRIS_ERR_ARG);
    strange.buffer = frame.buffer + 1;
    assert_int_equal(iris_capture_give(&capture, &strange), IRIS_ERR_ARG);
    give(&frame);
    assert_int_equal(iris_capture_give(&capture, &frame), IRIS_ERR_ARG);
    iris_capture_close(&capture);
    assert_int_equal(iris_capture_give(&capture, &frame), IRIS_ERR_ARG);
    assert_int_equal(iris_capture_next(&frame, &capture, 0), IRIS_ERR_ARG);
}

static void wishes_reach_the_source(void **state)
{
    (void)state;
    open_with(NULL);
    assert_int_equal(fake.wanted.buffers, 4);
    assert_int_equal(fake.wanted.reconnect_ms, 250);
    assert_int_equal(fake.wanted.policy, IRIS_CAPTURE_EVERY);
    assert_int_equal(fake.wanted.size.w, 0);
    assert_memory_equal(&capture.granted, &fake.grant, sizeof fake.grant);
    iris_capture_close(&capture);
    const iris_capture_config config = {{16, 8}, IRIS_CAPTURE_NV12, 25000, 32, 8, 7, IRIS_CAPTURE_LATEST};
    open_with(&config);
    assert_memory_equal(&fake.wanted, &config, sizeof config);
    iris_capture_close(&capture);
    iris_capture_close(&capture);
    assert_int_equal(fake.closes, 2);
}

static void an_open_that_fails_leaves_nothing_open(void **state)
{
    (void)state;
    for (int step = 0; step < 2; step++) {
        for (int status = IRIS_ERR_RANGE; status <= IRIS_ERR_TIMEOUT; status++) {
            fresh(NULL);
            fake.fail_at = step;
            fake.fail_times = 1;
            fake.fail_status = (iris_status)status;
            assert_int_equal(iris_capture_open(&capture, source, "somewhere", NULL), status);
            assert_false(fake.is_open || iris_capture_is_running(&capture));
            assert_string_equal(iris_capture_problem(&capture), "because");
            iris_capture_close(&capture);
        }
    }
}

static void every_frame_comes_in_turn(void **state)
{
    (void)state;
    open_with(NULL);
    next_and_give(0);
    next_and_give(1);
    fake.sequence += 3; /* lost by the source */
    next_and_give(5);
    assert_int_equal(capture.dropped, 3);
    fake.sequence = 2; /* a count that runs backwards tells nothing */
    next_and_give(6);
    next_and_give(7);
    fake.sequence = 3; /* nor one that stands still */
    next_and_give(8);
    fake.sequence = 3;
    next_and_give(9);
    assert_int_equal(capture.dropped, 3);
    assert_int_equal(capture.frames, 7);
    assert_int_equal(capture.skipped + capture.damaged + capture.restarts + capture.returns, 0);
    iris_capture_close(&capture);
    assert_int_equal(capture.frames, 7);
}

static void a_count_of_32_bits_wraps(void **state)
{
    (void)state;
    open_with(NULL);
    fake.sequence = 0xfffffffdu;
    for (uint64_t i = 0; i < 3; i++) {
        next_and_give(i);
    }
    fake.sequence += 2; /* 0 and 1 are lost, just behind the end */
    next_and_give(5);
    assert_int_equal(capture.dropped, 2);
    iris_capture_close(&capture);
}

static void the_latest_overtakes(void **state)
{
    (void)state;
    open_with(&(iris_capture_config){.policy = IRIS_CAPTURE_LATEST});
    fake.waiting = 3;
    next_and_give(2);
    assert_int_equal(capture.skipped, 2);
    fake.waiting = 1;
    next_and_give(3);
    fake.waiting = 4;
    fake.damaged = 2; /* the first two */
    next_and_give(7);
    assert_int_equal(capture.damaged, 2);
    assert_int_equal(capture.skipped, 3);
    assert_int_equal(capture.frames, 3);
    assert_int_equal(fake.borrowed, 0);
    fake.waiting = NEVER; /* a source that is always faster */
    iris_frame frame = next();
    assert_true(frame.sequence < 8 + 2 * IRIS_CAPTURE_BUFFERS_MAX);
    give(&frame);
    assert_int_equal(capture.frames + capture.skipped + capture.damaged, fake.sequence);
    iris_capture_close(&capture);
}

static void damaged_frames_are_counted(void **state)
{
    (void)state;
    open_with(NULL);
    fake.damaged = 2;
    next_and_give(2);
    assert_int_equal(capture.damaged, 2);
    assert_int_equal(capture.dropped, 0);
    fake.damaged = NEVER;
    int64_t start_ms = now_ms();
    iris_frame frame;
    assert_int_equal(iris_capture_next(&frame, &capture, 30), IRIS_ERR_TIMEOUT);
    assert_in_range(now_ms() - start_ms, 29, 3000);
    iris_capture_close(&capture);
}

static void all_but_one_may_be_borrowed(void **state)
{
    (void)state;
    iris_frame frames[BUFFERS];
    open_with(NULL);
    for (int i = 0; i < BUFFERS - 1; i++) {
        frames[i] = next();
        assert_int_equal(frames[i].sequence, i);
    }
    memset(&frames[BUFFERS - 1], 0x5a, sizeof frames[0]);
    iris_frame before = frames[BUFFERS - 1];
    assert_int_equal(iris_capture_next(&frames[BUFFERS - 1], &capture, 50), IRIS_ERR_FULL);
    assert_memory_equal(&frames[BUFFERS - 1], &before, sizeof before);
    give(&frames[1]); /* in any order */
    frames[1] = next();
    assert_int_equal(frames[1].sequence, 3);
    give(&frames[2]);
    give(&frames[0]);
    give(&frames[1]);
    assert_int_equal(fake.borrowed, 0);
    iris_capture_close(&capture);
}

static void waits_have_an_end(void **state)
{
    (void)state;
    iris_frame frame;
    open_with(NULL);
    fake.waiting = 0;
    int64_t start_ms = now_ms();
    assert_int_equal(iris_capture_next(&frame, &capture, 40), IRIS_ERR_TIMEOUT);
    assert_in_range(now_ms() - start_ms, 39, 3000);
    assert_int_equal(iris_capture_next(&frame, &capture, 0), IRIS_ERR_TIMEOUT);
    fake.waiting = 1;
    next_and_give(0);
    iris_capture_close(&capture);
}

static void a_recording_ends(void **state)
{
    (void)state;
    iris_frame frame;
    open_with(NULL);
    next_and_give(0);
    fake.fail_at = 0;
    fake.fail_times = NEVER;
    fake.fail_status = IRIS_ERR_END;
    assert_int_equal(iris_capture_next(&frame, &capture, 50), IRIS_ERR_END);
    assert_int_equal(iris_capture_next(&frame, &capture, 50), IRIS_ERR_END);
    assert_true(iris_capture_is_running(&capture));
    iris_capture_close(&capture);
}

static void a_stream_that_breaks_is_started_again(void **state)
{
    (void)state;
    open_with(NULL);
    iris_frame held = next();
    next_and_give(1);
    fake.broken = 1;
    next_and_give(2); /* the source's count began anew, ours goes on */
    assert_int_equal(capture.restarts, 1);
    assert_int_equal(capture.dropped + capture.returns, 0);
    give(&held); /* borrowed before, given back after it */
    assert_int_equal(fake.borrowed, 0);
    assert_int_equal(fake.opens, 1);
    iris_capture_close(&capture);
}

static void a_stream_that_goes_on_breaking_is_lost(void **state)
{
    (void)state;
    static const int32_t timeouts[] = {0, 20};
    for (int i = 0; i < 2; i++) {
        iris_frame frame;
        fresh(NULL);
        open_with(&(iris_capture_config){.reconnect_ms = 10000});
        fake.broken = 2;
        for (int turn = 0; turn < 2; turn++) {
            iris_status status = iris_capture_next(&frame, &capture, timeouts[i]);
            assert_true(status == IRIS_ERR_IO || status == IRIS_ERR_TIMEOUT);
        }
        assert_false(iris_capture_is_running(&capture) || fake.is_open);
        assert_int_equal(capture.restarts, 1);
        assert_int_equal(iris_capture_next(&frame, &capture, 0), IRIS_ERR_IO);
        iris_capture_close(&capture);
        assert_int_equal(fake.closes, 1);
    }
}

static void lose_the_source(int missing)
{
    iris_frame frame;
    fake.broken = 2;
    fake.missing = missing;
    assert_int_equal(iris_capture_next(&frame, &capture, 5), IRIS_ERR_IO);
    assert_false(iris_capture_is_running(&capture));
}

static void a_lost_source_comes_back(void **state)
{
    (void)state;
    iris_frame frame;
    open_with(&(iris_capture_config){.reconnect_ms = 30});
    next_and_give(0);
    lose_the_source(2);
    assert_false(fake.is_open);
    int64_t start_ms = now_ms();
    assert_int_equal(iris_capture_next(&frame, &capture, 10), IRIS_ERR_IO); /* too early to try */
    assert_in_range(now_ms() - start_ms, 9, 3000);
    assert_int_equal(fake.opens, 1);
    fake.broken = 0;
    int turns = 0;
    while (iris_capture_next(&frame, &capture, 10) == IRIS_ERR_IO) {
        assert_true(++turns < 100);
    }
    assert_int_equal(frame.sequence, 1);
    give(&frame);
    assert_int_equal(fake.opens, 4); /* two attempts in vain */
    for (int i = 2; i < 4; i++) {
        assert_true(fake.opened_ms[i] - fake.opened_ms[i - 1] >= 30);
    }
    assert_int_equal(capture.returns, 1);
    assert_int_equal(capture.restarts, 1);
    assert_int_equal(capture.dropped, 0);
    iris_capture_close(&capture);
    assert_int_equal(fake.closes, 2);
}

static void it_comes_back_within_one_wait(void **state)
{
    (void)state;
    open_with(&(iris_capture_config){.reconnect_ms = 10});
    lose_the_source(0);
    fake.broken = 0;
    next_and_give(0);
    assert_int_equal(capture.returns, 1);
    iris_capture_close(&capture);
}

static void frames_may_be_borrowed_while_the_source_is_lost(void **state)
{
    (void)state;
    iris_frame frame;
    open_with(&(iris_capture_config){.reconnect_ms = 1});
    iris_frame first = next(), second = next();
    lose_the_source(0);
    fake.broken = 0;
    assert_true(fake.is_open); /* their memory is there */
    int64_t start_ms = now_ms();
    assert_int_equal(iris_capture_next(&frame, &capture, 20), IRIS_ERR_IO);
    assert_in_range(now_ms() - start_ms, 19, 3000);
    assert_int_equal(iris_capture_give(&capture, &second), IRIS_ERR_IO);
    assert_int_equal(iris_capture_give(&capture, &second), IRIS_ERR_ARG);
    assert_true(fake.is_open);
    assert_int_equal(iris_capture_give(&capture, &first), IRIS_ERR_IO);
    assert_false(fake.is_open);
    next_and_give(2);
    assert_int_equal(capture.returns, 1);
    iris_capture_close(&capture);
    assert_int_equal(fake.opens, fake.closes);
}

static void what_comes_back_has_to_be_the_same(void **state)
{
    (void)state;
    iris_frame frame;
    open_with(&(iris_capture_config){.reconnect_ms = 1});
    assert_int_equal(fake.wanted.size.w + fake.wanted.format, 0);
    lose_the_source(0);
    fake.broken = 0;
    fake.grant.format = IRIS_YUYV;
    for (int i = 0; i < 3; i++) {
        assert_int_equal(iris_capture_next(&frame, &capture, 10), IRIS_ERR_IO);
        assert_false(fake.is_open);
        assert_non_null(strstr(iris_capture_problem(&capture), "another"));
    }
    fake.grant.format = IRIS_GRAY8;
    fake.grant.size = (iris_size){16, 16}; /* what it is set to now, but the old size is asked for */
    next_and_give(0);
    assert_int_equal(fake.wanted.size.w, 8);
    assert_int_equal(fake.wanted.size.h, 4);
    assert_int_equal(fake.wanted.format, IRIS_GRAY8);
    assert_string_equal(iris_capture_problem(&capture), "because");
    assert_int_equal(capture.returns, 1);
    iris_capture_close(&capture);
}

static void closing_ends_every_state(void **state)
{
    (void)state;
    open_with(NULL); /* borrowed */
    (void)next();
    iris_capture_close(&capture);
    assert_false(fake.is_open);
    open_with(NULL); /* away */
    lose_the_source(NEVER);
    iris_capture_close(&capture);
    assert_false(fake.is_open);
    fresh(NULL);
    open_with(NULL); /* broken, with a frame borrowed */
    (void)next();
    lose_the_source(NEVER);
    assert_true(fake.is_open);
    iris_capture_close(&capture);
    assert_false(fake.is_open);
}

/* Twelve frames, two of them held over the next ones. 0: could not be opened. */
static int session(iris_capture_policy policy)
{
    const iris_capture_config config = {.reconnect_ms = 1, .policy = policy};
    iris_frame held[2];
    int holds = 0;
    if (iris_capture_open(&capture, source, "somewhere", &config) != IRIS_OK) {
        return 0;
    }
    uint64_t last = 0;
    for (int frames = 0, turns = 0; frames < 12; turns++) {
        iris_frame frame;
        assert_true(turns < 100);
        fake.waiting = 2;
        iris_status status = iris_capture_next(&frame, &capture, 3);
        if (status == IRIS_OK) {
            assert_true(frames == 0 || frame.sequence > last);
            last = frame.sequence;
            frames++;
            held[holds++] = frame;
        }
        if (holds == 2 || status != IRIS_OK) {
            while (holds > 0) {
                status = iris_capture_give(&capture, &held[--holds]);
                assert_true(status == IRIS_OK || status == fake.fail_status || status == IRIS_ERR_IO);
            }
        }
    }
    while (holds > 0) {
        (void)iris_capture_give(&capture, &held[--holds]);
    }
    assert_int_equal(fake.borrowed, 0);
    assert_int_equal(capture.frames, 12);
    iris_capture_close(&capture);
    return 1;
}

static void a_failure_at_every_step_is_survived(void **state)
{
    (void)state;
    static const iris_status statuses[] = {IRIS_ERR_IO, IRIS_ERR_DATA, IRIS_ERR_TIMEOUT};
    int sessions = 0, opened = 0;
    for (int i = 0; i < 3 * 2 * 3; i++) {
        iris_capture_policy policy = i % 2 ? IRIS_CAPTURE_LATEST : IRIS_CAPTURE_EVERY;
        int steps = 1;
        for (int at = 0; at < steps; at++) {
            fresh(NULL);
            fake.fail_at = at;
            fake.fail_times = 1 + i / 6;
            fake.fail_status = statuses[i / 2 % 3];
            int did = session(policy);
            steps = did && fake.step > at ? fake.step - fake.fail_times : steps + (at < 2);
            opened += did;
            sessions++;
            assert_false(fake.is_open);
            assert_int_equal(fake.borrowed, 0);
        }
    }
    print_message("#: %d sessions with a failure at one step, %d went on\n", sessions, opened);
    assert_true(sessions > 300 && opened > sessions * 8 / 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(arguments_are_checked, fresh),
        cmocka_unit_test_setup(wishes_reach_the_source, fresh),
        cmocka_unit_test_setup(an_open_that_fails_leaves_nothing_open, fresh),
        cmocka_unit_test_setup(every_frame_comes_in_turn, fresh),
        cmocka_unit_test_setup(a_count_of_32_bits_wraps, fresh),
        cmocka_unit_test_setup(the_latest_overtakes, fresh),
        cmocka_unit_test_setup(damaged_frames_are_counted, fresh),
        cmocka_unit_test_setup(all_but_one_may_be_borrowed, fresh),
        cmocka_unit_test_setup(waits_have_an_end, fresh),
        cmocka_unit_test_setup(a_recording_ends, fresh),
        cmocka_unit_test_setup(a_stream_that_breaks_is_started_again, fresh),
        cmocka_unit_test_setup(a_stream_that_goes_on_breaking_is_lost, fresh),
        cmocka_unit_test_setup(a_lost_source_comes_back, fresh),
        cmocka_unit_test_setup(it_comes_back_within_one_wait, fresh),
        cmocka_unit_test_setup(frames_may_be_borrowed_while_the_source_is_lost, fresh),
        cmocka_unit_test_setup(what_comes_back_has_to_be_the_same, fresh),
        cmocka_unit_test_setup(closing_ends_every_state, fresh),
        cmocka_unit_test_setup(a_failure_at_every_step_is_survived, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
