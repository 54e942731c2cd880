/* Borders: rows continued by hand, and the rules against walking. */
#include "iris/border.h"
#include "test.h"

static void by_hand(void **state)
{
    (void)state;
    /* Positions -5 to 8 of four pixels 0 1 2 3. */
    static const int32_t expected[4][14] = {{0, 0, 0, 0, 0, 0, 1, 2, 3, 3, 3, 3, 3, 3},
                                            {1, 2, 3, 2, 1, 0, 1, 2, 3, 2, 1, 0, 1, 2},
                                            {-1, -1, -1, -1, -1, 0, 1, 2, 3, -1, -1, -1, -1, -1},
                                            {0, 0, 0, 0, 0, 0, 1, 2, 3, 3, 3, 3, 3, 3}};
    for (int rule = IRIS_BORDER_REPLICATE; rule <= IRIS_BORDER_SKIP; rule++) {
        for (int32_t i = -5; i <= 8; i++) {
            assert_int_equal(iris_border_index(i, 4, (iris_border_rule)rule), expected[rule][i + 5]);
        }
    }
}

/* Walks from 0 and turns around at both ends. */
static void reflection_is_a_walk(void **state)
{
    (void)state;
    for (int32_t n = 1; n <= 9; n++) {
        int32_t place = 0, step = 1;
        for (int32_t i = 0; i < 100; i++) {
            assert_int_equal(iris_border_index(i, n, IRIS_BORDER_REFLECT101), place);
            assert_int_equal(iris_border_index(-i, n, IRIS_BORDER_REFLECT101), place);
            step = place + step < 0 || place + step >= n ? -step : step;
            place = n == 1 ? 0 : place + step;
        }
    }
}

static void the_farthest_positions(void **state)
{
    (void)state;
    for (int rule = IRIS_BORDER_REPLICATE; rule <= IRIS_BORDER_SKIP; rule++) {
        for (int32_t n = 1; n <= 40; n++) {
            int32_t low = iris_border_index(INT32_MIN, n, (iris_border_rule)rule);
            int32_t high = iris_border_index(INT32_MAX, n, (iris_border_rule)rule);
            assert_true(low >= -1 && low < n && high >= -1 && high < n);
        }
    }
    assert_int_equal(iris_border_index(INT32_MAX, INT32_MAX, IRIS_BORDER_REFLECT101), INT32_MAX - 2);
}

static void memory_is_a_constant(void **state)
{
    (void)state;
    static const uint8_t buffer[IRIS_BORDER_ROWS_BYTES(160, 1, 1, 1)];
    assert_int_equal(sizeof buffer, 4 * (16 + 160 + 16));
    assert_int_equal(IRIS_BORDER_ROWS_BYTES(3 * 7, 6, 9, 2), 6 * (16 + 32));
    assert_int_equal(IRIS_BORDER_ROWS_BYTES(16, 0, 0, 0), 2 * 16);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_hand),
        cmocka_unit_test(reflection_is_a_walk),
        cmocka_unit_test(the_farthest_positions),
        cmocka_unit_test(memory_is_a_constant),
    };
    return cmocka_run_group_tests_name("border", tests, NULL, NULL);
}
