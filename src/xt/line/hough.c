#include "iris/xt/hough.h"

#include <string.h>

#include "../../foundation/views.h"
#include "../mask/mask_runs.h"
#include "hough_parts.h"

void iris_hough_defaults(iris_hough_config *config)
{
    if (config) {
        *config = (iris_hough_config){.angle_min = -HOUGH_HALF_TURN / 2,
                                      .angle_max = HOUGH_HALF_TURN / 2,
                                      .theta_bins = 180,
                                      .rho_min = -IRIS_SIDE_MAX,
                                      .rho_max = IRIS_SIDE_MAX,
                                      .rho_step = 1,
                                      .min_votes = 50,
                                      .theta_separation = 8,
                                      .rho_separation = 12,
                                      .full_circle = 0,
                                      .spread = 1820};
    }
}

static int angles_are_bad(const iris_hough_config *c)
{
    int32_t most = c->full_circle == 1 ? HOUGH_HALF_TURN : HOUGH_HALF_TURN / 2;
    return hough_outside(c->full_circle, 0, 1) || hough_outside(c->angle_min, -most, most) ||
           hough_outside(c->angle_max, -most, most) ||
           hough_outside(c->theta_bins, 1, IRIS_HOUGH_THETA_BINS_MAX) ||
           hough_outside(c->spread, 0, IRIS_HOUGH_SPREAD_MAX);
}

static int config_is_bad(const iris_hough_config *c)
{
    return angles_are_bad(c) || c->rho_min >= c->rho_max ||
           hough_outside(c->rho_step, 1, IRIS_HOUGH_RHO_STEP_MAX) || (c->rho_step & (c->rho_step - 1)) != 0 ||
           hough_outside(c->min_votes, 1, HOUGH_VOTES_MAX) ||
           hough_outside(c->theta_separation, 0, IRIS_HOUGH_SEPARATION_MAX) ||
           hough_outside(c->rho_separation, 0, IRIS_HOUGH_SEPARATION_MAX);
}

/* Cuts the bounds to the image and derives the numbers of bins from them. */
static iris_status lay_out(iris_hough *hough)
{
    iris_hough_config *c = &hough->config;
    int32_t reach = (int32_t)IRIS_HOUGH_REACH(hough->size.w, hough->size.h);
    c->rho_min = c->rho_min < -reach ? -reach : c->rho_min;
    c->rho_max = c->rho_max > reach ? reach : c->rho_max;
    if (c->rho_min >= c->rho_max) {
        return IRIS_ERR_RANGE;
    }
    hough->rho_bins = (c->rho_max - c->rho_min + c->rho_step - 1) / c->rho_step;
    hough->shift = 15;
    while (c->rho_step >> (hough->shift - 15) > 1) {
        hough->shift++;
    }
    int32_t turn = hough_turn(hough), between = (c->angle_max - c->angle_min) & (turn - 1);
    hough->span = between == 0 ? turn : between;
    return hough->rho_bins > IRIS_SIDE_MAX ? IRIS_ERR_RANGE : IRIS_OK;
}

static int32_t magnitude(int32_t a)
{
    return a < 0 ? -a : a;
}

static void clear(iris_hough *hough)
{
    hough->room = HOUGH_VOTES_MAX;
    for (int32_t theta = 0; theta < hough->config.theta_bins; theta++) {
        iris_angle angle = iris_angle_wrap(hough_bin_angle(hough, theta));
        uint16_t *row = hough->votes + (size_t)theta * (size_t)hough->rho_bins;
        int32_t cosine = (int32_t)iris_round_shift(iris_cos_q30(angle), 16);
        int32_t sine = (int32_t)iris_round_shift(iris_sin_q30(angle), 16);
        hough->sines[2 * theta] = (int16_t)cosine;
        hough->sines[2 * theta + 1] = (int16_t)sine;
        /* of the farthest corners */
        int32_t reach = (hough->size.w - 1) * magnitude(cosine) + (hough->size.h - 1) * magnitude(sine);
        int32_t origin = hough->config.rho_min * 32768;
        if (reach > -origin || (reach - origin) >> hough->shift >= hough->rho_bins) {
            hough->room = 0;
        }
        memset(row, 0, (size_t)hough->rho_bins * sizeof *row);
    }
}

iris_status iris_hough_begin(iris_hough *hough, iris_size size, const iris_hough_config *config,
                             iris_scratch *scratch)
{
    if (!hough || !scratch) {
        return IRIS_ERR_ARG;
    }
    iris_hough made = {.size = size};
    iris_hough_defaults(&made.config);
    if (config) {
        made.config = *config;
    }
    if (config_is_bad(&made.config)) {
        return IRIS_ERR_ARG;
    }
    if (hough_size_is_bad(size) || lay_out(&made) != IRIS_OK) {
        return IRIS_ERR_RANGE;
    }
    size_t start = iris_scratch_mark(scratch), angles = (size_t)made.config.theta_bins;
    made.sines = (int16_t *)iris_scratch_take(scratch, angles * 4);
    made.votes = (uint16_t *)iris_scratch_take(scratch, angles * (size_t)made.rho_bins * 2);
    if (!made.sines || !made.votes) {
        iris_scratch_release(scratch, start);
        return IRIS_ERR_SCRATCH;
    }
    clear(&made);
    *hough = made;
    return IRIS_OK;
}

/* Points row by row. Coordinates are doubled and counted from the middle of the image: |x| and |y| at most 32766, so rho
 * with 15 fraction bits is below 2^30, and below 2^31 when counted from rho_min. */
enum { BATCH_POINTS = 256, BATCH_ROWS = 48 };
typedef struct {
    int32_t points, rows;
    int16_t x[BATCH_POINTS];
    int16_t y[BATCH_ROWS], end[BATCH_ROWS]; /* of each row: where the next one's points begin */
} batch;

/* From the bin `theta` on. */
static void vote_bounded(const iris_hough *hough, const batch *of, int32_t theta)
{
    uint32_t count = (uint32_t)hough->rho_bins;
    for (; theta < hough->config.theta_bins; theta++) {
        uint16_t *bins = hough->votes + (size_t)theta * count;
        int32_t cosine = hough->sines[2 * theta], sine = hough->sines[2 * theta + 1], i = 0;
        for (int32_t row = 0; row < of->rows; row++) {
            int32_t first = of->y[row] * sine - hough->config.rho_min * 32768, end = of->end[row];
            for (; i < end; i++) {
                /* below rho_min this is a large number */
                uint32_t rho = (uint32_t)(first + of->x[i] * cosine) >> hough->shift;
                if (rho < count && bins[rho] < HOUGH_VOTES_MAX) {
                    bins[rho]++;
                }
            }
        }
    }
}

/* Two theta bins for which points vote together: where a row of points begins, and its step per doubled x. */
typedef struct {
    uint16_t *votes[2];
    int32_t first[2], step[2];
} twins;

/* Two numbers in one, so that one multiplication and one addition serve both. Sums of them that are not negative come
 * out as they went in. */
static inline int64_t pair(const int32_t of[2])
{
    return (int64_t)of[1] * ((int64_t)1 << 32) + of[0];
}

/* n points of a row vote in both: at once where registers are that wide. */
static inline void vote_twice(const twins *in, const int16_t *x, int32_t n, int shift)
{
    uint16_t *const a = in->votes[0], *const b = in->votes[1];
    if (sizeof(size_t) > sizeof(int32_t)) {
        const int64_t first = pair(in->first), step = pair(in->step);
        for (int32_t i = 0; i < n; i++) {
            uint64_t rhos = (uint64_t)(first + x[i] * step);
            a[(uint32_t)rhos >> shift]++;
            b[rhos >> 32 >> shift]++;
        }
    } else {
        const int32_t a_first = in->first[0], a_step = in->step[0];
        const int32_t b_first = in->first[1], b_step = in->step[1];
        for (int32_t i = 0; i < n; i++) {
            a[(uint32_t)(a_first + x[i] * a_step) >> shift]++;
            b[(uint32_t)(b_first + x[i] * b_step) >> shift]++;
        }
    }
}

/* The same as vote_bounded where no point is out of bounds and no bin can be full, two theta bins at a time: less than
 * half the time. Returns the bin that is left. */
static int32_t vote_freely(const iris_hough *hough, const batch *of)
{
    const int32_t bins = hough->rho_bins, origin = hough->config.rho_min * 32768;
    int32_t theta = 0;
    for (; theta + 1 < hough->config.theta_bins; theta += 2) {
        uint16_t *votes = hough->votes + (size_t)theta * (size_t)bins;
        const int16_t *sines = hough->sines + 2 * theta;
        twins both = {{votes, votes + bins}, {0, 0}, {sines[0], sines[2]}};
        for (int32_t row = 0, i = 0; row < of->rows; row++) {
            int32_t y = of->y[row], n = of->end[row] - i;
            both.first[0] = y * sines[1] - origin;
            both.first[1] = y * sines[3] - origin;
            if (hough->shift == 15) { /* the compiler knows it then */
                vote_twice(&both, of->x + i, n, 15);
            } else {
                vote_twice(&both, of->x + i, n, hough->shift);
            }
            i += n;
        }
    }
    return theta;
}

static void vote(iris_hough *hough, batch *of)
{
    int32_t theta = 0;
    if (of->points > hough->room) {
        hough->room = 0;
    } else {
        hough->room -= of->points;
        theta = vote_freely(hough, of);
    }
    vote_bounded(hough, of, theta);
    of->points = of->rows = 0;
}

iris_status iris_hough_vote(iris_hough *hough, int32_t twice_x, int32_t twice_y)
{
    if (!hough || !hough->votes) {
        return IRIS_ERR_ARG;
    }
    int32_t right = hough->size.w - 1, bottom = hough->size.h - 1;
    if (hough_outside(twice_x, 0, 2 * right) || hough_outside(twice_y, 0, 2 * bottom)) {
        return IRIS_ERR_RANGE;
    }
    batch one;
    one.points = one.rows = 1;
    one.x[0] = (int16_t)(twice_x - right);
    one.y[0] = (int16_t)(twice_y - bottom);
    one.end[0] = 1;
    vote(hough, &one);
    return IRIS_OK;
}

/* Row y of a mask into the batch, which votes whenever it is full. */
static void gather(iris_hough *hough, batch *to, const uint32_t *mask_row, int32_t y)
{
    const int32_t w = hough->size.w, right = w - 1;
    iris_mask_span run = {0, 0};
    int is_open = 0; /* is the last row of the batch this one? */
    while (iris_mask_run(&run, mask_row, run.end, w)) {
        for (int32_t x = run.first; x < run.end; x++) {
            if (to->points == BATCH_POINTS || (!is_open && to->rows == BATCH_ROWS)) {
                vote(hough, to);
                is_open = 0;
            }
            if (!is_open) {
                to->y[to->rows++] = (int16_t)(2 * y - (hough->size.h - 1));
                is_open = 1;
            }
            to->x[to->points++] = (int16_t)(2 * x - right);
            to->end[to->rows - 1] = (int16_t)to->points;
        }
    }
}

iris_status iris_hough_vote_row(iris_hough *hough, const uint32_t *mask_row, int32_t y)
{
    if (!hough || !hough->votes || !mask_row) {
        return IRIS_ERR_ARG;
    }
    if (hough_outside(y, 0, hough->size.h - 1)) {
        return IRIS_ERR_RANGE;
    }
    batch points;
    points.points = points.rows = 0;
    gather(hough, &points, mask_row, y);
    if (points.points > 0) {
        vote(hough, &points);
    }
    return IRIS_OK;
}

iris_status iris_hough_vote_mask(iris_hough *hough, const iris_image *mask)
{
    if (!hough || !hough->votes || !mask) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_views_check_one(mask, IRIS_MASK1);
    if (status != IRIS_OK) {
        return status;
    }
    if (mask->w != hough->size.w || mask->h != hough->size.h) {
        return IRIS_ERR_RANGE;
    }
    batch points;
    points.points = points.rows = 0;
    for (int32_t y = 0; y < mask->h; y++) {
        gather(hough, &points, (const uint32_t *)iris_image_row(mask, y), y);
    }
    if (points.points > 0) {
        vote(hough, &points);
    }
    return IRIS_OK;
}

/* a / b rounded down, b above 0. */
static int32_t floored(int32_t a, int32_t b)
{
    return a >= 0 ? a / b : -((b - 1 - a) / b);
}

/* A point votes in the theta bins from the one nearest to `low` up to the one nearest to `high`, counted from angle_min,
 * as far as they exist and are not below `next`. Returns the next one. */
static int32_t vote_between(const iris_hough *hough, const iris_edge_point *point, int32_t low, int32_t high,
                            int32_t next)
{
    const int32_t bins = hough->config.theta_bins, span = hough->span;
    if (low >= span || 2 * high * bins + span < 0) {
        return next;
    }
    int32_t first = floored(2 * low * bins + span, 2 * span);
    int32_t last = floored(2 * high * bins + span, 2 * span);
    first = first < next ? next : first;
    last = last > bins - 1 ? bins - 1 : last;
    const int32_t x = 2 * point->x - (hough->size.w - 1), y = 2 * point->y - (hough->size.h - 1);
    const uint32_t rho_bins = (uint32_t)hough->rho_bins;
    for (int32_t theta = first; theta <= last; theta++) {
        const int16_t *sines = hough->sines + 2 * theta;
        int32_t from = x * sines[0] + y * sines[1] - hough->config.rho_min * 32768;
        uint32_t rho = (uint32_t)from >> hough->shift;
        uint16_t *votes = hough->votes + (size_t)theta * rho_bins;
        if (rho < rho_bins && votes[rho] < HOUGH_VOTES_MAX) {
            votes[rho]++;
        }
    }
    return last + 1;
}

iris_status iris_hough_vote_edges(iris_hough *hough, const iris_edge_point *points, int32_t count)
{
    if (!hough || !hough->votes || count < 0 || (!points && count > 0)) {
        return IRIS_ERR_ARG;
    }
    if (!hough_edges_fit(points, count, hough->size)) {
        return IRIS_ERR_RANGE;
    }
    hough->room = hough->room > count ? hough->room - count : 0;
    const int32_t turn = hough_turn(hough), spread = hough->config.spread;
    for (int32_t i = 0; i < count; i++) {
        int32_t angle = (points[i].angle - hough->config.angle_min) & (turn - 1), next = 0;
        for (int32_t middle = angle - turn; middle <= angle + turn; middle += turn) {
            next = vote_between(hough, &points[i], middle - spread, middle + spread, next);
        }
    }
    return IRIS_OK;
}

iris_status iris_hough_lines(iris_hough_line *lines, int32_t capacity, int32_t *count, const iris_image *mask,
                             const iris_hough_config *config, iris_scratch *scratch)
{
    if (!count || capacity < 0 || (!lines && capacity > 0) || !mask) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_views_check_one(mask, IRIS_MASK1);
    if (status != IRIS_OK) {
        return status;
    }
    iris_hough hough;
    size_t start = iris_scratch_mark(scratch);
    status = iris_hough_begin(&hough, (iris_size){mask->w, mask->h}, config, scratch);
    if (status != IRIS_OK) {
        return status;
    }
    (void)iris_hough_vote_mask(&hough, mask);
    status = iris_hough_peaks(lines, capacity, count, &hough);
    iris_scratch_release(scratch, start);
    return status;
}

iris_status iris_hough_accumulator(iris_image *view, const iris_hough *hough)
{
    if (!view || !hough || !hough->votes) {
        return IRIS_ERR_ARG;
    }
    *view = (iris_image){hough->votes, (ptrdiff_t)hough->rho_bins * 2, hough->rho_bins,
                         hough->config.theta_bins, IRIS_GRAY_U16};
    return IRIS_OK;
}
