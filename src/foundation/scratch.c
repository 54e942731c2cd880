#include "iris/scratch.h"

iris_status iris_scratch_init(iris_scratch *scratch, void *base, size_t bytes)
{
    if (!scratch || (!base && bytes > 0)) {
        return IRIS_ERR_ARG;
    }
    if ((uintptr_t)base % IRIS_SCRATCH_ALIGN != 0) {
        return IRIS_ERR_ALIGN;
    }
    scratch->base = (uint8_t *)base;
    scratch->bytes = bytes;
    scratch->used = 0;
    scratch->peak = 0;
    return IRIS_OK;
}

void *iris_scratch_take(iris_scratch *scratch, size_t bytes)
{
    static const uint8_t nothing[1] = {0};
    if (!scratch) {
        return NULL;
    }
    if (bytes == 0) {
        return scratch->base ? scratch->base + scratch->used : (uint8_t *)(uintptr_t)nothing;
    }
    if (bytes > SIZE_MAX - (IRIS_SCRATCH_ALIGN - 1)) {
        return NULL;
    }
    size_t rounded = IRIS_SCRATCH_ROUND(bytes);
    if (rounded > scratch->bytes - scratch->used) {
        return NULL;
    }
    uint8_t *block = scratch->base + scratch->used;
    scratch->used += rounded;
    if (scratch->used > scratch->peak) {
        scratch->peak = scratch->used;
    }
    return block;
}

size_t iris_scratch_mark(const iris_scratch *scratch)
{
    return scratch ? scratch->used : 0;
}

void iris_scratch_release(iris_scratch *scratch, size_t mark)
{
    if (scratch && mark <= scratch->used) {
        scratch->used = mark;
    }
}
