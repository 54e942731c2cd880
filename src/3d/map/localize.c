/* Correlative matching: blocks of places by what they can be at most, then the places in those that matter. */
#include "iris/3d/localize.h"

#include "map_parts.h"

#define BLOCK  IRIS_FIELD_BLOCK
#define PAD    (BLOCK - 1)
#define TOP    255 /* of the field */
#define SHARE  10  /* places within this part of the best score have a say in the spread */
#define SPREAD 3   /* cells */

typedef struct {
    int32_t x, y;
} spot;

/* A place of the window: a heading by its number, and steps of a cell from the prediction. */
typedef struct {
    int32_t score, angle, x, y;
} candidate;

/* Of the places near the best score, from the best one on. */
typedef struct {
    int64_t weight, xx, yy, xy, aa;
    int64_t likely, x, y, a; /* with what was predicted */
} moments;

typedef struct {
    const iris_field *field;
    const iris_scan *scan;
    iris_localize_config config;
    iris_map_pose predicted;
    spot *spots;     /* cells in which the beams end, at the prediction turned to `angle` */
    int32_t *bounds; /* of blocks: heading by heading, row by row; ~bound when it was looked into */
    int32_t beams, angle, side, block_count;
    candidate best;
    moments spread;
} matching;

void iris_localize_defaults(iris_localize_config *config)
{
    if (config) {
        *config = (iris_localize_config){
            .window_cells = 10, .angle_steps = 20, .angle_step = 91, .least_percent = 40, .least_beams = 20};
    }
}

/* --- the scan on the map --- */

static int counts(const matching *m, const iris_beam *beam)
{
    return beam->hit && beam->spread_mm <= 2 * m->field->cell_mm;
}

static iris_angle heading_of(const matching *m, int32_t angle)
{
    return iris_angle_wrap(m->predicted.heading + (angle - m->config.angle_steps) * m->config.angle_step);
}

static void turn_to(matching *m, int32_t angle)
{
    const iris_field *field = m->field;
    const iris_heading turn = iris_heading_of(heading_of(m, angle));
    const int32_t x = m->predicted.x_mm - field->left_mm, y = m->predicted.y_mm - field->bottom_mm;
    int32_t next = 0;
    if (m->angle == angle) {
        return;
    }
    m->angle = angle;
    for (int32_t i = 0; i < m->scan->count; i++) {
        const iris_beam *beam = &m->scan->beams[i];
        if (counts(m, beam)) {
            m->spots[next].x =
                iris_ray_floor(x + iris_heading_x(turn, beam->x_mm, beam->y_mm), field->cell_mm);
            m->spots[next++].y =
                iris_ray_floor(y + iris_heading_y(turn, beam->x_mm, beam->y_mm), field->cell_mm);
        }
    }
}

/* The sum of a map of w x h over the spots, moved by (x, y). */
static int32_t sum_over(const matching *m, const uint8_t *map, iris_size size, int32_t x, int32_t y)
{
    int32_t sum = 0;
    for (int32_t i = 0; i < m->beams; i++) {
        const int32_t at_x = m->spots[i].x + x, at_y = m->spots[i].y + y;
        if (at_x >= 0 && at_x < size.w && at_y >= 0 && at_y < size.h) {
            sum += map[(size_t)at_y * (size_t)size.w + (size_t)at_x];
        }
    }
    return sum;
}

static int32_t score_at(const matching *m, int32_t x, int32_t y)
{
    return sum_over(m, m->field->near, (iris_size){m->field->w, m->field->h}, x, y);
}

static int32_t headings(const matching *m)
{
    return 2 * m->config.angle_steps + 1;
}

static void bound_all(matching *m)
{
    const iris_size size = {m->field->w + PAD, m->field->h + PAD};
    const int32_t first = PAD - m->config.window_cells;
    int32_t *bound = m->bounds;
    for (int32_t angle = 0; angle < headings(m); angle++) {
        turn_to(m, angle);
        for (int32_t y = 0; y < m->side; y++) {
            for (int32_t x = 0; x < m->side; x++) {
                *bound++ = sum_over(m, m->field->blocks, size, first + BLOCK * x, first + BLOCK * y);
            }
        }
    }
}

/* --- the best place --- */

static int32_t apart(const matching *m, const candidate *c)
{
    const int32_t turned = c->angle - m->config.angle_steps;
    return turned < 0 ? -turned : turned;
}

/* The higher score; then the nearer to the prediction; then the earlier one: the order of looking does not matter. */
static int is_better(const matching *m, const candidate *a, const candidate *b)
{
    const int32_t far_a = a->x * a->x + a->y * a->y, far_b = b->x * b->x + b->y * b->y;
    if (a->score != b->score) {
        return a->score > b->score;
    }
    if (far_a != far_b) {
        return far_a < far_b;
    }
    if (apart(m, a) != apart(m, b)) {
        return apart(m, a) < apart(m, b);
    }
    return a->angle != b->angle ? a->angle < b->angle : a->y != b->y ? a->y < b->y : a->x < b->x;
}

static void take_better(matching *m, const candidate *c)
{
    if (is_better(m, c, &m->best)) {
        m->best = *c;
    }
}

/* How likely a place is by the prediction alone: 4096 / (1 + d^2 / 2)^2 for d standard deviations. */
static int64_t prior_of(const matching *m, const candidate *c)
{
    const iris_localize_config *by = &m->config;
    const int64_t cell = m->field->cell_mm, turned = (int64_t)apart(m, c) * by->angle_step;
    int64_t q = 256; /* 8 fraction bits */
    if (by->predicted_mm > 0) {
        q += (c->x * c->x + c->y * c->y) * cell * cell * 128 / ((int64_t)by->predicted_mm * by->predicted_mm);
    }
    if (by->predicted_angle > 0) {
        q += turned * turned * 128 / ((int64_t)by->predicted_angle * by->predicted_angle);
    }
    return q < 32768 ? ((int64_t)4096 << 16) / (q * q) : 0;
}

/* Weighs it by how much it is above the limit, 1 to 256. */
static void take_part(matching *m, const candidate *c)
{
    const int32_t range = m->best.score / SHARE + 1, above = c->score - (m->best.score - range + 1);
    if (above < 0) {
        return;
    }
    const int64_t x = c->x - m->best.x, y = c->y - m->best.y, a = c->angle - m->best.angle;
    const int64_t weight = 1 + (int64_t)above * 255 / range, likely = weight * prior_of(m, c);
    moments *s = &m->spread;
    s->weight += weight;
    s->xx += weight * x * x;
    s->yy += weight * y * y;
    s->xy += weight * x * y;
    s->aa += weight * a * a;
    s->likely += likely;
    s->x += likely * x;
    s->y += likely * y;
    s->a += likely * a;
}

static int32_t smaller(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

/* All places of a block. */
static void look_into(matching *m, int32_t block, void (*take)(matching *, const candidate *))
{
    const int32_t window = m->config.window_cells, in_plane = block % (m->side * m->side);
    const int32_t left = BLOCK * (in_plane % m->side) - window, low = BLOCK * (in_plane / m->side) - window;
    candidate c = {.angle = block / (m->side * m->side)};
    turn_to(m, c.angle);
    for (c.y = low; c.y <= smaller(low + BLOCK - 1, window); c.y++) {
        for (c.x = left; c.x <= smaller(left + BLOCK - 1, window); c.x++) {
            c.score = score_at(m, c.x, c.y);
            take(m, &c);
        }
    }
}

static int32_t best_block(const matching *m)
{
    int32_t best = 0;
    for (int32_t i = 1; i < m->block_count; i++) {
        best = m->bounds[i] > m->bounds[best] ? i : best;
    }
    return best;
}

static void find_best(matching *m, int32_t least)
{
    m->best = (candidate){-1, m->config.angle_steps, 0, 0};
    for (;;) {
        const int32_t block = best_block(m), bound = m->bounds[block];
        if (bound < least || bound < m->best.score) {
            return;
        }
        m->bounds[block] = ~bound;
        look_into(m, block, take_better);
    }
}

static void measure_spread(matching *m)
{
    const int32_t limit = m->best.score - m->best.score / SHARE;
    for (int32_t i = 0; i < m->block_count; i++) {
        const int32_t bound = m->bounds[i] < 0 ? ~m->bounds[i] : m->bounds[i];
        if (bound >= limit) {
            look_into(m, i, take_part);
        }
    }
}

/* --- what comes of it --- */

/* The mean of what is likely; the best place, where nothing is by the prediction. */
static iris_map_pose mean_of(const matching *m)
{
    const moments *s = &m->spread;
    const int64_t all = s->likely > 0 ? s->likely : 1, cell = m->field->cell_mm, step = m->config.angle_step;
    const int64_t x = s->x * 256 / all + 256 * (int64_t)m->best.x,
                  y = s->y * 256 / all + 256 * (int64_t)m->best.y, a = s->a * 256 / all;
    return (iris_map_pose){
        m->predicted.x_mm + (int32_t)iris_round_shift(cell * x, 8),
        m->predicted.y_mm + (int32_t)iris_round_shift(cell * y, 8),
        iris_angle_wrap(heading_of(m, m->best.angle) + (int32_t)iris_round_shift(step * a, 8))};
}

static int is_spread(const matching *m, int64_t places, int64_t angles)
{
    const int64_t window = m->config.window_cells, steps = m->config.angle_steps;
    return places > (int64_t)SPREAD * SPREAD * 256 || 4 * places > window * window * 256 ||
           (steps > 0 && 4 * angles > steps * steps * 256);
}

static int is_at_edge(const matching *m)
{
    const int32_t window = m->config.window_cells, steps = m->config.angle_steps;
    const candidate *b = &m->best;
    return b->x == window || b->x == -window || b->y == window || b->y == -window ||
           (steps > 0 && apart(m, b) == steps);
}

static void conclude(iris_location *location, const matching *m)
{
    const moments *s = &m->spread;
    /* variances with 8 fraction bits, in cells and in angle steps */
    const int64_t weight = s->weight > 0 ? s->weight : 1;
    const int64_t xx = (s->xx << 8) / weight, yy = (s->yy << 8) / weight, aa = (s->aa << 8) / weight;
    const int64_t xy = s->xy * 256 / weight, apart_2 = (xx - yy) * (xx - yy) + 4 * xy * xy;
    const int64_t most = (xx + yy + iris_sqrt_u64((uint64_t)apart_2)) / 2, cell = m->field->cell_mm,
                  step = m->config.angle_step;
    location->pose = mean_of(m);
    location->score_permille = (int32_t)((int64_t)m->best.score * 1000 / ((int64_t)TOP * m->beams));
    location->spread_mm = (int32_t)(iris_sqrt_u64((uint64_t)(most * cell * cell)) / 16u);
    location->spread_angle = (int32_t)(iris_sqrt_u64((uint64_t)(aa * step * step)) / 16u);
    location->spread_along = (iris_angle)(iris_atan2_angle((int32_t)(2 * xy), (int32_t)(xx - yy)) / 2);
    location->verdict = is_spread(m, most, aa) ? IRIS_LOCALIZE_AMBIGUOUS
                        : is_at_edge(m)        ? IRIS_LOCALIZE_AT_EDGE
                                               : IRIS_LOCALIZE_FOUND;
}

static iris_location match(matching *m)
{
    iris_location location = {.pose = m->predicted, .beams = m->beams};
    const int64_t least = ((int64_t)m->config.least_percent * TOP * m->beams + 99) / 100;
    if (m->beams < 1 || m->beams < m->config.least_beams) {
        location.verdict = IRIS_LOCALIZE_TOO_FEW;
        return location;
    }
    bound_all(m);
    find_best(m, (int32_t)least);
    if (m->best.score < least) {
        location.verdict = IRIS_LOCALIZE_NO_MATCH;
        return location;
    }
    measure_spread(m);
    conclude(&location, m);
    return location;
}

static iris_status check(const iris_field *field, const iris_localize_config *c)
{
    const int fits =
        field->near && field->blocks && c->window_cells >= 1 && c->window_cells <= IRIS_LOCALIZE_WINDOW_MAX &&
        c->angle_steps >= 0 && c->angle_steps <= IRIS_LOCALIZE_STEPS_MAX && c->angle_step > 0 &&
        c->angle_steps * c->angle_step < 32768 && c->least_percent >= 1 && c->least_percent <= 100 &&
        c->least_beams >= 1 && c->predicted_mm >= 0 && c->predicted_angle >= 0;
    return fits && iris_grid_is_laid_out((iris_size){field->w, field->h}, field->cell_mm, field->left_mm,
                                         field->bottom_mm)
               ? IRIS_OK
               : IRIS_ERR_ARG;
}

iris_status iris_localize(iris_location *location, const iris_field *field, iris_map_pose predicted,
                          const iris_scan *scan, const iris_localize_config *config, iris_scratch *scratch)
{
    matching m = {.field = field, .scan = scan, .predicted = predicted, .angle = -1};
    iris_localize_defaults(&m.config);
    m.config = config ? *config : m.config;
    iris_status status = location && field && scratch ? iris_scan_check(scan) : IRIS_ERR_ARG;
    status = status == IRIS_OK ? check(field, &m.config) : status;
    if (status != IRIS_OK) {
        return status;
    }
    if (!iris_place_fits(predicted.x_mm) || !iris_place_fits(predicted.y_mm)) {
        return IRIS_ERR_RANGE;
    }
    const size_t mark = iris_scratch_mark(scratch);
    m.side = (int32_t)IRIS_LOCALIZE_BLOCKS(m.config.window_cells);
    m.block_count = headings(&m) * m.side * m.side;
    m.spots = iris_scratch_take(scratch, 8 * (size_t)scan->count);
    m.bounds = iris_scratch_take(scratch, 4 * (size_t)m.block_count);
    if (!m.spots || !m.bounds) {
        iris_scratch_release(scratch, mark);
        return IRIS_ERR_SCRATCH;
    }
    for (int32_t i = 0; i < scan->count; i++) {
        m.beams += counts(&m, &scan->beams[i]);
    }
    *location = match(&m);
    iris_scratch_release(scratch, mark);
    return IRIS_OK;
}
