#include "../../foundation/views.h"
#include "skeleton_parts.h"

static iris_status start(iris_thinning *thinning, const iris_image *dst, const iris_image *src,
                         iris_scratch *scratch)
{
    iris_status status = scratch ? iris_views_check_formats(dst, IRIS_MASK1, src, IRIS_MASK1) : IRIS_ERR_ARG;
    if (status == IRIS_OK) {
        status = iris_thinning_begin(thinning, (iris_size){src->w, src->h}, scratch);
    }
    if (status == IRIS_OK) {
        iris_thinning_load(thinning, src);
    }
    return status;
}

iris_status iris_skeleton(int32_t *passes, const iris_image *dst, const iris_image *src,
                          iris_skeleton_method method, iris_scratch *scratch)
{
    if (method != IRIS_SKELETON_EXACT && method != IRIS_SKELETON_ZHANG_SUEN) {
        return IRIS_ERR_ARG;
    }
    size_t mark = iris_scratch_mark(scratch);
    iris_thinning thinning;
    iris_status status = start(&thinning, dst, src, scratch);
    if (status == IRIS_OK) {
        int32_t made = iris_thinning_run(&thinning, method);
        iris_thinning_store(dst, &thinning);
        iris_scratch_release(scratch, mark);
        if (passes) {
            *passes = made;
        }
    }
    return status;
}

iris_status iris_skeleton_prune(const iris_image *dst, const iris_image *src, int32_t length,
                                iris_scratch *scratch)
{
    if (length < 0) {
        return IRIS_ERR_RANGE;
    }
    size_t mark = iris_scratch_mark(scratch);
    iris_thinning thinning;
    iris_status status = start(&thinning, dst, src, scratch);
    if (status == IRIS_OK) {
        (void)iris_thinning_run(&thinning, IRIS_SKELETON_EXACT);
        iris_thinning_store(dst, &thinning);
        iris_skeleton_prune_branches(dst, &thinning, length);
        iris_scratch_release(scratch, mark);
    }
    return status;
}
