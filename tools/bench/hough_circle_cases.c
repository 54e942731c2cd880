#include "bench.h"

#include "iris/xt/hough_circle.h"

static iris_edge_list edges;
static iris_image room; /* for points, where a tenth of the pixels are edges */

static void draw_ball(int32_t x, int32_t y, int32_t r, uint8_t level)
{
    for (int32_t dy = -r; dy <= r; dy++) {
        uint8_t *row = iris_image_row(&bench_frame.gray, y + dy);
        for (int32_t dx = -r; dx <= r; dx++) {
            row[x + dx] = dx * dx + dy * dy <= r * r ? level : row[x + dx];
        }
    }
}

/* Six balls, bright and dark, on the floor. */
static void draw_balls(void)
{
    const int32_t w = bench_frame.gray.w, h = bench_frame.gray.h;
    for (int32_t i = 0; i < 6; i++) {
        draw_ball(w * (1 + i % 3 * 2) / 6, h * (1 + i / 3 * 2) / 4, h / (7 + i), i % 2 ? 230 : 20);
    }
    room = bench_canvas_of(IRIS_GRAY_U16, w, h * 3 / 10);
}

static iris_status find_edges(void)
{
    iris_edge_point *points = (iris_edge_point *)room.data;
    edges = (iris_edge_list){points, 0, {bench_frame.gray.w, bench_frame.gray.h}};
    return iris_edge_points(points, room.w * room.h / 3, &edges.count, &bench_frame.gray, NULL,
                            &bench_frame.scratch);
}

/* Radii of a sixteenth to a quarter of the height. */
static iris_status find_circles(void)
{
    iris_circle found[16];
    int32_t count;
    iris_circle_config config;
    iris_circle_defaults(&config);
    config.radius_min = edges.size.h / 16;
    config.radius_max = edges.size.h / 4;
    config.min_distance = config.radius_min;
    return iris_hough_circles(found, 16, &count, &edges, &config, &bench_frame.scratch);
}

static void prepare(void)
{
    draw_balls();
    (void)find_edges();
}

static iris_status find_both(void)
{
    iris_status status = find_edges();
    return status == IRIS_OK ? find_circles() : status;
}

const bench_case bench_hough_circle[] = {
    {"Hough circles of edge points, 6 balls", find_circles, prepare},
    {"Hough circles of a picture, 6 balls", find_both, draw_balls},
    {0},
};
