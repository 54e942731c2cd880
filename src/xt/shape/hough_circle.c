#include "iris/xt/hough_circle.h"

#include <string.h>

#include "hough_circle_parts.h"

#define VOTES_MAX 65535

static int outside(int32_t value, int32_t low, int32_t high)
{
    return value < low || value > high;
}

void iris_circle_defaults(iris_circle_config *config)
{
    if (config) {
        *config = (iris_circle_config){.radius_min = 10,
                                       .radius_max = 50,
                                       .polarity = IRIS_CIRCLE_EITHER,
                                       .cell = 2,
                                       .min_share_permil = 300,
                                       .min_votes = 0,
                                       .min_distance = 10,
                                       .max_hypotheses = 256};
    }
}

static int config_is_bad(const iris_circle_config *c)
{
    return outside(c->radius_min, IRIS_CIRCLE_RADIUS_MIN, IRIS_CIRCLE_RADIUS_MAX) ||
           outside(c->radius_max, c->radius_min, IRIS_CIRCLE_RADIUS_MAX) ||
           (unsigned)c->polarity > IRIS_CIRCLE_DARK || outside(c->cell, 1, IRIS_CIRCLE_CELL_MAX) ||
           outside(c->min_share_permil, 1, 1000) || outside(c->min_votes, 0, VOTES_MAX) ||
           outside(c->min_distance, 0, IRIS_SIDE_MAX) ||
           outside(c->max_hypotheses, 1, IRIS_CIRCLE_HYPOTHESES_MAX);
}

/* The edges, the config, and nothing in working memory yet. */
static iris_status open_search(circle_search *s, const iris_edge_list *edges,
                               const iris_circle_config *config)
{
    if (!edges || edges->count < 0 || (!edges->points && edges->count > 0)) {
        return IRIS_ERR_ARG;
    }
    *s = (circle_search){.points = edges->points, .count = edges->count, .size = edges->size};
    iris_circle_defaults(&s->config);
    s->config = config ? *config : s->config;
    if (config_is_bad(&s->config)) {
        return IRIS_ERR_ARG;
    }
    if (outside(s->size.w, 1, IRIS_SIDE_MAX) || outside(s->size.h, 1, IRIS_SIDE_MAX)) {
        return IRIS_ERR_RANGE;
    }
    int32_t row = 0;
    for (int32_t i = 0; i < s->count; i++) {
        const iris_edge_point *p = &s->points[i];
        if (outside(p->x, 0, s->size.w - 1) || outside(p->y, row, s->size.h - 1)) {
            return IRIS_ERR_RANGE;
        }
        row = p->y;
    }
    return IRIS_OK;
}

static iris_status take_sines(circle_search *s, iris_scratch *scratch)
{
    s->sines = (int16_t *)iris_scratch_take(scratch, 1024u);
    if (!s->sines) {
        return IRIS_ERR_SCRATCH;
    }
    for (int32_t i = 0; i < DIRECTIONS; i++) {
        /* the middle of the angles that it stands for */
        iris_angle angle = iris_angle_wrap(i * (65536 / DIRECTIONS) + 32768 / DIRECTIONS);
        s->sines[2 * i] = (int16_t)iris_round_shift(iris_cos_q30(angle), 16);
        s->sines[2 * i + 1] = (int16_t)iris_round_shift(iris_sin_q30(angle), 16);
    }
    return IRIS_OK;
}

static iris_status take_memory(circle_search *s, iris_scratch *scratch)
{
    const size_t cell = (size_t)s->config.cell, h = (size_t)s->size.h, count = (size_t)s->count;
    const size_t cells = IRIS_CIRCLE_CELLS(s->size.w, cell) * IRIS_CIRCLE_CELLS(h, cell);
    const size_t words = (count + 31u) / 32u;
    iris_status status = take_sines(s, scratch);
    void *slice = iris_scratch_take(scratch, IRIS_CIRCLE_LARGER(2u * cells, sizeof *s->near * count));
    s->votes = (uint16_t *)slice;
    s->near = (iris_edge_point *)slice;
    s->row_first = (int32_t *)iris_scratch_take(scratch, 4u * (h + 1u));
    s->taken = (uint32_t *)iris_scratch_take(scratch, 4u * words);
    s->peaks = (hypothesis *)iris_scratch_take(scratch, sizeof *s->peaks * (size_t)s->config.max_hypotheses);
    if (status != IRIS_OK || !s->votes || !s->row_first || !s->taken || !s->peaks) {
        return IRIS_ERR_SCRATCH;
    }
    memset(s->taken, 0, 4u * words);
    int32_t i = 0;
    for (int32_t y = 0; y <= s->size.h; y++) {
        while (i < s->count && s->points[i].y < y) {
            i++;
        }
        s->row_first[y] = i;
    }
    return IRIS_OK;
}

/* --- voting --- */

static void vote_at(const iris_image *to, int32_t x_q14, int32_t y_q14)
{
    const int32_t column = x_q14 >> 14, line = y_q14 >> 14;
    if ((uint32_t)column < (uint32_t)to->w && (uint32_t)line < (uint32_t)to->h) {
        uint16_t *at = (uint16_t *)((uint8_t *)to->data + line * to->stride) + column;
        *at = (uint16_t)(*at + (*at < VOTES_MAX));
    }
}

/* The places that all points vote for, in cells with 14 fraction bits: below 2^29 + 2^24. */
static void vote(const circle_search *s, const iris_image *to, int32_t radius, int32_t cell)
{
    const int32_t per_pixel = 16384 / cell, half = per_pixel / 2, reach_q6 = radius * 64 / cell;
    const int toward = s->config.polarity != IRIS_CIRCLE_DARK,
              away = s->config.polarity != IRIS_CIRCLE_BRIGHT;
    for (int32_t i = 0; i < s->count; i++) {
        const iris_edge_point *p = &s->points[i];
        const int16_t *direction = s->sines + 2 * ((uint16_t)p->angle / (65536 / DIRECTIONS));
        const int32_t x = p->x * per_pixel + half, y = p->y * per_pixel + half;
        const int32_t dx = (direction[0] * reach_q6) >> 6, dy = (direction[1] * reach_q6) >> 6;
        if (toward) {
            vote_at(to, x + dx, y + dy);
        }
        if (away) {
            vote_at(to, x - dx, y - dy);
        }
    }
}

iris_status iris_circle_vote(const iris_image *votes, const iris_edge_list *edges, int32_t radius,
                             const iris_circle_config *config, iris_scratch *scratch)
{
    circle_search s;
    if (!votes || !scratch || outside(radius, IRIS_CIRCLE_RADIUS_MIN, IRIS_CIRCLE_RADIUS_MAX)) {
        return IRIS_ERR_ARG;
    }
    iris_status status = open_search(&s, edges, config);
    if (status == IRIS_ERR_ARG) {
        return status;
    }
    iris_status view = iris_image_check(votes);
    if (view != IRIS_OK || votes->format != IRIS_GRAY_U16) {
        return view != IRIS_OK ? view : IRIS_ERR_FORMAT;
    }
    if (status != IRIS_OK || (size_t)votes->w != IRIS_CIRCLE_CELLS(s.size.w, s.config.cell) ||
        (size_t)votes->h != IRIS_CIRCLE_CELLS(s.size.h, s.config.cell)) {
        return IRIS_ERR_RANGE;
    }
    size_t start = iris_scratch_mark(scratch);
    status = take_sines(&s, scratch);
    if (status == IRIS_OK) {
        vote(&s, votes, radius, s.config.cell);
    }
    iris_scratch_release(scratch, start);
    return status;
}

/* --- peaks --- */

/* Votes times share of the circumference: votes^2 / r. */
static int is_better(const hypothesis *a, const hypothesis *b)
{
    return (int64_t)a->votes * a->votes * b->r_q8 > (int64_t)b->votes * b->votes * a->r_q8;
}

/* Is b about the circle of a? */
static int is_same(const hypothesis *a, const hypothesis *b, int32_t reach_q8)
{
    int32_t dx = a->x_q8 - b->x_q8, dy = a->y_q8 - b->y_q8, dr = a->r_q8 - b->r_q8;
    return !outside(dx, -reach_q8, reach_q8) && !outside(dy, -reach_q8, reach_q8) &&
           !outside(dr, -reach_q8, reach_q8);
}

/* Keeps the best, best first, one for each circle. */
static void keep(circle_search *s, const hypothesis *peak, int32_t reach_q8)
{
    int32_t n = s->peak_count, most = s->config.max_hypotheses, kept = 0;
    if (n == most && !is_better(peak, &s->peaks[n - 1])) {
        return;
    }
    while (kept < n && !is_same(peak, &s->peaks[kept], reach_q8)) {
        kept++;
    }
    if (kept < n && !is_better(peak, &s->peaks[kept])) {
        return;
    }
    for (int32_t i = kept + 1; i < n; i++) { /* those behind are no better */
        if (!is_same(peak, &s->peaks[i], reach_q8)) {
            s->peaks[kept++] = s->peaks[i];
        }
    }
    int32_t at = kept < most ? kept++ : most - 1;
    for (; at > 0 && is_better(peak, &s->peaks[at - 1]); at--) {
        s->peaks[at] = s->peaks[at - 1];
    }
    s->peaks[at] = *peak;
    s->peak_count = kept;
}

/* The votes around a cell that no neighbor surpasses, and their center of gravity; 0 when one does. */
static int32_t gather(hypothesis *peak, const iris_image *slice, int32_t x, int32_t y, int32_t cell)
{
    const int32_t here = ((const uint16_t *)iris_image_row(slice, y))[x];
    int32_t sum = here, across = 0, down = 0;
    for (int32_t dy = y > 0 ? -1 : 0; dy <= (y < slice->h - 1 ? 1 : 0); dy++) {
        const uint16_t *row = (const uint16_t *)iris_image_row(slice, y + dy) + x;
        for (int32_t dx = x > 0 ? -1 : 0; dx <= (x < slice->w - 1 ? 1 : 0); dx++) {
            int32_t votes = row[dx];
            if (votes > here || (votes == here && (dy < 0 || (dy == 0 && dx < 0)))) {
                return 0;
            }
            sum += dx != 0 || dy != 0 ? votes : 0;
            across += dx * votes;
            down += dy * votes;
        }
    }
    sum = sum > 0 ? sum : 1;
    peak->x_q8 = (2 * x + 1) * cell * 128 - 128 + across * 256 / sum * cell;
    peak->y_q8 = (2 * y + 1) * cell * 128 - 128 + down * 256 / sum * cell;
    peak->votes = sum;
    return sum;
}

/* Has one of four cells at least `least` votes, 1 to 2^15? */
static int has_votes(const uint16_t cells[4], uint64_t least)
{
    const uint64_t ones = 0x0001000100010001u, high = 0x8000u * ones;
    uint64_t four;
    memcpy(&four, cells, sizeof four);
    return ((((four | high) - least * ones) | four) & high) != 0;
}

/* The peaks of a slice that have at least two thirds of the votes that a circle needs. */
static void find_peaks(circle_search *s, const iris_image *slice, int32_t radius, int32_t cell)
{
    hypothesis peak = {.r_q8 = radius * 256};
    int32_t least = radius * s->config.min_share_permil / 239 + 1; /* 1000 / (2 pi * 2 / 3) */
    least = least < s->config.min_votes * 2 / 3 ? s->config.min_votes * 2 / 3 : least;
    const int32_t least_here = (least + 8) / 9;
    for (int32_t y = 0; y < slice->h; y++) {
        const uint16_t *row = iris_image_row(slice, y);
        for (int32_t x = 0; x < slice->w; x++) {
            while (x + 4 <= slice->w && !has_votes(row + x, (uint64_t)least_here)) {
                x += 4;
            }
            for (int32_t end = x + 4 < slice->w ? x + 4 : slice->w; x < end; x++) {
                if (row[x] >= least_here && (x == 0 || row[x - 1] < row[x]) &&
                    gather(&peak, slice, x, y, cell) >= least) {
                    keep(s, &peak, 512 * cell);
                }
            }
            x--;
        }
    }
}

static void search_slices(circle_search *s)
{
    for (int32_t radius = s->config.radius_min, cell; radius <= s->config.radius_max; radius += cell) {
        cell = cell_of(&s->config, radius);
        const int32_t w = (int32_t)IRIS_CIRCLE_CELLS(s->size.w, cell);
        const int32_t h = (int32_t)IRIS_CIRCLE_CELLS(s->size.h, cell);
        const iris_image slice = {s->votes, (ptrdiff_t)w * 2, w, h, IRIS_GRAY_U16};
        memset(s->votes, 0, 2u * (size_t)w * (size_t)h);
        vote(s, &slice, radius, cell);
        find_peaks(s, &slice, radius, cell);
    }
}

/* --- circles --- */

/* Is the peak one of a circle that has been found already? */
static int is_known(const circle_search *s, int32_t found, const hypothesis *peak)
{
    const int32_t reach_q8 = cell_of(&s->config, peak->r_q8 / 256) * 512;
    for (int32_t i = 0; i < found; i++) {
        if (is_same(&s->peaks[i], peak, reach_q8)) {
            return 1;
        }
    }
    return 0;
}

/* Tests all peaks and keeps those that are circles, best first. */
static void test_peaks(circle_search *s)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < s->peak_count; i++) {
        hypothesis circle = s->peaks[i];
        if (!is_known(s, kept, &circle) && iris_circle_test(&circle, s)) {
            int32_t at = kept++;
            for (; at > 0 && is_better(&circle, &s->peaks[at - 1]); at--) {
                s->peaks[at] = s->peaks[at - 1];
            }
            s->peaks[at] = circle;
        }
    }
    s->peak_count = kept;
}

/* Is the center of a circle that has been taken too near? */
static int is_near(const circle_search *s, int32_t taken, const hypothesis *circle)
{
    const int64_t least = (int64_t)s->config.min_distance * 256;
    for (int32_t i = 0; i < taken; i++) {
        int64_t dx = s->peaks[i].x_q8 - circle->x_q8, dy = s->peaks[i].y_q8 - circle->y_q8;
        if (dx * dx + dy * dy < least * least) {
            return 1;
        }
    }
    return 0;
}

/* Takes the best, as long as there are points that support no other. Returns how many. */
static int32_t take_circles(circle_search *s)
{
    int32_t taken = 0;
    for (int32_t i = 0; i < s->peak_count; i++) {
        hypothesis circle = s->peaks[i];
        if (!is_near(s, taken, &circle) && iris_circle_take(&circle, s)) {
            s->peaks[taken++] = circle;
        }
    }
    return taken;
}

/* Puts a circle behind those that are as good, if there is room. */
static void insert(iris_circle *circles, int32_t capacity, int32_t count, const hypothesis *circle)
{
    const iris_circle found = {circle->x_q8 * 256, circle->y_q8 * 256, circle->r_q8 * 256, circle->votes};
    int32_t at = count < capacity ? count : capacity;
    for (; at > 0; at--) {
        const iris_circle *other = &circles[at - 1];
        const hypothesis before = {.r_q8 = other->r_q16 / 256, .votes = other->votes};
        if (!is_better(circle, &before)) {
            break;
        }
        if (at < capacity) {
            circles[at] = *other;
        }
    }
    if (at < capacity) {
        circles[at] = found;
    }
}

iris_status iris_hough_circles(iris_circle *circles, int32_t capacity, int32_t *count,
                               const iris_edge_list *edges, const iris_circle_config *config,
                               iris_scratch *scratch)
{
    circle_search s;
    if (!count || capacity < 0 || (!circles && capacity > 0) || !scratch) {
        return IRIS_ERR_ARG;
    }
    iris_status status = open_search(&s, edges, config);
    if (status != IRIS_OK) {
        return status;
    }
    size_t start = iris_scratch_mark(scratch);
    status = take_memory(&s, scratch);
    if (status == IRIS_OK) {
        search_slices(&s);
        test_peaks(&s);
        *count = take_circles(&s);
        for (int32_t i = 0; i < *count; i++) {
            insert(circles, capacity, i, &s.peaks[i]);
        }
        status = *count > capacity ? IRIS_ERR_FULL : IRIS_OK;
    }
    iris_scratch_release(scratch, start);
    return status;
}
