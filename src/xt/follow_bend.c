/* Rows that are suddenly wide: a crossing line, or a bend where the line turns to the side. */
#include "follow_parts.h"

/* How wide the line usually is: the mean of the rows that are not wider than the mean. */
static int32_t usual_width(const iris_follow_shape *s)
{
    int32_t mean = iris_follow_mean_width(s, s->follow->size.h);
    int32_t sum = 0, count = 0;
    for (int32_t y = s->top; y <= s->bottom; y++) {
        int32_t w = iris_span_width(s->spans[y]);
        if (w > 0 && w <= mean) {
            sum += w;
            count++;
        }
    }
    return count > 0 ? sum / count : mean;
}

/* Is row y suddenly twice as wide: as usual, and as the rows below it? */
static int widens(const iris_follow_shape *s, int32_t y, int32_t usual)
{
    int32_t w = iris_span_width(s->spans[y]);
    int32_t below = y + 2 + s->follow->size.h / 40;
    return w > usual * 2 + 2 && below <= s->bottom && w > iris_span_width(s->spans[below]) * 2;
}

/* Does the line go on behind the wide rows y to end + 1, for some rows, and about where it came in? */
static int goes_on_behind(const iris_follow_shape *s, int32_t y, int32_t end)
{
    int32_t some = 2 + s->follow->size.h / 40;
    if (end - some < s->top || y + some > s->bottom) {
        return 0;
    }
    iris_span before = s->spans[y + some], behind = s->spans[end], farther = s->spans[end - some];
    int32_t aside = (behind.left + behind.right - before.left - before.right) / 2;
    int32_t reach = iris_span_width(before) + (y - end);
    return iris_span_width(before) > 0 && iris_span_width(behind) > 0 && iris_span_width(farther) > 0 &&
           aside <= reach && aside >= -reach;
}

/* Do the wide rows y to end + 1 reach out to one side by more than the line's own width? */
static int has_arm(const iris_follow_shape *s, int32_t y, int32_t end, int32_t usual)
{
    iris_span before = s->spans[y + 2 + s->follow->size.h / 40];
    int32_t arm = 0;
    for (; y > end; y--) {
        int32_t left = before.left - s->spans[y].left, right = s->spans[y].right - before.right;
        int32_t longer = left > right ? left : right;
        arm = longer > arm ? longer : arm;
    }
    return arm * 2 > usual * 3;
}

/* Rows first down to last (first > last) hold something that lies across the line: span them by a straight
 * line between the rows below and above. */
static void bridge_crossing(iris_follow_shape *s, int32_t first, int32_t last)
{
    iris_span below = s->spans[first + 1], above = s->spans[last - 1];
    int32_t rows = first - last + 2;
    for (int32_t y = first; y >= last; y--) {
        int32_t k = first + 1 - y;
        s->spans[y].left = (int16_t)(below.left + (above.left - below.left) * k / rows);
        s->spans[y].right = (int16_t)(below.right + (above.right - below.right) * k / rows);
    }
}

/* Walks from the robot into the distance. Rows that are suddenly twice as wide hold a crossing, if the line goes on
 * behind them where it should, or else a bend: the line turns to the side there. */
void iris_follow_find_bend(iris_follow_shape *s)
{
    int32_t usual = usual_width(s);
    s->width = usual;
    for (int32_t y = s->bottom - 1; y >= s->top; y--) {
        if (!widens(s, y, usual)) {
            continue;
        }
        int32_t end = y;
        while (end >= s->top && iris_span_width(s->spans[end]) > usual * 3 / 2 + 2) {
            end--;
        }
        if (goes_on_behind(s, y, end)) {
            bridge_crossing(s, y, end + 1);
            y = end;
        } else if (has_arm(s, y, end, usual)) {
            s->bar_bottom = y;
            s->bar_top = end + 1;
            s->upright_top = y + 1;
            return;
        }
    }
}

/* The first (step 1) or last (step -1) row of the bar that covers column x; at the other end when none does. */
static int32_t bar_edge(const iris_follow_shape *s, int32_t x, int32_t y, int32_t step)
{
    for (; y >= s->bar_top && y <= s->bar_bottom; y += step) {
        if (s->spans[y].left <= x && s->spans[y].right >= x) {
            break;
        }
    }
    return y;
}

/* A line that lies across is fitted by the centers of its columns, as an upright one is by those of its rows. */
iris_status iris_follow_fit_bar(iris_line *line, const iris_follow_shape *s)
{
    enum { COLUMNS = 16 };
    iris_point centers[COLUMNS];
    int32_t count = 0;
    int32_t left = s->follow->size.w, right = -1;
    for (int32_t y = s->bar_top; y <= s->bar_bottom; y++) {
        if (iris_span_width(s->spans[y]) > 0) {
            left = s->spans[y].left < left ? s->spans[y].left : left;
            right = s->spans[y].right > right ? s->spans[y].right : right;
        }
    }
    for (int32_t k = 0; k < COLUMNS; k++) {
        int32_t x = left + (right - left) * (2 * k + 1) / (2 * COLUMNS);
        int32_t first = bar_edge(s, x, s->bar_top, 1), last = bar_edge(s, x, s->bar_bottom, -1);
        if (first <= last) {
            centers[count].twice_x = (int16_t)(2 * x);
            centers[count].twice_y = (int16_t)(first + last);
            count++;
        }
    }
    return iris_regress_points(line, centers, count);
}
