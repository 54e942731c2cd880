/* From the chosen chains to the result: one span per row, straight segments, angle, offsets, and bends. */
#include "follow_parts.h"

#define NONE IRIS_REGRESS_NONE

typedef struct {
    iris_follow *follow;
    iris_span *spans; /* per row; overlays follow->runs */
    int16_t *twice_x; /* per row, twice the center; overlays follow->owner */
    int is_lane;
    int is_dashed;               /* short pieces with gaps between them: only the whole has a direction */
    int32_t left_end, right_end; /* of a lane: the chains of its two lines that are nearest to the robot */
    int32_t top, bottom;         /* first and last row of the line */
    int32_t upright_top;         /* rows upright_top to bottom are fitted by row centers */
    int32_t bar_bottom;          /* rows bar_top to bar_bottom lie across; bar_bottom < bar_top: none */
    int32_t bar_top;
    int32_t width; /* of the line near the robot */
} shape;

static int32_t width(iris_span span)
{
    return span.right - span.left + 1;
}

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
static iris_span between(const shape *s, iris_span left, iris_span right, int32_t y)
{
    iris_span lane = {(int16_t)(left.right + 1), (int16_t)(right.left - 1)};
    if (width(left) <= 0) {
        lane.left = (int16_t)(left_image(s->follow, s->left_end, y, 0) ? 0 : s->follow->size.w);
    }
    if (width(right) <= 0) {
        lane.right =
            (int16_t)(left_image(s->follow, s->right_end, y, s->follow->size.w - 1) ? s->follow->size.w - 1
                                                                                    : -1);
    }
    return width(lane) > 0 ? lane : (iris_span){0, -1};
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
        if (width(span_a) > 0 && width(span_b) > 0) {
            sum += span_b.left + span_b.right - span_a.left - span_a.right;
        }
    }
    return sum != 0 ? sum > 0 : chain_a->bottom.left < chain_b->bottom.left;
}

/* Rows in which the line is not seen have no span. The spans take the place of the runs: row y's span is written to where
 * row y / 4's runs were, which are not needed any more. */
static void gather_spans(shape *s, int32_t line, int32_t other)
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
        if (width(span) > 0) {
            s->top = y < s->top ? y : s->top;
            s->bottom = y;
        }
        s->spans[y] = span;
    }
}

/* A line that is much wider than high lies across as a whole. */
static int lies_across(const shape *s)
{
    int32_t area = 0, rows = 0;
    for (int32_t y = s->top; y <= s->bottom; y++) {
        area += width(s->spans[y]);
        rows += width(s->spans[y]) > 0;
    }
    return area / rows > (s->bottom - s->top + 1) * 3 / 2;
}

static int32_t mean_width(const shape *s, int32_t from, int32_t rows)
{
    int32_t sum = 0, count = 0;
    for (int32_t y = from; y >= s->top && count < rows; y--) {
        if (width(s->spans[y]) > 0) {
            sum += width(s->spans[y]);
            count++;
        }
    }
    return count > 0 ? sum / count : 1;
}

/* Rows first down to last (first > last) hold something that lies across the line: span them by a straight
 * line between the rows below and above. */
static void bridge_crossing(shape *s, int32_t first, int32_t last)
{
    iris_span below = s->spans[first + 1], above = s->spans[last - 1];
    int32_t rows = first - last + 2;
    for (int32_t y = first; y >= last; y--) {
        int32_t k = first + 1 - y;
        s->spans[y].left = (int16_t)(below.left + (above.left - below.left) * k / rows);
        s->spans[y].right = (int16_t)(below.right + (above.right - below.right) * k / rows);
    }
}

/* Is the line made of pieces that are hardly longer than wide? */
static int has_dashes(const shape *s, int32_t chain)
{
    int32_t pieces = 0, rows = 0, area = 0;
    for (; chain >= 0; chain = s->follow->chains[chain].next) {
        pieces++;
        rows += s->follow->chains[chain].rows;
        area += s->follow->chains[chain].area;
    }
    int32_t gaps = s->bottom - s->top + 1 - rows;
    return pieces > 1 && gaps * 8 >= rows && (int64_t)rows * rows * 2 < (int64_t)area * pieces * 3;
}

/* How wide the line usually is: the mean of the rows that are not wider than the mean. */
static int32_t usual_width(const shape *s)
{
    int32_t mean = mean_width(s, s->bottom, s->follow->size.h);
    int32_t sum = 0, count = 0;
    for (int32_t y = s->top; y <= s->bottom; y++) {
        int32_t w = width(s->spans[y]);
        if (w > 0 && w <= mean) {
            sum += w;
            count++;
        }
    }
    return count > 0 ? sum / count : mean;
}

/* Is row y suddenly twice as wide: as usual, and as the rows below it? */
static int widens(const shape *s, int32_t y, int32_t usual)
{
    int32_t w = width(s->spans[y]);
    int32_t below = y + 2 + s->follow->size.h / 40;
    return w > usual * 2 + 2 && below <= s->bottom && w > width(s->spans[below]) * 2;
}

/* Does the line go on behind the wide rows y to end + 1, for some rows, and about where it came in? */
static int goes_on_behind(const shape *s, int32_t y, int32_t end)
{
    int32_t some = 2 + s->follow->size.h / 40;
    if (end - some < s->top || y + some > s->bottom) {
        return 0;
    }
    iris_span before = s->spans[y + some], behind = s->spans[end], farther = s->spans[end - some];
    int32_t aside = (behind.left + behind.right - before.left - before.right) / 2;
    int32_t reach = width(before) + (y - end);
    return width(before) > 0 && width(behind) > 0 && width(farther) > 0 && aside <= reach && aside >= -reach;
}

/* Do the wide rows y to end + 1 reach out to one side by more than the line's own width? */
static int has_arm(const shape *s, int32_t y, int32_t end, int32_t usual)
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

/* Walks from the robot into the distance. Rows that are suddenly twice as wide hold a crossing, if the line goes on
 * behind them where it should, or else a bend: the line turns to the side there. */
static void find_bend(shape *s)
{
    int32_t usual = usual_width(s);
    s->width = usual;
    for (int32_t y = s->bottom - 1; y >= s->top; y--) {
        if (!widens(s, y, usual)) {
            continue;
        }
        int32_t end = y;
        while (end >= s->top && width(s->spans[end]) > usual * 3 / 2 + 2) {
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

static int is_cut(const shape *s, iris_span span)
{
    return !s->is_lane && (span.left == 0) != (span.right == s->follow->size.w - 1);
}

/* Centers of the rows. Where a side of the image cuts the line, its hidden half is put back: behind a whole row, lines look
 * as wide as there or narrower. Cut rows nearer than any whole one are left out, unless there are only such. */
static void find_centers(shape *s)
{
    int32_t whole = 0, whole_rows = 0;
    for (int32_t y = s->upright_top; y <= s->bottom; y++) {
        whole_rows += width(s->spans[y]) > 0 && !is_cut(s, s->spans[y]);
    }
    for (int32_t y = s->follow->size.h - 1; y >= 0; y--) {
        iris_span span = s->spans[y];
        int32_t center = span.left + span.right;
        if (is_cut(s, span) && whole_rows > 0) {
            center = width(span) >= whole ? NONE
                     : span.left == 0     ? 2 * span.right - whole
                                          : 2 * span.left + whole;
        } else {
            whole = width(span) > 0 ? width(span) : whole;
        }
        s->twice_x[y] = (int16_t)(width(span) > 0 ? center : NONE);
    }
    while (s->bottom > s->upright_top && s->twice_x[s->bottom] == NONE) {
        s->bottom--;
    }
}

/* Column of a line in row y. Lines near the level have none: the caller asks only for |angle| below 80
 * degrees. */
static int32_t line_x_q16(const iris_line *line, int32_t y)
{
    int32_t tangent_q16 = line->dx / (line->dy >> 16);
    return line->x_q16 + (int32_t)(((int64_t)(y * 65536 - line->y_q16) * tangent_q16) >> 16);
}

#define STEEP ((iris_angle)14563) /* 80 degrees */

static int is_level(const iris_line *line)
{
    return line->angle > STEEP || line->angle < -STEEP;
}

/* The row between y0 and y1 (y0 > y1) whose center is farthest from their chord, at least `margin` rows from either; -1 when
 * none is farther than *most, which is twice the distance in pixels and becomes that row's. */
static int32_t farthest_row(const shape *s, int32_t y0, int32_t y1, int32_t margin, int32_t *most)
{
    int32_t at = -1;
    int32_t chord_q12 = s->twice_x[y0] * 4096;
    int32_t step_q12 = y0 > y1 ? (s->twice_x[y1] - s->twice_x[y0]) * 4096 / (y0 - y1) : 0;
    for (int32_t y = y0; y >= y1 + margin; y--, chord_q12 += step_q12) {
        int32_t off = s->twice_x[y] - (chord_q12 >> 12);
        off = off < 0 ? -off : off;
        if (off > *most && s->twice_x[y] != NONE && y <= y0 - margin) {
            at = y;
            *most = off;
        }
    }
    return at;
}

/* Splits rows bottom to upright_top into straight pieces: the piece that bends most is split where it bends most.
 * breaks[0] is the bottom, breaks[count] the top. Returns the count. */
static int32_t split(const shape *s, int32_t *breaks)
{
    int32_t count = 1;
    int32_t least_rows = s->follow->size.h / 16 > 4 ? s->follow->size.h / 16 : 4;
    int32_t tolerance = s->width / 2 > 4 ? s->width / 2 : 4;
    breaks[0] = s->bottom;
    breaks[1] = s->upright_top;
    while (breaks[1] < s->bottom && s->twice_x[breaks[1]] == NONE) {
        breaks[1]++;
    }
    while (count < IRIS_FOLLOW_SEGMENTS_MAX - 1) {
        int32_t at = -1, piece = 0, most = tolerance;
        for (int32_t k = 0; k < count; k++) {
            int32_t row = farthest_row(s, breaks[k], breaks[k + 1], least_rows, &most);
            at = row >= 0 ? row : at;
            piece = row >= 0 ? k : piece;
        }
        if (at < 0) {
            break;
        }
        for (int32_t k = count; k > piece; k--) {
            breaks[k + 1] = breaks[k];
        }
        breaks[piece + 1] = at;
        count++;
    }
    return count;
}

/* The straight line through the bar's pixels. */
static iris_status fit_bar(const shape *s, iris_line *line)
{
    iris_moments moments = {0};
    for (int32_t y = s->bar_top; y <= s->bar_bottom; y++) {
        if (width(s->spans[y]) > 0) {
            iris_moments_add_run(&moments, s->spans[y].left, s->spans[y].right, y);
        }
    }
    return iris_regress_moments(line, &moments);
}

static void add_segment(iris_follow_result *result, int32_t x0, int32_t y0, int32_t x1, int32_t y1)
{
    if (result->segment_count < IRIS_FOLLOW_SEGMENTS_MAX) {
        iris_segment segment = {x0, y0, x1, y1};
        result->segments[result->segment_count++] = segment;
    }
}

static int32_t row_of(const iris_line *line, int32_t x)
{
    int32_t slope_q16 = line->dx >> 16 != 0 ? line->dy / (line->dx >> 16) : 0;
    return (line->y_q16 + (int32_t)(((int64_t)(x * 65536 - line->x_q16) * slope_q16) >> 16) + 32768) >> 16;
}

/* The bar as a segment, from the side where the line comes in to the side where it goes. `from` is twice the
 * column where the line comes in. Returns the direction: the bar's angle, towards the longer arm. */
static iris_angle describe_bar(iris_follow_result *result, const shape *s, const iris_line *bar, int32_t from)
{
    int32_t left = s->follow->size.w, right = -1;
    for (int32_t y = s->bar_top; y <= s->bar_bottom; y++) {
        if (width(s->spans[y]) > 0) {
            left = s->spans[y].left < left ? s->spans[y].left : left;
            right = s->spans[y].right > right ? s->spans[y].right : right;
        }
    }
    int32_t to_right = 2 * right - from >= from - 2 * left;
    int32_t x0 = to_right ? left : right, x1 = to_right ? right : left;
    add_segment(result, x0, row_of(bar, x0), x1, row_of(bar, x1));
    if (to_right != (bar->angle >= 0)) {
        return (iris_angle)(bar->angle >= 0 ? -16384
                                            : 16384); /* it comes back a little: straight to the side */
    }
    return bar->angle;
}

/* Row y's center on the found segments: within a segment or the gap between two, or on the nearest one
 * extended. */
static int32_t segments_x_q16(const iris_follow_result *result, int32_t y)
{
    const iris_segment *best = NULL;
    int32_t least = INT32_MAX;
    for (int32_t k = 0; k < result->segment_count; k++) {
        const iris_segment *segment = &result->segments[k];
        int32_t away = y > segment->y0 ? y - segment->y0 : y < segment->y1 ? segment->y1 - y : 0;
        if (away < least) {
            best = segment;
            least = away;
        }
    }
    int32_t rows = best->y1 - best->y0, columns = best->x1 - best->x0;
    if (columns > 4 * -rows || columns < 4 * rows) { /* level: no row but its own */
        return (best->x0 + best->x1) * 32768;
    }
    return best->x0 * 65536 + columns * 4096 / rows * (y - best->y0) * 16;
}

static iris_q16 offset_of(const iris_follow *follow, int32_t x_q16)
{
    int32_t middle = (follow->size.w - 1) * 32768;
    int32_t limit = follow->size.w * 65536; /* twice the half width to each side */
    int32_t away = x_q16 - middle;
    away = away > limit ? limit : away < -limit ? -limit : away;
    return away / follow->size.w * 2;
}

/* The row's own center when it has one, else the segments' column there. */
static iris_q16 offset_at(const iris_follow_result *result, const shape *s, int32_t y)
{
    int32_t x_q16 =
        width(s->spans[y]) > 0 ? (s->spans[y].left + s->spans[y].right) * 32768 : segments_x_q16(result, y);
    return offset_of(s->follow, x_q16);
}

static void describe_upright(iris_follow_result *result, const shape *s)
{
    int32_t breaks[IRIS_FOLLOW_SEGMENTS_MAX + 1];
    int32_t count = split(s, breaks);
    for (int32_t k = 0; k < count; k++) {
        iris_line line;
        int32_t y0 = breaks[k], y1 = breaks[k + 1];
        if (iris_regress_rows(&line, s->twice_x, y1, y0, 2) != IRIS_OK) {
            continue;
        }
        if (is_level(&line)) {
            add_segment(result, s->twice_x[y0] / 2, y0, s->twice_x[y1] / 2, y1);
        } else {
            add_segment(result, (line_x_q16(&line, y0) + 32768) >> 16, y0,
                        (line_x_q16(&line, y1) + 32768) >> 16, y1);
        }
        if (result->segment_count == 1) {
            result->angle = line.angle;
        }
    }
}

/* Center of a piece of line, pixels. */
static void center_of_chain(const shape *s, const iris_follow_chain *chain, int32_t *x, int32_t *y)
{
    int32_t rows = 0, sum_x = 0, sum_y = 0;
    for (int32_t row = chain->top_y; row <= chain->bottom_y; row++) {
        if (width(s->spans[row]) > 0) {
            rows++;
            sum_x += s->spans[row].left + s->spans[row].right;
            sum_y += row;
        }
    }
    *x = rows > 0 ? sum_x / (2 * rows) : 0;
    *y = rows > 0 ? sum_y / rows : 0;
}

/* The nearest piece first: the list's far end is its start, so the segments are made in that order and then turned around. */
static void describe_dashes(iris_follow_result *result, shape *s, int32_t farthest)
{
    const iris_follow_chain *chains = s->follow->chains;
    int32_t pieces = 0, skip = 0, x1, y1;
    for (int32_t c = farthest; c >= 0; c = chains[c].next) {
        pieces++;
    }
    for (skip = pieces - 1 - IRIS_FOLLOW_SEGMENTS_MAX; skip > 0; skip--) {
        farthest = chains[farthest].next;
    }
    center_of_chain(s, &chains[farthest], &x1, &y1);
    for (int32_t c = chains[farthest].next; c >= 0; c = chains[c].next) {
        int32_t x0, y0;
        center_of_chain(s, &chains[c], &x0, &y0);
        add_segment(result, x0, y0, x1, y1);
        x1 = x0;
        y1 = y0;
    }
    for (int32_t i = 0, j = result->segment_count - 1; i < j; i++, j--) {
        iris_segment kept = result->segments[i];
        result->segments[i] = result->segments[j];
        result->segments[j] = kept;
    }
    const iris_segment *near = &result->segments[0];
    result->angle = iris_atan2_angle(near->x1 - near->x0, near->y0 - near->y1);
}

static int32_t confidence(const shape *s)
{
    int32_t rows = 0, pixels_high = s->bottom - s->top + 1;
    for (int32_t y = s->top; y <= s->bottom; y++) {
        rows += width(s->spans[y]) > 0;
    }
    int32_t enough = s->follow->size.h / 2;
    int32_t reach = pixels_high > enough ? 1000 : pixels_high * 1000 / enough;
    return reach * rows / pixels_high;
}

static void describe_solid(iris_follow_result *result, shape *s)
{
    if (s->is_lane) {
        s->width = mean_width(s, s->bottom, 8);
    } else if (lies_across(s)) {
        s->bar_top = s->top;
        s->bar_bottom = s->bottom;
        s->upright_top = s->bottom + 1;
    } else {
        find_bend(s);
    }
    find_centers(s);
    describe_upright(result, s);
    iris_line bar;
    if (s->bar_bottom >= s->bar_top && fit_bar(s, &bar) == IRIS_OK) {
        int upright = s->upright_top <= s->bottom;
        int32_t from = upright ? s->twice_x[s->upright_top] : s->follow->size.w - 1;
        iris_angle direction = describe_bar(result, s, &bar, from);
        result->has_next = upright;
        result->next_angle = upright ? direction : 0;
        result->angle = upright ? result->angle : bar.angle;
    }
}

int iris_follow_describe(iris_follow_result *result, iris_follow *follow, int32_t line, int32_t other)
{
    shape s = {.follow = follow, .spans = follow->runs, .twice_x = (int16_t *)(void *)follow->owner};
    s.is_lane = other >= 0;
    s.bar_bottom = -1;
    gather_spans(&s, line, other);
    if (s.top > s.bottom) {
        return 0;
    }
    s.upright_top = s.top;
    if (!s.is_lane && has_dashes(&s, line)) {
        describe_dashes(result, &s, line);
    } else {
        describe_solid(result, &s);
    }
    if (result->segment_count == 0) { /* a line without a direction, such as a single row */
        int32_t x = (s.spans[s.bottom].left + s.spans[s.bottom].right) / 2;
        add_segment(result, x, s.bottom, x, s.top);
    }
    int32_t ahead = (follow->size.h - 1) * follow->config.lookahead_permil / 1000;
    result->width_px = mean_width(&s, s.bottom, follow->size.h);
    result->offset_q16 = offset_of(follow, segments_x_q16(result, follow->size.h - 1));
    result->lookahead_offset_q16 = offset_at(result, &s, ahead);
    result->confidence_permil = confidence(&s);
    result->rows = s.spans;
    return 1;
}
