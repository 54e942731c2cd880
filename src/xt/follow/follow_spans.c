/* From chains to one span per row. */
#include "follow_parts.h"

iris_span iris_follow_run(const iris_follow *follow, int32_t y, int32_t *chain)
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

void iris_follow_put_span(iris_follow_shape *s, int32_t y, iris_span span)
{
    if (iris_span_width(span) > 0) {
        s->top = s->rows == 0 ? y : s->top;
        s->bottom = y;
        s->rows++;
    }
    s->spans[y] = span;
}

int32_t iris_follow_width(const iris_follow_shape *s, int32_t y)
{
    return y >= s->top && y <= s->bottom ? iris_span_width(s->spans[y]) : 0;
}

int32_t iris_follow_mean_width(const iris_follow_shape *s, int32_t widest)
{
    int32_t sum = 0, count = 0;
    for (int32_t y = s->top; y <= s->bottom; y++) {
        int32_t width = iris_follow_width(s, y);
        if (width > 0 && width <= widest) {
            sum += width;
            count++;
        }
    }
    return count > 0 ? sum / count : widest;
}

iris_span iris_follow_hull(const iris_follow_shape *s, int32_t first, int32_t last)
{
    iris_span hull = {IRIS_FOLLOW_SIDE_MAX, -1};
    for (int32_t y = first; y <= last; y++) {
        iris_span span = s->spans[y];
        if (iris_follow_width(s, y) > 0) {
            hull.left = span.left < hull.left ? span.left : hull.left;
            hull.right = span.right > hull.right ? span.right : hull.right;
        }
    }
    return hull;
}
