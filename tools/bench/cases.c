/* The cases: what a robot does with every frame, on a frame of 160x120 that a floor camera could have sent. */
#include "bench.h"

#include "iris/image.h"
#include "iris/scratch.h"
#include "iris/xt/threshold.h"

#include <string.h>

#define W 160
#define H 120

static IRIS_SCRATCH_BUFFER(gray_bytes, W *H);
static IRIS_SCRATCH_BUFFER(mask_bytes, W / 8 * H);
static IRIS_SCRATCH_BUFFER(working_bytes, 16384);
static iris_image gray, mask;
static iris_scratch scratch;

/* A floor in uneven light, noise, and a dark line that leans to the right. */
static void frame(void)
{
    uint32_t random = 1;
    (void)iris_image_wrap(&gray, gray_bytes.memory, W * H, (iris_size){W, H}, 0, IRIS_GRAY8);
    (void)iris_image_wrap(&mask, mask_bytes.memory, W / 8 * H, (iris_size){W, H}, 0, IRIS_MASK1);
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

const bench_case bench_cases[] = {
    {"threshold, fixed", W *H, frame, threshold_fixed},
    {"threshold, Otsu", W *H, frame, threshold_otsu},
    {"threshold, adaptive 25x25", W *H, frame, threshold_adaptive},
    {0},
};
