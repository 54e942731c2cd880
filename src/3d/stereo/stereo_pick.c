#include "stereo_pick.h"

#include <string.h>

#include "../../foundation/kernel.h"

#define NONE 65535u /* no match, until the row is filled */

iris_status iris_stereo_pick_begin(iris_stereo_pick *p, const iris_stereo_config *config, int32_t w,
                                   iris_scratch *scratch)
{
    p->config = *config;
    p->w = w;
    const size_t places = (size_t)w + (size_t)config->max_disparity;
    p->right_cost = iris_scratch_take(scratch, 2 * places);
    p->right = iris_scratch_take(scratch, 2 * places);
    return p->right_cost && p->right ? IRIS_OK : IRIS_ERR_SCRATCH;
}

uint16_t iris_stereo_best(const uint16_t *costs, int32_t n)
{
    uint16_t step, before, least, behind, best;
    const iris_row_least to = {&step, &before, &least, &behind};
    iris_row_least_u16(&to, costs, n, n, 1);
    iris_row_parabola_u16(&best, &to, 1);
    return best;
}

/* Pixels of a row from x on, with their costs. */
typedef struct {
    uint16_t *costs;
    int32_t steps, x, count;
} piece;

/* Near the left edge there are fewer disparities: the others are made the worst, and the last one has none behind. */
static void find_least(const iris_row_least *to, const piece *p)
{
    const int32_t last = p->steps - 1, near = last - p->x < p->count ? last - p->x : p->count;
    for (int32_t k = 0; k < near; k++) {
        memset(p->costs + (ptrdiff_t)k * p->steps + p->x + k + 1, 255, 2 * (size_t)(last - p->x - k));
    }
    iris_row_least_u16(to, p->costs, p->steps, p->steps, p->count);
    for (int32_t k = 0; k < near; k++) {
        if (to->step[k] == p->x + k) {
            to->before[k] = to->behind[k] = to->least[k];
        }
    }
}

/* Takes those back of which another one that is not beside the best is nearly as good. */
static void keep_unique(uint16_t *disparity, const piece *p, const iris_row_least *best, int32_t percent)
{
    uint16_t step[IRIS_STEREO_PIECE], before[IRIS_STEREO_PIECE], second[IRIS_STEREO_PIECE],
        behind[IRIS_STEREO_PIECE];
    const iris_row_least others = {step, before, second, behind};
    for (int32_t k = 0; k < p->count; k++) {
        int32_t d = best->step[k];
        uint16_t *at = p->costs + (ptrdiff_t)k * p->steps + d;
        at[0] = NONE;
        at[d > 0 ? -1 : 0] = NONE;
        at[d < p->steps - 1 ? 1 : 0] = NONE;
    }
    find_least(&others, p);
    for (int32_t k = 0; k < p->count; k++) {
        int close = second[k] * (100 - percent) < best->least[k] * 100;
        disparity[k] = second[k] != NONE && close ? (uint16_t)NONE : disparity[k];
    }
}

/* Places to the left of the right picture come out, too, behind its own. */
static void see_from_right(const iris_stereo_pick *p, const piece *from)
{
    const ptrdiff_t first = p->w - 1 - from->x;
    iris_row_facing_u16(p->right_cost + first, p->right + first, from->costs, from->steps, from->count);
}

/* Those that the right picture does not confirm are none. */
static void check(uint16_t *disparity, const iris_stereo_pick *p)
{
    for (int32_t x = 0; x < p->w; x++) {
        int32_t d = (disparity[x] + 128) >> 8;
        int32_t apart = disparity[x] == NONE ? 0 : p->right[p->w - 1 - x + d] - d;
        if (apart > p->config.check_px || -apart > p->config.check_px) {
            disparity[x] = NONE;
        }
    }
}

/* The smaller of the two matches around those that have none. */
static void fill(uint16_t *disparity, int32_t w)
{
    uint16_t last = NONE;
    for (int32_t x = 0; x < w;) {
        int32_t end = x;
        while (end < w && disparity[end] == NONE) {
            end++;
        }
        uint16_t next = end < w ? disparity[end] : (uint16_t)NONE;
        for (; x < end; x++) {
            disparity[x] = last < next ? last : next;
        }
        last = next;
        x = end + 1;
    }
}

void iris_stereo_pick_begin_row(const iris_stereo_pick *p)
{
    const size_t places = (size_t)p->w + (size_t)p->config.max_disparity;
    memset(p->right_cost, 255, 2 * places);
    memset(p->right, 0, 2 * places);
}

void iris_stereo_pick_piece(uint16_t *disparity, const iris_stereo_pick *p, uint16_t *costs, int32_t x,
                            int32_t count)
{
    uint16_t step[IRIS_STEREO_PIECE], before[IRIS_STEREO_PIECE], least[IRIS_STEREO_PIECE],
        behind[IRIS_STEREO_PIECE];
    const iris_row_least best = {step, before, least, behind};
    piece here = {NULL, p->config.max_disparity + 1, x, count};
    here.costs = costs;
    if (p->config.check_px < 255) {
        see_from_right(p, &here);
    }
    find_least(&best, &here);
    iris_row_parabola_u16(disparity + x, &best, count);
    if (p->config.uniqueness_percent > 0) {
        keep_unique(disparity + x, &here, &best, p->config.uniqueness_percent);
    }
}

void iris_stereo_pick_end_row(uint16_t *disparity, const iris_stereo_pick *p)
{
    if (p->config.check_px < 255) {
        check(disparity, p);
    }
    if (p->config.fill) {
        fill(disparity, p->w);
    }
    for (int32_t x = 0; x < p->w; x++) {
        disparity[x] = disparity[x] == NONE ? 0 : disparity[x];
    }
}
