/* From one span per row to the result: straight segments, angle, offsets, and bends. */
#include "follow_parts.h"

#define NONE      IRIS_REGRESS_NONE
#define NO_COLUMN INT32_MIN

static int is_cut(const iris_follow_shape *s, iris_span span)
{
    return !s->is_lane && (span.left == 0) != (span.right == s->follow->size.w - 1);
}

/* Centers of the upright rows. Where a side of the image cuts the line, its hidden half is put back: behind a whole
 * row, lines look as wide as there or narrower. Cut rows nearer than any whole one are left out. Returns 0 when there
 * are only such; they are taken as they are if `cut_too`. */
static int find_centers(iris_follow_shape *s, int cut_too)
{
    int32_t whole = 0;
    for (int32_t y = s->bottom; y >= s->upright_top; y--) {
        iris_span span = s->spans[y];
        int32_t width = iris_span_width(span), center = span.left + span.right;
        if (width > 0 && (cut_too || !is_cut(s, span))) {
            whole = width;
        } else if (width >= whole || width == 0) {
            center = NONE;
        } else {
            center += span.left == 0 ? width - whole : whole - width;
        }
        s->twice_x[y] = (int16_t)center;
    }
    return whole;
}

/* Column of a line in row y, within 80 degrees of upright; the line's center is in the image. */
static int32_t line_x_q12(const iris_line *line, int32_t y)
{
    int32_t tangent_q12 = line->dx / (line->dy >> 12);
    int32_t rows_q2 = y * 4 - ((line->y_q16 + 8192) >> 14);
    return ((line->x_q16 >> 2) + rows_q2 * tangent_q12) >> 2;
}

static int32_t line_x(const iris_line *line, int32_t y)
{
    return (line_x_q12(line, y) + 2048) >> 12;
}

static int is_level(const iris_line *line)
{
    enum { STEEP = 14563 }; /* 80 degrees */
    return line->angle > STEEP || line->angle < -STEEP;
}

/* A piece with fewer rows has no direction worth telling. */
static int32_t least_rows(const iris_follow_shape *s)
{
    int32_t rows = s->follow->size.h >> 4;
    return rows > 4 ? rows : 4;
}

/* The row between y0 and y1 (y0 > y1) whose center is farthest from their chord, if that is far and not too near to
 * either; else -1. */
static int32_t farthest_row(const iris_follow_shape *s, int32_t y0, int32_t y1)
{
    int32_t margin = least_rows(s), at = -1;
    int32_t most = s->width >> 1 > 4 ? s->width >> 1 : 4; /* twice the distance */
    if (y0 - y1 < 2 * margin) {
        return -1;
    }
    int32_t step_q12 = (s->twice_x[y1] - s->twice_x[y0]) * 4096 / (y0 - y1);
    for (int32_t y = y0 - margin; y >= y1 + margin; y--) {
        int32_t off = s->twice_x[y] - s->twice_x[y0] - (step_q12 * (y0 - y) >> 12);
        off = off < 0 ? -off : off;
        if (off > most && s->twice_x[y] != NONE) {
            at = y;
            most = off;
        }
    }
    return at;
}

static void add_segment(iris_follow_shape *s, int32_t x0, int32_t y0, int32_t x1, int32_t y1)
{
    s->result->segments[s->result->segment_count++] = (iris_segment){x0, y0, x1, y1};
}

/* The straight piece from row y0 up to row y1. */
static void describe_piece(iris_follow_shape *s, int32_t y0, int32_t y1)
{
    iris_line line;
    if (s->follow->fit(&line, s->follow, s->twice_x, y1, y0) != IRIS_OK ||
        (y0 == s->bottom && y1 != s->upright_top && line.points < least_rows(s))) {
        return;
    }
    if (is_level(&line)) {
        add_segment(s, s->twice_x[y0] / 2, y0, s->twice_x[y1] / 2, y1);
    } else {
        add_segment(s, line_x(&line, y0), y0, line_x(&line, y1), y1);
    }
    if (s->result->segment_count == 1) {
        s->result->angle = line.angle;
        s->bottom_x_q12 = is_level(&line) ? NO_COLUMN : line_x_q12(&line, s->follow->size.h - 1);
    }
}

/* Splits rows bottom to upright_top into straight pieces, where they bend most, and leaves room for the bar. */
static void describe_upright(iris_follow_shape *s)
{
    enum { PIECES_MAX = IRIS_FOLLOW_SEGMENTS_MAX - 1 };
    int32_t ends[PIECES_MAX]; /* of the nearest `ahead` pieces, the nearest last */
    int32_t ahead = 1, pieces = 1, near = s->bottom;
    ends[0] = s->upright_top;
    while (ahead > 0) {
        int32_t end = ends[ahead - 1];
        int32_t at = pieces < PIECES_MAX ? farthest_row(s, near, end) : -1;
        if (at >= 0) {
            ends[ahead++] = at;
            pieces++;
        } else {
            describe_piece(s, near, end);
            near = end;
            ahead--;
        }
    }
}

/* Twice the middle of the bar's rows that cover column x; of all its rows when none does. */
static int32_t twice_middle(const iris_follow_shape *s, int32_t x)
{
    int32_t first = s->bar_top, last = s->bar_bottom;
    while (first < s->bar_bottom && (s->spans[first].left > x || s->spans[first].right < x)) {
        first++;
    }
    while (last > s->bar_top && (s->spans[last].left > x || s->spans[last].right < x)) {
        last--;
    }
    return first + last;
}

/* The bar as a segment, from the side where the line comes in to the side of its longer arm. It runs through the
 * centers of its left and its right half, each the mean over eight columns. */
static void describe_bar(iris_follow_shape *s)
{
    enum { COLUMNS = 16 };
    iris_follow_result *result = s->result;
    iris_span hull = iris_follow_hull(s, s->bar_top, s->bar_bottom);
    int upright = s->upright_top <= s->bottom;
    int32_t sums[2] = {0, 0}, columns = hull.right - hull.left;
    for (int32_t k = 0; k < COLUMNS; k++) {
        sums[k / (COLUMNS / 2)] += twice_middle(s, hull.left + (columns * (2 * k + 1) >> 5));
    }
    int32_t middle = (sums[0] + sums[1]) >> 5, rise = sums[0] - sums[1];
    int32_t from = upright ? s->twice_x[s->upright_top] : s->follow->size.w - 1;
    int32_t x0 = hull.left, x1 = hull.right;
    if (hull.left + hull.right < from) {
        x0 = hull.right;
        x1 = hull.left;
        rise = -rise;
    }
    add_segment(s, x0, middle + rise / COLUMNS, x1, middle - rise / COLUMNS);
    int32_t across = (x1 - x0) * (COLUMNS / 2);
    result->has_next = upright;
    if (upright) { /* where it comes back a little: straight to the side */
        result->next_angle = iris_atan2_angle(across, rise < 0 ? 0 : rise);
    } else {
        result->angle = rise < 0 ? iris_atan2_angle(-across, -rise) : iris_atan2_angle(across, rise);
    }
}

/* Row y's center on the found segments: within a segment or the gap between two, or on the nearest one
 * extended. */
static int32_t segments_x_q12(const iris_follow_result *result, int32_t y)
{
    const iris_segment *best = result->segments;
    int32_t least = INT32_MAX;
    for (int32_t k = 0; k < result->segment_count; k++) {
        const iris_segment *segment = &result->segments[k];
        int32_t away = y > segment->y0 ? y - segment->y0 : y < segment->y1 ? segment->y1 - y : 0;
        if (away < least) {
            best = segment;
            least = away;
        }
    }
    int32_t rows = best->y0 - best->y1, columns = best->x1 - best->x0;
    if (rows <= 0 || columns > 4 * rows || columns < -4 * rows) { /* level: no row but its own */
        return (best->x0 + best->x1) * 2048;
    }
    return best->x0 * 4096 + columns * 4096 / rows * (best->y0 - y);
}

static iris_q16 offset_of(const iris_follow_shape *s, int32_t x_q12)
{
    int32_t w = s->follow->size.w;
    int32_t limit = w * 4096; /* twice the half width to each side */
    int32_t away = x_q12 - (w - 1) * 2048;
    away = away > limit ? limit : away < -limit ? -limit : away;
    return away * 32 / w;
}

iris_follow_shape iris_follow_shape_of(iris_follow_result *result, iris_follow *follow)
{
    return (iris_follow_shape){.result = result,
                               .follow = follow,
                               .spans = follow->runs,
                               .twice_x = (int16_t *)(void *)follow->owner,
                               .bar_bottom = -1,
                               .bottom_x_q12 = NO_COLUMN};
}

static void describe_solid(iris_follow_shape *s)
{
    if (!find_centers(s, 0)) {
        (void)find_centers(s, 1);
    }
    while (s->bottom > s->upright_top && s->twice_x[s->bottom] == NONE) {
        s->bottom--;
    }
    while (s->upright_top < s->bottom && s->twice_x[s->upright_top] == NONE) {
        s->upright_top++;
    }
    describe_upright(s);
    if (s->bar_bottom >= s->bar_top) {
        describe_bar(s);
    }
    if (s->result->segment_count == 0) { /* a line without a direction, such as a single row */
        int32_t x = (s->spans[s->bottom].left + s->spans[s->bottom].right) / 2;
        add_segment(s, x, s->bottom, x, s->top);
    }
}

/* The numbers that do not depend on how the segments were found. */
static void finish(iris_follow_shape *s, int32_t height)
{
    iris_follow_result *result = s->result;
    int32_t h = s->follow->size.h, ahead = (h - 1) * s->follow->config.lookahead_permil / 1000;
    int32_t ahead_q12 = iris_follow_width(s, ahead) > 0
                            ? (s->spans[ahead].left + s->spans[ahead].right) * 2048
                            : segments_x_q12(result, ahead);
    result->offset_q16 =
        offset_of(s, s->bottom_x_q12 != NO_COLUMN ? s->bottom_x_q12 : segments_x_q12(result, h - 1));
    result->lookahead_offset_q16 = offset_of(s, ahead_q12);
    result->width_px = iris_follow_mean_width(s, INT32_MAX);
    result->confidence_permil = s->rows * 1000 / (height > h >> 1 ? height : h >> 1);
    result->rows = s->spans;
}

void iris_follow_describe_shape(iris_follow_shape *s)
{
    int32_t height = s->bottom - s->top + 1;
    if (s->result->segment_count == 0) {
        describe_solid(s);
    }
    finish(s, height);
}

/* A line of dashes goes through their centers. The list of chains starts at the far end. */
static void describe_dashes(iris_follow_shape *s, const iris_follow_chain *far, int32_t count)
{
    iris_follow_result *result = s->result;
    result->segment_count = count < IRIS_FOLLOW_SEGMENTS_MAX ? count : IRIS_FOLLOW_SEGMENTS_MAX;
    while (count-- > 0) {
        const iris_follow_chain *near = &s->follow->chains[far->next];
        if (count < IRIS_FOLLOW_SEGMENTS_MAX) {
            result->segments[count] = (iris_segment){
                (near->top.left + near->top.right + near->bottom.left + near->bottom.right) >> 2,
                (near->top_y + near->bottom_y) / 2,
                (far->top.left + far->top.right + far->bottom.left + far->bottom.right) >> 2,
                (far->top_y + far->bottom_y) / 2};
        }
        far = near;
    }
    const iris_segment *near = &result->segments[0];
    result->angle = iris_atan2_angle(near->x1 - near->x0, near->y0 - near->y1);
}

int iris_follow_describe_line(iris_follow_result *result, iris_follow *follow, int32_t line)
{
    iris_follow_shape s = iris_follow_shape_of(result, follow);
    int32_t chain = line, pieces = 1;
    while (follow->chains[chain].next >= 0) {
        chain = follow->chains[chain].next;
        pieces++;
    }
    chain = line;
    for (int32_t y = 0; y < follow->size.h; y++) {
        iris_follow_put_span(&s, y, iris_follow_run(follow, y, &chain));
    }
    int32_t height = s.bottom - s.top + 1, gaps = height - s.rows;
    s.upright_top = s.top;
    s.width = iris_follow_mean_width(&s, INT32_MAX);
    if (pieces > 1 && gaps * 8 >= s.rows && s.rows * 2 < s.width * pieces * 3) { /* hardly longer than wide */
        describe_dashes(&s, &follow->chains[line], pieces - 1);
    } else if (s.width > height * 3 >> 1) { /* lies across as a whole */
        if (iris_follow_width(&s, follow->size.h - 1) == follow->size.w) {
            return 0; /* without an end towards the robot: its shadow */
        }
        s.bar_top = s.top;
        s.bar_bottom = s.bottom;
        s.upright_top = s.bottom + 1;
    } else {
        iris_follow_find_bend(&s);
    }
    iris_follow_describe_shape(&s);
    return 1;
}
