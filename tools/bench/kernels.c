/* The cases that show what a port's row kernels are worth: through public calls, on a frame of 640x480. */
#include "bench.h"

#include "iris/color.h"
#include "iris/xt/follow.h"
#include "iris/xt/threshold.h"

#define W 640
#define H 480

static IRIS_SCRATCH_BUFFER(gray_bytes, W *H);
static IRIS_SCRATCH_BUFFER(color_bytes, W *H * 3);
static IRIS_SCRATCH_BUFFER(other_bytes, W *H * 3);
static IRIS_SCRATCH_BUFFER(mask_bytes, W / 8 * H);
static IRIS_SCRATCH_BUFFER(working_bytes, IRIS_FOLLOW_SCRATCH_BYTES(W, H));
static iris_image gray, rgb, bgr, other, mask;
static iris_scratch scratch;
static iris_follow follow;

static void wrap(iris_image *image, void *bytes, iris_format format)
{
    size_t needed = iris_format_row_bytes(format, W) * H;
    (void)iris_image_wrap(image, bytes, needed, (iris_size){W, H}, 0, format);
}

/* A colored floor in uneven light, noise, and a dark line that leans to the right. */
static void frames(void)
{
    uint32_t random = 1;
    wrap(&gray, gray_bytes.memory, IRIS_GRAY8);
    wrap(&rgb, color_bytes.memory, IRIS_RGB888);
    wrap(&bgr, color_bytes.memory, IRIS_BGR888);
    wrap(&other, other_bytes.memory, IRIS_RGB888);
    wrap(&mask, mask_bytes.memory, IRIS_MASK1);
    (void)iris_scratch_init(&scratch, working_bytes.memory, sizeof working_bytes.memory);
    for (int32_t y = 0; y < H; y++) {
        uint8_t *pixel = iris_image_row(&rgb, y);
        int32_t line = 200 + (H - y) / 3;
        for (int32_t x = 0; x < W; x++, pixel += 3) {
            random = random * 1664525u + 1013904223u;
            int32_t level = 200 - x / 8 + (int32_t)(random >> 28) - 8;
            level = x >= line && x < line + 56 ? level / 4 : level;
            pixel[0] = (uint8_t)level;
            pixel[1] = (uint8_t)(level - (int32_t)(random >> 20 & 31u));
            pixel[2] = (uint8_t)(level / 2);
        }
    }
    (void)iris_color_gray(&gray, &rgb, IRIS_GRAY_LUMA);
}

static void luma_of_rgb(void)
{
    (void)iris_color_gray(&gray, &rgb, IRIS_GRAY_LUMA);
}

static void luma_of_bgr(void)
{
    (void)iris_color_gray(&gray, &bgr, IRIS_GRAY_LUMA);
}

static void rgb_of_bgr(void)
{
    (void)iris_color_convert(&other, &bgr);
}

static void rgb_of_bgr_in_place(void)
{
    (void)iris_color_convert(&rgb, &bgr);
}

static void hsl_range(void)
{
    const iris_hsl_range range = {30, 80, 30, 100, 20, 90};
    (void)iris_hsl_range_mask(&mask, &rgb, &range);
}

static void threshold_fixed(void)
{
    (void)iris_threshold(&mask, &gray, 100, IRIS_SELECT_DARK);
}

static void threshold_adaptive(void)
{
    (void)iris_threshold_adaptive(&mask, &gray, 12, 20, IRIS_SELECT_DARK, &scratch);
}

/* The second frame: the floor is known. */
static void follower(void)
{
    iris_follow_result line;
    frames();
    (void)iris_follow_init(&follow, (iris_size){W, H}, NULL, &scratch);
    (void)iris_follow_frame(&line, &follow, &gray, 0);
}

static void follow_frame(void)
{
    iris_follow_result line;
    (void)iris_follow_frame(&line, &follow, &gray, 33);
}

const bench_case bench_cases[] = {
    {"RGB to gray by luma", W *H, frames, luma_of_rgb},
    {"BGR to gray by luma", W *H, frames, luma_of_bgr},
    {"BGR to RGB", W *H, frames, rgb_of_bgr},
    {"BGR to RGB in place", W *H, frames, rgb_of_bgr_in_place},
    {"RGB to mask by HSL range", W *H, frames, hsl_range},
    {"threshold, fixed", W *H, frames, threshold_fixed},
    {"threshold, adaptive 25x25", W *H, frames, threshold_adaptive},
    {"line follower, gray frame to result", W *H, follower, follow_frame},
    {0},
};
