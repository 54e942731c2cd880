/* Edge points: the pixels of Canny's mask in order, and their directions against floating point. */
#include "iris/xt/edge_points.h"

#include <math.h>

#include "edge_smooth.h"

#define POINTS_MAX (SIDE_MAX * SIDE_MAX)

static iris_edge_point points[POINTS_MAX + 1];

static void assert_direction(const iris_image *smooth, const iris_edge_point *point, iris_border border)
{
    static const int weight[3] = {1, 2, 1};
    int dx = 0, dy = 0;
    for (int k = 0; k < 9; k++) {
        int level = pixel_beyond(smooth, point->x + k % 3 - 1, point->y + k / 3 - 1, border);
        dx += level * weight[k / 3] * (k % 3 - 1);
        dy += level * weight[k % 3] * (k / 3 - 1);
    }
    double expected = atan2(dy, dx) / (2 * acos(-1)) * 65536;
    assert_true(fabs(remainder(point->angle - expected, 65536)) <= 1.01);
}

static int32_t assert_points(const iris_image *src, iris_canny_config config)
{
    const iris_border border = {IRIS_BORDER_REPLICATE, 0};
    int32_t count = -1, found = 0;
    iris_image mask = mask_view(src->w, src->h);
    for (int32_t y = 0; y < src->h; y++) {
        memset(iris_image_row(&mask, y), 0, iris_format_row_bytes(IRIS_MASK1, src->w));
    }
    iris_scratch scratch = arena(IRIS_CANNY_SCRATCH_BYTES(src->w, src->h, config.sigma_q16));
    assert_int_equal(iris_canny(&mask, src, &config, border, &scratch), IRIS_OK);
    scratch = arena(IRIS_EDGE_POINTS_SCRATCH_BYTES(src->w, src->h, config.sigma_q16));
    assert_int_equal(iris_edge_points(points, POINTS_MAX, &count, src, &config, &scratch), IRIS_OK);
    assert_int_equal(scratch.peak, IRIS_EDGE_POINTS_SCRATCH_BYTES(src->w, src->h, config.sigma_q16));
    assert_int_equal(scratch.used, 0);
    iris_image smooth = smooth_of(src, config.sigma_q16, border);
    for (int32_t i = 0; i < src->w * src->h; i++) {
        if (bit(&mask, i % src->w, i / src->w)) {
            assert_true(found < count);
            assert_int_equal(points[found].x, i % src->w);
            assert_int_equal(points[found].y, i / src->w);
            assert_direction(&smooth, &points[found], border);
            found++;
        }
    }
    assert_int_equal(found, count);
    return count;
}

static void every_size(void **state)
{
    (void)state;
    static const iris_size sizes[] = {{1, 1}, {2, 3}, {31, 7}, {32, 8}, {33, 9}, {65, 9}, {13, 64}, {70, 40}};
    static const iris_q16 sigmas[] = {0, 30000, 91750};
    int32_t all = 0;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        for (int kind = 0; kind < PICTURE_KINDS; kind++) {
            iris_image src = picture_of(kind, sizes[i]);
            for (int k = 0; k < 3; k++) {
                all += assert_points(&src, (iris_canny_config){sigmas[k], 30, 100});
            }
        }
    }
    assert_true(all > 1000);
}

static void too_many_are_thinned_evenly(void **state)
{
    (void)state;
    iris_image src = picture_of(1, (iris_size){120, 100});
    const iris_canny_config config = {0, 0, 0};
    int32_t all = assert_points(&src, config);
    assert_true(all > 1000);
    for (int32_t capacity = 0; capacity <= all; capacity += capacity / 2 + 1) {
        int32_t count = 0;
        iris_scratch scratch = arena(IRIS_EDGE_POINTS_SCRATCH_BYTES(120, 100, 0));
        points[capacity].x = -7;
        assert_int_equal(
            iris_edge_points(capacity ? points : NULL, capacity, &count, &src, &config, &scratch),
            IRIS_ERR_FULL);
        assert_int_equal(count, all);
        assert_int_equal(points[capacity].x, -7);
        for (int32_t i = 1; i < capacity; i++) {
            assert_true(points[i].y > points[i - 1].y ||
                        (points[i].y == points[i - 1].y && points[i].x > points[i - 1].x));
        }
        if (capacity > 20) { /* the middle of the list is in the middle of the picture */
            assert_in_range(points[capacity / 2].y, 45, 55);
        }
    }
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    iris_image src = picture_of(1, (iris_size){20, 10}), mask = mask_view(20, 10);
    const iris_canny_config bad = {0, 3, 2};
    const size_t bytes = IRIS_EDGE_POINTS_SCRATCH_BYTES(20, 10, 91750);
    int32_t count = 99;
    iris_scratch scratch = arena(bytes);
    assert_int_equal(iris_edge_points(NULL, 5, &count, &src, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_edge_points(points, -1, &count, &src, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_edge_points(points, 5, NULL, &src, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_edge_points(points, 5, &count, NULL, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_edge_points(points, 5, &count, &src, &bad, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_edge_points(points, 5, &count, &src, NULL, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_edge_points(points, 5, &count, &mask, NULL, &scratch), IRIS_ERR_FORMAT);
    src.h = 0;
    assert_int_equal(iris_edge_points(points, 5, &count, &src, NULL, &scratch), IRIS_ERR_RANGE);
    src.h = 10;
    scratch = arena(bytes - 1);
    assert_int_equal(iris_edge_points(points, 5, &count, &src, NULL, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(count, 99);
    assert_int_equal(scratch.used, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_size),
        cmocka_unit_test(too_many_are_thinned_evenly),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("edge_points", tests, NULL, NULL);
}
