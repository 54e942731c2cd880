/* From the chosen chains to the result: one span per row, straight segments, angle, offsets, and bends. */
#include "follow_parts.h"

#define NONE      IRIS_REGRESS_NONE
#define NO_COLUMN INT32_MIN

/* A line that is much wider than high lies across as a whole. */
static int lies_across(const iris_follow_shape *s)
{
    int32_t area = 0, rows = 0;
    for (int32_t y = s->top; y <= s->bottom; y++) {
        area += iris_span_width(s->spans[y]);
        rows += iris_span_width(s->spans[y]) > 0;
    }
    return area / rows > (s->bottom - s->top + 1) * 3 / 2;
}

/* Is the line made of pieces that are hardly longer than wide? */
static int has_dashes(const iris_follow_shape *s, int32_t chain)
{
    int32_t pieces = 0, rows = 0, area = 0;
    for (; chain >= 0; chain = s->follow->chains[chain].next) {
        pieces++;
        rows += s->follow->chains[chain].rows;
        area += s->follow->chains[chain].area;
    }
    int32_t gaps = s->bottom - s->top + 1 - rows;
    return pieces > 1 && gaps * 8 >= rows && rows * rows * 2 / (pieces * 3) < area;
}

static int is_cut(const iris_follow_shape *s, iris_span span)
{
    return !s->is_lane && (span.left == 0) != (span.right == s->follow->size.w - 1);
}

/* Centers of the rows. Where a side of the image cuts the line, its hidden half is put back: behind a whole row, lines look
 * as wide as there or narrower. Cut rows nearer than any whole one are left out, unless there are only such. */
static void find_centers(iris_follow_shape *s)
{
    int32_t whole = 0, whole_rows = 0;
    for (int32_t y = s->upright_top; y <= s->bottom; y++) {
        whole_rows += iris_span_width(s->spans[y]) > 0 && !is_cut(s, s->spans[y]);
    }
    for (int32_t y = s->follow->size.h - 1; y >= 0; y--) {
        iris_span span = s->spans[y];
        int32_t center = span.left + span.right;
        if (is_cut(s, span) && whole_rows > 0) {
            center = iris_span_width(span) >= whole ? NONE
                     : span.left == 0               ? 2 * span.right - whole
                                                    : 2 * span.left + whole;
        } else {
            whole = iris_span_width(span) > 0 ? iris_span_width(span) : whole;
        }
        s->twice_x[y] = (int16_t)(iris_span_width(span) > 0 ? center : NONE);
    }
    while (s->bottom > s->upright_top && s->twice_x[s->bottom] == NONE) {
        s->bottom--;
    }
}

/* Columns and rows outside of the image are kept within reach of 32 bits. */
static int32_t within_reach(int64_t q16)
{
    const int64_t reach = (int64_t)2 * IRIS_FOLLOW_SIDE_MAX * 65536;
    return (int32_t)(q16 > reach ? reach : q16 < -reach ? -reach : q16);
}

/* Column of a line in row y. Lines near the level have none: the caller asks only for |angle| below 80 degrees. */
static int32_t line_x_q16(const iris_line *line, int32_t y)
{
    int32_t tangent_q16 = line->dx / (line->dy >> 16);
    int64_t aside = ((int64_t)(y * 65536 - line->y_q16) * tangent_q16) >> 16;
    return within_reach(line->x_q16 + aside);
}

static int32_t line_x(const iris_line *line, int32_t y)
{
    return (line_x_q16(line, y) + 32768) >> 16;
}

/* Row of a line in column x, for lines that lie across. */
static int32_t line_y(const iris_line *line, int32_t x)
{
    int32_t slope_q16 = line->dx >> 16 != 0 ? line->dy / (line->dx >> 16) : 0;
    int64_t aside = ((int64_t)(x * 65536 - line->x_q16) * slope_q16) >> 16;
    return (within_reach(line->y_q16 + aside) + 32768) >> 16;
}

#define STEEP ((iris_angle)14563) /* 80 degrees */

static int is_level(const iris_line *line)
{
    return line->angle > STEEP || line->angle < -STEEP;
}

/* Fewer rows with the line have no direction of their own. */
static int32_t least_rows(const iris_follow_shape *s)
{
    return s->follow->size.h / 16 > 4 ? s->follow->size.h / 16 : 4;
}

/* The row between y0 and y1 (y0 > y1) whose center is farthest from their chord, at least `margin` rows from either; -1 when
 * none is farther than *most, which is twice the distance in pixels and becomes that row's. */
static int32_t farthest_row(const iris_follow_shape *s, int32_t y0, int32_t y1, int32_t margin, int32_t *most)
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
static int32_t split(const iris_follow_shape *s, int32_t *breaks)
{
    int32_t count = 1;
    int32_t tolerance = s->width / 2 > 4 ? s->width / 2 : 4;
    breaks[0] = s->bottom;
    breaks[1] = s->upright_top;
    while (breaks[1] < s->bottom && s->twice_x[breaks[1]] == NONE) {
        breaks[1]++;
    }
    while (count < IRIS_FOLLOW_SEGMENTS_MAX - 1) {
        int32_t at = -1, piece = 0, most = tolerance;
        for (int32_t k = 0; k < count; k++) {
            int32_t row = farthest_row(s, breaks[k], breaks[k + 1], least_rows(s), &most);
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

static void add_segment(iris_follow_result *result, int32_t x0, int32_t y0, int32_t x1, int32_t y1)
{
    if (result->segment_count < IRIS_FOLLOW_SEGMENTS_MAX) {
        iris_segment segment = {x0, y0, x1, y1};
        result->segments[result->segment_count++] = segment;
    }
}

/* The bar as a segment, from the side where the line comes in to the side where it goes. `from` is twice the
 * column where the line comes in. Returns the direction: the bar's angle, towards the longer arm. */
static iris_angle describe_bar(iris_follow_result *result, const iris_follow_shape *s, const iris_line *bar,
                               int32_t from)
{
    int32_t left = s->follow->size.w, right = -1;
    for (int32_t y = s->bar_top; y <= s->bar_bottom; y++) {
        if (iris_span_width(s->spans[y]) > 0) {
            left = s->spans[y].left < left ? s->spans[y].left : left;
            right = s->spans[y].right > right ? s->spans[y].right : right;
        }
    }
    int32_t to_right = 2 * right - from >= from - 2 * left;
    int32_t x0 = to_right ? left : right, x1 = to_right ? right : left;
    add_segment(result, x0, line_y(bar, x0), x1, line_y(bar, x1));
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
    if (rows == 0 || columns > 4 * -rows || columns < 4 * rows) { /* level: no row but its own */
        return (best->x0 + best->x1) * 32768;
    }
    return within_reach(best->x0 * 65536 + (int64_t)(columns * 65536 / rows) * (y - best->y0));
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
static iris_q16 offset_at(const iris_follow_result *result, const iris_follow_shape *s, int32_t y)
{
    int32_t x_q16 = iris_span_width(s->spans[y]) > 0 ? (s->spans[y].left + s->spans[y].right) * 32768
                                                     : segments_x_q16(result, y);
    return offset_of(s->follow, x_q16);
}

static void describe_upright(iris_follow_result *result, iris_follow_shape *s)
{
    int32_t breaks[IRIS_FOLLOW_SEGMENTS_MAX + 1];
    int32_t count = split(s, breaks);
    for (int32_t k = 0; k < count; k++) {
        iris_line line;
        int32_t y0 = breaks[k], y1 = breaks[k + 1];
        if (s->follow->fit(&line, s->follow, s->twice_x, y1, y0) != IRIS_OK ||
            (k == 0 && count > 1 && line.points < least_rows(s))) {
            continue;
        }
        if (is_level(&line)) {
            add_segment(result, s->twice_x[y0] / 2, y0, s->twice_x[y1] / 2, y1);
        } else {
            add_segment(result, line_x(&line, y0), y0, line_x(&line, y1), y1);
        }
        if (result->segment_count == 1) {
            result->angle = line.angle;
            s->bottom_x_q16 = is_level(&line) ? NO_COLUMN : line_x_q16(&line, s->follow->size.h - 1);
        }
    }
}

/* Center of a piece of line, pixels. */
static void center_of_chain(const iris_follow_shape *s, const iris_follow_chain *chain, int32_t *x,
                            int32_t *y)
{
    int32_t rows = 0, sum_x = 0, sum_y = 0;
    for (int32_t row = chain->top_y; row <= chain->bottom_y; row++) {
        if (iris_span_width(s->spans[row]) > 0) {
            rows++;
            sum_x += s->spans[row].left + s->spans[row].right;
            sum_y += row;
        }
    }
    *x = rows > 0 ? sum_x / (2 * rows) : 0;
    *y = rows > 0 ? sum_y / rows : 0;
}

/* The nearest piece first: the list's far end is its start, so the segments are made in that order and then turned around. */
static void describe_dashes(iris_follow_result *result, iris_follow_shape *s, int32_t farthest)
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

static int32_t confidence(const iris_follow_shape *s)
{
    int32_t rows = 0, pixels_high = s->bottom - s->top + 1;
    for (int32_t y = s->top; y <= s->bottom; y++) {
        rows += iris_span_width(s->spans[y]) > 0;
    }
    int32_t enough = s->follow->size.h / 2;
    int32_t reach = pixels_high > enough ? 1000 : pixels_high * 1000 / enough;
    return reach * rows / pixels_high;
}

static void describe_solid(iris_follow_result *result, iris_follow_shape *s)
{
    if (s->is_lane) {
        s->width = iris_follow_mean_width(s, 8);
    } else if (lies_across(s)) {
        s->bar_top = s->top;
        s->bar_bottom = s->bottom;
        s->upright_top = s->bottom + 1;
    } else {
        iris_follow_find_bend(s);
    }
    find_centers(s);
    describe_upright(result, s);
    iris_line bar;
    if (s->bar_bottom >= s->bar_top && iris_follow_fit_bar(&bar, s) == IRIS_OK) {
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
    iris_follow_shape s = {
        .follow = follow, .spans = follow->runs, .twice_x = (int16_t *)(void *)follow->owner};
    s.is_lane = other >= 0;
    s.bar_bottom = -1;
    s.bottom_x_q16 = NO_COLUMN;
    iris_follow_gather(&s, line, other);
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
    result->width_px = iris_follow_mean_width(&s, follow->size.h);
    int32_t bottom_q16 =
        s.bottom_x_q16 != NO_COLUMN ? s.bottom_x_q16 : segments_x_q16(result, follow->size.h - 1);
    result->offset_q16 = offset_of(follow, bottom_q16);
    result->lookahead_offset_q16 = offset_at(result, &s, ahead);
    result->confidence_permil = confidence(&s);
    result->rows = s.spans;
    return 1;
}
