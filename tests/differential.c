/* Two driven wheels: speeds worked out by hand, and what holds for all commands. */
#include "iris/differential.h"
#include "test.h"

static iris_wheels mixed(int32_t steer, int32_t speed, int32_t turn, int32_t limit, int32_t least)
{
    const iris_command command = {.steer_permil = steer, .speed_permil = speed};
    const iris_differential_config config = {turn, limit, least};
    iris_wheels wheels = {INT32_MIN, INT32_MIN};
    assert_int_equal(iris_differential_mix(&wheels, &command, &config), IRIS_OK);
    return wheels;
}

static void known_speeds(void **state)
{
    (void)state;
    static const struct {
        int32_t steer, speed, turn, limit, least, left, right;
    } known[] = {
        {0, 0, 1000, 1000, 0, 0, 0},
        {0, 600, 1000, 1000, 0, 600, 600},
        {500, 400, 1000, 1000, 0, 600, 200},
        {-500, 400, 1000, 1000, 0, 200, 600},
        {1000, 400, 1000, 1000, 0, 800, 0},
        {-1000, 400, 1000, 1000, 0, 0, 800},
        {1000, 400, 2000, 1000, 0, 1000, -333} /* 1200 and -400, slowed down alike */,
        {1000, 1000, 0, 1000, 0, 1000, 1000} /* no turning */,
        {500, 1000, 1000, 1000, 0, 1000, 333} /* 1500 and 500 */,
        {0, 1000, 1000, 700, 0, 700, 700},
        {200, 500, 1000, 500, 0, 500, 333} /* 600 and 400 */,
        {1000, 500, 1000, 0, 0, 0, 0},
        {950, 400, 1000, 1000, 150, 780, 150} /* 20 is too little */,
        {1000, 400, 1000, 1000, 150, 800, 0},
        {1000, 100, 1500, 1000, 100, 250, -100} /* -50 is too little */,
        {1, 1, 1000, 1000, 0, 1, 1},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        iris_wheels wheels =
            mixed(known[i].steer, known[i].speed, known[i].turn, known[i].limit, known[i].least);
        assert_int_equal(wheels.left_permil, known[i].left);
        assert_int_equal(wheels.right_permil, known[i].right);
    }
}

static int32_t absolute(int32_t a)
{
    return a < 0 ? -a : a;
}

/* Within the limit, mirrored by the steering's sign, and on the same curve as without a limit, to a permil. */
static void all_commands(void **state)
{
    (void)state;
    for (int32_t turn = 0; turn <= 4000; turn += 500) {
        for (int32_t steer = -1000; steer <= 1000; steer += 25) {
            for (int32_t speed = 0; speed <= 1000; speed += 50) {
                iris_wheels a = mixed(steer, speed, turn, 900, 0), b = mixed(-steer, speed, turn, 900, 0);
                assert_true(a.left_permil == b.right_permil && a.right_permil == b.left_permil);
                assert_true(absolute(a.left_permil) <= 900 && absolute(a.right_permil) <= 900);
                assert_true(steer < 0 || a.left_permil >= a.right_permil);
                int64_t outer = 1000000 + (int64_t)turn * absolute(steer);
                int64_t inner = 1000000 - (int64_t)turn * absolute(steer);
                int64_t fast = steer < 0 ? a.right_permil : a.left_permil;
                int64_t slow = steer < 0 ? a.left_permil : a.right_permil;
                int64_t off = slow * outer - fast * inner; /* 0 on the curve itself */
                assert_true(off <= 3 * outer && -off <= 3 * outer);
            }
        }
    }
}

static void the_defaults_are_what_a_null_config_means(void **state)
{
    (void)state;
    iris_differential_config config;
    iris_differential_defaults(&config);
    iris_differential_defaults(NULL);
    const iris_command command = {.steer_permil = 700, .speed_permil = 800};
    iris_wheels a, b;
    assert_int_equal(iris_differential_mix(&a, &command, NULL), IRIS_OK);
    assert_int_equal(iris_differential_mix(&b, &command, &config), IRIS_OK);
    assert_memory_equal(&a, &b, sizeof a);
    assert_int_equal(a.left_permil, 1000);
    assert_int_equal(a.right_permil, 176); /* 1360 and 240 */
}

static void arguments_are_checked(void **state)
{
    (void)state;
    static const iris_differential_config bad[] = {{-1, 1000, 0},   {4001, 1000, 0}, {1000, -1, 0},
                                                   {1000, 1001, 0}, {1000, 500, -1}, {1000, 500, 501}};
    static const iris_command wrong[] = {{.steer_permil = 1001},      {.steer_permil = -1001},
                                         {.steer_permil = INT32_MIN}, {.speed_permil = -1},
                                         {.speed_permil = 1001},      {.speed_permil = INT32_MAX}};
    const iris_command command = {.speed_permil = 500};
    iris_wheels wheels = {77, 78};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(iris_differential_mix(&wheels, &command, &bad[i]), IRIS_ERR_ARG);
    }
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(iris_differential_mix(&wheels, &wrong[i], NULL), IRIS_ERR_ARG);
    }
    assert_int_equal(iris_differential_mix(NULL, &command, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_differential_mix(&wheels, NULL, NULL), IRIS_ERR_ARG);
    assert_int_equal(wheels.left_permil, 77);
    assert_int_equal(wheels.right_permil, 78);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_speeds),
        cmocka_unit_test(all_commands),
        cmocka_unit_test(the_defaults_are_what_a_null_config_means),
        cmocka_unit_test(arguments_are_checked),
    };
    return cmocka_run_group_tests_name("differential", tests, NULL, NULL);
}
