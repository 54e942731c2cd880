#include "bench.h"

#include "iris/xt/distance.h"
#include "iris/xt/hitmiss.h"
#include "iris/xt/morph.h"

static const iris_border replicate;
static const iris_morph_element square15 = {15, 15, IRIS_MORPH_SQUARE, 0};
static const iris_morph_element cross3 = {3, 3, IRIS_MORPH_CROSS, 0};

static iris_image far;
static iris_hitmiss_pattern corner;

static void prepare_far(void)
{
    far = bench_canvas(IRIS_GRAY_U16);
}

static void prepare_corner(void)
{
    (void)iris_hitmiss_pattern_read(&corner, ".1./011/00.");
}

static iris_status dilate_3(void)
{
    return iris_morph_dilate(&bench_frame.gray_to, &bench_frame.gray, NULL, replicate, &bench_frame.scratch);
}

static iris_status dilate_cross(void)
{
    return iris_morph_dilate(&bench_frame.gray_to, &bench_frame.gray, &cross3, replicate,
                             &bench_frame.scratch);
}

static iris_status erode_15(void)
{
    return iris_morph_erode(&bench_frame.gray_to, &bench_frame.gray, &square15, replicate,
                            &bench_frame.scratch);
}

static iris_status open_3(void)
{
    return iris_morph_open(&bench_frame.gray_to, &bench_frame.gray, NULL, replicate, &bench_frame.scratch);
}

static iris_status gradient(void)
{
    return iris_morph_gradient(&bench_frame.gray_to, &bench_frame.gray, NULL, replicate,
                               &bench_frame.scratch);
}

static iris_status tophat(void)
{
    return iris_morph_tophat(&bench_frame.gray_to, &bench_frame.gray, &square15, replicate,
                             &bench_frame.scratch);
}

static iris_status mask_dilate_3(void)
{
    return iris_morph_dilate(&bench_frame.mask_to, &bench_frame.mask, NULL, replicate, &bench_frame.scratch);
}

static iris_status mask_open_3(void)
{
    return iris_morph_open(&bench_frame.mask_to, &bench_frame.mask, NULL, replicate, &bench_frame.scratch);
}

static iris_status mask_close_15(void)
{
    return iris_morph_close(&bench_frame.mask_to, &bench_frame.mask, &square15, replicate,
                            &bench_frame.scratch);
}

static iris_status find_corners(void)
{
    return iris_hitmiss_find(&bench_frame.mask_to, &bench_frame.mask, &corner, replicate,
                             &bench_frame.scratch);
}

static iris_status distance_l1(void)
{
    return iris_distance_transform(&far, &bench_frame.mask, IRIS_DISTANCE_L1);
}

static iris_status distance_chamfer(void)
{
    return iris_distance_transform(&far, &bench_frame.mask, IRIS_DISTANCE_CHAMFER);
}

const bench_case bench_morph[] = {
    {"dilate gray, 3x3", dilate_3, NULL},
    {"dilate gray, 3x3 cross", dilate_cross, NULL},
    {"erode gray, 15x15", erode_15, NULL},
    {"open gray, 3x3", open_3, NULL},
    {"gradient of gray, 3x3", gradient, NULL},
    {"top-hat of gray, 15x15", tophat, NULL},
    {"dilate a mask, 3x3", mask_dilate_3, NULL},
    {"open a mask, 3x3", mask_open_3, NULL},
    {"close a mask, 15x15", mask_close_15, NULL},
    {"hit-or-miss, 3x3", find_corners, prepare_corner},
    {"distance, L1", distance_l1, prepare_far},
    {"distance, chamfer 3-4", distance_chamfer, prepare_far},
    {0},
};
