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

static iris_status copy(void)
{
    return iris_copy(&bench_frame.gray_to, &bench_frame.gray);
}

static iris_status fill(void)
{
    return iris_fill(&bench_frame.rgb_to, 0x102030);
}

static iris_status mask_copy(void)
{
    return iris_mask_copy(&bench_frame.mask_to, &bench_frame.mask, 0, 0);
}

static iris_status channel_extract(void)
{
    return iris_channel_extract(&bench_frame.gray_to, &bench_frame.rgb, 1);
}

static iris_status channel_insert(void)
{
    return iris_channel_insert(&bench_frame.rgb_to, &bench_frame.gray, 1);
}

static iris_status resize_nearest(void)
{
    return iris_resize_nearest(&bench_frame.gray_to, &small);
}

static iris_status resize_bilinear(void)
{
    return iris_resize_bilinear(&bench_frame.gray_to, &small);
}

static iris_status resize_area(void)
{
    return iris_resize_area(&small, &bench_frame.gray);
}

static iris_status flip(void)
{
    return iris_turn(&bench_frame.gray_to, &bench_frame.gray, IRIS_FLIP_HORIZONTAL);
}

static iris_status flip_mask(void)
{
    return iris_turn(&bench_frame.mask_to, &bench_frame.mask, IRIS_FLIP_HORIZONTAL);
}

static iris_status quarter_turn(void)
{
    return iris_turn(&turned, &bench_frame.gray, IRIS_TURN_90);
}

static iris_status quarter_turn_mask(void)
{
    return iris_turn(&mask_turned, &bench_frame.mask, IRIS_TURN_90);
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
