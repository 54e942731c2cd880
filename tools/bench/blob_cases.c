#include "bench.h"

#include "iris/xt/blob.h"
#include "iris/xt/threshold.h"

#define ROOM 16

/* What is brighter than the middle: half of the floor, and noise along its edge. */
static void half(void)
{
    (void)iris_threshold(&bench_frame.mask, &bench_frame.gray, 160, IRIS_SELECT_BRIGHT);
}

static iris_status find(const iris_image *picture)
{
    iris_blob blobs[ROOM];
    iris_blob_table table = {blobs, ROOM, 0};
    return iris_blobs(&table, &bench_frame.mask, picture, NULL, &bench_frame.scratch);
}

static iris_status plain(void)
{
    return find(NULL);
}

static iris_status gray(void)
{
    return find(&bench_frame.gray);
}

static iris_status color(void)
{
    return find(&bench_frame.rgb);
}

static iris_status mask_of_one(void)
{
    iris_blob one;
    iris_blob_table table = {&one, 1, 0};
    (void)iris_blobs(&table, &bench_frame.mask, NULL, NULL, &bench_frame.scratch);
    return iris_blob_mask(&bench_frame.mask_to, &bench_frame.mask, &one, 8, &bench_frame.scratch);
}

const bench_case bench_blob[] = {
    {"blobs: a line", plain, NULL},
    {"blobs: half the frame and noise", plain, half},
    {"blobs: the same with mean gray", gray, half},
    {"blobs: the same with mean color", color, half},
    {"blobs: the line's own mask", mask_of_one, NULL},
    {0},
};
