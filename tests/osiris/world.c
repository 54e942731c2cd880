/* Hand-made worlds: what is seen in them, by hand and by doubles. */
#include "iris/osiris/world.h"

#include <math.h>

#include "random_within.h"
#include "test.h"

/* A room of 4 m by 3 m with a wall in the middle, a line across, and two things. */
static const osiris_segment walls[] = {
    {0, 0, 4000, 0}, {4000, 0, 4000, 3000}, {4000, 3000, 0, 3000}, {0, 3000, 0, 0}, {2000, 0, 2000, 1500}};
static const osiris_segment lines[] = {{500, 500, 500, 2500}, {500, 2500, 1500, 2500}};
static const osiris_object objects[] = {{1000, 750, 50, 0xFF0000}, {3000, 750, 100, 0x00FF00}};
static const osiris_pose starts[] = {{500, 500, 16384}};
static const osiris_world room = {walls, lines, objects, starts, 5, 2, 2, 1};

static int32_t range(int32_t x, int32_t y, int32_t degrees, int32_t most)
{
    const osiris_pose from = {x, y, iris_angle_from_degrees(degrees)};
    return osiris_world_range(&room, from, most);
}

static void ranges(void **state)
{
    (void)state;
    assert_int_equal(osiris_world_check(&room), IRIS_OK);
    assert_int_equal(range(500, 2000, 0, 5000), 3500);
    assert_int_equal(range(500, 2000, 90, 5000), 1000);
    assert_int_equal(range(500, 2000, 180, 5000), 500);
    assert_int_equal(range(500, 2000, 180, 500), 500);
    assert_int_equal(range(500, 2000, 180, 499), -1);
    assert_int_equal(range(500, 1200, 0, 5000), 1500); /* the wall in the middle */
    assert_int_equal(range(500, 750, 0, 5000), 450);   /* the red thing */
    assert_int_equal(range(1000, 750, 0, 5000), 0);    /* in it */
    assert_int_equal(range(1000, 2000, 45, 5000), 1414);
    assert_int_equal(range(500, 749, 0, 0), -1);
    assert_int_equal(range(INT32_MAX, INT32_MIN, 45, INT32_MAX), -1);
    assert_int_equal(range(INT32_MIN, 100, 0, INT32_MAX), 1 << 20); /* counts as the nearest place there is */
}

static void ranges_beside_doubles(void **state)
{
    (void)state;
    for (int i = 0; i < 3000; i++) {
        const osiris_segment wall = {random_within(-9000, 9000), random_within(-9000, 9000),
                                     random_within(-9000, 9000), random_within(-9000, 9000)};
        const osiris_object thing = {random_within(-9000, 9000), random_within(-9000, 9000),
                                     random_within(1, 3000), 0};
        const osiris_world world = {&wall, NULL, &thing, NULL, i % 2, 0, (i + 1) % 2, 0};
        const osiris_pose from = {random_within(-9000, 9000), random_within(-9000, 9000),
                                  (iris_angle)random_within(-32768, 32767)};
        const double c = cos(from.heading / 65536.0 * 6.28318530717958648);
        const double s = sin(from.heading / 65536.0 * 6.28318530717958648);
        double truth = -1, margin = 1; /* margin: how clear it is that the ray meets it, or does not */
        if (i % 2) {
            const double ax = wall.x1_mm - wall.x0_mm, ay = wall.y1_mm - wall.y0_mm;
            const double tx = wall.x0_mm - from.x_mm, ty = wall.y0_mm - from.y_mm, whole = c * ay - s * ax;
            const double at = (tx * ay - ty * ax) / whole, on = (tx * s - ty * c) / whole;
            margin =
                fmin(fmin(fabs(on), fabs(on - 1)) * hypot(ax, ay), fabs(at)) * fabs(whole) / hypot(ax, ay);
            truth = at >= 0 && on >= 0 && on <= 1 ? at : -1;
        } else {
            const double tx = thing.x_mm - from.x_mm, ty = thing.y_mm - from.y_mm;
            const double along = tx * c + ty * s, aside = fabs(tx * s - ty * c), r = thing.radius_mm;
            margin = fmin(fabs(aside - r) / 10, fabs(hypot(tx, ty) - r));
            truth = aside <= r && along > 0 ? fmax(0, along - sqrt(r * r - aside * aside)) : -1;
            truth = hypot(tx, ty) <= r ? 0 : truth;
        }
        if (margin > 0.5 && fabs(truth - 20000) > 3) {
            const int32_t found = osiris_world_range(&world, from, 20000);
            truth = truth > 20000 ? -1 : truth;
            assert_true(truth < 0 ? found == -1 : fabs(found - truth) <= 1 + truth / 5000 / fmin(1, margin));
        }
    }
}

static void hidden(void **state)
{
    (void)state;
    const osiris_pose left = {1000, 750, 0}, right = {3000, 750, 0}, up = {1000, 1600, 0},
                      over = {3000, 1600, 0};
    const osiris_pose end = {2000, 1500, 0};
    assert_int_equal(osiris_world_is_hidden(&room, left, right), 1);
    assert_int_equal(osiris_world_is_hidden(&room, up, over), 0);
    assert_int_equal(osiris_world_is_hidden(&room, up, left), 0);
    assert_int_equal(osiris_world_is_hidden(&room, left, end), 1);
}

static int touching(int32_t x, int32_t y, int32_t radius, int32_t *degrees)
{
    const osiris_pose at = {x, y, 0};
    iris_angle toward = 0;
    const int touches = osiris_world_touches(&room, &toward, at, radius);
    *degrees = iris_angle_to_degrees(toward);
    return touches;
}

static void touches(void **state)
{
    (void)state;
    int32_t degrees;
    assert_int_equal(touching(1000, 2000, 100, &degrees), 0);
    assert_int_equal(touching(90, 2000, 100, &degrees), 1);
    assert_int_equal(abs(degrees), 180);
    assert_int_equal(touching(1890, 1000, 110, &degrees), 1);
    assert_int_equal(degrees, 0);
    assert_int_equal(touching(1890, 1000, 109, &degrees), 0);
    assert_int_equal(touching(2000, 1600, 101, &degrees), 1); /* the end of the middle wall */
    assert_int_equal(degrees, -90);
    assert_int_equal(touching(1000, 900, 101, &degrees), 1); /* the red thing */
    assert_int_equal(degrees, -90);
    assert_int_equal(touching(1000, 900, 99, &degrees), 0);
    assert_int_equal(touching(INT32_MAX, 0, INT32_MAX, &degrees), 1);
}

static int line_at(int32_t x, int32_t y, int32_t degrees, int32_t half, int32_t *offset, int32_t *lean)
{
    const osiris_pose at = {x, y, iris_angle_from_degrees(degrees)};
    iris_angle angle = 0;
    const int found = osiris_world_line(&room, offset, &angle, at, half);
    *lean = iris_angle_to_degrees(angle);
    return found;
}

static void line_sensors(void **state)
{
    (void)state;
    int32_t offset = 0, lean = 0;
    assert_int_equal(line_at(500, 1000, 90, 60, &offset, &lean), 1); /* on it, along it */
    assert_int_equal(offset, 0);
    assert_int_equal(lean, 0);
    assert_int_equal(line_at(480, 1000, 90, 60, &offset, &lean), 1); /* it is to the right */
    assert_int_equal(offset, 20);
    assert_int_equal(line_at(480, 1000, -90, 60, &offset, &lean), 1); /* driving the other way: to the left */
    assert_int_equal(offset, -20);
    assert_int_equal(line_at(500, 1000, 120, 60, &offset, &lean), 1); /* looks left of it: it leans right */
    assert_int_equal(lean, 30);
    assert_int_equal(line_at(500, 1000, 60, 60, &offset, &lean), 1);
    assert_int_equal(lean, -30);
    assert_int_equal(line_at(430, 1000, 90, 60, &offset, &lean), 0);
    assert_int_equal(line_at(500, 499, 90, 60, &offset, &lean), 0);
    assert_int_equal(line_at(500, 1000, 90, 0, &offset, &lean), 0); /* sees nothing aside */
    assert_int_equal(line_at(INT32_MIN, INT32_MAX, 90, INT32_MAX, &offset, &lean), 0);
}

static void refuses(void **state)
{
    (void)state;
    osiris_world bad = room;
    osiris_object thing = {0, 0, 0, 0};
    osiris_segment wall = {0, OSIRIS_PLACE_MAX_MM, 0, 0};
    osiris_pose start = {-OSIRIS_PLACE_MAX_MM, 0, 0};
    const osiris_world none = {NULL, NULL, NULL, NULL, 0, 0, 0, 0};
    assert_int_equal(osiris_world_check(&none), IRIS_OK);
    assert_int_equal(osiris_world_check(NULL), IRIS_ERR_ARG);
    bad.objects = &thing;
    bad.object_count = 1;
    assert_int_equal(osiris_world_check(&bad), IRIS_ERR_ARG);
    bad = room;
    bad.lines = &wall;
    bad.line_count = 1;
    assert_int_equal(osiris_world_check(&bad), IRIS_ERR_ARG);
    bad = room;
    bad.starts = &start;
    assert_int_equal(osiris_world_check(&bad), IRIS_ERR_ARG);
    bad = room;
    bad.wall_count = -1;
    assert_int_equal(osiris_world_check(&bad), IRIS_ERR_ARG);
    bad = room;
    bad.walls = NULL;
    assert_int_equal(osiris_world_check(&bad), IRIS_ERR_ARG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ranges),  cmocka_unit_test(ranges_beside_doubles), cmocka_unit_test(hidden),
        cmocka_unit_test(touches), cmocka_unit_test(line_sensors),          cmocka_unit_test(refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
