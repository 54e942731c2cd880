/* Generalized Hough: shapes that are taught and found. */
#include "iris/xt/hough_shape.h"

#include "calls.h"

#define POINTS_MAX  60
#define ENTRIES_MAX 40

/* A ring of points around the middle of a picture, mostly. */
static int32_t ring(iris_edge_point *points, iris_size size, int32_t most)
{
    int32_t count = draw_within(0, most);
    int32_t w = size.w > 0 ? size.w : 1, h = size.h > 0 ? size.h : 1;
    for (int32_t i = 0; i < count; i++) {
        points[i] = (iris_edge_point){(int16_t)draw_within(0, w - 1), (int16_t)draw_within(0, h - 1),
                                      (iris_angle)draw_within(-32768, 32767)};
    }
    if (count > 0 && draw_chance(20)) {
        points[0].x = (int16_t)draw_int(-32768, 32767);
    }
    return count;
}

static iris_hough_shape_teaching any_teaching(void)
{
    iris_hough_shape_teaching config;
    iris_hough_shape_teaching_defaults(&config);
    config.entries = draw_int(IRIS_HOUGH_SHAPE_ENTRIES_MIN, ENTRIES_MAX);
    config.fraction_bits = draw_chance(4) ? draw_int(0, 4) : 0;
    if (draw_chance(4)) {
        config.is_chosen = draw_int(0, 1);
        config.x_q16 = draw_int(-3000000, 3000000);
        config.y_q16 = draw_int(-3000000, 3000000);
    }
    return config;
}

static iris_hough_shape_config any_config(void)
{
    iris_hough_shape_config config;
    iris_hough_shape_defaults(&config);
    config.angle_step = draw_chance(20) ? draw_int(91, 65536) : draw_within(9000, 65536);
    config.scale_min_q16 = draw_int(30000, 60000);
    config.scale_max_q16 = draw_int(60000, 90000);
    config.scale_step_q16 = draw_chance(30) ? draw_int(1, 20) : draw_within(12000, 40000);
    config.cell = 1 << draw_below(6);
    config.polarity = (iris_hough_shape_polarity)draw_int(0, 2);
    config.min_score = draw_int(1, 1000);
    config.separation = draw_int(0, 1000);
    config.points = draw_int(1, POINTS_MAX);
    if (draw_chance(3)) {
        config.angle_min = (iris_angle)draw_within(-32768, 32767);
        config.angle_max = (iris_angle)draw_within(-32768, 32767);
    }
    return config;
}

static void teach(void)
{
    iris_edge_point points[POINTS_MAX];
    iris_size size = draw_size();
    int32_t count = ring(points, size, POINTS_MAX);
    iris_hough_shape_teaching config = any_teaching();
    size_t capacity = IRIS_HOUGH_SHAPE_TABLE_BYTES(draw_within(0, ENTRIES_MAX));
    uint8_t *table = OR_NULL(draw_results(capacity));
    size_t *bytes = OR_NULL(draw_results(sizeof *bytes));
    const iris_edge_point *given = OR_NULL(draw_given(points, (size_t)count * sizeof *points));
    const iris_hough_shape_teaching *by = OR_NULL(draw_given(&config, sizeof config));
    CALL(iris_hough_shape_teach(table, capacity, bytes, given, count, by));
}

static void silhouette(void)
{
    int32_t capacity = draw_within(0, POINTS_MAX);
    iris_edge_point *points = OR_NULL(draw_results((size_t)capacity * sizeof *points));
    int32_t *count = OR_NULL(draw_results(sizeof *count));
    const iris_image *mask = draw_input(IRIS_MASK1, draw_size());
    CALL(iris_hough_shape_silhouette(points, draw_chance(30) ? -1 : capacity, count, mask));
}

/* A table, mostly a good one, of *bytes bytes. */
static uint8_t *any_table(size_t *bytes)
{
    iris_edge_point points[POINTS_MAX];
    static uint8_t table[IRIS_HOUGH_SHAPE_TABLE_BYTES(ENTRIES_MAX)];
    iris_hough_shape_teaching config;
    iris_hough_shape_teaching_defaults(&config);
    config.entries = ENTRIES_MAX;
    *bytes = sizeof table;
    if (iris_hough_shape_teach(table, sizeof table, bytes, points,
                               ring(points, (iris_size){60, 60}, POINTS_MAX), &config) != IRIS_OK) {
        *bytes = (size_t)draw_within(0, 200);
    }
    if (draw_chance(8)) {
        table[draw_below((uint32_t)sizeof table)] ^= (uint8_t)(1u << draw_below(8));
    }
    if (draw_chance(20)) {
        *bytes -= draw_below((uint32_t)*bytes + 1);
    }
    return OR_NULL(draw_given(table, *bytes));
}

static void table(void)
{
    size_t bytes;
    const uint8_t *given = any_table(&bytes);
    int32_t *entries = OR_NULL(draw_results(sizeof *entries));
    iris_q16 *x = OR_NULL(draw_results(sizeof *x)), *y = OR_NULL(draw_results(sizeof *y));
    CALL(iris_hough_shape_table(entries, x, y, given, bytes));
}

static void begin(void)
{
    size_t bytes;
    iris_size size = draw_size();
    iris_hough_shape_config config = any_config();
    const uint8_t *given = any_table(&bytes);
    iris_hough_shape *shape = OR_NULL(draw_results(sizeof *shape));
    const iris_hough_shape_config *by = OR_NULL(draw_given(&config, sizeof config));
    iris_scratch *scratch =
        draw_scratch_up_to(IRIS_HOUGH_SHAPE_SCRATCH_BYTES(70, 70, 1, ENTRIES_MAX, POINTS_MAX));
    draw_scratch_is_kept();
    CALL(iris_hough_shape_begin(shape, given, bytes, size, by, scratch));
}

/* A finder that has begun, in memory that calls may change; null when it could not begin. */
static iris_hough_shape *begun(iris_size size)
{
    size_t table_bytes;
    iris_hough_shape shape;
    iris_scratch scratch;
    iris_hough_shape_config config = any_config();
    const uint8_t *given = any_table(&table_bytes);
    size_t bytes = IRIS_HOUGH_SHAPE_SCRATCH_BYTES(70, 70, 1, ENTRIES_MAX, POINTS_MAX);
    if (iris_scratch_init(&scratch, draw_state(NULL, bytes), bytes) != IRIS_OK ||
        iris_hough_shape_begin(&shape, given, table_bytes, size, &config, &scratch) != IRIS_OK) {
        return NULL;
    }
    return OR_NULL(draw_given(&shape, sizeof shape));
}

static void find(void)
{
    iris_edge_point points[POINTS_MAX];
    iris_size size = draw_size();
    iris_hough_shape *shape = begun(size);
    int32_t count = ring(points, size, POINTS_MAX), capacity = draw_within(0, 4);
    iris_hough_shape_found *found = OR_NULL(draw_results((size_t)capacity * sizeof *found));
    int32_t *all = OR_NULL(draw_results(sizeof *all));
    const iris_edge_point *given = OR_NULL(draw_given(points, (size_t)count * sizeof *points));
    CALL(iris_hough_shape_find(found, draw_chance(30) ? -1 : capacity, all, shape, given, count));
}

static void outline(void)
{
    const iris_hough_shape *shape = begun(draw_size());
    iris_hough_shape_found found = {draw_int(-3000000, 3000000), draw_int(-3000000, 3000000),
                                    (iris_angle)draw_within(-32768, 32767), draw_int(0, 1048576), 0};
    iris_q16 *x = OR_NULL(draw_results(sizeof *x)), *y = OR_NULL(draw_results(sizeof *y));
    iris_angle *direction = OR_NULL(draw_results(sizeof *direction));
    const iris_hough_shape_found *given = OR_NULL(draw_given(&found, sizeof found));
    CALL(iris_hough_shape_outline(x, y, direction, shape, given, draw_int(0, ENTRIES_MAX - 1)));
}

const random_call calls_hough_shape[] = {
    {"iris_hough_shape_teach", teach},
    {"iris_hough_shape_silhouette", silhouette},
    {"iris_hough_shape_table", table},
    {"iris_hough_shape_begin", begin},
    {"iris_hough_shape_find", find},
    {"iris_hough_shape_outline", outline},
    {NULL, NULL},
};
