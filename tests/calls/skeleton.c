/* Skeletons. */
#include "iris/xt/skeleton.h"

#include "calls.h"

static void skeleton(void)
{
    iris_size size = draw_size();
    const iris_image *dst = draw_output(IRIS_MASK1, size);
    const iris_image *src = draw_input(IRIS_MASK1, size);
    int32_t *passes = OR_NULL(draw_results(sizeof *passes));
    iris_skeleton_method method = (iris_skeleton_method)draw_below(draw_chance(20) ? 3 : 2);
    iris_scratch *scratch = draw_scratch(IRIS_SKELETON_SCRATCH_BYTES(size.w, size.h));
    CALL(iris_skeleton(passes, dst, src, method, scratch));
}

static void prune(void)
{
    iris_size size = draw_size();
    const iris_image *dst = draw_output(IRIS_MASK1, size);
    const iris_image *src = draw_input(IRIS_MASK1, size);
    int32_t length = draw_int(0, 20);
    iris_scratch *scratch = draw_scratch(IRIS_SKELETON_SCRATCH_BYTES(size.w, size.h));
    CALL(iris_skeleton_prune(dst, src, length, scratch));
}

static void ends(void)
{
    iris_size size = draw_size();
    const iris_image *dst = draw_output(IRIS_MASK1, size);
    const iris_image *src = draw_input(IRIS_MASK1, size);
    iris_scratch *scratch = draw_scratch(IRIS_SKELETON_POINTS_SCRATCH_BYTES(size.w));
    CALL(iris_skeleton_ends(dst, src, scratch));
}

static void branches(void)
{
    iris_size size = draw_size();
    const iris_image *dst = draw_output(IRIS_MASK1, size);
    const iris_image *src = draw_input(IRIS_MASK1, size);
    iris_scratch *scratch = draw_scratch(IRIS_SKELETON_POINTS_SCRATCH_BYTES(size.w));
    CALL(iris_skeleton_branches(dst, src, scratch));
}

const random_call calls_skeleton[] = {
    {"iris_skeleton", skeleton},
    {"iris_skeleton_prune", prune},
    {"iris_skeleton_ends", ends},
    {"iris_skeleton_branches", branches},
    {NULL, NULL},
};
