#include "bench.h"

#include "iris/copy.h"
#include "iris/turn.h"

static iris_image small, turned, mask_turned;

static void prepare_small(void)
{
    small = bench_canvas_of(IRIS_GRAY8, bench_frame.gray.w * 2 / 3, bench_frame.gray.h * 2 / 3);
    (void)iris_resize_bilinear(&small, &bench_frame.gray);
}

static void prepare_turned(void)
{
    turned = bench_canvas_of(IRIS_GRAY8, bench_frame.gray.h, bench_frame.gray.w);
    mask_turned = bench_canvas_of(IRIS_MASK1, bench_frame.gray.h, bench_frame.gray.w);
}

static void copy(void)
{
    (void)iris_copy(&bench_frame.gray_to, &bench_frame.gray);
}

static void fill(void)
{
    (void)iris_fill(&bench_frame.rgb_to, 0x102030);
}

static void mask_copy(void)
{
    (void)iris_mask_copy(&bench_frame.mask_to, &bench_frame.mask, 0, 0);
}

static void channel_extract(void)
{
    (void)iris_channel_extract(&bench_frame.gray_to, &bench_frame.rgb, 1);
}

static void channel_insert(void)
{
    (void)iris_channel_insert(&bench_frame.rgb_to, &bench_frame.gray, 1);
}

static void resize_nearest(void)
{
    (void)iris_resize_nearest(&bench_frame.gray_to, &small);
}

static void resize_bilinear(void)
{
    (void)iris_resize_bilinear(&bench_frame.gray_to, &small);
}

static void resize_area(void)
{
    (void)iris_resize_area(&small, &bench_frame.gray);
}

static void flip(void)
{
    (void)iris_turn(&bench_frame.gray_to, &bench_frame.gray, IRIS_FLIP_HORIZONTAL);
}

static void flip_mask(void)
{
    (void)iris_turn(&bench_frame.mask_to, &bench_frame.mask, IRIS_FLIP_HORIZONTAL);
}

static void quarter_turn(void)
{
    (void)iris_turn(&turned, &bench_frame.gray, IRIS_TURN_90);
}

static void quarter_turn_mask(void)
{
    (void)iris_turn(&mask_turned, &bench_frame.mask, IRIS_TURN_90);
}

const bench_case bench_copy[] = {
    {"copy of gray", copy, NULL},
    {"fill of RGB", fill, NULL},
    {"copy of a mask", mask_copy, NULL},
    {"channel out of RGB", channel_extract, NULL},
    {"channel into RGB", channel_insert, NULL},
    {"resize by 3/2, nearest", resize_nearest, prepare_small},
    {"resize by 3/2, bilinear", resize_bilinear, prepare_small},
    {"resize by 2/3, area", resize_area, prepare_small},
    {"mirror gray", flip, NULL},
    {"mirror a mask", flip_mask, NULL},
    {"quarter turn of gray", quarter_turn, prepare_turned},
    {"quarter turn of a mask", quarter_turn_mask, prepare_turned},
    {0},
};
