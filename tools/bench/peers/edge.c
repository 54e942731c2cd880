/* Edges, and what a Hough transform finds among them. */
#include "iris/xt/edge.h"
#include "iris/xt/canny.h"
#include "iris/xt/edge_points.h"
#include "iris/xt/hough.h"
#include "iris/xt/hough_circle.h"
#include "peers.h"

static const iris_border replicate = {IRIS_BORDER_REPLICATE, 0};
static const iris_border mirrored = {IRIS_BORDER_REFLECT101, 0};
static iris_image dx, dy, angles;

static iris_status magnitude(iris_edge_operator op)
{
    iris_edge_config config;
    iris_edge_defaults(&config);
    config.op = op;
    config.gain_q16 = IRIS_Q16_ONE;
    return iris_edge_magnitude(&bench_frame.gray_to, &bench_frame.gray, &config, mirrored,
                               &bench_frame.scratch);
}

static iris_status sobel(void)
{
    return magnitude(IRIS_EDGE_SOBEL);
}

static iris_status laplacian(void)
{
    return magnitude(IRIS_EDGE_LAPLACIAN);
}

static void prepare_gradient(void)
{
    dx = bench_canvas(IRIS_GRAY_S16);
    dy = bench_canvas(IRIS_GRAY_S16);
    peer_result = dy;
}

static iris_status gradient(void)
{
    return iris_edge_gradient(&dx, &dy, &bench_frame.gray, NULL, mirrored, &bench_frame.scratch);
}

static void prepare_direction(void)
{
    angles = bench_canvas(IRIS_GRAY_U16);
    peer_result = angles;
}

static iris_status direction(void)
{
    return iris_edge_direction(&angles, &bench_frame.gray, NULL, mirrored, &bench_frame.scratch);
}

static iris_status canny(void)
{
    const iris_canny_config config = {0, 50, 150};
    return iris_canny(&bench_frame.mask_to, &bench_frame.gray, &config, replicate, &bench_frame.scratch);
}

/* Lines through the edges: angle, distance from the middle, votes; best first. */
#define LINES 4096
static iris_hough_line lines[LINES];
static int32_t count;

static void prepare_lines(void)
{
    peer_gives_numbers(3, LINES);
}

static iris_status find_lines(void)
{
    iris_hough_config config;
    iris_hough_defaults(&config);
    config.min_votes = 150 * bench_frame.mask.w / 640;
    config.theta_separation = config.rho_separation = 1;
    return iris_hough_lines(lines, LINES, &count, &bench_frame.mask, &config, &bench_frame.scratch);
}

static void report_lines(void)
{
    for (int32_t i = 0; i < count && i < LINES; i++) {
        peer_number(0, i, lines[i].angle);
        peer_number(1, i, lines[i].rho_q16);
        peer_number(2, i, lines[i].votes);
    }
}

/* Circles from the picture on: x, y, r. */
#define CIRCLES 256
static iris_circle circles[CIRCLES];
static iris_image room; /* for edge points */

static void prepare_circles(void)
{
    room = bench_canvas_of(IRIS_GRAY_U16, bench_frame.gray.w, bench_frame.gray.h);
    peer_gives_numbers(3, CIRCLES);
}

static iris_status find_circles(void)
{
    iris_edge_point *points = (iris_edge_point *)room.data;
    iris_edge_list edges = {points, 0, {room.w, room.h}};
    const iris_canny_config canny_config = {0, 50, 100};
    iris_circle_config config;
    iris_circle_defaults(&config);
    config.radius_min = 15 * room.w / 640;
    config.radius_max = 60 * room.w / 640;
    config.min_distance = 20 * room.w / 640;
    iris_status status = iris_edge_points(points, room.w * room.h / 3, &edges.count, &bench_frame.gray,
                                          &canny_config, &bench_frame.scratch);
    return status == IRIS_OK
               ? iris_hough_circles(circles, CIRCLES, &count, &edges, &config, &bench_frame.scratch)
               : status;
}

static void report_circles(void)
{
    for (int32_t i = 0; i < count && i < CIRCLES; i++) {
        peer_number(0, i, circles[i].x_q16);
        peer_number(1, i, circles[i].y_q16);
        peer_number(2, i, circles[i].r_q16);
    }
}

const peer_case peer_edge[] = {
    {"Sobel, abs dx + abs dy", sobel, peer_gives_gray, NULL},
    {"Sobel, dx and dy", gradient, prepare_gradient, NULL},
    {"Sobel, direction", direction, prepare_direction, NULL},
    {"Laplacian, absolute", laplacian, peer_gives_gray, NULL},
    {"Canny, L1", canny, peer_gives_mask, NULL},
    {"Hough lines, 1 pixel, 1 degree", find_lines, prepare_lines, report_lines},
    {"Hough circles", find_circles, prepare_circles, report_circles},
    {NULL, NULL, NULL, NULL},
};
