/* Masks: shapes and what is known of them. */
#include <stdint.h>

#include "iris/xt/blob.h"
#include "iris/xt/contour.h"
#include "iris/xt/distance.h"
#include "iris/xt/hitmiss.h"
#include "iris/xt/moments.h"
#include "iris/xt/morph.h"
#include "iris/xt/regress.h"
#include "iris/xt/skeleton.h"
#include "peers.h"

static const iris_border replicate = {IRIS_BORDER_REPLICATE, 0};
static iris_image far;

static iris_status dilate(void)
{
    return iris_morph_dilate(&bench_frame.mask_to, &bench_frame.mask, NULL, replicate, &bench_frame.scratch);
}

static iris_status open(void)
{
    return iris_morph_open(&bench_frame.mask_to, &bench_frame.mask, NULL, replicate, &bench_frame.scratch);
}

static iris_status close_15(void)
{
    const iris_morph_element square = {15, 15, IRIS_MORPH_SQUARE, 0};
    return iris_morph_close(&bench_frame.mask_to, &bench_frame.mask, &square, replicate,
                            &bench_frame.scratch);
}

static iris_hitmiss_pattern corner;

static void prepare_corner(void)
{
    (void)iris_hitmiss_pattern_read(&corner, ".1./011/00.");
    peer_gives_mask();
}

static iris_status find_corners(void)
{
    const iris_border clear = {IRIS_BORDER_CONSTANT, 0};
    return iris_hitmiss_find(&bench_frame.mask_to, &bench_frame.mask, &corner, clear, &bench_frame.scratch);
}

static void prepare_far(void)
{
    far = bench_canvas(IRIS_GRAY_U16);
    peer_result = far;
}

static iris_status distance(void)
{
    return iris_distance_transform(&far, &bench_frame.mask, IRIS_DISTANCE_L1);
}

/* Boxes and areas, the largest first. */
#define PARTS 4096
static iris_blob blobs[PARTS];
static iris_blob_table table;

static void prepare_blobs(void)
{
    table = (iris_blob_table){blobs, PARTS, 0};
    peer_gives_numbers(5, PARTS);
}

static iris_status find_blobs(void)
{
    return iris_blobs(&table, &bench_frame.mask, NULL, NULL, &bench_frame.scratch);
}

static void report_blobs(void)
{
    for (int32_t i = 0; i < table.count && i < PARTS; i++) {
        peer_number(0, i, blobs[i].box.x);
        peer_number(1, i, blobs[i].box.y);
        peer_number(2, i, blobs[i].box.w);
        peer_number(3, i, blobs[i].box.h);
        peer_number(4, i, blobs[i].area);
    }
}

static iris_mask_moments sums;

static void prepare_moments(void)
{
    peer_gives_numbers(20, 1);
}

static iris_status moments(void)
{
    return iris_mask_moments_sum(&sums, &bench_frame.mask);
}

static void report_moments(void)
{
    const int64_t all[10] = {sums.m00, sums.m10, sums.m01, sums.m20, sums.m11,
                             sums.m02, sums.m30, sums.m21, sums.m12, sums.m03};
    for (int32_t i = 0; i < 10; i++) {
        peer_number(2 * i, 0, all[i]);
        peer_number(2 * i + 1, 0, all[i] >> 32);
    }
}

static iris_status thin(void)
{
    return iris_skeleton(NULL, &bench_frame.mask_to, &bench_frame.mask, IRIS_SKELETON_ZHANG_SUEN,
                         &bench_frame.scratch);
}

/* Borders with all their pixels: hole or not, box, area. */
#define POINTS 262144
static iris_contour contours[PARTS];
static iris_contour_point points[POINTS];
static int32_t count;

static void prepare_contours(void)
{
    peer_gives_numbers(6, PARTS);
}

static iris_status find_contours(void)
{
    int32_t used = 0, more = 0;
    iris_status status = iris_contour_find(contours, PARTS, &count, &bench_frame.mask, &bench_frame.scratch);
    for (int32_t i = 0; i < count && status == IRIS_OK; i++, used += more) {
        status = iris_contour_points(points + used, POINTS - used, &more, &contours[i], &bench_frame.mask);
    }
    return status;
}

static void report_contours(void)
{
    for (int32_t i = 0; i < count && i < PARTS; i++) {
        peer_number(0, i, contours[i].is_hole + 1);
        peer_number(1, i, contours[i].box.x);
        peer_number(2, i, contours[i].box.y);
        peer_number(3, i, contours[i].box.w);
        peer_number(4, i, contours[i].box.h);
        peer_number(5, i, contours[i].area);
    }
}

static iris_line line;

static void prepare_line(void)
{
    peer_gives_numbers(1, 1);
}

static iris_status regress(void)
{
    return iris_regress_mask(&line, &bench_frame.mask);
}

static void report_angle(void)
{
    peer_number(0, 0, line.angle);
}

const peer_case peer_mask[] = {
    {"dilate a mask 3x3", dilate, peer_gives_mask, NULL},
    {"open a mask 3x3", open, peer_gives_mask, NULL},
    {"close a mask 15x15", close_15, peer_gives_mask, NULL},
    {"hit-or-miss 3x3", find_corners, prepare_corner, NULL},
    {"distance, L1", distance, prepare_far, NULL},
    {"connected components with statistics", find_blobs, prepare_blobs, report_blobs},
    {"moments of a mask", moments, prepare_moments, report_moments},
    {"thinning, Zhang-Suen", thin, peer_gives_mask, NULL},
    {"contours with their pixels", find_contours, prepare_contours, report_contours},
    {"line through a mask's pixels", regress, prepare_line, report_angle},
    {NULL, NULL, NULL, NULL},
};
