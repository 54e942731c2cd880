/* The lane between two lines. */
#include "follow_parts.h"

/* Has the line left the image at this side (0 or w - 1) before row y? */
static int left_image(const iris_follow *follow, int32_t nearest, int32_t y, int32_t side)
{
    const iris_follow_chain *chain = &follow->chains[nearest];
    int32_t away = side == 0 ? chain->bottom.left : side - chain->bottom.right;
    return y > chain->bottom_y && away <= follow->size.w / 8;
}

static int32_t nearest_chain(const iris_follow *follow, int32_t chain)
{
    while (follow->chains[chain].next >= 0) {
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
        iris_span span_a = iris_follow_run(follow, y, &a), span_b = iris_follow_run(follow, y, &b);
        if (iris_span_width(span_a) > 0 && iris_span_width(span_b) > 0) {
            sum += span_b.left + span_b.right - span_a.left - span_a.right;
        }
    }
    return sum != 0 ? sum > 0 : chain_a->bottom.left < chain_b->bottom.left;
}

/* The columns between two lines. Where one of them has left the image on its side, up to that side. */
static void gather(iris_follow_shape *s, int32_t left, int32_t right)
{
    const iris_follow *follow = s->follow;
    int32_t left_end = nearest_chain(follow, left), right_end = nearest_chain(follow, right);
    int32_t side = follow->size.w - 1;
    for (int32_t y = 0; y < follow->size.h; y++) {
        iris_span a = iris_follow_run(follow, y, &left), b = iris_follow_run(follow, y, &right);
        iris_span lane = {(int16_t)(a.right + 1), (int16_t)(b.left - 1)};
        if (iris_span_width(a) <= 0) {
            lane.left = (int16_t)(left_image(follow, left_end, y, 0) ? 0 : side + 1);
        }
        if (iris_span_width(b) <= 0) {
            lane.right = (int16_t)(left_image(follow, right_end, y, side) ? side : -1);
        }
        iris_follow_put_span(s, y, iris_span_width(lane) > 0 ? lane : (iris_span){0, -1});
    }
}

/* Near the robot: the mean of the nearest rows. */
static int32_t width_of(const iris_follow_shape *s)
{
    int32_t sum = 0, count = 0;
    for (int32_t y = s->bottom; y >= s->top && count < 8; y--) {
        sum += iris_follow_width(s, y);
        count += iris_follow_width(s, y) > 0;
    }
    return count > 0 ? sum / count : 0;
}

int iris_follow_describe_lane(iris_follow_result *result, iris_follow *follow, int32_t line)
{
    iris_follow_shape s = iris_follow_shape_of(result, follow);
    int32_t other = iris_follow_choose(follow);
    if (other < 0) {
        return 0;
    }
    int left = is_left_of(follow, line, other);
    gather(&s, left ? line : other, left ? other : line);
    if (s.rows == 0) {
        return 0;
    }
    s.is_lane = 1;
    s.upright_top = s.top;
    s.width = width_of(&s);
    iris_follow_describe_shape(&s);
    return 1;
}
