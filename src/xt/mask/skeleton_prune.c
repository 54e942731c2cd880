#include "skeleton_parts.h"

const int8_t iris_step_x[8] = {0, 1, 1, 1, 0, -1, -1, -1};
const int8_t iris_step_y[8] = {-1, -1, 0, 1, 1, 1, 0, -1};

/* Pixels x - 1, x, x + 1 of a row. */
static unsigned three_at(const uint64_t *row, int32_t x)
{
    const uint64_t *word = row + (x + 63) / 64 - 1;
    int32_t shift = (x + 63) % 64;
    uint64_t bits = word[0] >> shift;
    if (shift > 61) {
        bits |= word[1] << (64 - shift);
    }
    return (unsigned)(bits & 7);
}

unsigned iris_skeleton_neighbors(const iris_thinning *skeleton, int32_t x, int32_t y)
{
    const uint64_t *row = skeleton->words + (ptrdiff_t)y * skeleton->stride;
    unsigned above = three_at(row - skeleton->stride, x), at = three_at(row, x);
    unsigned below = three_at(row + skeleton->stride, x);
    return (above >> 1 & 3) | (at >> 2) << 2 | (below >> 2) << 3 | (below >> 1 & 1) << 4 | (below & 1) << 5 |
           (at & 1) << 6 | (above & 1) << 7;
}

int iris_skeleton_is_branch(unsigned around)
{
    unsigned twice = around | around << 8;
    unsigned begins = ~around & twice >> 1 & 0xFF;
    unsigned but_one = begins & (begins - 1);
    return (but_one & (but_one - 1)) != 0 || (twice & twice >> 1 & twice >> 2 & 0x55) != 0;
}

static void clear(const iris_image *mask, int32_t x, int32_t y)
{
    ((uint32_t *)iris_image_row(mask, y))[x / 32] &= ~((uint32_t)1 << x % 32);
}

/* Pixels of the branch that ends at (x, y), at most `limit`; `limit` too when no branch point comes. `erased`: clears
 * them there; null: only counts. No pixel of a skeleton one pixel wide has more than two groups of neighbors unless it is a
 * branch point, and a group of more than one pixel has a branch point in it; so there is one way to go, or none. */
static int32_t walk(const iris_image *erased, const iris_thinning *skeleton, int32_t x, int32_t y,
                    int32_t limit)
{
    unsigned back = 0;
    for (int32_t count = 1; count < limit; count++) {
        unsigned next = iris_skeleton_neighbors(skeleton, x, y) & ~back;
        if (erased) {
            clear(erased, x, y);
        }
        int to = -1;
        for (int i = 0; i < 8; i++) {
            if (next >> i & 1) {
                to = i;
                if (iris_skeleton_is_branch(
                        iris_skeleton_neighbors(skeleton, x + iris_step_x[i], y + iris_step_y[i]))) {
                    return count;
                }
            }
        }
        if (to < 0) {
            return limit;
        }
        x += iris_step_x[to];
        y += iris_step_y[to];
        back = 1u << (to + 4) % 8;
    }
    return limit;
}

/* Clears the short branches in dst, which holds the skeleton. Returns 1 when there were any. */
static int erase_branches(const iris_image *dst, const iris_thinning *skeleton, int32_t length)
{
    int found = 0;
    for (int32_t y = 0; y < skeleton->h; y++) {
        const uint64_t *row = skeleton->words + (ptrdiff_t)y * skeleton->stride;
        for (int32_t i = 0; i < skeleton->stride; i++) {
            uint64_t ends =
                iris_ends_of_word(row + i - skeleton->stride, row + i, row + i + skeleton->stride);
            for (int32_t x = 64 * i; ends != 0; x++, ends >>= 1) {
                if ((ends & 1) != 0 && walk(NULL, skeleton, x, y, length) < length) {
                    (void)walk(dst, skeleton, x, y, length);
                    found = 1;
                }
            }
        }
    }
    return found;
}

void iris_skeleton_prune_branches(const iris_image *dst, iris_thinning *skeleton, int32_t length)
{
    while (erase_branches(dst, skeleton, length)) {
        iris_thinning_load(skeleton, dst);
        (void)iris_thinning_run(skeleton, IRIS_SKELETON_EXACT);
        iris_thinning_store(dst, skeleton);
    }
}
