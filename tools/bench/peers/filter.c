/* Levels and neighborhoods of gray. */
#include "iris/xt/blur.h"
#include "iris/xt/convolve.h"
#include "iris/xt/equalize.h"
#include "iris/xt/histogram.h"
#include "iris/xt/median.h"
#include "iris/xt/morph.h"
#include "iris/xt/threshold.h"
#include "iris/xt/tone.h"
#include "iris/xt/unsharp.h"
#include "peers.h"

static const iris_border mirrored = {IRIS_BORDER_REFLECT101, 0};
static const iris_border replicate = {IRIS_BORDER_REPLICATE, 0};

#define SIGMA 52428 /* 0.8 pixels: 5x5 */

static iris_status above_127(void)
{
    return iris_threshold(&bench_frame.mask_to, &bench_frame.gray, 127, IRIS_SELECT_BRIGHT);
}

static iris_status otsu(void)
{
    return iris_threshold_otsu(NULL, &bench_frame.mask_to, &bench_frame.gray, IRIS_SELECT_BRIGHT,
                               &bench_frame.scratch);
}

static iris_status adaptive(void)
{
    return iris_threshold_adaptive(&bench_frame.mask_to, &bench_frame.gray, 12, 5, IRIS_SELECT_DARK,
                                   &bench_frame.scratch);
}

static uint32_t counts[256];

static void prepare_histogram(void)
{
    peer_gives_numbers(256, 1);
}

static iris_status histogram(void)
{
    return iris_histogram(counts, &bench_frame.gray, 0, NULL);
}

static iris_status histogram_of_mask(void)
{
    return iris_histogram(counts, &bench_frame.gray, 0, &bench_frame.mask);
}

static void report_histogram(void)
{
    for (int32_t i = 0; i < 256; i++) {
        peer_number(i, 0, counts[i]);
    }
}

static iris_status equalize(void)
{
    return iris_equalize(&bench_frame.gray_to, &bench_frame.gray, &bench_frame.scratch);
}

static iris_status equalize_local(void)
{
    return iris_equalize_local(&bench_frame.gray_to, &bench_frame.gray, NULL, &bench_frame.scratch);
}

static iris_tone tone;

static iris_status stretch(void)
{
    uint8_t darkest, brightest;
    iris_status status = iris_histogram_extremes(&darkest, &brightest, &bench_frame.gray);
    (void)iris_tone_identity(&tone);
    status = status == IRIS_OK ? iris_tone_levels(&tone, darkest, brightest) : status;
    return status == IRIS_OK ? iris_tone_apply(&bench_frame.gray_to, &bench_frame.gray, &tone) : status;
}

static void prepare_tone(void)
{
    (void)iris_tone_identity(&tone);
    (void)iris_tone_levels(&tone, 30, 210);
    peer_gives_gray();
}

static iris_status apply_tone(void)
{
    return iris_tone_apply(&bench_frame.gray_to, &bench_frame.gray, &tone);
}

static iris_status gaussian(void)
{
    return iris_blur_gaussian(&bench_frame.gray_to, &bench_frame.gray, SIGMA, mirrored, &bench_frame.scratch);
}

static iris_status gaussian_color(void)
{
    return iris_blur_gaussian(&bench_frame.rgb_to, &bench_frame.rgb, SIGMA, mirrored, &bench_frame.scratch);
}

static iris_status gaussian_wide(void)
{
    return iris_blur_gaussian(&bench_frame.gray_to, &bench_frame.gray, 3 * IRIS_Q16_ONE, mirrored,
                              &bench_frame.scratch);
}

static iris_status box_3(void)
{
    return iris_blur_box(&bench_frame.gray_to, &bench_frame.gray, 3, mirrored, &bench_frame.scratch);
}

static iris_status box_15(void)
{
    return iris_blur_box(&bench_frame.gray_to, &bench_frame.gray, 15, mirrored, &bench_frame.scratch);
}

static iris_status median_3(void)
{
    return iris_median(&bench_frame.gray_to, &bench_frame.gray, 3, replicate, &bench_frame.scratch);
}

static iris_status median_5(void)
{
    return iris_median(&bench_frame.gray_to, &bench_frame.gray, 5, replicate, &bench_frame.scratch);
}

static iris_status unsharp(void)
{
    const iris_unsharp_config half = {SIGMA, IRIS_Q16_ONE / 2, 0};
    return iris_unsharp(&bench_frame.gray_to, &bench_frame.gray, &half, mirrored, &bench_frame.scratch);
}

static int32_t weights[7 * 7];
static iris_kernel kernel;

/* Weights of both signs that are no product of a column and a row; peers.py has the same. */
static void make_kernel(int32_t side)
{
    int32_t sum = 0;
    for (int32_t i = 0; i < side * side; i++) {
        weights[i] = (5 * i * i + 3) % 16 - 4;
        sum += weights[i];
    }
    kernel = (iris_kernel){weights, side, side, sum, 0, 0};
    peer_gives_gray();
}

static void any_3(void)
{
    make_kernel(3);
}

static void any_5(void)
{
    make_kernel(5);
}

static void any_7(void)
{
    make_kernel(7);
}

static void binomial(void)
{
    static const int32_t row[5] = {1, 4, 6, 4, 1};
    for (int32_t i = 0; i < 25; i++) {
        weights[i] = row[i / 5] * row[i % 5];
    }
    kernel = (iris_kernel){weights, 5, 5, 256, 0, 0};
    peer_gives_gray();
}

static iris_status correlate(void)
{
    return iris_correlate(&bench_frame.gray_to, &bench_frame.gray, &kernel, mirrored, &bench_frame.scratch);
}

static iris_status correlate_color(void)
{
    return iris_correlate(&bench_frame.rgb_to, &bench_frame.rgb, &kernel, mirrored, &bench_frame.scratch);
}

static void any_3_of_color(void)
{
    make_kernel(3);
    peer_gives_color();
}

static iris_status dilate(void)
{
    return iris_morph_dilate(&bench_frame.gray_to, &bench_frame.gray, NULL, replicate, &bench_frame.scratch);
}

static iris_status erode(void)
{
    return iris_morph_erode(&bench_frame.gray_to, &bench_frame.gray, NULL, replicate, &bench_frame.scratch);
}

static iris_status open(void)
{
    return iris_morph_open(&bench_frame.gray_to, &bench_frame.gray, NULL, replicate, &bench_frame.scratch);
}

static iris_status gradient(void)
{
    return iris_morph_gradient(&bench_frame.gray_to, &bench_frame.gray, NULL, replicate,
                               &bench_frame.scratch);
}

static const iris_morph_element square = {15, 15, IRIS_MORPH_SQUARE, 0};

static iris_status erode_15(void)
{
    return iris_morph_erode(&bench_frame.gray_to, &bench_frame.gray, &square, replicate,
                            &bench_frame.scratch);
}

static iris_status tophat(void)
{
    return iris_morph_tophat(&bench_frame.gray_to, &bench_frame.gray, &square, replicate,
                             &bench_frame.scratch);
}

const peer_case peer_filter[] = {
    {"range test, 1 channel", above_127, peer_gives_mask, NULL},
    {"threshold", above_127, peer_gives_mask, NULL},
    {"threshold, Otsu", otsu, peer_gives_mask, NULL},
    {"threshold, adaptive 25x25", adaptive, peer_gives_mask, NULL},
    {"histogram", histogram, prepare_histogram, report_histogram},
    {"histogram of a mask", histogram_of_mask, prepare_histogram, report_histogram},
    {"equalize", equalize, peer_gives_gray, NULL},
    {"equalize locally, 8x8 tiles", equalize_local, peer_gives_gray, NULL},
    {"linear stretch, darkest to brightest", stretch, peer_gives_gray, NULL},
    {"tone curve", apply_tone, prepare_tone, NULL},
    {"Gaussian 5x5, sigma 0.8", gaussian, peer_gives_gray, NULL},
    {"Gaussian 5x5, binomial", correlate, binomial, NULL},
    {"Gaussian 5x5 of color", gaussian_color, peer_gives_color, NULL},
    {"Gaussian, sigma 3", gaussian_wide, peer_gives_gray, NULL},
    {"box 3x3", box_3, peer_gives_gray, NULL},
    {"box 15x15", box_15, peer_gives_gray, NULL},
    {"median 3x3", median_3, peer_gives_gray, NULL},
    {"median 5x5", median_5, peer_gives_gray, NULL},
    {"unsharp", unsharp, peer_gives_gray, NULL},
    {"convolve 3x3", correlate, any_3, NULL},
    {"convolve 5x5", correlate, any_5, NULL},
    {"convolve 7x7", correlate, any_7, NULL},
    {"convolve 3x3 of color", correlate_color, any_3_of_color, NULL},
    {"dilate 3x3", dilate, peer_gives_gray, NULL},
    {"erode 3x3", erode, peer_gives_gray, NULL},
    {"erode 15x15", erode_15, peer_gives_gray, NULL},
    {"open 3x3", open, peer_gives_gray, NULL},
    {"morphological gradient 3x3", gradient, peer_gives_gray, NULL},
    {"top-hat 15x15", tophat, peer_gives_gray, NULL},
    {NULL, NULL, NULL, NULL},
};
