/* Stereo: disparities, and what is done to them. */
#include "iris/3d/stereo.h"

#include "calls.h"

/* Sides of 1 to 30, rarely 0: each pixel has many disparities. */
static iris_size any_size(void)
{
    iris_size size = draw_size();
    size.w = size.w > 30 ? size.w - 40 : size.w;
    size.h = size.h > 30 ? size.h - 40 : size.h;
    return (iris_size){size.w < 0 ? -size.w : size.w, size.h < 0 ? -size.h : size.h};
}

static int32_t any_disparities(void)
{
    return draw_chance(20) ? draw_int(1, IRIS_STEREO_DISPARITY_MAX)
                           : draw_within(1, draw_chance(8) ? 40 : 12);
}

static iris_stereo_config any_config(void)
{
    iris_stereo_config config = {any_disparities(), (iris_stereo_cost)draw_within(0, 2), 1, 0, 1, 1};
    config.fill = draw_within(0, 1);
    config.smooth = draw_within(0, 1);
    if (draw_chance(4)) {
        config.cost = (iris_stereo_cost)draw_int(IRIS_STEREO_CENSUS, IRIS_STEREO_BOTH);
        config.check_px = draw_int(0, 255);
        config.uniqueness_percent = draw_int(0, 99);
    }
    return config;
}

/* What the views' working memory is asked for. */
static int32_t asked(int32_t disparities)
{
    return disparities >= 1 && disparities <= IRIS_STEREO_DISPARITY_MAX ? disparities : 1;
}

static void block(void)
{
    iris_size size = any_size();
    iris_stereo_block_config config = {any_config(), 2 * draw_within(0, 6) + 1};
    config.side = draw_chance(4) ? draw_int(1, IRIS_STEREO_SIDE_MAX) : config.side;
    const iris_image *left = draw_input(IRIS_GRAY8, size), *right = draw_input(IRIS_GRAY8, size);
    const iris_image *disparity = draw_output(IRIS_GRAY_U16, size);
    const iris_stereo_block_config *with = draw_chance(20) ? NULL : draw_given(&config, sizeof config);
    int32_t most = with ? asked(config.stereo.max_disparity) : 63;
    iris_scratch *scratch = draw_scratch(IRIS_STEREO_BLOCK_SCRATCH_BYTES(size.w, most));
    CALL(iris_stereo_block(disparity, left, right, with, scratch));
}

static void semiglobal(void)
{
    iris_size size = any_size();
    iris_stereo_semiglobal_config config = {any_config(), 24, 200};
    if (draw_chance(3)) {
        config.p2 = draw_int(0, IRIS_STEREO_P2_MAX);
        config.p1 = draw_int(0, config.p2 > 0 ? config.p2 : 0);
    }
    const iris_image *left = draw_input(IRIS_GRAY8, size), *right = draw_input(IRIS_GRAY8, size);
    const iris_image *disparity = draw_output(IRIS_GRAY_U16, size);
    const iris_stereo_semiglobal_config *with = draw_chance(20) ? NULL : draw_given(&config, sizeof config);
    int32_t most = with ? asked(config.stereo.max_disparity) : 63;
    iris_scratch *scratch = draw_scratch(IRIS_STEREO_SEMIGLOBAL_SCRATCH_BYTES(size.w, most));
    CALL(iris_stereo_semiglobal(disparity, left, right, with, scratch));
}

static void quadtree(void)
{
    iris_size size = any_size();
    iris_stereo_quadtree_config config = {
        any_disparities(), (iris_stereo_cost)draw_within(0, 2),   20, (iris_stereo_side)draw_within(0, 1),
        draw_within(0, 1), draw_within(1, IRIS_STEREO_LEVELS_MAX)};
    if (draw_chance(4)) {
        config.cost = (iris_stereo_cost)draw_int(IRIS_STEREO_CENSUS, IRIS_STEREO_BOTH);
        config.tolerance = draw_int(0, 255);
        config.divided = (iris_stereo_side)draw_int(IRIS_STEREO_LEFT, IRIS_STEREO_RIGHT);
        config.levels = draw_int(1, IRIS_STEREO_LEVELS_MAX);
    }
    const iris_image *left = draw_input(IRIS_GRAY8, size), *right = draw_input(IRIS_GRAY8, size);
    const iris_image *disparity = draw_output(IRIS_GRAY_U16, size);
    const iris_stereo_quadtree_config *with = draw_chance(20) ? NULL : draw_given(&config, sizeof config);
    int32_t most = with ? asked(config.max_disparity) : 63, levels = with ? config.levels : 3;
    levels = levels < 1 ? 1 : levels > IRIS_STEREO_LEVELS_MAX ? IRIS_STEREO_LEVELS_MAX : levels;
    size_t mirror =
        with && config.divided == IRIS_STEREO_RIGHT ? IRIS_STEREO_MIRROR_BYTES(size.w, size.h) : 0;
    iris_scratch *scratch =
        draw_scratch(IRIS_STEREO_QUADTREE_SCRATCH_BYTES(size.w, size.h, most, levels) + mirror);
    CALL(iris_stereo_quadtree(disparity, left, right, with, scratch));
}

/* The map of half the size alone. */
static void quadtree_maps(void)
{
    iris_size size = any_size(), half_size = {(size.w + 1) / 2, (size.h + 1) / 2};
    iris_stereo_quadtree_config config = {any_disparities(), IRIS_STEREO_CENSUS, 20, IRIS_STEREO_LEFT, 1, 2};
    int32_t count = draw_chance(8) ? draw_int(1, 2) : 2;
    const iris_image *left = draw_input(IRIS_GRAY8, size), *right = draw_input(IRIS_GRAY8, size);
    const iris_image *half = draw_output(IRIS_GRAY_U16, half_size);
    iris_image maps[2] = {{0}};
    if (half) {
        maps[1] = *half;
    }
    iris_scratch *scratch =
        draw_scratch(IRIS_STEREO_QUADTREE_SCRATCH_BYTES(size.w, size.h, asked(config.max_disparity), 2));
    CALL(iris_stereo_quadtree_maps(half && half->data ? maps : NULL, count, left, right, &config, scratch));
}

static void smooth(void)
{
    iris_size size = draw_size();
    const iris_image *disparity = draw_output(IRIS_GRAY_U16, size);
    iris_scratch *scratch = draw_scratch(IRIS_STEREO_SMOOTH_SCRATCH_BYTES(size.w));
    CALL(iris_stereo_smooth(disparity, scratch));
}

static void speckle(void)
{
    iris_size size = draw_size();
    const iris_image *disparity = draw_output(IRIS_GRAY_U16, size);
    int32_t least_area = draw_int(0, 100), difference = draw_chance(2) ? draw_int(0, 65535) : 20000;
    iris_scratch *scratch = draw_scratch(IRIS_STEREO_SPECKLE_SCRATCH_BYTES(size.w, size.h));
    CALL(iris_stereo_speckle(disparity, least_area, difference, scratch));
}

const random_call calls_stereo[] = {
    {"iris_stereo_block", block},
    {"iris_stereo_semiglobal", semiglobal},
    {"iris_stereo_quadtree", quadtree},
    {"iris_stereo_quadtree_maps", quadtree_maps},
    {"iris_stereo_smooth", smooth},
    {"iris_stereo_speckle", speckle},
    {NULL, NULL},
};
