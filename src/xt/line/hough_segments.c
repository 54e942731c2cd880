#include "iris/xt/hough_segments.h"

#include "../../foundation/views.h"
#include "../mask/mask_runs.h"
#include "hough_parts.h"
#include "iris/xt/regress.h"

void iris_hough_segment_defaults(iris_hough_segment_config *config)
{
    if (config) {
        *config =
            (iris_hough_segment_config){.max_gap = 8, .min_length = 20, .reach_q16 = 65536, .spread = 3641};
    }
}

/* A line, and which points support it: those within reach, from `first` to `last` along it. */
typedef struct {
    iris_hough_segment_config config;
    iris_size size;
    iris_hough_line line;
    iris_q30 cosine, sine;
    hough_walk path;
    int32_t first, last;
    uint32_t *hits; /* in scratch: a bit for each b where a point is */
    /* one of them has the points: */
    const iris_image *mask;
    iris_edge_list *edges;
} band;

static iris_status check_config(const iris_hough_segment_config *c)
{
    return hough_outside(c->max_gap, 0, IRIS_SIDE_MAX) || hough_outside(c->min_length, 1, IRIS_SIDE_MAX) ||
                   hough_outside(c->reach_q16, 0, IRIS_HOUGH_REACH_MAX) ||
                   hough_outside(c->spread, 0, IRIS_HOUGH_SPREAD_MAX) || hough_outside(c->full_circle, 0, 1)
               ? IRIS_ERR_ARG
               : IRIS_OK;
}

/* Goes on along this line, all of it. */
static void follow(band *in, const iris_hough_line *line)
{
    in->line = *line;
    in->cosine = iris_cos_q30(line->angle);
    in->sine = iris_sin_q30(line->angle);
    in->path = hough_walk_along(line, in->size);
    in->first = 0;
    in->last = in->path.b_side - 1;
}

/* Where along the line the place is; -1 when it is not in the band. */
static int32_t position(const band *in, int32_t x, int32_t y)
{
    int64_t off = iris_round_shift((int64_t)(2 * x - (in->size.w - 1)) * in->cosine +
                                       (int64_t)(2 * y - (in->size.h - 1)) * in->sine,
                                   15) -
                  in->line.rho_q16;
    int32_t b = in->path.is_upright ? y : x;
    return off < -in->config.reach_q16 || off > in->config.reach_q16 || b < in->first || b > in->last ? -1
                                                                                                      : b;
}

/* The same for an edge point, whose direction must fit. */
static int32_t edge_position(const band *in, const iris_edge_point *point)
{
    int32_t turn = HOUGH_HALF_TURN << in->config.full_circle;
    int32_t aside = (point->angle - in->line.angle) & (turn - 1);
    aside = aside > turn / 2 ? turn - aside : aside;
    return aside > in->config.spread ? -1 : position(in, point->x, point->y);
}

/* What is done with the points that support a line. */
typedef enum { MARK, MEASURE, TAKE } deed;
typedef struct {
    deed what;
    iris_moments moments;
} task;

static void meet(task *of, const band *in, int32_t x, int32_t y, int32_t b)
{
    if (of->what == MARK) {
        in->hits[b / 32] |= (uint32_t)1 << b % 32;
    } else {
        iris_moments_add(&of->moments, x, y);
    }
}

/* The pixel, if it is selected and supports the line. */
static void visit_pixel(task *of, const band *in, int32_t x, int32_t y)
{
    uint32_t *word = (uint32_t *)iris_image_row(in->mask, y) + x / 32, bit = (uint32_t)1 << x % 32;
    int32_t b = (*word & bit) != 0 ? position(in, x, y) : -1;
    if (b >= 0) {
        meet(of, in, x, y, b);
        *word &= of->what == TAKE ? ~bit : ~(uint32_t)0;
    }
}

static void visit_mask(task *of, const band *in)
{
    const hough_walk *path = &in->path;
    /* a step to the side is at least 0.7 pixels of distance */
    int32_t reach = in->config.reach_q16 * 3 / 2 / 65536 + 1;
    for (int32_t b = in->first; b <= in->last; b++) {
        int64_t middle = hough_walk_at(path, b);
        int32_t from = middle - reach < 0              ? 0
                       : middle - reach > path->a_side ? path->a_side
                                                       : (int32_t)(middle - reach);
        int32_t to = middle + reach >= path->a_side ? path->a_side - 1
                     : middle + reach < 0           ? -1
                                                    : (int32_t)(middle + reach);
        for (int32_t a = from; a <= to; a++) {
            visit_pixel(of, in, path->is_upright ? a : b, path->is_upright ? b : a);
        }
    }
}

static void visit_edges(task *of, const band *in)
{
    iris_edge_list *edges = in->edges;
    int32_t kept = 0;
    for (int32_t i = 0; i < edges->count; i++) {
        const iris_edge_point point = edges->points[i];
        int32_t b = edge_position(in, &point);
        if (b >= 0) {
            meet(of, in, point.x, point.y, b);
        }
        if (of->what == TAKE && b < 0) {
            edges->points[kept++] = point;
        }
    }
    edges->count = of->what == TAKE ? kept : edges->count;
}

static iris_moments visit(const band *in, deed what)
{
    task of = {.what = what};
    if (in->mask) {
        visit_mask(&of, in);
    } else {
        visit_edges(&of, in);
    }
    return of.moments;
}

/* Above 0: so many steps along b are longer than so many pixels of the line; below 0: shorter. */
static int64_t longer(const band *in, int32_t steps, int32_t pixels)
{
    return (int64_t)steps * IRIS_Q30_ONE - (int64_t)pixels * in->path.straightness;
}

/* Narrows the band to its longest segment. 0: none is long enough. */
static int find_longest(band *in)
{
    int32_t side = in->path.b_side, first = 0, end = 0, best_first = 0, best_end = 0;
    for (int32_t word = 0; word <= (side - 1) / 32; word++) {
        in->hits[word] = 0;
    }
    (void)visit(in, MARK);
    iris_mask_span run = {0, 0};
    while (iris_mask_run(&run, in->hits, run.end, side)) {
        if (end == 0 || longer(in, run.first - end, in->config.max_gap) > 0) {
            first = run.first;
        }
        end = run.end;
        if (end - first > best_end - best_first) {
            best_first = first;
            best_end = end;
        }
    }
    in->first = best_first;
    in->last = best_end - 1;
    return best_end > 0 && longer(in, best_end - best_first, in->config.min_length) >= 0;
}

/* The line fitted to points; the line itself when they have no direction. */
static iris_hough_line fitted(const band *in, const iris_moments *moments)
{
    iris_hough_line line = in->line;
    iris_line found;
    if (iris_regress_moments(&found, moments) != IRIS_OK) {
        return line;
    }
    int32_t turn = found.angle - line.angle; /* to be that of less than a quarter */
    int32_t angle = line.angle + (int32_t)(((uint32_t)turn + HOUGH_HALF_TURN / 2) & (HOUGH_HALF_TURN - 1)) -
                    HOUGH_HALF_TURN / 2;
    if (!in->config.full_circle) {
        angle = ((angle + HOUGH_HALF_TURN / 2) & (HOUGH_HALF_TURN - 1)) - HOUGH_HALF_TURN / 2;
    }
    line.angle = iris_angle_wrap(angle);
    line.rho_q16 = iris_q30_mul(found.x_q16 - (in->size.w - 1) * 32768, iris_cos_q30(line.angle)) +
                   iris_q30_mul(found.y_q16 - (in->size.h - 1) * 32768, iris_sin_q30(line.angle));
    return line;
}

/* The line fitted to its segment, which grows thereby: over again, as long as more points support it. */
static void fit(band *in)
{
    enum { ROUNDS = 4 };
    iris_moments moments = visit(in, MEASURE);
    for (int round = 0; round < ROUNDS; round++) {
        band before = *in;
        iris_hough_line better = fitted(in, &moments);
        follow(in, &better);
        iris_moments now = {0, 0, 0, 0, 0, 0};
        if (find_longest(in)) {
            now = visit(in, MEASURE);
        }
        if (now.n < moments.n) {
            *in = before;
        }
        if (now.n <= moments.n) {
            break;
        }
        moments = now;
    }
}

static iris_status take(iris_hough_segment *segment, band *in, const iris_hough_line *line)
{
    follow(in, line);
    if (!find_longest(in)) {
        return IRIS_ERR_END;
    }
    fit(in);
    segment->line = in->line;
    segment->ends = hough_walk_ends(&in->path, in->first, in->last);
    segment->points = (int32_t)visit(in, TAKE).n;
    return IRIS_OK;
}

/* Memory, and then the segment. */
static iris_status take_with(iris_hough_segment *segment, band *in, const iris_hough_line *line,
                             iris_scratch *scratch)
{
    size_t start = iris_scratch_mark(scratch);
    in->hits =
        (uint32_t *)iris_scratch_take(scratch, IRIS_HOUGH_SEGMENT_SCRATCH_BYTES(in->size.w, in->size.h));
    iris_status status = in->hits ? take(segment, in, line) : IRIS_ERR_SCRATCH;
    iris_scratch_release(scratch, start);
    return status;
}

iris_status iris_hough_segment_of_mask(iris_hough_segment *segment, const iris_image *mask,
                                       const iris_hough_line *line, const iris_hough_segment_config *config,
                                       iris_scratch *scratch)
{
    band in = {.mask = mask};
    iris_hough_segment_defaults(&in.config);
    if (config) {
        in.config = *config;
    }
    if (!segment || !mask || !line || !scratch || check_config(&in.config) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_views_check_one(mask, IRIS_MASK1);
    if (status != IRIS_OK) {
        return status;
    }
    in.size = (iris_size){mask->w, mask->h};
    return take_with(segment, &in, line, scratch);
}

iris_status iris_hough_segment_of_edges(iris_hough_segment *segment, iris_edge_list *edges,
                                        const iris_hough_line *line, const iris_hough_segment_config *config,
                                        iris_scratch *scratch)
{
    band in = {.edges = edges};
    iris_hough_segment_defaults(&in.config);
    if (config) {
        in.config = *config;
    }
    if (!segment || !edges || !line || !scratch || check_config(&in.config) != IRIS_OK || edges->count < 0 ||
        (!edges->points && edges->count > 0)) {
        return IRIS_ERR_ARG;
    }
    in.size = edges->size;
    if (hough_size_is_bad(in.size) || !hough_edges_fit(edges->points, edges->count, in.size)) {
        return IRIS_ERR_RANGE;
    }
    return take_with(segment, &in, line, scratch);
}
