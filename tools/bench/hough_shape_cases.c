#include "bench.h"

#include "iris/xt/hough_shape.h"

#define ENTRIES 128
#define POINTS  2000

static uint8_t table[IRIS_HOUGH_SHAPE_TABLE_BYTES(ENTRIES)];
static size_t table_bytes;
static iris_edge_point points[POINTS], outline[POINTS];
static int32_t point_count, outline_count;

/* A shape like an arrow, 40 pixels long. */
static void prepare_outline(void)
{
    iris_image mask = bench_canvas_of(IRIS_MASK1, 64, 64);
    for (int32_t y = 10; y < 50; y++) {
        uint32_t *row = iris_image_row(&mask, y);
        for (int32_t x = 0; x < 64; x++) {
            int32_t across = x < 32 ? 32 - x : x - 32;
            if (y < 30 ? across <= (y - 10) / 2 : across < 4) {
                row[x / 32] |= (uint32_t)1 << x % 32;
            }
        }
    }
    (void)iris_hough_shape_silhouette(outline, POINTS, &outline_count, &mask);
}

static iris_status teach(void)
{
    const iris_hough_shape_teaching by = {.fraction_bits = 1, .entries = ENTRIES};
    return iris_hough_shape_teach(table, sizeof table, &table_bytes, outline, outline_count, &by);
}

static void prepare_find(void)
{
    prepare_outline();
    (void)teach();
    size_t start = iris_scratch_mark(&bench_frame.scratch);
    (void)iris_edge_points(points, POINTS, &point_count, &bench_frame.gray, NULL, &bench_frame.scratch);
    point_count = point_count < POINTS ? point_count : POINTS;
    iris_scratch_release(&bench_frame.scratch, start);
}

static iris_status find(void)
{
    iris_hough_shape shape;
    iris_hough_shape_config config;
    iris_hough_shape_found found[4];
    int32_t count;
    size_t start = iris_scratch_mark(&bench_frame.scratch);
    iris_hough_shape_defaults(&config);
    config.points = POINTS;
    config.angle_step = 1820;
    config.scale_min_q16 = 52429;
    config.scale_max_q16 = 78643;
    config.scale_step_q16 = 13107;
    config.polarity = IRIS_HOUGH_SHAPE_SAME;
    iris_status status = iris_hough_shape_begin(&shape, table, table_bytes,
                                                (iris_size){bench_frame.gray.w, bench_frame.gray.h}, &config,
                                                &bench_frame.scratch);
    if (status == IRIS_OK) {
        status = iris_hough_shape_find(found, 4, &count, &shape, points, point_count);
    }
    iris_scratch_release(&bench_frame.scratch, start);
    return status;
}

const bench_case bench_hough_shape[] = {
    {"table of a shape, 128 entries", teach, prepare_outline},
    {"shapes, 36 angles, 3 scales", find, prepare_find},
    {0},
};
