/* A camera's text: what is written is read again bit by bit, and what is damaged is refused with its line. */
#include "iris/3d/camera_text.h"

#include "random3d.h"
#include "test.h"

static const char good[] = "iris camera 1\n"
                           "size 640 480\n"
                           "focal 532.5000000000 533.2500000000\n"
                           "skew 0.0000000000\n"
                           "center 342.0000000002 233.8557685700\n"
                           "lens corrects\n"
                           "radial -0.2500000000 0.1250000000 0.0000000000\n"
                           "tangential 0.0000000000 -0.0009765625\n"
                           "decentering 0.0000000000 0.5000000000\n";

static iris_camera_model random_model(void)
{
    iris_camera_model m = {{640, 480}, {0}, {0}};
    iris_q32 *numbers[] = {&m.intrinsics.alpha_u,
                           &m.intrinsics.alpha_v,
                           &m.intrinsics.shear,
                           &m.intrinsics.u0,
                           &m.intrinsics.v0,
                           &m.lens.k1,
                           &m.lens.k2,
                           &m.lens.k3,
                           &m.lens.p1,
                           &m.lens.p2,
                           &m.lens.center.x,
                           &m.lens.center.y};
    for (int i = 0; i < 12; i++) {
        *numbers[i] = any_q32() % (1000000000 * IRIS_Q32_ONE);
    }
    m.intrinsics.alpha_u = llabs(m.intrinsics.alpha_u) | 1;
    m.intrinsics.alpha_v = llabs(m.intrinsics.alpha_v) | 1;
    m.lens.direction = random_u64() & 1 ? IRIS_LENS_CORRECTS : IRIS_LENS_BENDS;
    return m;
}

static void round_trips(void **state)
{
    (void)state;
    for (int i = 0; i < 2000; i++) {
        iris_camera_model m = random_model(), again;
        char text[IRIS_CAMERA_TEXT_BYTES];
        size_t length = 0;
        int32_t line = 0;
        assert_int_equal(iris_camera_write_text(text, sizeof text, &length, &m), IRIS_OK);
        assert_int_equal(length, strlen(text));
        memset(&again, 0, sizeof again);
        assert_int_equal(iris_camera_read_text(&again, &line, text, length + i % 2), IRIS_OK);
        assert_memory_equal(&again.intrinsics, &m.intrinsics, sizeof m.intrinsics);
        assert_true(again.size.w == 640 && again.size.h == 480 && again.lens.direction == m.lens.direction);
        assert_true(again.lens.k1 == m.lens.k1 && again.lens.k2 == m.lens.k2 && again.lens.k3 == m.lens.k3);
        assert_true(again.lens.p1 == m.lens.p1 && again.lens.p2 == m.lens.p2 &&
                    again.lens.center.x == m.lens.center.x && again.lens.center.y == m.lens.center.y);
    }
}

/* The text with its check, which is the only thing that is not told by hand. */
static void by_hand(void **state)
{
    (void)state;
    const iris_q32 one = IRIS_Q32_ONE;
    iris_camera_model m = {{640, 480}, {one * 1065 / 2, one * 2133 / 4, 0, 342 * one + 1, 0}, {0}};
    char text[IRIS_CAMERA_TEXT_BYTES];
    size_t length = 0;
    m.intrinsics.v0 = (iris_q32)llround(233.85576857 * 4294967296.0);
    m.lens = (iris_lens){-one / 4, one / 8, 0, 0, -one / 1024, {0, one / 2}, IRIS_LENS_CORRECTS};
    assert_int_equal(iris_camera_write_text(text, sizeof text, &length, &m), IRIS_OK);
    char *skew = strstr(text, "skew "), *check = strstr(text, "check ");
    assert_non_null(skew);
    assert_non_null(check);
    assert_int_equal(strncmp(skew, "skew 0.0000000000\ncenter 342.0000000002 233.8557685700\n", 54), 0);
    assert_int_equal(strncmp(text, good, 50), 0);
    assert_int_equal(strncmp(strstr(text, "lens "), strstr(good, "lens "), strlen(strstr(good, "lens "))), 0);
    assert_int_equal(strlen(check), 15);
    assert_int_equal(iris_camera_write_text(text, length + 1, &length, &m), IRIS_OK);
    assert_int_equal(iris_camera_write_text(text, length, &length, &m), IRIS_ERR_RANGE);
}

/* What a person writes, from OpenCV's numbers: no check. */
static void without_a_check(void **state)
{
    (void)state;
    static const char text[] =
        "iris camera 1\nsize 640 480\nfocal 532.5 533.25\nskew 0\ncenter 342.5 233.75\n"
        "lens bends\nradial -0.25 0.5 0\ntangential 0.125 0\ndecentering 0 0\n";
    iris_camera_model m;
    int32_t line = 0;
    assert_int_equal(iris_camera_read_text(&m, &line, text, sizeof text - 1), IRIS_OK);
    assert_true(m.size.w == 640 && m.size.h == 480 && m.intrinsics.alpha_u == IRIS_Q32_ONE * 1065 / 2 &&
                m.intrinsics.alpha_v == IRIS_Q32_ONE * 2133 / 4 &&
                m.intrinsics.u0 == IRIS_Q32_ONE * 685 / 2 && m.lens.k1 == -IRIS_Q32_ONE / 4 &&
                m.lens.p1 == IRIS_Q32_ONE / 8);
    for (size_t i = 0; i < sizeof text - 1; i++) {
        assert_int_not_equal(iris_camera_read_text(&m, &line, text, i), IRIS_OK);
    }
}

static void refused(void **state)
{
    (void)state;
    iris_camera_model m = random_model(), before = m, read_again;
    char text[IRIS_CAMERA_TEXT_BYTES], bad[IRIS_CAMERA_TEXT_BYTES];
    size_t length = 0;
    int32_t line = 1;
    assert_int_equal(iris_camera_write_text(text, sizeof text, &length, &m), IRIS_OK);
    int same = 0;
    for (size_t i = 0; i < length - 1; i++) { /* every byte but the last one, and every end */
        memcpy(bad, text, length);
        bad[i] = bad[i] == '7' ? '3' : '7';
        int read = iris_camera_read_text(&m, &line, bad, length) == IRIS_OK;
        same += read; /* the last of ten digits, 10^-10, need not tell 2^-32 */
        assert_true(line >= 1 && line <= 10 &&
                    (!read || memcmp(&m.intrinsics, &before.intrinsics, sizeof m.intrinsics) == 0));
        const int whole = text + i == strstr(text, "check "); /* without the check */
        assert_int_equal(iris_camera_read_text(&read_again, &line, text, i) == IRIS_OK, whole);
    }
    assert_true(same <= 12 && m.lens.k1 == before.lens.k1 && m.lens.p2 == before.lens.p2);
    before = m;
    assert_memory_equal(&m, &before, sizeof m);
    assert_int_equal(iris_camera_read_text(&m, &line, "iris camera 2\n", 14), IRIS_ERR_UNSUPPORTED);
    assert_int_equal(iris_camera_read_text(&m, &line, "iris camera 1\n# more\n", 21), IRIS_ERR_TRUNCATED);
    assert_int_equal(line, 3);
    assert_int_equal(iris_camera_read_text(&m, &line, "iris floor 1\n", 13), IRIS_ERR_DATA);
    assert_int_equal(line, 1);
    assert_int_equal(iris_camera_read_text(NULL, &line, text, length), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_read_text(&m, NULL, text, length), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_read_text(&m, &line, NULL, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_camera_write_text(NULL, 1, &length, &m), IRIS_ERR_ARG);
    m.intrinsics.alpha_v = 0;
    assert_int_equal(iris_camera_write_text(text, sizeof text, &length, &m), IRIS_ERR_RANGE);
    m = before;
    m.lens.k2 = INT64_MIN;
    assert_int_equal(iris_camera_write_text(text, sizeof text, &length, &m), IRIS_ERR_RANGE);
    m = before;
    m.size.w = 0;
    assert_int_equal(iris_camera_write_text(text, sizeof text, &length, &m), IRIS_ERR_RANGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(round_trips),
        cmocka_unit_test(by_hand),
        cmocka_unit_test(without_a_check),
        cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
