/* Poses on a map and steps between them, against double precision. */
#include "iris/3d/map_pose.h"

#include <math.h>

#include "random_number.h"
#include "test.h"

#define UNITS (65536 / 6.283185307179586)

static iris_map_pose random_pose(int32_t limit)
{
    const uint32_t n = 2 * (uint32_t)limit + 1;
    return (iris_map_pose){(int32_t)(random_u64() % n) - limit, (int32_t)(random_u64() % n) - limit,
                           (iris_angle)random_u64()};
}

static void a_step_is_turned_and_added(void **state)
{
    (void)state;
    const iris_map_pose east = {1000, -2000, 0}, north = {1000, -2000, 16384}, west = {0, 0, -32768};
    const iris_map_pose step = {300, 40, 100};
    iris_map_pose p = iris_map_pose_after(east, step);
    assert_true(p.x_mm == 1300 && p.y_mm == -1960 && p.heading == 100);
    p = iris_map_pose_after(north, step);
    assert_true(p.x_mm == 960 && p.y_mm == -1700 && p.heading == 16484);
    p = iris_map_pose_after(west, (iris_map_pose){300, 40, -1});
    assert_true(p.x_mm == -300 && p.y_mm == -40 && p.heading == 32767); /* wraps around */
    p = iris_map_pose_step(north, (iris_map_pose){960, -1700, 16484});
    assert_true(p.x_mm == 300 && p.y_mm == 40 && p.heading == 100);
}

static void beside_double_precision(void **state)
{
    (void)state;
    for (int i = 0; i < 20000; i++) {
        const iris_map_pose a = random_pose(i % 2 ? 3000 : IRIS_MAP_PLACE_MAX_MM / 4);
        const iris_map_pose step = random_pose(i % 3 ? 200 : IRIS_MAP_PLACE_MAX_MM / 4);
        const double turn = a.heading / UNITS, error = i % 6 ? 0.6 : 1.5;
        const iris_map_pose b = iris_map_pose_after(a, step);
        assert_true(fabs(b.x_mm - (a.x_mm + step.x_mm * cos(turn) - step.y_mm * sin(turn))) < error + 0.5);
        assert_true(fabs(b.y_mm - (a.y_mm + step.x_mm * sin(turn) + step.y_mm * cos(turn))) < error + 0.5);
        assert_int_equal(b.heading, iris_angle_wrap(a.heading + step.heading));
        const iris_map_pose back = iris_map_pose_after(a, iris_map_pose_step(a, b));
        assert_true(abs(back.x_mm - b.x_mm) <= 1 && abs(back.y_mm - b.y_mm) <= 1);
        assert_int_equal(back.heading, b.heading);
    }
}

static void far_away_it_saturates(void **state)
{
    (void)state;
    const iris_map_pose far = {INT32_MAX, INT32_MIN, 8192};
    iris_map_pose p = iris_map_pose_after(far, (iris_map_pose){INT32_MAX, INT32_MAX, -32768});
    assert_true(p.x_mm == INT32_MAX);
    p = iris_map_pose_after((iris_map_pose){INT32_MAX, 0, 0}, (iris_map_pose){1, 0, 0});
    assert_true(p.x_mm == INT32_MAX && p.y_mm == 0);
    p = iris_map_pose_step((iris_map_pose){INT32_MIN, 0, 0}, (iris_map_pose){INT32_MAX, 0, 0});
    assert_true(p.x_mm == INT32_MAX && p.y_mm == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_step_is_turned_and_added),
        cmocka_unit_test(beside_double_precision),
        cmocka_unit_test(far_away_it_saturates),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
