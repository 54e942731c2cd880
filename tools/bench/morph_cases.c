#include "bench.h"

#include "iris/xt/morph.h"

static const iris_border replicate;
static const iris_morph_element square15 = {15, 15, IRIS_MORPH_SQUARE, 0};
static const iris_morph_element cross3 = {3, 3, IRIS_MORPH_CROSS, 0};

static void dilate_3(void)
{
    (void)iris_morph_dilate(&bench_frame.gray_to, &bench_frame.gray, NULL, replicate, &bench_frame.scratch);
}

static void dilate_cross(void)
{
    (void)iris_morph_dilate(&bench_frame.gray_to, &bench_frame.gray, &cross3, replicate,
                            &bench_frame.scratch);
}

static void erode_15(void)
{
    (void)iris_morph_erode(&bench_frame.gray_to, &bench_frame.gray, &square15, replicate,
                           &bench_frame.scratch);
}

static void open_3(void)
{
    (void)iris_morph_open(&bench_frame.gray_to, &bench_frame.gray, NULL, replicate, &bench_frame.scratch);
}

static void gradient(void)
{
    (void)iris_morph_gradient(&bench_frame.gray_to, &bench_frame.gray, NULL, replicate, &bench_frame.scratch);
}

static void tophat(void)
{
    (void)iris_morph_tophat(&bench_frame.gray_to, &bench_frame.gray, &square15, replicate,
                            &bench_frame.scratch);
}

static void mask_dilate_3(void)
{
    (void)iris_morph_dilate(&bench_frame.mask_to, &bench_frame.mask, NULL, replicate, &bench_frame.scratch);
}

static void mask_open_3(void)
{
    (void)iris_morph_open(&bench_frame.mask_to, &bench_frame.mask, NULL, replicate, &bench_frame.scratch);
}

static void mask_close_15(void)
{
    (void)iris_morph_close(&bench_frame.mask_to, &bench_frame.mask, &square15, replicate,
                           &bench_frame.scratch);
}

const bench_case bench_morph[] = {
    {"dilate gray, 3x3", dilate_3, NULL},         {"dilate gray, 3x3 cross", dilate_cross, NULL},
    {"erode gray, 15x15", erode_15, NULL},        {"open gray, 3x3", open_3, NULL},
    {"gradient of gray, 3x3", gradient, NULL},    {"top-hat of gray, 15x15", tophat, NULL},
    {"dilate a mask, 3x3", mask_dilate_3, NULL},  {"open a mask, 3x3", mask_open_3, NULL},
    {"close a mask, 15x15", mask_close_15, NULL}, {0},
};
