/* A pair's text: what is written is read again bit by bit, and what is damaged is refused with its line. */
#include "iris/3d/pair_text.h"

#include <stdlib.h>
#include <string.h>

#include "random3d.h"
#include "test.h"

static iris_q32 some(void)
{
    return any_q32() % (1000000000 * IRIS_Q32_ONE);
}

static iris_pair random_of_two(void)
{
    iris_pair made = {.turn = {some(), some(), some()}, .place = {some(), some(), some()}};
    for (int k = 0; k < 2; k++) {
        made.cameras[k] = (iris_camera_model){{640 + k, 480 - k},
                                              {llabs(some()) | 1, llabs(some()) | 1, some(), some(), some()},
                                              {some(),
                                               some(),
                                               some(),
                                               some(),
                                               some(),
                                               {some(), some()},
                                               k ? IRIS_LENS_CORRECTS : IRIS_LENS_BENDS}};
    }
    return made;
}

static int is_same(const iris_pair *a, const iris_pair *b)
{
    int same =
        memcmp(&a->turn, &b->turn, sizeof a->turn) == 0 && memcmp(&a->place, &b->place, sizeof a->place) == 0;
    for (int k = 0; k < 2; k++) {
        const iris_camera_model *p = &a->cameras[k], *q = &b->cameras[k];
        same = same && p->size.w == q->size.w && p->size.h == q->size.h &&
               memcmp(&p->intrinsics, &q->intrinsics, sizeof p->intrinsics) == 0 &&
               p->lens.k1 == q->lens.k1 && p->lens.k2 == q->lens.k2 && p->lens.k3 == q->lens.k3 &&
               p->lens.p1 == q->lens.p1 && p->lens.p2 == q->lens.p2 && p->lens.center.x == q->lens.center.x &&
               p->lens.center.y == q->lens.center.y && p->lens.direction == q->lens.direction;
    }
    return same;
}

static void round_trips(void **state)
{
    (void)state;
    for (int i = 0; i < 1000; i++) {
        const iris_pair pair = random_of_two();
        iris_pair again = {.turn = {0, 0, 0}};
        char text[IRIS_PAIR_TEXT_BYTES];
        size_t length = 0;
        int32_t line = 0;
        assert_int_equal(iris_pair_write_text(text, sizeof text, &length, &pair), IRIS_OK);
        assert_int_equal(length, strlen(text));
        assert_int_equal(iris_pair_read_text(&again, &line, text, length + i % 2), IRIS_OK);
        assert_true(is_same(&again, &pair));
    }
}

/* Its lines by hand, but for the check. */
static void by_hand(void **state)
{
    (void)state;
    const iris_q32 one = IRIS_Q32_ONE;
    iris_pair pair = {.turn = {0, one / 16, -one}, .place = {120 * one, 0, one / 2}};
    char text[IRIS_PAIR_TEXT_BYTES];
    size_t length = 0;
    for (int k = 0; k < 2; k++) {
        pair.cameras[k] = (iris_camera_model){
            {640, 480}, {500 * one, 501 * one, 0, 320 * one, 240 * one}, {.k1 = -one / 4}};
    }
    pair.cameras[1].lens.direction = IRIS_LENS_CORRECTS;
    assert_int_equal(iris_pair_write_text(text, sizeof text, &length, &pair), IRIS_OK);
#define CAMERA(direction)                                                                                    \
    "size 640 480\nfocal 500.0000000000 501.0000000000\nskew 0.0000000000\ncenter 320.0000000000 "           \
    "240.0000000000\nlens " direction                                                                        \
    "\nradial -0.2500000000 0.0000000000 0.0000000000\ntangential 0.0000000000 0.0000000000\n"               \
    "decentering 0.0000000000 0.0000000000\n"
    static const char wanted[] = "iris pair 1\nleft\n" CAMERA("bends") "right\n" CAMERA(
        "corrects") "turn 0.0000000000 0.0625000000 -1.0000000000\nplace 120.0000000000 0.0000000000 "
                    "0.5000000000\ncheck ";
    assert_int_equal(strncmp(text, wanted, sizeof wanted - 1), 0);
    assert_int_equal(length, sizeof wanted - 1 + 9);
}

/* In the left camera's frame, by hand: the right one looks to the left by a right angle. */
static void as_sensors(void **state)
{
    (void)state;
    iris_pair pair = random_of_two();
    iris_sensor sensors[2];
    pair.turn = (iris_vec3){0, IRIS_PI_Q32 / 2, 0};
    pair.place = (iris_vec3){3 * IRIS_Q32_ONE, 0, 0};
    iris_pair_sensors(sensors, &pair);
    const iris_vec3 ahead = {0, 0, 5 * IRIS_Q32_ONE};
    const iris_vec3 left = iris_pose_into(&sensors[0].pose, ahead),
                    right = iris_pose_into(&sensors[1].pose, ahead);
    assert_memory_equal(&left, &ahead, sizeof left);
    assert_true(fabs(real(right.x) - 5) < 1e-8 && fabs(real(right.y)) < 1e-8 &&
                fabs(real(right.z) - 3) < 1e-8);
    assert_true(sensors[1].intrinsics.u0 == pair.cameras[1].intrinsics.u0 &&
                sensors[0].lens.p2 == pair.cameras[0].lens.p2);
}

static void refused(void **state)
{
    (void)state;
    iris_pair pair = random_of_two(), read = pair;
    const iris_pair before = pair;
    char text[IRIS_PAIR_TEXT_BYTES], bad[IRIS_PAIR_TEXT_BYTES];
    size_t length = 0;
    int32_t line = 1;
    int same = 0;
    assert_int_equal(iris_pair_write_text(text, sizeof text, &length, &pair), IRIS_OK);
    for (size_t i = 0; i < length - 1; i++) { /* every byte but the last one, and every end */
        memcpy(bad, text, length);
        bad[i] = bad[i] == '7' ? '3' : '7';
        same += iris_pair_read_text(&read, &line, bad, length) ==
                IRIS_OK; /* the last of ten digits may not tell */
        assert_true(line >= 1 && line <= 22 && is_same(&read, &before));
        const int whole = text + i == strstr(text, "check "); /* without the check */
        assert_int_equal(iris_pair_read_text(&read, &line, text, i) == IRIS_OK, whole);
        assert_true(is_same(&read, &before));
    }
    assert_true(same <= 30);
    assert_int_equal(iris_pair_read_text(&read, &line, "iris pair 2\n", 12), IRIS_ERR_UNSUPPORTED);
    assert_int_equal(iris_pair_read_text(&read, &line, "iris pair 1\nleft\n", 17), IRIS_ERR_TRUNCATED);
    assert_int_equal(line, 3);
    assert_int_equal(iris_pair_read_text(&read, &line, "iris pair 1\nright\n", 18), IRIS_ERR_DATA);
    assert_int_equal(line, 2);
    assert_int_equal(iris_pair_read_text(&read, &line, "iris camera 1\n", 14), IRIS_ERR_DATA);
    assert_int_equal(iris_pair_read_text(NULL, &line, text, length), IRIS_ERR_ARG);
    assert_int_equal(iris_pair_read_text(&read, NULL, text, length), IRIS_ERR_ARG);
    assert_int_equal(iris_pair_read_text(&read, &line, NULL, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_pair_write_text(NULL, sizeof text, &length, &pair), IRIS_ERR_ARG);
    assert_int_equal(iris_pair_write_text(text, sizeof text, NULL, &pair), IRIS_ERR_ARG);
    assert_int_equal(iris_pair_write_text(text, sizeof text, &length, NULL), IRIS_ERR_ARG);
    memcpy(bad, text, sizeof bad);
    assert_int_equal(iris_pair_write_text(text, sizeof text - 1, &length, &pair), IRIS_ERR_RANGE);
    pair.place.z = 1000000000 * IRIS_Q32_ONE;
    assert_int_equal(iris_pair_write_text(text, sizeof text, &length, &pair), IRIS_ERR_RANGE);
    pair = before;
    pair.cameras[1].size.h = 0;
    assert_int_equal(iris_pair_write_text(text, sizeof text, &length, &pair), IRIS_ERR_RANGE);
    pair = before;
    pair.cameras[0].lens.direction = (iris_lens_direction)2;
    assert_int_equal(iris_pair_write_text(text, sizeof text, &length, &pair), IRIS_ERR_RANGE);
    assert_memory_equal(text, bad, sizeof bad);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(round_trips),
        cmocka_unit_test(by_hand),
        cmocka_unit_test(as_sensors),
        cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
