#include "bench.h"

#include "iris/3d/stereo.h"

#define MOST 63

static iris_image right, disparity;

/* The right picture: what the left one shows is nearer, the lower it is. */
static void prepare(void)
{
    const int32_t w = bench_frame.gray.w, h = bench_frame.gray.h;
    right = bench_canvas(IRIS_GRAY8);
    disparity = bench_canvas(IRIS_GRAY_U16);
    for (int32_t y = 0; y < h; y++) {
        const uint8_t *from = iris_image_row(&bench_frame.gray, y);
        uint8_t *to = iris_image_row(&right, y);
        int32_t d = 4 + 40 * y / h;
        for (int32_t x = 0; x < w; x++) {
            to[x] = from[x + d < w ? x + d : w - 1];
        }
    }
}

static iris_status block(const iris_stereo_block_config *config)
{
    return iris_stereo_block(&disparity, &bench_frame.gray, &right, config, &bench_frame.scratch);
}

static iris_status block_defaults(void)
{
    return block(NULL);
}

static iris_status block_plain(void)
{
    const iris_stereo_block_config config = {{MOST, IRIS_STEREO_SAD, 255, 0, 0, 0}, 15};
    return block(&config);
}

static iris_status semiglobal(void)
{
    return iris_stereo_semiglobal(&disparity, &bench_frame.gray, &right, NULL, &bench_frame.scratch);
}

static iris_status quadtree(void)
{
    return iris_stereo_quadtree(&disparity, &bench_frame.gray, &right, NULL, &bench_frame.scratch);
}

static void prepare_disparity(void)
{
    prepare();
    (void)block_plain();
}

static iris_status smooth(void)
{
    return iris_stereo_smooth(&disparity, &bench_frame.scratch);
}

static iris_status speckle(void)
{
    return iris_stereo_speckle(&disparity, 100, 256, &bench_frame.scratch);
}

const bench_case bench_stereo[] = {
    {"stereo, block matching", block_defaults, prepare},
    {"stereo, block matching, SAD 15x15, plain", block_plain, prepare},
    {"stereo, semi-global", semiglobal, prepare},
    {"stereo, quadtree", quadtree, prepare},
    {"stereo, smoothed disparities", smooth, prepare_disparity},
    {"stereo, specks taken away", speckle, prepare_disparity},
    {0},
};
