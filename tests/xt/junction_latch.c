/* The latch: frames of a junction that comes nearer, as the follower and the search tell them. */
#include "iris/xt/junction_latch.h"

#include "../test.h"

#define W 160
#define H 120

static iris_angle degrees(int32_t n)
{
    return iris_angle_from_degrees(n);
}

/* A crossing, or what is left of it without some branches. */
static iris_junction junction_at(int32_t y, int left, int ahead, int right)
{
    iris_junction j = {IRIS_JUNCTION_T, 80 * 16, y * 16, H - 1 - y, 12, 0, {0}, 1000};
    j.branches[j.branch_count++] = degrees(-180);
    if (left) {
        j.branches[j.branch_count++] = degrees(-90);
    }
    if (ahead) {
        j.branches[j.branch_count++] = 0;
    }
    if (right) {
        j.branches[j.branch_count++] = degrees(90);
    }
    return j;
}

static iris_follow_result straight_line(void)
{
    return (iris_follow_result){.state = IRIS_LINE_FOUND, .width_px = 12, .confidence_permil = 900};
}

static iris_junction_latch latch_of(iris_turn turn)
{
    iris_junction_latch latch;
    assert_int_equal(iris_junction_latch_init(&latch, (iris_size){W, H}), IRIS_OK);
    assert_int_equal(iris_junction_latch_take(&latch, &turn, 1), IRIS_OK);
    return latch;
}

static iris_follow_result update(iris_junction_latch *latch, iris_follow_result line, const iris_junction *j)
{
    assert_int_equal(iris_junction_latch_update(&line, latch, j, j != NULL, 33), IRIS_OK);
    return line;
}

/* Down to the bottom in steps of 4 rows. Returns the last result before it has passed. */
static iris_follow_result come(iris_junction_latch *latch, int left, int ahead, int right)
{
    iris_follow_result line = straight_line();
    for (int32_t y = 20; latch->state != IRIS_LATCH_TURNS && y < H; y += 4) {
        iris_junction j = junction_at(y, left, ahead, right);
        line = update(latch, straight_line(), &j);
        assert_int_equal(latch->state == IRIS_LATCH_WAITS, y < 28);
    }
    assert_int_equal(latch->state, IRIS_LATCH_TURNS);
    return line;
}

static void changes_nothing_without_a_turn(void **state)
{
    (void)state;
    iris_junction_latch latch;
    iris_junction_latch_init(&latch, (iris_size){W, H});
    for (int32_t y = 20; y < H; y += 4) {
        iris_junction j = junction_at(y, 1, 1, 1);
        iris_follow_result before = straight_line(), line = update(&latch, before, &j);
        assert_memory_equal(&line, &before, sizeof line);
    }
}

static void leads_into_the_branch(void **state)
{
    (void)state;
    for (int side = -1; side <= 1; side += 2) {
        iris_junction_latch latch = latch_of(side < 0 ? IRIS_TURN_LEFT : IRIS_TURN_RIGHT);
        iris_follow_result line = come(&latch, 1, 1, 1);
        assert_int_equal(line.has_next, 1);
        assert_int_equal(line.next_angle, side * 16384);
        assert_true(line.angle > degrees(-3) && line.angle < degrees(3));
        assert_true(line.offset_q16 > -2000 && line.offset_q16 < 2000);
        assert_int_equal(line.segment_count, 2);
        assert_true((line.segments[1].x1 - line.segments[1].x0) * side > 0);

        line = update(&latch, straight_line(), NULL); /* what leads straight on is hidden */
        assert_int_equal(line.state, IRIS_LINE_LOST);
        for (int angle = 85; angle > 0; angle -= 5) { /* the branch comes around */
            iris_follow_result seen = straight_line();
            seen.angle = degrees(angle * side);
            assert_int_equal(latch.turn_count, angle > 15 ? 1 : 0);
            line = update(&latch, seen, NULL);
            assert_int_equal(line.state, IRIS_LINE_FOUND);
            assert_int_equal(line.angle, degrees(angle * side));
        }
        assert_int_equal(latch.state, IRIS_LATCH_DONE);
        assert_int_equal(latch.turn, side < 0 ? IRIS_TURN_LEFT : IRIS_TURN_RIGHT);
    }
}

/* A slow robot, whose branch is out of sight for two seconds: the line straight on, that leaves to the other side, is
 * never taken for it. Then the branch comes in on the side of the turn. */
static void refuses_the_old_line(void **state)
{
    (void)state;
    for (int side = -1; side <= 1; side += 2) {
        for (int rate = 25; rate <= 100; rate += 25) { /* degrees a second */
            iris_junction_latch latch = latch_of(side < 0 ? IRIS_TURN_LEFT : IRIS_TURN_RIGHT);
            come(&latch, 1, 1, 1);
            iris_follow_result line = straight_line(), seen = line;
            int32_t ms = 33;
            for (; rate * ms < 50000; ms += 33) {
                seen.angle = degrees(-rate * ms / 1000 * side);
                seen.state =
                    rate * ms / 1000 % 10 < 5 ? IRIS_LINE_FOUND : IRIS_LINE_LOST; /* it comes and goes */
                line = update(&latch, seen, NULL);
                assert_int_equal(line.state, IRIS_LINE_LOST);
                assert_int_equal(latch.state, IRIS_LATCH_TURNS);
            }
            for (; rate * ms < 100000 && latch.state == IRIS_LATCH_TURNS; ms += 33) {
                seen.state = IRIS_LINE_FOUND;
                seen.angle = degrees((90 - rate * ms / 1000) * side);
                line = update(&latch, seen, NULL);
                assert_int_equal(line.state, IRIS_LINE_FOUND);
                assert_int_equal(line.angle, seen.angle);
            }
            assert_int_equal(latch.state, IRIS_LATCH_DONE);
        }
    }
}

/* What still leads to the junction, and the other arm of a fork, are not the branch. */
static void takes_the_arm_of_a_fork(void **state)
{
    (void)state;
    iris_junction_latch latch = latch_of(IRIS_TURN_LEFT);
    for (int32_t y = 20; latch.state != IRIS_LATCH_TURNS && y < H; y += 4) {
        iris_junction j = junction_at(y, 1, 0, 1);
        j.branches[1] = degrees(-42);
        j.branches[2] = degrees(42);
        update(&latch, straight_line(), &j);
    }
    assert_int_equal(latch.state, IRIS_LATCH_TURNS);
    assert_int_equal(update(&latch, straight_line(), NULL).state, IRIS_LINE_LOST);
    iris_follow_result seen = straight_line();
    seen.angle = degrees(44);
    assert_int_equal(update(&latch, seen, NULL).state, IRIS_LINE_LOST);
    seen.angle = degrees(-38);
    assert_int_equal(update(&latch, seen, NULL).state, IRIS_LINE_FOUND);
}

/* The follower was on another line: its offset becomes the latch's without a jump. */
static void tells_no_jump(void **state)
{
    (void)state;
    iris_junction_latch latch = latch_of(IRIS_TURN_LEFT);
    iris_junction j = junction_at(60, 1, 1, 1);
    iris_follow_result across = straight_line(), line = across;
    across.offset_q16 = -131072;
    across.lookahead_offset_q16 = 49152;
    for (int frame = 0; frame < 40; frame++) {
        iris_follow_result before = line;
        line = update(&latch, across, &j);
        if (frame < 3) {
            assert_int_equal(line.offset_q16, across.offset_q16);
        } else {
            assert_true(line.offset_q16 >= before.offset_q16 && line.offset_q16 < before.offset_q16 + 32768);
            assert_true(line.lookahead_offset_q16 <= before.lookahead_offset_q16);
        }
    }
    assert_true(line.offset_q16 > -2000 && line.offset_q16 < 2000);
}

static void goes_straight_on(void **state)
{
    (void)state;
    iris_junction_latch latch = latch_of(IRIS_TURN_STRAIGHT);
    iris_follow_result line = come(&latch, 1, 1, 0), aside = straight_line();
    assert_int_equal(line.has_next, 0);
    aside.angle = degrees(-80);
    line = update(&latch, aside, NULL);
    assert_int_equal(line.state, IRIS_LINE_FOUND);
    assert_int_equal(line.angle, 0);
    for (int frame = 0; frame < 60; frame++) {
        line = update(&latch, straight_line(), NULL);
        assert_int_equal(line.state, IRIS_LINE_FOUND);
    }
    assert_int_equal(latch.turn_count, 0);
}

static void keeps_a_turn_that_is_not_offered(void **state)
{
    (void)state;
    iris_junction_latch latch = latch_of(IRIS_TURN_LEFT);
    for (int32_t y = 20; y < H; y += 4) {
        iris_junction j = junction_at(y, 0, 1, 1);
        iris_follow_result before = straight_line(), line = update(&latch, before, &j);
        assert_memory_equal(&line, &before, sizeof line);
    }
    assert_int_equal(latch.turn_count, 1);
    update(&latch, straight_line(), NULL);
    update(&latch, straight_line(), NULL);
    come(&latch, 1, 0, 1);
}

static void two_frames_are_no_junction(void **state)
{
    (void)state;
    iris_junction_latch latch = latch_of(IRIS_TURN_LEFT);
    for (int round = 0; round < 10; round++) {
        iris_junction j = junction_at(60, 1, 1, 1), elsewhere = j;
        elsewhere.x_q4 = 20 * 16;
        update(&latch, straight_line(), &j);
        update(&latch, straight_line(), &j);
        update(&latch, straight_line(), &elsewhere);
        update(&latch, straight_line(), NULL);
        assert_int_equal(latch.state, IRIS_LATCH_WAITS);
    }
    iris_junction j = junction_at(20, 1, 1, 1); /* one that vanishes far away was none */
    for (int frame = 0; frame < 3; frame++) {
        update(&latch, straight_line(), &j);
    }
    assert_int_equal(latch.state, IRIS_LATCH_COMING);
    for (int frame = 0; frame < 5; frame++) {
        update(&latch, straight_line(), NULL);
    }
    assert_int_equal(latch.state, IRIS_LATCH_WAITS);
    assert_int_equal(latch.turn_count, 1);
}

static void gives_up_in_time(void **state)
{
    (void)state;
    iris_junction_latch latch = latch_of(IRIS_TURN_RIGHT);
    come(&latch, 1, 1, 1);
    for (int frame = 0; frame < 125; frame++) {
        update(&latch, straight_line(), NULL);
    }
    assert_int_equal(latch.state, IRIS_LATCH_MISSED);
    assert_int_equal(latch.turn_count, 0);
    iris_turn next = IRIS_TURN_LEFT; /* one more waits again */
    assert_int_equal(iris_junction_latch_take(&latch, &next, 1), IRIS_OK);
    update(&latch, straight_line(), NULL);
    assert_int_equal(latch.state, IRIS_LATCH_WAITS);
    assert_int_equal(latch.turn, IRIS_TURN_LEFT);
}

static void refuses(void **state)
{
    (void)state;
    iris_junction_latch latch;
    iris_follow_result line = straight_line();
    iris_turn turns[IRIS_JUNCTION_TURNS_MAX + 1] = {IRIS_TURN_LEFT}, bad = (iris_turn)3;
    assert_int_equal(iris_junction_latch_init(NULL, (iris_size){W, H}), IRIS_ERR_ARG);
    assert_int_equal(iris_junction_latch_init(&latch, (iris_size){7, H}), IRIS_ERR_RANGE);
    assert_int_equal(iris_junction_latch_init(&latch, (iris_size){W, 8192}), IRIS_ERR_RANGE);
    assert_int_equal(iris_junction_latch_init(&latch, (iris_size){W, H}), IRIS_OK);
    assert_int_equal(iris_junction_latch_take(NULL, turns, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_junction_latch_take(&latch, NULL, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_junction_latch_take(&latch, turns, -1), IRIS_ERR_ARG);
    assert_int_equal(iris_junction_latch_take(&latch, &bad, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_junction_latch_take(&latch, turns, IRIS_JUNCTION_TURNS_MAX + 1), IRIS_ERR_FULL);
    assert_int_equal(latch.turn_count, 0);
    assert_int_equal(iris_junction_latch_take(&latch, turns, IRIS_JUNCTION_TURNS_MAX), IRIS_OK);
    assert_int_equal(iris_junction_latch_take(&latch, turns, 1), IRIS_ERR_FULL);
    assert_int_equal(iris_junction_latch_update(NULL, &latch, NULL, 0, 33), IRIS_ERR_ARG);
    assert_int_equal(iris_junction_latch_update(&line, NULL, NULL, 0, 33), IRIS_ERR_ARG);
    assert_int_equal(iris_junction_latch_update(&line, &latch, NULL, 1, 33), IRIS_ERR_ARG);
    assert_int_equal(iris_junction_latch_update(&line, &latch, NULL, -1, 33), IRIS_ERR_ARG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(changes_nothing_without_a_turn),
        cmocka_unit_test(leads_into_the_branch),
        cmocka_unit_test(refuses_the_old_line),
        cmocka_unit_test(takes_the_arm_of_a_fork),
        cmocka_unit_test(tells_no_jump),
        cmocka_unit_test(goes_straight_on),
        cmocka_unit_test(keeps_a_turn_that_is_not_offered),
        cmocka_unit_test(two_frames_are_no_junction),
        cmocka_unit_test(gives_up_in_time),
        cmocka_unit_test(refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
