#include "digest.h"

#include "iris/xt/hough_circle.h"

#define W      56
#define H      40
#define POINTS 220

/* A bright and a dark disc on the floor. */
static iris_image discs(void)
{
    static const int32_t disc[2][4] = {{18, 20, 12, 220}, {42, 22, 9, 10}};
    iris_image gray = digest_picture(IRIS_GRAY8, W, H);
    for (int32_t i = 0; i < 2 * W * H; i++) {
        const int32_t *d = disc[i % 2], x = i / 2 % W, y = i / 2 / W;
        if ((x - d[0]) * (x - d[0]) + (y - d[1]) * (y - d[1]) <= d[2] * d[2]) {
            ((uint8_t *)iris_image_row(&gray, y))[x] = (uint8_t)d[3];
        }
    }
    return gray;
}

static iris_edge_list edges_of(iris_edge_point *points)
{
    iris_image gray = discs();
    iris_edge_list edges = {points, 0, {W, H}};
    iris_scratch scratch = digest_scratch(IRIS_EDGE_POINTS_SCRATCH_BYTES(W, H, 65536));
    const iris_canny_config canny = {65536, 60, 150};
    digest_number(iris_edge_points(points, POINTS, &edges.count, &gray, &canny, &scratch));
    edges.count = edges.count > POINTS ? POINTS : edges.count;
    return edges;
}

static void find(int32_t cell, iris_circle_polarity polarity, const iris_edge_list *edges,
                 iris_scratch scratch)
{
    iris_circle found[3] = {{0, 0, 0, 0}};
    int32_t count = 0;
    iris_circle_config config;
    iris_circle_defaults(&config);
    config.radius_min = 6;
    config.radius_max = 16;
    config.cell = cell;
    config.polarity = polarity;
    config.max_hypotheses = 20;
    digest_number(iris_hough_circles(found, 3, &count, edges, &config, &scratch));
    digest_number(count);
    for (int32_t i = 0; i < count && i < 3; i++) {
        digest_number(found[i].x_q16);
        digest_number(found[i].y_q16);
        digest_number(found[i].r_q16);
        digest_number(found[i].votes);
    }
}

static void circles(void)
{
    iris_edge_point *points = digest_take(POINTS * sizeof *points);
    const iris_edge_list edges = edges_of(points);
    iris_scratch scratch = digest_scratch(IRIS_CIRCLE_SCRATCH_BYTES(W, H, edges.count, 2, 20));
    find(2, IRIS_CIRCLE_EITHER, &edges, scratch);
    find(2, IRIS_CIRCLE_DARK, &edges, scratch);
    find(4, IRIS_CIRCLE_EITHER, &edges, scratch);
}

static void votes(void)
{
    iris_edge_point *points = digest_take(POINTS * sizeof *points);
    const iris_edge_list edges = edges_of(points);
    iris_image slice = digest_canvas(IRIS_GRAY_U16, W / 2, H / 2);
    iris_scratch scratch = digest_scratch(IRIS_CIRCLE_VOTE_SCRATCH_BYTES);
    digest_number(iris_circle_vote(&slice, &edges, 12, NULL, &scratch));
    digest_view(&slice);
}

const digest_operation digest_hough_circle[] = {
    {"hough.circles", circles},
    {"hough.circle_votes", votes},
    {NULL, NULL},
};
