/* From chains to one span per row. */
#include "follow_parts.h"

/* The run of row y that belongs to the line whose chain `*chain` covers the rows around y, or an empty one. Rows are asked
 * for in order from the top; *chain moves on towards the robot. */
static iris_span run_of(const iris_follow *follow, int32_t y, int32_t *chain)
{
    const iris_follow_chain *chains = follow->chains;
    while (*chain >= 0 && y > chains[*chain].bottom_y) {
        *chain = chains[*chain].next;
    }
    for (int32_t i = 0; *chain >= 0 && y >= chains[*chain].top_y && i < IRIS_FOLLOW_RUNS; i++) {
        if (follow->owner[y * IRIS_FOLLOW_RUNS + i] == *chain) {
            return follow->runs[y * IRIS_FOLLOW_RUNS + i];
        }
    }
    return (iris_span){0, -1};
}

/* Has the line left the image at this side (0 or w - 1) before row y? */
static int left_image(const iris_follow *follow, int32_t nearest, int32_t y, int32_t side)
{
    const iris_follow_chain *chain = &follow->chains[nearest];
    int32_t away = side == 0 ? chain->bottom.left : side - chain->bottom.right;
    return y > chain->bottom_y && away <= follow->size.w / 8;
}

/* The columns between two lines. Where one of them has left the image on its side, up to that side. */
static iris_span between(const iris_follow_shape *s, iris_span left, iris_span right, int32_t y)
{
    iris_span lane = {(int16_t)(left.right + 1), (int16_t)(right.left - 1)};
    if (iris_span_width(left) <= 0) {
        lane.left = (int16_t)(left_image(s->follow, s->left_end, y, 0) ? 0 : s->follow->size.w);
    }
    if (iris_span_width(right) <= 0) {
        lane.right =
            (int16_t)(left_image(s->follow, s->right_end, y, s->follow->size.w - 1) ? s->follow->size.w - 1
                                                                                    : -1);
    }
    return iris_span_width(lane) > 0 ? lane : (iris_span){0, -1};
}

static int32_t nearest_chain(const iris_follow *follow, int32_t chain)
{
    while (chain >= 0 && follow->chains[chain].next >= 0) {
        chain = follow->chains[chain].next;
    }
    return chain;
}

/* Is line a to the left of line b? Where they share rows, there; else by where they end. */
static int is_left_of(const iris_follow *follow, int32_t a, int32_t b)
{
    int32_t sum = 0;
    const iris_follow_chain *chain_a = &follow->chains[a], *chain_b = &follow->chains[b];
    for (int32_t y = 0; y < follow->size.h; y++) {
        iris_span span_a = run_of(follow, y, &a), span_b = run_of(follow, y, &b);
        if (iris_span_width(span_a) > 0 && iris_span_width(span_b) > 0) {
            sum += span_b.left + span_b.right - span_a.left - span_a.right;
        }
    }
    return sum != 0 ? sum > 0 : chain_a->bottom.left < chain_b->bottom.left;
}

/* Rows in which the line is not seen have no span. The spans take the place of the runs: row y's span is written to where
 * row y / 4's runs were, which are not needed any more. */
void iris_follow_gather(iris_follow_shape *s, int32_t line, int32_t other)
{
    if (s->is_lane) {
        int32_t left = is_left_of(s->follow, line, other) ? line : other;
        other = left == line ? other : line;
        line = left;
        s->left_end = nearest_chain(s->follow, line);
        s->right_end = nearest_chain(s->follow, other);
    }
    s->top = s->follow->size.h;
    s->bottom = -1;
    for (int32_t y = 0; y < s->follow->size.h; y++) {
        iris_span span = run_of(s->follow, y, &line);
        if (s->is_lane) {
            span = between(s, span, run_of(s->follow, y, &other), y);
        }
        if (iris_span_width(span) > 0) {
            s->top = y < s->top ? y : s->top;
            s->bottom = y;
        }
        s->spans[y] = span;
    }
}

int32_t iris_follow_mean_width(const iris_follow_shape *s, int32_t rows)
{
    int32_t sum = 0, count = 0;
    for (int32_t y = s->bottom; y >= s->top && count < rows; y--) {
        if (iris_span_width(s->spans[y]) > 0) {
            sum += iris_span_width(s->spans[y]);
            count++;
        }
    }
    return count > 0 ? sum / count : 1;
}
