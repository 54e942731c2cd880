/* Pulses in software, against a clock that is moved by hand: how long the line is high, and when it changes. */
#include "iris/pwm.h"
#include "test.h"

/* Sleeps as long as it is told for `periods`, from now on. Returns the microseconds at level 1; *edges counts changes. */
static int64_t high_us(iris_pwm *pwm, int32_t *edges, int32_t speed, uint32_t *now_us, int32_t periods)
{
    int64_t high = 0;
    const uint32_t end_us = *now_us + (uint32_t)(periods * pwm->period_us);
    *edges = 0;
    while ((int32_t)(end_us - *now_us) > 0) {
        int32_t before = pwm->level;
        iris_pwm_run(pwm, speed, *now_us);
        *edges += pwm->level != before;
        assert_true(pwm->wait_us >= 1 && pwm->wait_us <= pwm->period_us);
        high += pwm->level ? pwm->wait_us : 0;
        *now_us += (uint32_t)pwm->wait_us;
    }
    return high;
}

static void the_duty_is_the_speed(void **state)
{
    (void)state;
    static const int32_t rates[] = {1, 3, 50, 100, 333, 1000, 10000};
    static const uint32_t starts[] = {0, 12345, 0xffff0000u};
    for (size_t r = 0; r < sizeof rates / sizeof rates[0]; r++) {
        for (int32_t speed = -1000; speed <= 1000; speed += 125) {
            iris_pwm pwm;
            uint32_t now_us = starts[r % 3];
            int32_t edges, magnitude = speed < 0 ? -speed : speed;
            assert_int_equal(iris_pwm_init(&pwm, rates[r], now_us), IRIS_OK);
            assert_int_equal(pwm.period_us, 1000000 / rates[r]);
            high_us(&pwm, &edges, speed, &now_us, 1); /* a new speed counts from the next period on */
            assert_int_equal(edges, 0);
            int64_t high = high_us(&pwm, &edges, speed, &now_us, 40);
            int64_t off = high * 1000 - (int64_t)40 * pwm.period_us * magnitude;
            assert_true(off <= 40 * 500 && off >= -40 * 500); /* half a microsecond for each pulse */
            assert_int_equal(edges, magnitude == 0 ? 0 : magnitude == 1000 ? 1 : 80);
            assert_int_equal(pwm.backward, speed < 0);
        }
    }
}

/* Woken late, by any time up to several periods: the grid stays, and so does the duty on average. */
static void a_late_edge_moves_no_other(void **state)
{
    (void)state;
    iris_pwm pwm;
    uint32_t now_us = 0xfffff000u, seed = 1;
    int64_t high = 0, total = 0;
    assert_int_equal(iris_pwm_init(&pwm, 100, now_us), IRIS_OK);
    iris_pwm_run(&pwm, 300, now_us += 10000);
    for (int i = 0; i < 200000; i++) {
        seed = seed * 1664525u + 1013904223u;
        int32_t late = i % 101 == 0 ? 35000 : (int32_t)(seed >> 16) % 300;
        int32_t sleep_us = pwm.wait_us + late;
        high += pwm.level ? sleep_us : 0;
        total += sleep_us;
        now_us += (uint32_t)sleep_us;
        iris_pwm_run(&pwm, 300, now_us);
        assert_int_equal((now_us - pwm.begin_us) / 10000, 0);
        assert_int_equal((pwm.begin_us - 0xfffff000u) % 10000, 0);
    }
    int64_t permil = high * 1000 / total;
    assert_true(permil >= 260 && permil <= 340);
}

static void no_pulse_is_cut_but_by_a_stop(void **state)
{
    (void)state;
    iris_pwm pwm;
    assert_int_equal(iris_pwm_init(&pwm, 100, 0), IRIS_OK);
    iris_pwm_run(&pwm, 500, 10000);
    assert_int_equal(pwm.level, 1);
    assert_int_equal(pwm.wait_us, 5000);
    iris_pwm_run(&pwm, 100, 12000); /* slower: this pulse ends as it began */
    assert_int_equal(pwm.level, 1);
    assert_int_equal(pwm.wait_us, 3000);
    iris_pwm_run(&pwm, 900, 15000); /* faster: no second pulse */
    assert_int_equal(pwm.level, 0);
    assert_int_equal(pwm.wait_us, 5000);
    iris_pwm_run(&pwm, 900, 20000);
    assert_int_equal(pwm.level, 1);
    assert_int_equal(pwm.wait_us, 9000);
    iris_pwm_run(&pwm, 0, 21000); /* a stop is one */
    assert_int_equal(pwm.level, 0);
    iris_pwm_run(&pwm, 900, 22000);
    assert_int_equal(pwm.level, 0);
    iris_pwm_run(&pwm, 900, 30000);
    assert_int_equal(pwm.level, 1);
    iris_pwm_run(&pwm, -900, 31000); /* backwards: first nothing, then the direction with its pulse */
    assert_int_equal(pwm.level, 0);
    assert_int_equal(pwm.backward, 0);
    iris_pwm_run(&pwm, -900, 40000);
    assert_int_equal(pwm.level, 1);
    assert_int_equal(pwm.backward, 1);
    iris_pwm_run(&pwm, 0, 50000);
    assert_int_equal(pwm.level, 0);
    assert_int_equal(pwm.backward, 1); /* the direction line does not move under a motor that runs out */
}

static void arguments_are_checked(void **state)
{
    (void)state;
    iris_pwm pwm, before;
    memset(&pwm, 0x5a, sizeof pwm);
    before = pwm;
    assert_int_equal(iris_pwm_init(&pwm, 0, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_pwm_init(&pwm, -1, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_pwm_init(&pwm, 10001, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_pwm_init(NULL, 100, 0), IRIS_ERR_ARG);
    assert_memory_equal(&pwm, &before, sizeof pwm);
    iris_pwm_run(NULL, 500, 0);
    assert_int_equal(iris_pwm_init(&pwm, 100, 0), IRIS_OK);
    iris_pwm_run(&pwm, INT32_MAX, 10000);
    assert_int_equal(pwm.wait_us, 10000);
    iris_pwm_run(&pwm, INT32_MIN, 20000);
    assert_int_equal(pwm.level, 1);
    assert_int_equal(pwm.backward, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_duty_is_the_speed),
        cmocka_unit_test(a_late_edge_moves_no_other),
        cmocka_unit_test(no_pulse_is_cut_but_by_a_stop),
        cmocka_unit_test(arguments_are_checked),
    };
    return cmocka_run_group_tests_name("pwm", tests, NULL, NULL);
}
