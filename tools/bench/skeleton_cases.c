#include "bench.h"

#include "iris/xt/skeleton.h"
#include "iris/xt/threshold.h"

/* What is brighter than the middle: half of the floor, and noise along its edge. */
static void half(void)
{
    (void)iris_threshold(&bench_frame.mask, &bench_frame.gray, 160, IRIS_SELECT_BRIGHT);
}

static iris_status exact(void)
{
    return iris_skeleton(NULL, &bench_frame.mask_to, &bench_frame.mask, IRIS_SKELETON_EXACT,
                         &bench_frame.scratch);
}

static iris_status zhang_suen(void)
{
    return iris_skeleton(NULL, &bench_frame.mask_to, &bench_frame.mask, IRIS_SKELETON_ZHANG_SUEN,
                         &bench_frame.scratch);
}

static iris_status prune(void)
{
    return iris_skeleton_prune(&bench_frame.mask_to, &bench_frame.mask, 8, &bench_frame.scratch);
}

static iris_status branches(void)
{
    return iris_skeleton_branches(&bench_frame.mask_to, &bench_frame.mask, &bench_frame.scratch);
}

const bench_case bench_skeleton[] = {
    {"skeleton of a line", exact, NULL},
    {"skeleton of half the frame", exact, half},
    {"skeleton of half the frame, Zhang-Suen", zhang_suen, half},
    {"skeleton of half the frame, pruned", prune, half},
    {"branch points", branches, NULL},
    {0},
};
