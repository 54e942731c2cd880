#include "stereo_pick.h"

#define NONE 65535u /* no match, until the row is filled */

iris_status iris_stereo_pick_begin(iris_stereo_pick *p, const iris_stereo_config *config, int32_t w,
                                   iris_scratch *scratch)
{
    p->config = *config;
    p->w = w;
    p->right_cost = iris_scratch_take(scratch, 2 * (size_t)w);
    p->right = iris_scratch_take(scratch, (size_t)w);
    return p->right_cost && p->right ? IRIS_OK : IRIS_ERR_SCRATCH;
}

static int32_t least_of(const uint16_t *costs, int32_t n)
{
    int32_t best = 0;
    for (int32_t d = 1; d < n; d++) {
        best = costs[d] < costs[best] ? d : best;
    }
    return best;
}

/* Is none of those that are not beside the best one nearly as good? */
static int is_unique(const uint16_t *costs, int32_t n, int32_t best, int32_t percent)
{
    for (int32_t d = 0; d < n && percent > 0; d++) {
        int beside = d >= best - 1 && d <= best + 1;
        if (!beside && costs[d] * (100 - percent) < costs[best] * 100) {
            return 0;
        }
    }
    return 1;
}

/* Where the parabola through the least cost and its two neighbors is lowest, in 256ths. */
static uint16_t refine(const uint16_t *costs, int32_t n, int32_t best)
{
    int32_t value = best * 256;
    if (best > 0 && best < n - 1) {
        int32_t before = costs[best - 1], behind = costs[best + 1];
        int32_t bend = before + behind - 2 * costs[best];
        int32_t slope = 128 * (before - behind);
        int32_t off = bend == 0 ? 0 : (slope + (slope < 0 ? -bend : bend) / 2) / bend;
        value += off > 127 ? 127 : off < -127 ? -127 : off;
    }
    return (uint16_t)(value > 0 ? value : 1);
}

uint16_t iris_stereo_best(const uint16_t *costs, int32_t n)
{
    return refine(costs, n, least_of(costs, n));
}

static void see_from_right(const iris_stereo_pick *p, const uint16_t *costs, int32_t n, int32_t x)
{
    for (int32_t d = 0; d < n; d++) {
        if (costs[d] < p->right_cost[x - d]) {
            p->right_cost[x - d] = costs[d];
            p->right[x - d] = (uint8_t)d;
        }
    }
}

/* Those that the right picture does not confirm are none. */
static void check(uint16_t *disparity, const iris_stereo_pick *p)
{
    for (int32_t x = 0; x < p->w; x++) {
        int32_t d = (disparity[x] + 128) >> 8;
        int32_t apart = disparity[x] == NONE ? 0 : p->right[x - d] - d;
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

void iris_stereo_pick_row(uint16_t *disparity, const iris_stereo_pick *p, const uint16_t *costs)
{
    int32_t steps = p->config.max_disparity + 1;
    for (int32_t x = 0; x < p->w; x++) {
        p->right_cost[x] = UINT16_MAX;
        p->right[x] = 0;
    }
    for (int32_t x = 0; x < p->w; x++, costs += steps) {
        int32_t n = x < steps - 1 ? x + 1 : steps, best = least_of(costs, n);
        int unique = is_unique(costs, n, best, p->config.uniqueness_percent);
        disparity[x] = unique ? refine(costs, n, best) : (uint16_t)NONE;
        see_from_right(p, costs, n, x);
    }
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
