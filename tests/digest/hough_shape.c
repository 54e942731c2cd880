#include "digest.h"

#include "iris/xt/hough_shape.h"

#define W       64
#define H       48
#define ENTRIES 40
#define POINTS  300

/* A silhouette with a corner, a bow, and a notch. */
static iris_image silhouette(void)
{
    iris_image mask = digest_canvas(IRIS_MASK1, 32, 32);
    for (int32_t y = 4; y < 28; y++) {
        uint32_t *row = iris_image_row(&mask, y);
        for (int32_t x = 4; x < 28; x++) {
            int32_t dx = x - 12, dy = y - 16;
            if ((dx * dx + dy * dy < 64 || (x >= 12 && y >= 16)) && !(x > 20 && y > 20 && y < 24)) {
                *row |= (uint32_t)1 << x;
            }
        }
    }
    return mask;
}

/* The table, and how many bytes it has. */
static const uint8_t *taught(size_t *bytes)
{
    int32_t count = 0;
    iris_image mask = silhouette();
    iris_edge_point *points = digest_take(POINTS * sizeof *points);
    uint8_t *table = digest_take(IRIS_HOUGH_SHAPE_TABLE_BYTES(ENTRIES));
    const iris_hough_shape_teaching by = {.fraction_bits = 1, .entries = ENTRIES};
    *bytes = 0;
    digest_number(iris_hough_shape_silhouette(points, POINTS, &count, &mask));
    digest_number(count);
    digest_values(points, (size_t)count * sizeof *points, sizeof points->x);
    digest_number(
        iris_hough_shape_teach(table, IRIS_HOUGH_SHAPE_TABLE_BYTES(ENTRIES), bytes, points, count, &by));
    return table;
}

static void teach(void)
{
    size_t bytes;
    const uint8_t *table = taught(&bytes);
    digest_bytes(table, bytes);
}

static void find(void)
{
    size_t bytes;
    int32_t count = 0;
    const uint8_t *table = taught(&bytes);
    iris_hough_shape shape;
    iris_hough_shape_config config;
    iris_hough_shape_found found[4] = {{0, 0, 0, 0, 0}};
    iris_edge_point *points = digest_take(POINTS / 2 * sizeof *points);
    iris_hough_shape_defaults(&config);
    config.angle_step = 8192;
    config.scale_max_q16 = 80000;
    config.scale_step_q16 = 10000;
    config.min_score = 100;
    config.points = POINTS / 2;
    iris_scratch scratch = digest_scratch(IRIS_HOUGH_SHAPE_SCRATCH_BYTES(W, H, 4, ENTRIES, POINTS / 2));
    digest_number(iris_hough_shape_begin(&shape, table, bytes, (iris_size){W, H}, &config, &scratch));
    for (int32_t i = 0; i < POINTS / 2; i++) { /* an instance, and what has nothing to do with it */
        const iris_hough_shape_found at = {30 * 65536, 20 * 65536, 9000, 70000, 0};
        iris_q16 x, y;
        iris_angle direction;
        int32_t right = digest_between(0, W - 1);
        points[i] = (iris_edge_point){(int16_t)right, (int16_t)digest_between(0, H - 1), 0};
        points[i].angle = iris_angle_wrap(digest_between(0, 65535));
        if (iris_hough_shape_outline(&x, &y, &direction, &shape, &at, i) == IRIS_OK && x >= 0 && y >= 0 &&
            x < W * 65536 - 65536 && y < H * 65536 - 65536) {
            points[i] =
                (iris_edge_point){(int16_t)iris_q16_to_int(x), (int16_t)iris_q16_to_int(y), direction};
        }
    }
    digest_number(iris_hough_shape_find(found, 4, &count, &shape, points, POINTS / 2));
    digest_number(count);
    for (int32_t i = 0; i < 4; i++) {
        digest_number(found[i].x_q16);
        digest_number(found[i].y_q16);
        digest_number(found[i].angle);
        digest_number(found[i].scale_q16);
        digest_number(found[i].score);
    }
}

const digest_operation digest_hough_shape[] = {
    {"hough_shape.teach", teach},
    {"hough_shape.find", find},
    {NULL, NULL},
};
