/* Generalized Hough transform: shapes that are laid into pictures here, in double
 * precision, with a third hidden and clutter around them, and must be found again. */
#include "iris/xt/hough_shape.h"

#include "egg.h"
#include "iris/bmp.h"
#include "iris/xt/threshold.h"

#define W       240
#define H       180
#define ENTRIES 128
#define POINTS  4000

static const iris_size size = {W, H};
static iris_edge_point points[POINTS];
static int32_t point_count;
static uint32_t seed = 1;
static IRIS_SCRATCH_BUFFER(working, 1 << 20);

static double next(double low, double high)
{
    seed = seed * 1664525 + 1013904223;
    return low + (high - low) * (seed >> 8) / 16777216.0;
}

static iris_scratch arena(size_t bytes)
{
    iris_scratch scratch;
    assert_true(bytes <= sizeof working.memory);
    assert_int_equal(iris_scratch_init(&scratch, working.memory, bytes), IRIS_OK);
    return scratch;
}

/* Where an instance is. */
typedef struct {
    double x, y, angle, scale;
    int reversed;
} instance;

/* The edge points of an instance from the share `from` on, `part` of the outline. */
static void draw(instance at, double from, double part)
{
    int steps = (int)(220 * at.scale);
    for (int i = 0; i < steps * part; i++) {
        double t = from + (double)i / steps, x, y, x1, y1, c = cos(at.angle), s = sin(at.angle);
        t -= floor(t);
        egg(&x, &y, t);
        egg(&x1, &y1, t + 0.002);
        double inside = atan2(x1 - x, -(y1 - y)) + at.angle + next(-0.1, 0.1) + (at.reversed ? pi : 0);
        long px = lrint(at.x + at.scale * (x * c - y * s)), py = lrint(at.y + at.scale * (x * s + y * c));
        if (px >= 0 && py >= 0 && px < W && py < H) {
            points[point_count++] = (iris_edge_point){
                (int16_t)px, (int16_t)py, iris_angle_wrap((int32_t)(lrint(inside / pi * 32768) & 65535))};
        }
    }
}

static void add_clutter(int count)
{
    for (int i = 0; i < count; i++) {
        points[point_count++] =
            (iris_edge_point){(int16_t)next(0, W), (int16_t)next(0, H), (iris_angle)next(-32768, 32768)};
    }
}

static iris_hough_shape_config config_of(double scale_min, double scale_max)
{
    iris_hough_shape_config config;
    iris_hough_shape_defaults(&config);
    config.scale_min_q16 = (iris_q16)(scale_min * 65536);
    config.scale_max_q16 = (iris_q16)(scale_max * 65536);
    config.points = POINTS;
    return config;
}

static iris_hough_shape_found found[8];

/* The number of shapes found. */
static int32_t find(iris_hough_shape_config config)
{
    iris_hough_shape shape;
    int32_t count = -1;
    int32_t entries = (int32_t)((table_bytes - IRIS_HOUGH_SHAPE_TABLE_BYTES(0)) / 6);
    size_t bytes = IRIS_HOUGH_SHAPE_SCRATCH_BYTES(W, H, config.cell, entries, config.points);
    iris_scratch scratch = arena(bytes);
    assert_int_equal(iris_hough_shape_begin(&shape, table, table_bytes, size, &config, &scratch), IRIS_OK);
    assert_int_equal(scratch.used, bytes);
    iris_status status = iris_hough_shape_find(found, 8, &count, &shape, points, point_count);
    assert_int_equal(status, count > 8 ? IRIS_ERR_FULL : IRIS_OK);
    return count;
}

static int is_at(const iris_hough_shape_found *f, instance at)
{
    double turn = remainder(f->angle * pi / 32768 - at.angle, 2 * pi);
    return hypot(f->x_q16 / 65536.0 - at.x, f->y_q16 / 65536.0 - at.y) < 1.5 && fabs(turn) < 0.08 &&
           fabs(f->scale_q16 / 65536.0 / at.scale - 1) < 0.03;
}

static instance anywhere(void)
{
    return (instance){next(60, W - 60), next(60, H - 60), next(-pi, pi), next(0.7, 1.3), next(0, 1) < 0.5};
}

static void two_thirds_in_clutter_are_found(void **state)
{
    (void)state;
    teach(ENTRIES);
    for (int i = 0; i < 12; i++) {
        instance at = anywhere();
        point_count = 0;
        draw(at, next(0, 1), 0.66);
        add_clutter(800);
        assert_int_equal(find(config_of(0.7, 1.3)), 1);
        assert_true(is_at(&found[0], at));
        assert_true(found[0].score > 500 && found[0].score < 750);
    }
}

/* A square's outline of 120 pixels; every other 20 of its points lie `aside` pixels aside and are turned by so many
 * degrees; of each 20 the last `last` are turned by a quarter, or left out when that is negative. */
static void draw_square(int aside, double turn, int last)
{
    point_count = 0;
    for (int i = 0; i < 4 * 120; i++) {
        int side = i / 120, odd = i / 20 % 2, is_last = i % 20 >= 20 - abs(last);
        int along = i % 120 + 30, edge = (side < 2 ? 30 : 150) + odd * aside;
        int32_t inside = (side % 2 ? 0 : 16384) + (side < 2 ? 0 : 32768) + (is_last ? 16384 : 0);
        if (!is_last || last > 0) {
            points[point_count++] =
                (iris_edge_point){(int16_t)(side % 2 ? edge : along), (int16_t)(side % 2 ? along : edge),
                                  iris_angle_wrap(inside + (int32_t)lrint(odd * turn / 360 * 65536))};
        }
    }
}

static int32_t score_of_square(int aside, double turn, int last)
{
    iris_hough_shape_config config = config_of(1, 1);
    config.min_score = 1;
    config.angle_min = config.angle_max = 0;
    config.polarity = IRIS_HOUGH_SHAPE_SAME;
    draw_square(aside, turn, last);
    return find(config) >= 1 ? found[0].score : 0;
}

static void score_is_how_exactly_edges_agree(void **state)
{
    (void)state;
    const iris_hough_shape_teaching by = {0, 480, 0, 0, 0};
    draw_square(0, 0, 0);
    assert_int_equal(iris_hough_shape_teach(table, sizeof table, &table_bytes, points, point_count, &by),
                     IRIS_OK);
    assert_int_equal(score_of_square(0, 0, 0), 1000);
    assert_int_equal(score_of_square(0, 11, 0), 1000);
    assert_in_range(score_of_square(0, 16.875, 0), 740, 770);
    assert_in_range(score_of_square(0, 22, 0), 510, 570);
    assert_int_equal(score_of_square(1, 0, 0), 1000); /* half a pixel to either side */
    assert_in_range(score_of_square(2, 0, 0), 1, 300);
    /* of the last ten one neighbor or two on each side are near enough */
    assert_in_range(score_of_square(0, 0, -10), 580, 700);
    assert_in_range(score_of_square(0, 0, 10), 380, 470);
}

static void exact_to_a_fraction_of_a_pixel(void **state)
{
    (void)state;
    teach(ENTRIES);
    double worst = 0;
    for (int i = 0; i < 6; i++) {
        instance at = anywhere();
        point_count = 0;
        draw(at, 0, 1);
        assert_int_equal(find(config_of(0.7, 1.3)), 1);
        assert_true(found[0].score > 980);
        worst = fmax(worst, hypot(found[0].x_q16 / 65536.0 - at.x, found[0].y_q16 / 65536.0 - at.y));
        assert_true(fabs(remainder(found[0].angle * pi / 32768 - at.angle, 2 * pi)) < 0.01);
        assert_true(fabs(found[0].scale_q16 / 65536.0 / at.scale - 1) < 0.006);
    }
    assert_true(worst < 0.3);
}

static void several_at_once_best_first(void **state)
{
    (void)state;
    teach(ENTRIES);
    const instance at[3] = {{60, 60, 1, 1, 0}, {170, 60, -2, 0.8, 1}, {110, 125, 3, 1.1, 0}};
    point_count = 0;
    draw(at[0], 0.1, 0.8);
    draw(at[1], 0.5, 1);
    draw(at[2], 0.8, 0.7);
    assert_int_equal(find(config_of(0.7, 1.3)), 3);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(is_at(&found[0], at[i]) + is_at(&found[1], at[i]) + is_at(&found[2], at[i]), 1);
    }
    iris_hough_shape shape;
    iris_hough_shape_config config = config_of(0.7, 1.3);
    iris_hough_shape_found best[3] = {found[0], found[1], found[2]}, kept[3];
    int32_t count;
    iris_scratch scratch = arena(IRIS_HOUGH_SHAPE_SCRATCH_BYTES(W, H, 4, ENTRIES, POINTS));
    assert_int_equal(iris_hough_shape_begin(&shape, table, table_bytes, size, &config, &scratch), IRIS_OK);
    for (int32_t capacity = 0; capacity <= 3; capacity++) {
        memset(kept, 0xA5, sizeof kept);
        assert_int_equal(
            iris_hough_shape_find(capacity ? kept : NULL, capacity, &count, &shape, points, point_count),
            capacity < 3 ? IRIS_ERR_FULL : IRIS_OK);
        assert_int_equal(count, 3);
        for (int32_t k = 0; k < capacity; k++) {
            assert_true(kept[k].x_q16 == best[k].x_q16 && kept[k].y_q16 == best[k].y_q16 &&
                        kept[k].angle == best[k].angle && kept[k].scale_q16 == best[k].scale_q16 &&
                        kept[k].score == best[k].score);
        }
        for (size_t k = (size_t)capacity * sizeof best[0]; k < sizeof kept; k++) {
            assert_int_equal(((uint8_t *)kept)[k], 0xA5);
        }
    }
}

/* min_score 600: half a turn of the egg is not much worse. */
static void polarity_bounds_and_score_are_kept(void **state)
{
    (void)state;
    teach(ENTRIES);
    const instance at = {120, 90, 0.5, 1, 0}, reversed = {120, 90, 0.5, 1, 1};
    for (int i = 0; i < 2; i++) {
        iris_hough_shape_config config = config_of(0.9, 1.1);
        config.min_score = 600;
        point_count = 0;
        draw(i ? reversed : at, 0, 0.8);
        assert_int_equal(find(config), 1);
        config.polarity = i ? IRIS_HOUGH_SHAPE_REVERSED : IRIS_HOUGH_SHAPE_SAME;
        assert_int_equal(find(config), 1);
        config.polarity = i ? IRIS_HOUGH_SHAPE_SAME : IRIS_HOUGH_SHAPE_REVERSED;
        assert_int_equal(find(config), 0);
    }
    iris_hough_shape_config config = config_of(0.9, 1.1);
    config.min_score = 600;
    config.angle_min = 4000; /* 0.5 is 5215 */
    config.angle_max = 6000;
    assert_int_equal(find(config), 1);
    assert_true(is_at(&found[0], at));
    config.min_score = found[0].score;
    assert_int_equal(find(config), 1);
    config.min_score = found[0].score + 1;
    assert_int_equal(find(config), 0);
    config.min_score = 600;
    config.angle_min = 16000; /* around the half turn */
    config.angle_max = -6000;
    assert_int_equal(find(config), 0);
    config = config_of(1.5, 1.8);
    config.min_score = 600;
    assert_int_equal(find(config), 0);
    point_count = 0;
    assert_int_equal(find(config_of(0.9, 1.1)), 0);
}

static void only_one_of_two_that_are_near(void **state)
{
    (void)state;
    teach(ENTRIES);
    const instance one = {110, 90, 0.5, 1, 0}, other = {122, 90, 0.9, 1, 0};
    iris_hough_shape_config config = config_of(1, 1);
    config.min_score = 700;
    point_count = 0;
    draw(one, 0, 1);
    draw(other, 0, 0.9);
    config.separation = 0;
    assert_int_equal(find(config), 2);
    assert_true(is_at(&found[0], one) && is_at(&found[1], other));
    config.separation = 500; /* of 48 pixels */
    assert_int_equal(find(config), 1);
    assert_true(is_at(&found[0], one));
}

static void outline_is_where_it_was_drawn(void **state)
{
    (void)state;
    teach(ENTRIES);
    iris_hough_shape shape;
    iris_scratch scratch = arena(sizeof working.memory);
    assert_int_equal(iris_hough_shape_begin(&shape, table, table_bytes, size, NULL, &scratch), IRIS_OK);
    const iris_hough_shape_found at = {7000000, 5000000, -12345, 91000, 0};
    for (int32_t i = 0; i < shape.entries; i++) {
        const uint8_t *entry = table + 150 + 6 * i;
        double x = (int16_t)(entry[0] | entry[1] << 8) / 16.0, y = (int16_t)(entry[2] | entry[3] << 8) / 16.0;
        double c = cos(-12345 * pi / 32768) * 91000, s = sin(-12345 * pi / 32768) * 91000;
        iris_q16 x_q16, y_q16;
        iris_angle direction;
        assert_int_equal(iris_hough_shape_outline(&x_q16, &y_q16, &direction, &shape, &at, i), IRIS_OK);
        assert_true(fabs(x_q16 - (7000000 + x * c - y * s)) < 4096);
        assert_true(fabs(y_q16 - (5000000 + x * s + y * c)) < 4096);
        assert_int_equal((uint16_t)direction, (uint16_t)((entry[4] | entry[5] << 8) - 12345));
    }
    iris_q16 x, y;
    iris_angle direction;
    assert_int_equal(iris_hough_shape_outline(&x, &y, &direction, &shape, &at, shape.entries),
                     IRIS_ERR_RANGE);
    assert_int_equal(iris_hough_shape_outline(&x, &y, &direction, &shape, &at, -1), IRIS_ERR_RANGE);
}

/* --- wrong calls --- */

static void wrong_finding(void **state)
{
    (void)state;
    iris_hough_shape shape, untouched;
    teach(ENTRIES);
    const iris_hough_shape_config good = config_of(0.9, 1.1);
    size_t needed = IRIS_HOUGH_SHAPE_SCRATCH_BYTES(W, H, 4, (table_bytes - 150) / 6, POINTS);
    memset(&shape, 0xA5, sizeof shape);
    memcpy(&untouched, &shape, sizeof shape);
    iris_scratch scratch = arena(needed - 1);
    assert_int_equal(iris_hough_shape_begin(&shape, table, table_bytes, size, &good, &scratch),
                     IRIS_ERR_SCRATCH);
    assert_int_equal(scratch.used, 0);
    scratch = arena(needed);
    for (int i = 0; i < 16; i++) {
        iris_hough_shape_config bad = good;
        int32_t *fields[] = {&bad.angle_step,    &bad.angle_step,     &bad.scale_min_q16,  &bad.scale_max_q16,
                             &bad.scale_max_q16, &bad.scale_step_q16, &bad.scale_step_q16, &bad.cell,
                             &bad.cell,          &bad.min_score,      &bad.min_score,      &bad.separation,
                             &bad.separation,    &bad.points,         &bad.points,         NULL};
        const int32_t values[] = {90,   65537, 6553, 524289, bad.scale_min_q16 - 1,          0, 51, 3, 64, 0,
                                  1001, -1,    1001, 0,      IRIS_HOUGH_SHAPE_POINTS_MAX + 1};
        if (fields[i]) {
            *fields[i] = values[i];
        } else {
            bad.polarity = (iris_hough_shape_polarity)3;
        }
        assert_int_equal(iris_hough_shape_begin(&shape, table, table_bytes, size, &bad, &scratch),
                         IRIS_ERR_ARG);
    }
    assert_int_equal(iris_hough_shape_begin(&shape, table, table_bytes, (iris_size){0, H}, &good, &scratch),
                     IRIS_ERR_RANGE);
    assert_int_equal(
        iris_hough_shape_begin(&shape, table, table_bytes, (iris_size){W, 32768}, &good, &scratch),
        IRIS_ERR_RANGE);
    assert_int_equal(iris_hough_shape_begin(&shape, table, 149, size, &good, &scratch), IRIS_ERR_TRUNCATED);
    assert_memory_equal(&shape, &untouched, sizeof shape);
    assert_int_equal(iris_hough_shape_begin(&shape, table, table_bytes, size, &good, &scratch), IRIS_OK);
    iris_edge_point beyond[2] = {{0, 0, 0}, {W, 0, 0}};
    int32_t count = 77;
    assert_int_equal(iris_hough_shape_find(found, 8, &count, &shape, beyond, 2), IRIS_ERR_RANGE);
    assert_int_equal(iris_hough_shape_find(found, 8, &count, &shape, points, POINTS + 1), IRIS_ERR_RANGE);
    assert_int_equal(iris_hough_shape_find(found, -1, &count, &shape, points, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_shape_find(NULL, 1, &count, &shape, points, 0), IRIS_ERR_ARG);
    assert_int_equal(count, 77);
}

/* Sides and turns at the ends of what is allowed: sanitizers look on. */
static void extremes(void **state)
{
    (void)state;
    static iris_edge_point far[64];
    const iris_hough_shape_teaching by = {0, 8, 1, 0, 0};
    iris_hough_shape_config config;
    iris_hough_shape shape;
    int32_t count;
    for (int i = 0; i < 64; i++) {
        far[i] = (iris_edge_point){(int16_t)(i % 2 ? 2047 : -2047), (int16_t)(i % 4 < 2 ? 2047 : -2047),
                                   iris_angle_wrap(i * 1024)};
    }
    assert_int_equal(iris_hough_shape_teach(table, sizeof table, &table_bytes, far, 64, &by), IRIS_OK);
    iris_hough_shape_defaults(&config);
    config.scale_min_q16 = IRIS_HOUGH_SHAPE_SCALE_MAX - 1;
    config.scale_max_q16 = IRIS_HOUGH_SHAPE_SCALE_MAX;
    config.scale_step_q16 = INT32_MAX;
    config.angle_step = 20000;
    config.cell = 32;
    config.min_score = 1;
    config.points = 64;
    for (int i = 0; i < 64; i++) {
        far[i] = (iris_edge_point){(int16_t)(i % 2 ? 32766 : 0), (int16_t)(i % 4 < 2 ? 39 : 0),
                                   iris_angle_wrap(i * 999)};
    }
    iris_scratch scratch = arena(sizeof working.memory);
    assert_int_equal(
        iris_hough_shape_begin(&shape, table, table_bytes, (iris_size){32767, 40}, &config, &scratch),
        IRIS_OK);
    iris_status status = iris_hough_shape_find(found, 8, &count, &shape, far, 64);
    assert_true(status == IRIS_OK || status == IRIS_ERR_FULL);
}

/* A wide step beside the smallest scale: fitting must not make a shape vanish. */
static void the_smallest_scale(void **state)
{
    (void)state;
    teach(ENTRIES);
    iris_hough_shape_config config = config_of(0.2, 8);
    config.scale_min_q16 = IRIS_HOUGH_SHAPE_SCALE_MIN;
    config.scale_step_q16 = 500000;
    config.min_score = 1;
    point_count = 0;
    for (int i = 0; i < 8; i++) {
        draw((instance){120, 90, 0, 0.07, 0}, 0, 1); /* smaller than is looked for */
    }
    int32_t count = find(config);
    assert_true(count > 0);
    for (int32_t i = 0; i < count && i < 8; i++) {
        assert_true(found[i].scale_q16 >= IRIS_HOUGH_SHAPE_SCALE_MIN * 7 / 8);
    }
}

/* --- the real --- */

/* A silhouette of the shared data, as a mask; w is 0 when it is not there. Given back with free(mask.data). */
static iris_image load_mask(const char *name)
{
    size_t bytes;
    iris_image gray = {0}, mask = {0};
    iris_bmp_reader reader;
    iris_stream stream;
    uint8_t *file = load_file(data_path(name), &bytes);
    if (!file) {
        return mask;
    }
    iris_memory_source memory = {file, bytes, 0};
    iris_stream_init(&stream, iris_source_memory(&memory));
    assert_int_equal(iris_bmp_begin(&reader, &stream), IRIS_OK);
    iris_size of = {reader.w, reader.h};
    size_t room = (size_t)of.w * (size_t)of.h,
           mask_room = iris_format_row_bytes(IRIS_MASK1, of.w) * (size_t)of.h;
    assert_int_equal(iris_image_wrap(&gray, malloc(room), room, of, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_bmp_read(&gray, &reader), IRIS_OK);
    assert_int_equal(iris_image_wrap(&mask, malloc(mask_room), mask_room, of, 0, IRIS_MASK1), IRIS_OK);
    assert_int_equal(iris_threshold(&mask, &gray, 127, IRIS_SELECT_BRIGHT), IRIS_OK);
    free(gray.data);
    free(file);
    return mask;
}

/* A key finds itself among its own outline's points, turned by a quarter. */
static void a_key_turned(void **state)
{
    (void)state;
    iris_image mask = load_mask("shapes/mpeg7/key-01.bmp");
    if (mask.w == 0) {
        skip();
    }
    const iris_hough_shape_teaching by = {1, 200, 0, 0, 0};
    iris_hough_shape shape;
    iris_q16 x, y;
    int32_t entries, count;
    assert_int_equal(iris_hough_shape_silhouette(outline, OUTLINE_MAX, &outline_count, &mask), IRIS_OK);
    assert_int_equal(iris_hough_shape_teach(table, sizeof table, &table_bytes, outline, outline_count, &by),
                     IRIS_OK);
    assert_int_equal(iris_hough_shape_table(&entries, &x, &y, table, table_bytes), IRIS_OK);
    point_count = 0;
    for (int32_t i = 0; i < outline_count; i++) {
        points[point_count++] =
            (iris_edge_point){(int16_t)(199 - outline[i].y / 2), (int16_t)(outline[i].x / 2),
                              iris_angle_wrap(outline[i].angle + 16384)};
    }
    iris_hough_shape_config config = config_of(0.8, 1.2);
    iris_scratch scratch = arena(sizeof working.memory);
    assert_int_equal(
        iris_hough_shape_begin(&shape, table, table_bytes, (iris_size){200, 200}, &config, &scratch),
        IRIS_OK);
    assert_int_equal(iris_hough_shape_find(found, 8, &count, &shape, points, point_count), IRIS_OK);
    assert_true(count >= 1);
    assert_true(found[0].score > 950);
    assert_true(fabs(found[0].x_q16 / 65536.0 - (199 - y / 65536.0)) < 1);
    assert_true(fabs(found[0].y_q16 / 65536.0 - x / 65536.0) < 1);
    assert_true(abs(found[0].angle - 16384) < 100);
    assert_true(fabs(found[0].scale_q16 / 65536.0 - 1) < 0.01);
    free(mask.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_thirds_in_clutter_are_found),
        cmocka_unit_test(score_is_how_exactly_edges_agree),
        cmocka_unit_test(exact_to_a_fraction_of_a_pixel),
        cmocka_unit_test(several_at_once_best_first),
        cmocka_unit_test(polarity_bounds_and_score_are_kept),
        cmocka_unit_test(only_one_of_two_that_are_near),
        cmocka_unit_test(outline_is_where_it_was_drawn),
        cmocka_unit_test(wrong_finding),
        cmocka_unit_test(extremes),
        cmocka_unit_test(the_smallest_scale),
        cmocka_unit_test(a_key_turned),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
