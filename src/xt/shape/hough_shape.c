/* The generalized Hough transform: votes of one slice, its best places, and what becomes of them. */
#include "hough_shape_parts.h"

#define TURN      65536
#define VOTES_MAX 65535
#define VOTERS    2048 /* of more edge points every other one votes */
#define PEAKS     4    /* of a slice that are looked at */
#define SAMPLES   64   /* outline points by which they are */

void iris_hough_shape_defaults(iris_hough_shape_config *config)
{
    if (config) {
        *config = (iris_hough_shape_config){
            -32768, 32767, 910, IRIS_Q16_ONE, IRIS_Q16_ONE, 6554, 4, IRIS_HOUGH_SHAPE_EITHER, 400, 300, 8192};
    }
}

static int outside(int32_t value, int32_t low, int32_t high)
{
    return value < low || value > high;
}

static int config_is_bad(const iris_hough_shape_config *c)
{
    return outside(c->angle_step, 91, TURN) ||
           outside(c->scale_min_q16, IRIS_HOUGH_SHAPE_SCALE_MIN, IRIS_HOUGH_SHAPE_SCALE_MAX) ||
           outside(c->scale_max_q16, c->scale_min_q16, IRIS_HOUGH_SHAPE_SCALE_MAX) || c->scale_step_q16 < 1 ||
           (c->scale_max_q16 - c->scale_min_q16) / c->scale_step_q16 >= IRIS_HOUGH_SHAPE_SCALES_MAX ||
           outside(c->cell, 1, IRIS_HOUGH_SHAPE_CELL_MAX) || (c->cell & (c->cell - 1)) != 0 ||
           (unsigned)c->polarity > IRIS_HOUGH_SHAPE_EITHER || outside(c->min_score, 1, 1000) ||
           outside(c->separation, 0, 1000) || outside(c->points, 1, IRIS_HOUGH_SHAPE_POINTS_MAX);
}

/* What follows from table, size, and config. */
static void lay_out(iris_hough_shape *shape)
{
    uint32_t reach2 = 0;
    for (int32_t i = 0; i < shape->entries; i++) {
        const uint8_t *entry = table_entry(shape->table, i);
        int32_t x = table_s16(entry, 0), y = table_s16(entry, 2);
        uint32_t square = (uint32_t)(x * x) + (uint32_t)(y * y);
        reach2 = square > reach2 ? square : reach2;
    }
    shape->reach_q4 = (int32_t)iris_sqrt_u32(reach2) + 1;
    shape->cells_w = (int32_t)IRIS_HOUGH_SHAPE_CELLS(shape->size.w, shape->config.cell);
    shape->cells_h = (int32_t)IRIS_HOUGH_SHAPE_CELLS(shape->size.h, shape->config.cell);
    shape->indexes_w = (int32_t)IRIS_HOUGH_SHAPE_CELLS(shape->size.w, 1 << INDEX_SHIFT);
    shape->indexes_h = (int32_t)IRIS_HOUGH_SHAPE_CELLS(shape->size.h, 1 << INDEX_SHIFT);
    shape->shift = 0;
    while (shape->config.cell >> shape->shift > 1) {
        shape->shift++;
    }
}

static int take_memory(iris_hough_shape *shape, iris_scratch *scratch)
{
    size_t votes = (size_t)shape->cells_w * (size_t)shape->cells_h;
    size_t indexes = (size_t)shape->indexes_w * (size_t)shape->indexes_h;
    shape->votes = iris_scratch_take(scratch, votes * sizeof *shape->votes);
    shape->turned = iris_scratch_take(scratch, (size_t)shape->entries * sizeof *shape->turned);
    shape->edges = iris_scratch_take(scratch, (size_t)shape->config.points * sizeof *shape->edges);
    shape->first = iris_scratch_take(scratch, (indexes + 1) * sizeof *shape->first);
    shape->places = iris_scratch_take(scratch, IRIS_HOUGH_SHAPE_PLACES * sizeof *shape->places);
    return shape->votes && shape->turned && shape->edges && shape->first && shape->places;
}

iris_status iris_hough_shape_begin(iris_hough_shape *shape, const uint8_t *table, size_t bytes,
                                   iris_size size, const iris_hough_shape_config *config,
                                   iris_scratch *scratch)
{
    iris_hough_shape made = {.size = size, .table = table};
    iris_hough_shape_defaults(&made.config);
    if (config) {
        made.config = *config;
    }
    if (!shape || !table || !scratch || config_is_bad(&made.config)) {
        return IRIS_ERR_ARG;
    }
    if (outside(size.w, 1, IRIS_SIDE_MAX) || outside(size.h, 1, IRIS_SIDE_MAX)) {
        return IRIS_ERR_RANGE;
    }
    iris_status status = iris_hough_shape_check(table, bytes);
    if (status != IRIS_OK) {
        return status;
    }
    made.entries = (int32_t)table_u16(table, 6);
    lay_out(&made);
    size_t start = iris_scratch_mark(scratch);
    if (!take_memory(&made, scratch)) {
        iris_scratch_release(scratch, start);
        return IRIS_ERR_SCRATCH;
    }
    for (int32_t i = 0; i < made.entries; i++) {
        iris_angle angle = iris_angle_wrap((int32_t)table_u16(table_entry(table, i), 4));
        made.turned[i].normal_x = (int16_t)iris_round_shift(iris_cos_q30(angle), 16);
        made.turned[i].normal_y = (int16_t)iris_round_shift(iris_sin_q30(angle), 16);
    }
    *shape = made;
    return IRIS_OK;
}

/* An edge point votes by the entries `from` up to below `to`. */
static void vote(const iris_hough_shape *shape, const iris_hough_shape_edge *edge, int32_t from, int32_t to)
{
    const iris_hough_shape_entry *turned = shape->turned;
    uint32_t cells_w = (uint32_t)shape->cells_w, cells_h = (uint32_t)shape->cells_h;
    int32_t x = edge->x * 16 + 8, y = edge->y * 16 + 8, shift = shape->shift + 4;
    for (int32_t i = from; i < to; i++) {
        /* left of the picture this is a large number */
        uint32_t cell_x = (uint32_t)((x - turned[i].x_q4) >> shift);
        uint32_t cell_y = (uint32_t)((y - turned[i].y_q4) >> shift);
        if (cell_x < cells_w && cell_y < cells_h) {
            uint16_t *votes = &shape->votes[cell_y * cells_w + cell_x];
            *votes = (uint16_t)(*votes + (*votes < VOTES_MAX));
        }
    }
}

/* Votes by the entries whose direction, turned, is that of the edge point: those of its bin and of both neighbors. */
static void vote_alike(const iris_hough_shape *shape, const iris_hough_shape_edge *edge, int32_t direction)
{
    int32_t last_bin = IRIS_HOUGH_SHAPE_BINS - 1;
    int32_t bin = (direction & (TURN - 1)) / (TURN / IRIS_HOUGH_SHAPE_BINS);
    int32_t from = bin == 0 ? 0 : bin - 1, to = bin == last_bin ? last_bin : bin + 1;
    vote(shape, edge, table_start(shape->table, from), table_start(shape->table, to + 1));
    if (bin == 0) {
        vote(shape, edge, table_start(shape->table, last_bin), shape->entries);
    }
    if (bin == last_bin) {
        vote(shape, edge, 0, table_start(shape->table, 1));
    }
}

/* All votes for one angle and scale. */
static void vote_slice(const iris_hough_shape *shape, iris_angle angle, iris_q16 scale_q16, int reversed,
                       int32_t count)
{
    iris_hough_shape_turn turn = turn_of(angle, scale_q16);
    int32_t cells = shape->cells_w * shape->cells_h;
    for (int32_t i = 0; i < cells; i++) {
        shape->votes[i] = 0;
    }
    for (int32_t i = 0; i < shape->entries; i++) {
        turn_entry(&shape->turned[i].x_q4, &shape->turned[i].y_q4, shape->table, i, turn);
    }
    int32_t step = count > VOTERS ? 2 : 1; /* one edge point votes much as the next does */
    for (int32_t i = 0; i < count; i += step) {
        const iris_hough_shape_edge *edge = &shape->edges[i];
        vote_alike(shape, edge, edge->angle - angle + (reversed ? TURN / 2 : 0));
    }
}

typedef struct {
    int32_t votes, x, y; /* of the cells around it; the cell */
} peak;

/* The votes of the 3x3 cells around one, those of the picture; 0 when one of them has more votes than the middle. */
static int32_t votes_around(const iris_hough_shape *shape, int32_t x, int32_t y)
{
    int32_t w = shape->cells_w, sum = 0;
    uint16_t most = shape->votes[(size_t)y * (size_t)w + (size_t)x];
    for (int32_t row = y > 0 ? y - 1 : 0; row <= y + 1 && row < shape->cells_h; row++) {
        const uint16_t *votes = shape->votes + (size_t)row * (size_t)w;
        for (int32_t column = x > 0 ? x - 1 : 0; column <= x + 1 && column < w; column++) {
            if (votes[column] > most) {
                return 0;
            }
            sum += votes[column];
        }
    }
    return sum;
}

static int is_beside(const peak *a, const peak *b)
{
    return !outside(a->x - b->x, -2, 2) && !outside(a->y - b->y, -2, 2);
}

/* Puts a peak among the best, unless a better one is beside it; worse ones beside it go. */
static void insert_peak(peak peaks[PEAKS], int32_t *count, const peak *new)
{
    int32_t at = 0;
    for (; at < *count && peaks[at].votes >= new->votes; at++) {
        if (is_beside(&peaks[at], new)) {
            return;
        }
    }
    int32_t kept = at;
    for (int32_t i = at; i < *count; i++) {
        if (!is_beside(&peaks[i], new)) {
            peaks[kept++] = peaks[i];
        }
    }
    *count = kept < PEAKS ? kept + 1 : PEAKS;
    for (int32_t i = *count - 1; i > at; i--) {
        peaks[i] = peaks[i - 1];
    }
    peaks[at] = *new;
}

/* The best cells of a slice, best first, none beside another. Returns how many. */
static int32_t find_peaks(peak peaks[PEAKS], const iris_hough_shape *shape)
{
    int32_t count = 0, least = 1;
    const uint16_t *votes = shape->votes;
    for (int32_t y = 0; y < shape->cells_h; y++) {
        for (int32_t x = 0; x < shape->cells_w; x++) {
            if (*votes++ * 9 < least) { /* none of the 3x3 has more */
                continue;
            }
            peak new = {votes_around(shape, x, y), x, y};
            if (new.votes >= least) {
                insert_peak(peaks, &count, &new);
                least = count == PEAKS ? peaks[PEAKS - 1].votes + 1 : 1;
            }
        }
    }
    return count;
}

/* Are two hypotheses probably one? */
static int is_same(const iris_hough_shape *shape, const iris_hough_shape_place *a,
                   const iris_hough_shape_place *b)
{
    int32_t near = shape->config.cell * 65536 + 4 * 65536;
    int32_t turn = iris_angle_wrap(a->angle - b->angle), step = shape->config.angle_step;
    int32_t growth = a->scale_q16 > b->scale_q16 ? a->scale_q16 - b->scale_q16 : b->scale_q16 - a->scale_q16;
    return a->is_reversed == b->is_reversed && !outside(a->x_q16 - b->x_q16, -near, near) &&
           !outside(a->y_q16 - b->y_q16, -near, near) && !outside(turn, -step, step) &&
           growth <= shape->config.scale_step_q16;
}

/* Keeps the best hypotheses by their fit, best first. */
static void keep(const iris_hough_shape *shape, int32_t *count, const iris_hough_shape_place *new)
{
    iris_hough_shape_place *places = shape->places;
    for (int32_t i = 0; i < *count; i++) {
        if (is_same(shape, &places[i], new)) {
            if (places[i].fit >= new->fit) {
                return;
            }
            for (int32_t k = i + 1; k < *count; k++) {
                places[k - 1] = places[k];
            }
            (*count)--;
            break;
        }
    }
    int32_t at = *count;
    if (at == IRIS_HOUGH_SHAPE_PLACES) {
        if (places[at - 1].fit >= new->fit) {
            return;
        }
        at--;
    } else {
        (*count)++;
    }
    for (; at > 0 && places[at - 1].fit < new->fit; at--) {
        places[at] = places[at - 1];
    }
    places[at] = *new;
}

/* Of a row or column of cells, pixels. */
static iris_q16 cell_middle(const iris_hough_shape *shape, int32_t cell)
{
    return iris_sat_s32(((int64_t)2 * cell + 1) * shape->config.cell * 32768);
}

static void search_slice(const iris_hough_shape *shape, int32_t *count, iris_angle angle, iris_q16 scale_q16,
                         int reversed, int32_t points)
{
    peak peaks[PEAKS];
    vote_slice(shape, angle, scale_q16, reversed, points);
    int32_t found = find_peaks(peaks, shape);
    int32_t step = (shape->entries + SAMPLES - 1) / SAMPLES;
    for (int32_t i = 0; i < found; i++) {
        iris_hough_shape_place place = {.x_q16 = cell_middle(shape, peaks[i].x),
                                        .y_q16 = cell_middle(shape, peaks[i].y),
                                        .scale_q16 = scale_q16,
                                        .angle = angle,
                                        .is_reversed = (int8_t)reversed};
        iris_hough_shape_fit(&place, shape, 8 * 16, step);
        iris_hough_shape_fit(&place, shape, 6 * 16, step);
        iris_hough_shape_rate(&place, shape, 4 * 16, step);
        keep(shape, count, &place);
    }
}

static int points_are_bad(const iris_hough_shape *shape, const iris_edge_point *points, int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        if (outside(points[i].x, 0, shape->size.w - 1) || outside(points[i].y, 0, shape->size.h - 1)) {
            return 1;
        }
    }
    return 0;
}

/* All angles and scales. Returns how many places there are, not fitted to the end. */
static int32_t search(const iris_hough_shape *shape, int32_t points)
{
    const iris_hough_shape_config *c = &shape->config;
    int32_t span = (c->angle_max - c->angle_min) & (TURN - 1), count = 0;
    int32_t angles = span / c->angle_step + 1;
    int32_t scales = (c->scale_max_q16 - c->scale_min_q16) / c->scale_step_q16 + 1;
    if (span == TURN - 1) {
        angles = (TURN + c->angle_step / 2) / c->angle_step;
    }
    for (int32_t k = 0; k < scales; k++) {
        for (int32_t i = 0; i < angles; i++) {
            int32_t turned = span == TURN - 1 ? i * TURN / angles : i * c->angle_step;
            iris_angle angle = iris_angle_wrap(c->angle_min + turned);
            iris_q16 scale_q16 = c->scale_min_q16 + k * c->scale_step_q16;
            if (c->polarity != IRIS_HOUGH_SHAPE_REVERSED) {
                search_slice(shape, &count, angle, scale_q16, 0, points);
            }
            if (c->polarity != IRIS_HOUGH_SHAPE_SAME) {
                search_slice(shape, &count, angle, scale_q16, 1, points);
            }
        }
    }
    return count;
}

static void refine(const iris_hough_shape *shape, int32_t count)
{
    static const int8_t reach[] = {6, 5, 4, 3, 3, 3};
    for (int32_t i = 0; i < count; i++) {
        for (int32_t k = 0; k < (int32_t)sizeof reach; k++) {
            iris_hough_shape_fit(&shape->places[i], shape, reach[k] * 16, 1);
        }
        iris_hough_shape_score(&shape->places[i], shape);
    }
}

/* The best place that is left; null when it is not good enough. */
static iris_hough_shape_place *best(const iris_hough_shape *shape, int32_t count)
{
    iris_hough_shape_place *best = NULL;
    for (int32_t i = 0; i < count; i++) {
        iris_hough_shape_place *place = &shape->places[i];
        if (!place->is_gone && place->score >= shape->config.min_score &&
            (!best || place->score > best->score)) {
            best = place;
        }
    }
    return best;
}

/* What is not better than the place that was taken goes: it is too near, or has too little of its own. */
static void suppress(const iris_hough_shape *shape, int32_t count, const iris_hough_shape_place *taken)
{
    int64_t reach_q16 = (int64_t)shape->reach_q4 * taken->scale_q16 >> 4;
    int64_t apart = reach_q16 * shape->config.separation / 1000;
    for (int32_t i = 0; i < count; i++) {
        iris_hough_shape_place *place = &shape->places[i];
        int64_t dx = ((int64_t)place->x_q16 - taken->x_q16) >> 8,
                dy = ((int64_t)place->y_q16 - taken->y_q16) >> 8;
        if (place->is_gone || dx * dx + dy * dy <= (apart >> 8) * (apart >> 8)) {
            place->is_gone = 1;
            continue;
        }
        iris_hough_shape_score(place, shape);
    }
}

iris_status iris_hough_shape_find(iris_hough_shape_found *found, int32_t capacity, int32_t *count,
                                  iris_hough_shape *shape, const iris_edge_point *points, int32_t point_count)
{
    if (!count || !shape || !shape->votes || capacity < 0 || (!found && capacity > 0) ||
        (!points && point_count != 0)) {
        return IRIS_ERR_ARG;
    }
    if (outside(point_count, 0, shape->config.points) || points_are_bad(shape, points, point_count)) {
        return IRIS_ERR_RANGE;
    }
    iris_hough_shape_index(shape, points, point_count);
    int32_t places = search(shape, point_count), all = 0;
    refine(shape, places);
    for (iris_hough_shape_place *place = best(shape, places); place; place = best(shape, places)) {
        if (all < capacity) {
            found[all] = (iris_hough_shape_found){place->x_q16, place->y_q16, place->angle, place->scale_q16,
                                                  place->score};
        }
        all++;
        iris_hough_shape_use(place, shape);
        suppress(shape, places, place);
    }
    *count = all;
    return all > capacity ? IRIS_ERR_FULL : IRIS_OK;
}

iris_status iris_hough_shape_outline(iris_q16 *x_q16, iris_q16 *y_q16, iris_angle *direction,
                                     const iris_hough_shape *shape, const iris_hough_shape_found *found,
                                     int32_t index)
{
    if (!x_q16 || !y_q16 || !direction || !shape || !shape->table || !found) {
        return IRIS_ERR_ARG;
    }
    if (outside(index, 0, shape->entries - 1) ||
        outside(found->scale_q16, 0, 2 * IRIS_HOUGH_SHAPE_SCALE_MAX)) {
        return IRIS_ERR_RANGE;
    }
    int32_t x, y;
    turn_entry(&x, &y, shape->table, index, turn_of(found->angle, found->scale_q16));
    *x_q16 = iris_sat_s32((int64_t)found->x_q16 + (int64_t)x * 4096);
    *y_q16 = iris_sat_s32((int64_t)found->y_q16 + (int64_t)y * 4096);
    *direction = iris_angle_wrap((int32_t)table_u16(table_entry(shape->table, index), 4) + found->angle);
    return IRIS_OK;
}
