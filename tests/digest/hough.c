#include "digest.h"

#include "iris/xt/hough_segments.h"
#include "iris/xt/threshold.h"
#include "iris/xt/votes.h"

#define W 64
#define H 48

static void digest_peaks(const iris_hough *hough)
{
    iris_hough_line lines[4] = {{0, 0, 0}};
    int32_t count = 0;
    digest_number(iris_hough_peaks(lines, 4, &count, hough));
    digest_number(count);
    for (int32_t i = 0; i < count && i < 4; i++) {
        iris_hough_ends ends = {0, 0, 0, 0};
        digest_number(lines[i].angle);
        digest_number(lines[i].rho_q16);
        digest_number(lines[i].votes);
        digest_number(iris_hough_clip(&ends, &lines[i], (iris_size){W, H}));
        digest_values(&ends, sizeof ends, 4);
    }
}

static void transform(const iris_hough_config *config, int32_t rho_bins)
{
    iris_hough hough;
    iris_image gray = digest_picture(IRIS_GRAY8, W, H);
    iris_image mask = digest_canvas(IRIS_MASK1, W, H);
    iris_scratch scratch =
        digest_scratch(IRIS_HOUGH_BINS_SCRATCH_BYTES((size_t)rho_bins, (size_t)config->theta_bins));
    (void)iris_threshold(&mask, &gray, 70, IRIS_SELECT_DARK);
    digest_number(iris_hough_begin(&hough, (iris_size){W, H}, config, &scratch));
    for (int32_t y = 0; y < H; y++) {
        digest_number(iris_hough_vote_row(&hough, iris_image_row(&mask, y), y));
    }
    digest_values(hough.votes, (size_t)hough.rho_bins * (size_t)config->theta_bins * sizeof hough.votes[0],
                  sizeof hough.votes[0]);
    digest_peaks(&hough);
}

static void every_direction(void)
{
    iris_hough_config config;
    iris_hough_defaults(&config);
    config.theta_bins = 40;
    config.rho_step = 2;
    config.min_votes = 15;
    transform(&config, (int32_t)IRIS_HOUGH_REACH(W, H));
}

static void bounded(void)
{
    iris_hough_config config;
    iris_hough_defaults(&config);
    config.angle_min = -8192;
    config.angle_max = 8192;
    config.theta_bins = 32;
    config.rho_min = -30;
    config.rho_max = 30;
    config.min_votes = 10;
    transform(&config, 60);
}

/* Points strewn over the picture and along a line, with directions. */
static void directed(void)
{
    iris_hough hough;
    iris_hough_config config;
    iris_hough_defaults(&config);
    config.full_circle = 1;
    config.angle_min = config.angle_max = 0;
    config.theta_bins = 60;
    config.rho_step = 2;
    config.min_votes = 15;
    iris_scratch scratch = digest_scratch(IRIS_HOUGH_BINS_SCRATCH_BYTES(IRIS_HOUGH_REACH(W, H), 60));
    digest_number(iris_hough_begin(&hough, (iris_size){W, H}, &config, &scratch));
    for (int32_t i = 0; i < 200; i++) {
        iris_edge_point point;
        point.x = (int16_t)digest_between(0, W - 1);
        point.y = (int16_t)(i % 3 ? digest_between(0, H - 1) : point.x / 2 + 5);
        point.angle = (iris_angle)(i % 3 ? digest_between(-32768, 32767) : 21000);
        digest_number(iris_hough_vote_edges(&hough, &point, 1));
    }
    digest_values(hough.votes, (size_t)hough.rho_bins * 60u * sizeof hough.votes[0], sizeof hough.votes[0]);
    digest_peaks(&hough);
}

static void show(void)
{
    iris_image gray = digest_canvas(IRIS_GRAY8, W, 20), votes = digest_canvas(IRIS_GRAY_U16, W, 20);
    for (int32_t i = 0; i < W * 20; i++) {
        ((uint16_t *)iris_image_row(&votes, i / W))[i % W] = (uint16_t)digest_between(0, 900);
    }
    digest_number(iris_votes_show(&gray, &votes));
    digest_view(&gray);
}

static void digest_segment(const iris_hough_segment *segment)
{
    digest_number(segment->line.angle);
    digest_number(segment->line.rho_q16);
    digest_number(segment->points);
    digest_values(&segment->ends, sizeof segment->ends, 4);
}

static void segments(void)
{
    iris_hough_segment segment = {{0, 0, 0}, {0, 0, 0, 0}, 0};
    iris_image gray = digest_picture(IRIS_GRAY8, W, H), mask = digest_canvas(IRIS_MASK1, W, H);
    iris_scratch scratch = digest_scratch(IRIS_HOUGH_SEGMENT_SCRATCH_BYTES(W, H));
    (void)iris_threshold(&mask, &gray, 70, IRIS_SELECT_DARK);
    for (int32_t i = 0; i < 12; i++) {
        iris_hough_line line = {(iris_angle)(i * 2731 - 16384), (i - 6) * 150000, i};
        digest_number(iris_hough_segment_of_mask(&segment, &mask, &line, NULL, &scratch));
        digest_segment(&segment);
    }
    digest_view(&mask);
    iris_edge_point points[150];
    iris_edge_list edges = {points, 150, {W, H}};
    for (int32_t i = 0; i < 150; i++) {
        points[i].x = (int16_t)(i % W);
        points[i].y = (int16_t)(i % 4 ? i % W / 2 + 5 : digest_between(0, H - 1));
        points[i].angle = (iris_angle)digest_between(17000, 24000);
    }
    iris_hough_line line = {21000, 400000, 9};
    while (iris_hough_segment_of_edges(&segment, &edges, &line, NULL, &scratch) == IRIS_OK) {
        digest_segment(&segment);
        digest_number(edges.count);
    }
    digest_number(edges.count);
}

const digest_operation digest_hough[] = {
    {"hough.every_direction", every_direction},
    {"hough.bounded", bounded},
    {"hough.directed", directed},
    {"hough.segments", segments},
    {"votes.show", show},
    {NULL, NULL},
};
