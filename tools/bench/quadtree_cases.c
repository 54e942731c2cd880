#include "bench.h"

#include "iris/integral.h"
#include "iris/quadtree.h"
#include "iris/xt/region.h"

static iris_quadtree tree;
static iris_region_table regions;
static iris_image integral;

static void prepare_tree(void)
{
    tree.capacity = bench_frame.gray.w * bench_frame.gray.h / 8;
    tree.leaves = iris_scratch_take(&bench_frame.scratch, (size_t)tree.capacity * sizeof *tree.leaves);
    (void)iris_quadtree_segment(&tree, &bench_frame.gray, NULL);
}

static void prepare_regions(void)
{
    prepare_tree();
    regions.labels = iris_scratch_take(&bench_frame.scratch, (size_t)tree.count * sizeof *regions.labels);
}

static void prepare_integral(void)
{
    integral = bench_canvas_of(IRIS_GRAY_U32, bench_frame.gray.w + 1, bench_frame.gray.h + 1);
}

static iris_status segment(void)
{
    return iris_quadtree_segment(&tree, &bench_frame.gray, NULL);
}

static iris_status segment_color(void)
{
    return iris_quadtree_segment(&tree, &bench_frame.rgb, NULL);
}

static iris_status means(void)
{
    return iris_quadtree_means(&bench_frame.gray_to, &tree);
}

static iris_status merge(void)
{
    return iris_region_merge(&regions, &tree, NULL, &bench_frame.scratch);
}

static iris_status integral_sums(void)
{
    return iris_integral(&integral, &bench_frame.gray);
}

static iris_status integral_of_mask(void)
{
    return iris_integral(&integral, &bench_frame.mask);
}

static iris_status integral_squares(void)
{
    return iris_integral_squares(&integral, &bench_frame.gray);
}

const bench_case bench_quadtree[] = {
    {"integral image", integral_sums, prepare_integral},
    {"integral image of a mask", integral_of_mask, prepare_integral},
    {"integral image of squares", integral_squares, prepare_integral},
    {"quadtree of gray", segment, prepare_tree},
    {"quadtree of RGB", segment_color, prepare_tree},
    {"quadtree, block means", means, prepare_tree},
    {"regions of a quadtree", merge, prepare_regions},
    {0},
};
