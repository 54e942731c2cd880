#include "../../foundation/views.h"
#include "skeleton_parts.h"

#include <string.h>

typedef uint64_t (*points)(const uint64_t *above, const uint64_t *word, const uint64_t *below);

/* One group, and no three in a row. */
uint64_t iris_ends_of_word(const uint64_t *above, const uint64_t *word, const uint64_t *below)
{
    iris_around a = iris_around_word(above, word, below);
    iris_groups groups = iris_groups_around(&a);
    uint64_t n = a.nw & a.ne, e = a.ne & a.se, s = a.se & a.sw, w = a.sw & a.nw;
    uint64_t three = (a.n & (n | (a.ne & a.e))) | (a.e & (e | (a.se & a.s))) | (a.s & (s | (a.sw & a.w))) |
                     (a.w & (w | (a.nw & a.n)));
    return *word & iris_groups_one(&groups) & ~three;
}

uint64_t iris_branches_of_word(const uint64_t *above, const uint64_t *word, const uint64_t *below)
{
    iris_around a = iris_around_word(above, word, below);
    iris_groups g = iris_groups_around(&a);
    uint64_t three = (g.q0 & g.q1 & (g.q2 | g.q3)) | (g.q2 & g.q3 & (g.q0 | g.q1));
    uint64_t square = (a.ne & a.n & a.e) | (a.se & a.e & a.s) | (a.sw & a.s & a.w) | (a.nw & a.w & a.n);
    return *word & (three | square);
}

/* Writes the points of every row, with the three rows around it in a ring. */
static iris_status find(const iris_image *dst, const iris_image *src, points of, iris_scratch *scratch)
{
    iris_status status = scratch ? iris_views_check_formats(dst, IRIS_MASK1, src, IRIS_MASK1) : IRIS_ERR_ARG;
    if (status != IRIS_OK) {
        return status;
    }
    size_t mark = iris_scratch_mark(scratch), bytes = IRIS_SKELETON_POINTS_SCRATCH_BYTES(src->w);
    uint64_t *memory = (uint64_t *)iris_scratch_take(scratch, bytes);
    if (!memory) {
        return IRIS_ERR_SCRATCH;
    }
    memset(memory, 0, bytes);
    int32_t stride = iris_skeleton_stride(src->w);
    uint64_t *above = memory + 1, *row = above + stride, *below = row + stride;
    iris_skeleton_load(row, src, 0);
    for (int32_t y = 0; y < src->h; y++) {
        if (y + 1 < src->h) {
            iris_skeleton_load(below, src, y + 1);
        } else {
            memset(below, 0, (size_t)stride * sizeof *below);
        }
        for (int32_t i = 0; i < stride; i++) {
            iris_skeleton_put(dst, y, i, of(above + i, row + i, below + i));
        }
        uint64_t *oldest = above;
        above = row;
        row = below;
        below = oldest;
    }
    iris_scratch_release(scratch, mark);
    return IRIS_OK;
}

iris_status iris_skeleton_ends(const iris_image *dst, const iris_image *src, iris_scratch *scratch)
{
    return find(dst, src, iris_ends_of_word, scratch);
}

iris_status iris_skeleton_branches(const iris_image *dst, const iris_image *src, iris_scratch *scratch)
{
    return find(dst, src, iris_branches_of_word, scratch);
}
