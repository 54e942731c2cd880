#include "digest.h"

#include "iris/3d/stereo.h"

/* Odd sizes, and one whose disparities are whole vectors. */
#define W 29
#define H 19
enum { FEW = 10, WHOLE = 15 };

/* The right picture: the left one with nearer things in its lower half, and noise of its own. */
static void draw_pair(iris_image *left, iris_image *right)
{
    *left = digest_picture(IRIS_GRAY8, W, H);
    *right = digest_canvas(IRIS_GRAY8, W, H);
    for (int32_t y = 0; y < H; y++) {
        const uint8_t *from = iris_image_row(left, y);
        uint8_t *to = iris_image_row(right, y);
        int32_t d = y < H / 2 ? 2 : 7;
        for (int32_t x = 0; x < W; x++) {
            int32_t level = from[x + d < W ? x + d : W - 1] + digest_between(-2, 2);
            to[x] = (uint8_t)(level < 0 ? 0 : level > 255 ? 255 : level);
        }
    }
}

static void block_of(iris_stereo_cost cost, int32_t most, int32_t side, int32_t uniqueness)
{
    iris_image left, right, disparity = digest_canvas(IRIS_GRAY_U16, W, H);
    iris_scratch scratch = digest_scratch(IRIS_STEREO_BLOCK_SCRATCH_BYTES(W, WHOLE));
    draw_pair(&left, &right);
    iris_stereo_block_config config = {{most, cost, 1, uniqueness, uniqueness == 0, 1}, side};
    digest_number(iris_stereo_block(&disparity, &left, &right, &config, &scratch));
    digest_view(&disparity);
    config.stereo.check_px = 255;
    config.stereo.smooth = 0;
    digest_number(iris_stereo_block(&disparity, &left, &right, &config, &scratch));
    digest_view(&disparity);
}

static void block_sad(void)
{
    block_of(IRIS_STEREO_SAD, WHOLE, 5, 0);
}

static void block_census(void)
{
    block_of(IRIS_STEREO_CENSUS, FEW, 7, 0);
}

static void block_unique(void)
{
    block_of(IRIS_STEREO_BOTH, FEW, 3, 15);
}

/* A strip, with memory for which the band of rows is short. */
static void semiglobal_of(iris_stereo_cost cost, int32_t most)
{
    enum { STRIP = 11 };
    iris_image left, right, disparity = digest_canvas(IRIS_GRAY_U16, STRIP, H);
    draw_pair(&left, &right);
    left.w = right.w = STRIP;
    iris_stereo_semiglobal_config config;
    iris_stereo_semiglobal_defaults(&config);
    config.stereo.max_disparity = most;
    config.stereo.cost = cost;
    iris_scratch scratch = digest_scratch(IRIS_STEREO_SEMIGLOBAL_SCRATCH_BYTES(STRIP, most));
    digest_number(iris_stereo_semiglobal(&disparity, &left, &right, &config, &scratch));
    digest_view(&disparity);
}

static void semiglobal(void)
{
    semiglobal_of(IRIS_STEREO_BOTH, 9);
}

static void semiglobal_whole(void)
{
    semiglobal_of(IRIS_STEREO_SAD, 7);
}

static void quadtree_of(iris_stereo_side divided, int32_t planes, int32_t levels)
{
    enum { STRIP = 24, MOST = 7 };
    iris_image left, right, maps[2] = {digest_canvas(IRIS_GRAY_U16, STRIP, H), {0}};
    draw_pair(&left, &right);
    left.w = right.w = STRIP;
    maps[1] = digest_canvas(IRIS_GRAY_U16, (STRIP + 1) / 2, (H + 1) / 2);
    iris_stereo_quadtree_config config = {MOST, IRIS_STEREO_CENSUS, 20, divided, planes, levels};
    iris_scratch scratch = digest_scratch(IRIS_STEREO_QUADTREE_SCRATCH_BYTES(STRIP, H, MOST, levels) +
                                          IRIS_STEREO_MIRROR_BYTES(STRIP, H));
    digest_number(iris_stereo_quadtree_maps(maps, levels > 1 ? 2 : 1, &left, &right, &config, &scratch));
    digest_view(&maps[0]);
    digest_view(&maps[1]);
}

static void quadtree(void)
{
    quadtree_of(IRIS_STEREO_LEFT, 0, 1);
}

static void quadtree_planes(void)
{
    quadtree_of(IRIS_STEREO_RIGHT, 1, 2);
}

/* Disparities of two depths with holes and specks. */
static iris_image draw_disparities(void)
{
    iris_image disparity = digest_canvas(IRIS_GRAY_U16, W, H);
    for (int32_t y = 0; y < H; y++) {
        uint16_t *row = iris_image_row(&disparity, y);
        for (int32_t x = 0; x < W; x++) {
            int32_t noise = digest_between(-300, 300), hole = digest_between(0, 9);
            row[x] = (uint16_t)(hole < (x > W / 2 ? 3 : 0) ? 0 : (x < y ? 900 : 3000) + noise);
        }
    }
    return disparity;
}

static void smooth(void)
{
    iris_image disparity = draw_disparities();
    iris_scratch scratch = digest_scratch(IRIS_STEREO_SMOOTH_SCRATCH_BYTES(W));
    digest_number(iris_stereo_smooth(&disparity, &scratch));
    digest_view(&disparity);
}

static void speckle(void)
{
    iris_image disparity = draw_disparities();
    iris_scratch scratch = digest_scratch(IRIS_STEREO_SPECKLE_SCRATCH_BYTES(W, H));
    digest_number(iris_stereo_speckle(&disparity, 12, 100, &scratch));
    digest_view(&disparity);
}

static void depth(void)
{
    for (int32_t d = 0; d < 65536; d += 997) {
        digest_number(iris_stereo_depth((uint16_t)d, IRIS_Q32_ONE / 16 + d, 500 * IRIS_Q32_ONE));
    }
}

const digest_operation digest_stereo[] = {
    {"stereo.block_sad", block_sad},
    {"stereo.block_census", block_census},
    {"stereo.block_unique", block_unique},
    {"stereo.semiglobal", semiglobal},
    {"stereo.semiglobal_whole", semiglobal_whole},
    {"stereo.quadtree", quadtree},
    {"stereo.quadtree_planes", quadtree_planes},
    {"stereo.smooth", smooth},
    {"stereo.speckle", speckle},
    {"stereo.depth", depth},
    {NULL, NULL},
};
