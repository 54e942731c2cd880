/* Circles among edge points. */
#include "iris/xt/hough_circle.h"

#include "calls.h"

#define POINTS_MAX 120

static iris_circle_config any_config(void)
{
    iris_circle_config config;
    iris_circle_defaults(&config);
    config.radius_min = draw_int(IRIS_CIRCLE_RADIUS_MIN, 12);
    config.radius_max = draw_int(12, 40);
    config.polarity = (iris_circle_polarity)draw_below(3);
    config.cell = draw_int(1, IRIS_CIRCLE_CELL_MAX);
    config.min_share_permil = draw_int(1, draw_chance(2) ? 1000 : 100);
    config.max_hypotheses = draw_int(1, 20);
    if (draw_chance(3)) {
        config.min_votes = draw_int(0, 30);
        config.min_distance = draw_int(0, 40);
    }
    return config;
}

/* Points row by row, mostly; some in a ring. */
static const iris_edge_list *any_edges(iris_size size)
{
    static const int8_t ring[8][2] = {{0, -10}, {7, -7}, {-7, -7}, {10, 0},
                                      {-10, 0}, {7, 7},  {-7, 7},  {0, 10}};
    iris_edge_point points[POINTS_MAX];
    iris_edge_list edges = {NULL, draw_within(0, POINTS_MAX), size};
    int32_t y = 0, sorted = !draw_chance(20), rings = draw_chance(2);
    for (int32_t i = 0; i < edges.count; i++) {
        int32_t x = draw_within(0, size.w > 0 ? size.w - 1 : 0);
        y = sorted ? (draw_chance(3) && y < size.h - 1 ? y + 1 : y) : draw_within(0, 80);
        points[i] = (iris_edge_point){(int16_t)x, (int16_t)y, (iris_angle)draw_within(-32768, 32767)};
        if (rings && size.w > 24 && size.h > 24 && i < 8) {
            y = 11 + ring[i][1];
            points[i] = (iris_edge_point){(int16_t)(11 + ring[i][0]), (int16_t)y,
                                          iris_atan2_angle(-ring[i][1], -ring[i][0])};
        }
    }
    edges.points = OR_NULL(draw_given(points, (size_t)edges.count * sizeof points[0]));
    edges.count = draw_chance(40) ? -edges.count : edges.count;
    return OR_NULL(draw_given(&edges, sizeof edges));
}

static void circles(void)
{
    iris_size size = draw_size();
    iris_circle_config config = any_config();
    int32_t capacity = draw_int(0, 5);
    int fits = capacity >= 0 && capacity <= 5;
    iris_circle *found = OR_NULL(draw_results((size_t)(fits ? capacity : 5) * sizeof *found));
    capacity = fits || capacity < 0 ? capacity : 5;
    int32_t *count = OR_NULL(draw_results(sizeof *count));
    const iris_edge_list *edges = any_edges(size);
    const iris_circle_config *given = OR_NULL(draw_given(&config, sizeof config));
    iris_scratch *scratch = draw_scratch_up_to(IRIS_CIRCLE_SCRATCH_BYTES(70, 70, POINTS_MAX, 1, 256));
    CALL(iris_hough_circles(found, capacity, count, edges, given, scratch));
}

static void vote(void)
{
    iris_size size = draw_size();
    iris_circle_config config = any_config();
    int32_t cell = config.cell > 0 && config.cell < 17 ? config.cell : 2;
    const iris_image *votes =
        draw_output(IRIS_GRAY_U16, (iris_size){(int32_t)IRIS_CIRCLE_CELLS(size.w, cell),
                                               (int32_t)IRIS_CIRCLE_CELLS(size.h, cell)});
    const iris_edge_list *edges = any_edges(size);
    int32_t radius = draw_int(IRIS_CIRCLE_RADIUS_MIN, IRIS_CIRCLE_RADIUS_MAX);
    const iris_circle_config *given = OR_NULL(draw_given(&config, sizeof config));
    iris_scratch *scratch = draw_scratch_up_to(IRIS_CIRCLE_VOTE_SCRATCH_BYTES);
    CALL(iris_circle_vote(votes, edges, radius, given, scratch));
}

const random_call calls_hough_circle[] = {
    {"iris_hough_circles", circles},
    {"iris_circle_vote", vote},
    {NULL, NULL},
};
