/* Rows that are suddenly wide: a crossing line, or a bend where the line turns to the side. */
#include "follow_parts.h"

/* Does the line go on behind the wide rows first to last, for some rows, and about where it came in? */
static int goes_on_behind(const iris_follow_shape *s, int32_t first, int32_t last, int32_t some)
{
    iris_span before = s->spans[last + some], behind = s->spans[first - 1];
    int32_t aside = (behind.left + behind.right - before.left - before.right) / 2;
    int32_t reach = iris_span_width(before) + last + 1 - first;
    return iris_span_width(before) > 0 && iris_span_width(behind) > 0 &&
           iris_follow_width(s, first - 1 - some) > 0 && aside <= reach && aside >= -reach;
}

/* Do the wide rows first to last reach out to one side by more than the line's own width? */
static int has_arm(const iris_follow_shape *s, int32_t first, int32_t last, int32_t some)
{
    iris_span before = s->spans[last + some], hull = iris_follow_hull(s, first, last);
    int32_t left = before.left - hull.left, right = hull.right - before.right;
    return (left > right ? left : right) * 2 > s->width * 3;
}

/* Rows first to last hold something that lies across the line: span them by a straight line between the rows above and
 * below. */
static void bridge_crossing(iris_follow_shape *s, int32_t first, int32_t last)
{
    iris_span above = s->spans[first - 1], below = s->spans[last + 1];
    int32_t rows = last - first + 2;
    for (int32_t k = 1; k < rows; k++) {
        iris_span *span = &s->spans[first - 1 + k];
        span->left = (int16_t)(above.left + (below.left - above.left) * k / rows);
        span->right = (int16_t)(above.right + (below.right - above.right) * k / rows);
    }
}

/* Walks from the robot into the distance. Rows that are suddenly twice as wide, as usual and as the rows below, hold a
 * crossing, if the line goes on behind them where it should, or else a bend: the line turns to the side there. */
void iris_follow_find_bend(iris_follow_shape *s)
{
    int32_t some = 2 + s->follow->size.h / 40;
    s->width = iris_follow_mean_width(s, s->width);
    for (int32_t y = s->bottom - some; y >= s->top; y--) {
        int32_t width = iris_follow_width(s, y);
        if (width <= s->width * 2 + 2 || width <= iris_follow_width(s, y + some) * 2) {
            continue;
        }
        int32_t first = y;
        while (iris_follow_width(s, first - 1) > (s->width * 3 >> 1) + 2) {
            first--;
        }
        if (first > s->top && goes_on_behind(s, first, y, some)) {
            bridge_crossing(s, first, y);
            y = first;
        } else if (has_arm(s, first, y, some)) {
            s->bar_bottom = y;
            s->bar_top = first;
            s->upright_top = y + 1;
            return;
        }
    }
}
