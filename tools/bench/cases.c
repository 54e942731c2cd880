/* The cases: what a robot does with every frame, on a frame of 160x120 that a floor camera could have sent. */
#include "bench.h"

#include "iris/color.h"
#include "iris/command.h"
#include "iris/xt/follow.h"
#include "iris/xt/hough.h"
#include "iris/xt/regress.h"
#include "iris/xt/steer.h"
#include "iris/xt/threshold.h"

#define W 160
#define H 120

static IRIS_SCRATCH_BUFFER(gray_bytes, W *H);
static IRIS_SCRATCH_BUFFER(color_bytes, W *H * 3);
static IRIS_SCRATCH_BUFFER(mask_bytes, W / 8 * H);
#define THETA_BINS 90
static IRIS_SCRATCH_BUFFER(working_bytes, IRIS_HOUGH_SCRATCH_BYTES(W, H, THETA_BINS));
static iris_image gray, color, yuyv, mask;
static iris_scratch scratch;
static iris_follow follow;
static iris_steer steer;

static void wrap(iris_image *image, void *bytes, iris_format format)
{
    size_t needed = iris_format_row_bytes(format, W) * H;
    (void)iris_image_wrap(image, bytes, needed, (iris_size){W, H}, 0, format);
}

/* A floor in uneven light, noise, and a dark line that leans to the right. */
static void gray_frame(void)
{
    uint32_t random = 1;
    wrap(&gray, gray_bytes.memory, IRIS_GRAY8);
    wrap(&mask, mask_bytes.memory, IRIS_MASK1);
    (void)iris_scratch_init(&scratch, working_bytes.memory, sizeof working_bytes.memory);
    for (int32_t y = 0; y < H; y++) {
        uint8_t *row = iris_image_row(&gray, y);
        int32_t line = 50 + (H - y) / 3;
        for (int32_t x = 0; x < W; x++) {
            random = random * 1664525u + 1013904223u;
            int32_t level = 200 - x / 2 + (int32_t)(random >> 28) - 8;
            row[x] = (uint8_t)(x >= line && x < line + 14 ? level / 4 : level);
        }
    }
}

static void color_frame(void)
{
    gray_frame();
    wrap(&color, color_bytes.memory, IRIS_RGB888);
    (void)iris_color_convert(&color, &gray);
    for (size_t i = 0; i < (size_t)W * H; i++) {
        color_bytes.memory[3 * i + i % 3] ^= (uint8_t)i;
    }
}

static void yuyv_frame(void)
{
    color_frame();
    wrap(&yuyv, color_bytes.memory, IRIS_YUYV);
}

static void luma_of_rgb(void)
{
    (void)iris_color_gray(&gray, &color, IRIS_GRAY_LUMA);
}

static void gray_of_yuyv(void)
{
    (void)iris_color_gray(&gray, &yuyv, IRIS_GRAY_LUMA);
}

static void hsl_range(void)
{
    const iris_hsl_range range = {40, 80, 30, 100, 20, 90};
    (void)iris_hsl_range_mask(&mask, &color, &range);
}

static void threshold_fixed(void)
{
    (void)iris_threshold(&mask, &gray, 100, IRIS_SELECT_DARK);
}

static void threshold_otsu(void)
{
    uint8_t value;
    (void)iris_threshold_otsu(&value, &mask, &gray, IRIS_SELECT_DARK, &scratch);
}

static void threshold_adaptive(void)
{
    (void)iris_threshold_adaptive(&mask, &gray, 12, 20, IRIS_SELECT_DARK, &scratch);
}

static void mask_frame(void)
{
    gray_frame();
    (void)iris_threshold(&mask, &gray, 60, IRIS_SELECT_DARK);
}

static void regress_mask(void)
{
    iris_line line;
    (void)iris_regress_mask(&line, &mask);
}

static void hough_lines(void)
{
    iris_hough_config config;
    iris_hough_line lines[4];
    int32_t count;
    iris_hough_defaults(&config);
    config.theta_bins = THETA_BINS;
    (void)iris_hough_lines(lines, 4, &count, &mask, &config, &scratch);
}

/* The second frame: the floor is known. */
static void follower(void)
{
    iris_follow_result line;
    gray_frame();
    (void)iris_follow_init(&follow, (iris_size){W, H}, NULL, &scratch);
    (void)iris_steer_init(&steer, NULL);
    (void)iris_follow_frame(&line, &follow, &gray, 0);
}

static void follower_by_hough(void)
{
    follower();
    (void)iris_follow_use_hough(&follow, &scratch);
}

static void frame_to_sentence(void)
{
    iris_follow_result line;
    iris_command command;
    char sentence[IRIS_COMMAND_SENTENCE_BYTES];
    size_t length;
    (void)iris_follow_frame(&line, &follow, &gray, 33);
    (void)iris_steer_update(&command, &steer, &line, 33);
    (void)iris_command_format(sentence, sizeof sentence, &length, &command);
}

const bench_case bench_cases[] = {
    {"RGB to gray by luma", W *H, color_frame, luma_of_rgb},
    {"YUYV to gray", W *H, yuyv_frame, gray_of_yuyv},
    {"RGB to mask by HSL range", W *H, color_frame, hsl_range},
    {"threshold, fixed", W *H, gray_frame, threshold_fixed},
    {"threshold, Otsu", W *H, gray_frame, threshold_otsu},
    {"threshold, adaptive 25x25", W *H, gray_frame, threshold_adaptive},
    {"regression over a mask", W *H, mask_frame, regress_mask},
    {"Hough lines of a mask, 90 angles", W *H, mask_frame, hough_lines},
    {"line follower, gray frame to sentence", W *H, follower, frame_to_sentence},
    {"the same by Hough transform of row centers", W *H, follower_by_hough, frame_to_sentence},
    {0},
};
