/* Which chains are the line: those that continue each other over gaps are put together, and the best row of
 * chains wins. */
#include "follow_parts.h"

static int32_t larger(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

static int32_t distance(int32_t a, int32_t b)
{
    return a > b ? a - b : b - a;
}

/* How far the chain reaches, roughly in pixels along it. */
static int32_t length_of(const iris_follow_chain *chain)
{
    int32_t along_y = chain->bottom_y - chain->top_y + 1;
    int32_t along_x =
        distance(chain->top.left + chain->top.right, chain->bottom.left + chain->bottom.right) >> 1;
    int32_t length = larger(along_x, along_y) + ((along_x < along_y ? along_x : along_y) >> 1);
    return larger(length, chain->widest);
}

static int32_t contrast_permil(const iris_follow_chain *chain)
{
    int32_t permil = chain->range_sum > 0 ? chain->contrast_sum * 1000 / chain->range_sum : 0;
    return permil < 1000 ? permil : 1000;
}

/* Columns between two runs, 0 when they overlap. */
static int32_t columns_between(iris_span a, iris_span b)
{
    return larger(0, larger(a.left - b.right, b.left - a.right));
}

static int32_t center(iris_span span)
{
    return (span.left + span.right) >> 1;
}

/* Does the way over the gap lie within 60 degrees of the way that the nearer chain goes? */
static int goes_on(const iris_follow_chain *near, const iris_follow_chain *far)
{
    int32_t near_x = center(near->top) - center(near->bottom), near_y = near->top_y - near->bottom_y;
    int32_t gap_x = center(far->bottom) - center(near->top), gap_y = far->bottom_y - near->top_y;
    int32_t along = near_x * gap_x + near_y * gap_y;
    int32_t across = near_x * gap_y - near_y * gap_x;
    return (across < 0 ? -across : across) * 4 <= along * 7;
}

/* Does the chain stand out from the floor by 1 / part more than its pixels have to, of what is left? */
static int stands_out(const iris_follow *follow, const iris_follow_chain *chain, int32_t part)
{
    int32_t asked = follow->config.contrast_permil;
    return contrast_permil(chain) >= asked + (1000 - asked) / part;
}

static int is_line_like(const iris_follow *follow, const iris_follow_chain *chain)
{
    return chain->rows >= 2 && stands_out(follow, chain, 5);
}

/* Is it long or dark enough to be one of several pieces of a line? The stones of a terrazzo floor are neither. */
static int is_piece(const iris_follow *follow, const iris_follow_chain *chain)
{
    return chain->rows * 6 >= follow->size.h || stands_out(follow, chain, 3);
}

/* May `far` be the line's continuation above `near`? The gap is at most a quarter of the image high, and the farther
 * the gap, the farther to the side it may continue. */
static int continues(const iris_follow *follow, const iris_follow_chain *near, const iris_follow_chain *far)
{
    int32_t gap = near->top_y - far->bottom_y;
    if (far->bottom_y >= near->bottom_y || far->top_y >= near->top_y || gap > follow->size.h >> 2 ||
        !is_piece(follow, near) || !is_piece(follow, far)) {
        return 0;
    }
    int32_t aside = columns_between(near->top, far->bottom);
    if (aside > (gap > 0 ? gap * 3 >> 1 : 0) + 2) {
        return 0;
    }
    return gap <= follow->size.h >> 4 || goes_on(near, far);
}

/* Does the chain reach the robot about where the line was in an earlier frame? */
static int is_where_it_was(const iris_follow *follow, const iris_follow_chain *chain)
{
    int32_t w = follow->size.w;
    int32_t last = (w - 1 + ((follow->last.offset_q16 * w) >> 16)) / 2;
    return follow->seen && !follow->config.lane && chain->bottom_y >= follow->size.h * 3 >> 2 &&
           distance(center(chain->bottom), last) <= w >> 3;
}

/* Longer, higher in contrast, nearer to the robot, and where the line was before is better. */
static int32_t score_of(const iris_follow *follow, const iris_follow_chain *chain)
{
    int32_t score = length_of(chain) * contrast_permil(chain);
    score += score / follow->size.h * chain->bottom_y;
    return is_where_it_was(follow, chain) ? score + (score >> 1) : score;
}

/* Is the whole long enough, thin enough for its length, and without more gaps than line? */
static int is_line(const iris_follow *follow, int32_t farthest)
{
    int32_t length = 0, area = 0, rows = 0, bottom = 0;
    for (int32_t c = farthest; c >= 0; c = follow->chains[c].next) {
        const iris_follow_chain *chain = &follow->chains[c];
        length += length_of(chain);
        area += chain->area;
        rows += chain->rows;
        bottom = chain->bottom_y;
    }
    int32_t extent = bottom - follow->chains[farthest].top_y + 1;
    int32_t shorter = follow->size.w < follow->size.h ? follow->size.w : follow->size.h;
    return length >= shorter >> 2 && area / length * 3 <= length * 2 && rows * 2 >= extent;
}

/* The nearest chain that is not done yet. */
static iris_follow_chain *nearest(const iris_follow *follow)
{
    iris_follow_chain *nearest = NULL;
    for (int32_t c = 0; c < follow->chain_count; c++) {
        iris_follow_chain *chain = &follow->chains[c];
        if (!chain->done && (!nearest || chain->bottom_y > nearest->bottom_y)) {
            nearest = chain;
        }
    }
    return nearest;
}

int32_t iris_follow_choose(iris_follow *follow)
{
    int32_t best = -1;
    for (int32_t c = 0; c < follow->chain_count; c++) {
        follow->chains[c].done = 0;
        follow->chains[c].total = 0;
    }
    for (iris_follow_chain *chain = nearest(follow); chain; chain = nearest(follow)) {
        chain->done = 1;
        if (chain->used || !is_line_like(follow, chain)) {
            continue;
        }
        chain->next = -1;
        for (int32_t c = 0; c < follow->chain_count; c++) {
            const iris_follow_chain *near = &follow->chains[c];
            if (near->total > chain->total && continues(follow, near, chain)) {
                chain->total = near->total;
                chain->next = (int16_t)c;
            }
        }
        chain->total += score_of(follow, chain);
        if (best < 0 || chain->total > follow->chains[best].total) {
            best = (int32_t)(chain - follow->chains);
        }
    }
    if (best < 0 || !is_line(follow, best)) {
        return -1;
    }
    for (int32_t c = best; c >= 0; c = follow->chains[c].next) {
        follow->chains[c].used = 1;
    }
    return best;
}
