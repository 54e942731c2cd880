/* The watchdog against a clock that is moved by hand. */
#include "iris/watchdog.h"
#include "test.h"

static void it_starts_expired(void **state)
{
    (void)state;
    iris_watchdog dog;
    assert_int_equal(iris_watchdog_init(&dog, 200), IRIS_OK);
    assert_int_equal(iris_watchdog_expired(&dog, 0), 1);
    assert_int_equal(iris_watchdog_left_ms(&dog, 5), 0);
    assert_int_equal(dog.expirations, 0); /* nothing passed: there was none */
}

static void the_deadline_is_kept_to_the_millisecond(void **state)
{
    (void)state;
    static const uint32_t starts[] = {0, 1, 1000, 0x7fffffff, 0x80000000, 0xffffff38, 0xffffffff};
    static const int32_t deadlines[] = {1, 2, 200, IRIS_WATCHDOG_MAX_MS};
    for (size_t s = 0; s < sizeof starts / sizeof starts[0]; s++) {
        for (size_t d = 0; d < sizeof deadlines / sizeof deadlines[0]; d++) {
            iris_watchdog dog;
            const uint32_t deadline = (uint32_t)deadlines[d];
            assert_int_equal(iris_watchdog_init(&dog, deadlines[d]), IRIS_OK);
            iris_watchdog_feed(&dog, starts[s]);
            assert_int_equal(iris_watchdog_left_ms(&dog, starts[s]), deadlines[d] + 1);
            assert_int_equal(iris_watchdog_expired(&dog, starts[s] + deadline), 0);
            assert_int_equal(iris_watchdog_left_ms(&dog, starts[s] + deadline), 1);
            assert_int_equal(iris_watchdog_expired(&dog, starts[s] + deadline + 1), 1);
            assert_int_equal(dog.expirations, 1);
        }
    }
}

/* 49 days later the clock reads as if nothing had happened. */
static void expired_stays_expired_until_it_is_fed(void **state)
{
    (void)state;
    iris_watchdog dog;
    assert_int_equal(iris_watchdog_init(&dog, 100), IRIS_OK);
    iris_watchdog_feed(&dog, 1000);
    assert_int_equal(iris_watchdog_expired(&dog, 1101), 1);
    assert_int_equal(iris_watchdog_expired(&dog, 1050), 1);
    assert_int_equal(iris_watchdog_expired(&dog, 1000), 1);
    assert_int_equal(dog.expirations, 1);
    iris_watchdog_feed(&dog, 1200);
    assert_int_equal(iris_watchdog_expired(&dog, 1300), 0);
    iris_watchdog_feed(&dog, 1300);
    assert_int_equal(iris_watchdog_expired(&dog, 1400), 0);
    assert_int_equal(iris_watchdog_expired(&dog, 1401), 1);
    assert_int_equal(dog.expirations, 2);
}

static void a_clock_that_goes_back_is_too_late(void **state)
{
    (void)state;
    iris_watchdog dog;
    assert_int_equal(iris_watchdog_init(&dog, 100), IRIS_OK);
    iris_watchdog_feed(&dog, 1000);
    assert_int_equal(iris_watchdog_expired(&dog, 999), 1);
}

static void arguments_are_checked(void **state)
{
    (void)state;
    iris_watchdog dog, before;
    memset(&dog, 0x5a, sizeof dog);
    before = dog;
    static const int32_t bad[] = {0, -1, INT32_MIN, IRIS_WATCHDOG_MAX_MS + 1, INT32_MAX};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(iris_watchdog_init(&dog, bad[i]), IRIS_ERR_ARG);
    }
    assert_memory_equal(&dog, &before, sizeof dog);
    assert_int_equal(iris_watchdog_init(NULL, 100), IRIS_ERR_ARG);
    iris_watchdog_feed(NULL, 0);
    assert_int_equal(iris_watchdog_expired(NULL, 0), 1);
    assert_int_equal(iris_watchdog_left_ms(NULL, 0), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_starts_expired),
        cmocka_unit_test(the_deadline_is_kept_to_the_millisecond),
        cmocka_unit_test(expired_stays_expired_until_it_is_fed),
        cmocka_unit_test(a_clock_that_goes_back_is_too_late),
        cmocka_unit_test(arguments_are_checked),
    };
    return cmocka_run_group_tests_name("watchdog", tests, NULL, NULL);
}
