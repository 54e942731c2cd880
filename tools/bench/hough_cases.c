#include "bench.h"

#include "iris/xt/edge_points.h"
#include "iris/xt/hough_segments.h"
#include "iris/xt/regress.h"

static iris_status regress(void)
{
    iris_line line;
    return iris_regress_mask(&line, &bench_frame.mask);
}

static iris_status hough_lines(void)
{
    iris_hough_config config;
    iris_hough_line lines[4];
    int32_t count;
    iris_hough_defaults(&config);
    config.theta_bins = 90;
    return iris_hough_lines(lines, 4, &count, &bench_frame.mask, &config, &bench_frame.scratch);
}

/* A ninth of the pixels, as edges of a picture full of detail. */
static iris_image edges;
static iris_hough_config every_degree;

static void prepare_edges(void)
{
    uint32_t seed = 1;
    edges = bench_canvas(IRIS_MASK1);
    iris_hough_defaults(&every_degree);
    every_degree.min_votes = edges.w / 4;
    for (int32_t i = 0; i < edges.w * edges.h; i++) {
        seed = seed * 1664525u + 1013904223u;
        uint32_t *row = (uint32_t *)iris_image_row(&edges, i / edges.w);
        row[i % edges.w / 32] |= (uint32_t)((seed >> 16) % 9 == 0) << i % edges.w % 32;
    }
}

static iris_status hough_edges(void)
{
    iris_hough_line lines[16];
    int32_t count;
    return iris_hough_lines(lines, 16, &count, &edges, &every_degree, &bench_frame.scratch);
}

/* Edge points of the frame, of which there are few; their votes; and the best lines' segments. */
static iris_edge_point *points, *points_left;
static int32_t point_count;

#define POINTS 4096

static void prepare_points(void)
{
    points = (iris_edge_point *)iris_scratch_take(&bench_frame.scratch, POINTS * sizeof *points);
    points_left = (iris_edge_point *)iris_scratch_take(&bench_frame.scratch, POINTS * sizeof *points);
    point_count = 0;
    (void)iris_edge_points(points, points ? POINTS : 0, &point_count, &bench_frame.gray, NULL,
                           &bench_frame.scratch);
    point_count = point_count > POINTS ? POINTS : point_count;
}

static iris_status vote_and_find(iris_hough_line lines[4])
{
    iris_hough hough;
    int32_t count;
    size_t start = iris_scratch_mark(&bench_frame.scratch);
    iris_hough_config config;
    iris_hough_defaults(&config);
    config.theta_bins = 90;
    iris_status status = iris_hough_begin(&hough, (iris_size){bench_frame.gray.w, bench_frame.gray.h},
                                          &config, &bench_frame.scratch);
    if (status == IRIS_OK) {
        status = iris_hough_vote_edges(&hough, points, point_count);
    }
    if (status == IRIS_OK) {
        status = iris_hough_peaks(lines, 4, &count, &hough);
    }
    iris_scratch_release(&bench_frame.scratch, start);
    return status;
}

static iris_status hough_points(void)
{
    iris_hough_line lines[4];
    return vote_and_find(lines);
}

static iris_status lines_and_segments(void)
{
    iris_hough_line lines[4] = {{0, 0, 0}};
    iris_hough_segment segment;
    iris_edge_list edges_left = {points_left, 0, {bench_frame.gray.w, bench_frame.gray.h}};
    iris_status status = iris_edge_points(points_left, POINTS, &edges_left.count, &bench_frame.gray, NULL,
                                          &bench_frame.scratch);
    status = status == IRIS_OK ? vote_and_find(lines) : status;
    edges_left.count = edges_left.count > POINTS ? POINTS : edges_left.count;
    for (int i = 0; i < 4 && !bench_refused(status); i++) {
        status = iris_hough_segment_of_edges(&segment, &edges_left, &lines[i], NULL, &bench_frame.scratch);
    }
    return status;
}

const bench_case bench_hough[] = {
    {"regression over a mask", regress, NULL},
    {"Hough lines of a mask, 90 angles", hough_lines, NULL},
    {"Hough lines of a mask, a ninth of it edges", hough_edges, prepare_edges},
    {"Hough lines of edge points, 90 angles", hough_points, prepare_points},
    {"gray frame to four lines with their ends", lines_and_segments, prepare_points},
    {0},
};
