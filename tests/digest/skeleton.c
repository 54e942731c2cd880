#include "digest.h"

#include "iris/xt/skeleton.h"
#include "iris/xt/threshold.h"

#define W 131
#define H 45

/* What is brighter than `value`: a bright half, spots, and a ragged line between them. */
static iris_image bright(uint8_t value)
{
    iris_image gray = digest_picture(IRIS_GRAY8, W, H);
    iris_image mask = digest_canvas(IRIS_MASK1, W, H);
    (void)iris_threshold(&mask, &gray, value, IRIS_SELECT_BRIGHT);
    return mask;
}

static void thin(iris_skeleton_method method, uint8_t value)
{
    int32_t passes = 0;
    iris_image mask = bright(value);
    iris_scratch scratch = digest_scratch(IRIS_SKELETON_SCRATCH_BYTES(W, H));
    digest_number(iris_skeleton(&passes, &mask, &mask, method, &scratch));
    digest_number(passes);
    digest_view(&mask);
}

static void exact(void)
{
    thin(IRIS_SKELETON_EXACT, 128);
}

static void zhang_suen(void)
{
    thin(IRIS_SKELETON_ZHANG_SUEN, 128);
}

static void exact_sparse(void)
{
    thin(IRIS_SKELETON_EXACT, 170);
}

static void prune(void)
{
    iris_image mask = bright(150);
    iris_scratch scratch = digest_scratch(IRIS_SKELETON_SCRATCH_BYTES(W, H));
    digest_number(iris_skeleton_prune(&mask, &mask, 6, &scratch));
    digest_view(&mask);
}

static void points(void)
{
    iris_image mask = bright(140);
    iris_image found = digest_canvas(IRIS_MASK1, W, H);
    iris_scratch scratch = digest_scratch(IRIS_SKELETON_SCRATCH_BYTES(W, H));
    digest_number(iris_skeleton(NULL, &mask, &mask, IRIS_SKELETON_EXACT, &scratch));
    digest_number(iris_skeleton_ends(&found, &mask, &scratch));
    digest_view(&found);
    digest_number(iris_skeleton_branches(&found, &mask, &scratch));
    digest_view(&found);
}

const digest_operation digest_skeleton[] = {
    {"skeleton.exact", exact},           {"skeleton.exact_sparse", exact_sparse},
    {"skeleton.zhang_suen", zhang_suen}, {"skeleton.prune", prune},
    {"skeleton.points", points},         {NULL, NULL},
};
