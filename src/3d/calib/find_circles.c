/* The circles of a board: see board_find.h for the method. */
#include "lattice.h"

#define AREA_MIN  16     /* pixels of a circle */
#define AREA_MAX  800000 /* of these and of boxes so wide sums of squares fit 64 bits */
#define SIDE_MAX  1024
#define NEIGHBORS 6
#define WAYS      (2 * 2 * 2)

typedef struct {
    const iris_image *gray;
    iris_image mask;
    iris_blob *blobs;
    iris_lattice lattice;
    iris_lattice_order order;
    iris_board_report *report;
    iris_scratch *scratch;
    int bright; /* circles on dark ground */
} search;

/* --- candidates --- */

/* Variances, 1/256 square pixel, each pixel a square; and their determinant. */
typedef struct {
    int64_t across, down, both, all;
} spread;

static spread spread_of(const iris_blob *blob)
{
    const int64_t n = blob->area, left = blob->box.x, top = blob->box.y;
    const int64_t x = blob->moments.x - n * left, y = blob->moments.y - n * top;
    const int64_t xx = blob->moments.xx - 2 * left * blob->moments.x + n * left * left;
    const int64_t xy = blob->moments.xy - left * blob->moments.y - top * blob->moments.x + n * left * top;
    const int64_t yy = blob->moments.yy - 2 * top * blob->moments.y + n * top * top;
    spread s = {(n * xx - x * x) / n * 256 / n + 21, (n * yy - y * y) / n * 256 / n + 21,
                (n * xy - x * y) / n * 256 / n, 0};
    s.all = s.across * s.down - s.both * s.both;
    return s;
}

/* Is a blob as large as the ellipse of its moments, to a sixth, and not four times as long as broad? */
static int is_ellipse(const iris_blob *blob)
{
    const int64_t n = blob->area;
    if (n < AREA_MIN || n > AREA_MAX || blob->box.w > SIDE_MAX || blob->box.h > SIDE_MAX || blob->holes > 0) {
        return 0;
    }
    const spread by = spread_of(blob);
    const int64_t square = by.all / 256 * 158 / 256; /* of the area: (4 pi)^2 times the determinant */
    return 4 * n * n > 3 * square && 3 * n * n < 4 * square &&
           (by.across + by.down) * (by.across + by.down) < 18 * by.all;
}

/* How far a pixel is from the middle, squared, so that 4 is the ellipse's outline. */
static int64_t distance(const spread *by, const iris_blob *blob, int32_t x, int32_t y)
{
    const int64_t dx = x * 16 - blob->x_q16 / 4096, dy = y * 16 - blob->y_q16 / 4096;
    return (dx * dx * by->down - 2 * dx * dy * by->both + dy * dy * by->across) / by->all;
}

static int32_t level_of(const search *s, int32_t x, int32_t y)
{
    const int32_t level = ((const uint8_t *)iris_image_row(s->gray, y))[x];
    return s->bright ? 255 - level : level;
}

/* The box of a blob and some ground around it. */
static iris_rect around(const search *s, const iris_blob *blob)
{
    const int32_t more_x = 1 + blob->box.w * 4 / 9, more_y = 1 + blob->box.h * 4 / 9;
    const int32_t left = blob->box.x > more_x ? blob->box.x - more_x : 0,
                  top = blob->box.y > more_y ? blob->box.y - more_y : 0;
    const int32_t right = blob->box.x + blob->box.w + more_x, bottom = blob->box.y + blob->box.h + more_y;
    return (iris_rect){left, top, (right < s->gray->w ? right : s->gray->w) - left,
                       (bottom < s->gray->h ? bottom : s->gray->h) - top};
}

/* The level of the ground: between one and a half and one and five sixths of an ellipse. And of the darkest pixel. */
static void levels_of(int32_t levels[2], const search *s, const iris_blob *blob, const spread *by)
{
    const iris_rect box = around(s, blob);
    int32_t ground = 0, count = 0, darkest = 255;
    for (int32_t y = box.y; y < box.y + box.h; y++) {
        for (int32_t x = box.x; x < box.x + box.w; x++) {
            const int64_t away = distance(by, blob, x, y);
            const int32_t level = level_of(s, x, y);
            if (away >= 9 && away < 13) {
                ground += level;
                count++;
            }
            darkest = away < 9 && level < darkest ? level : darkest;
        }
    }
    levels[0] = count > 0 ? ground / count : darkest;
    levels[1] = darkest;
}

/* The center of gravity by how much darker than the ground each pixel is, within one and a half of the ellipse. */
static void weigh(iris_candidate *to, const search *s, const iris_blob *blob)
{
    const iris_rect box = around(s, blob);
    const spread by = spread_of(blob);
    int64_t sum = 0, x_sum = 0, y_sum = 0;
    int32_t levels[2];
    levels_of(levels, s, blob, &by);
    const int32_t limit = levels[0] - (levels[0] - levels[1]) / 8;
    for (int32_t y = box.y; y < box.y + box.h; y++) {
        for (int32_t x = box.x; x < box.x + box.w; x++) {
            const int32_t weight = limit - level_of(s, x, y);
            if (weight > 0 && distance(&by, blob, x, y) < 9) {
                sum += weight;
                x_sum += (int64_t)weight * (x - box.x);
                y_sum += (int64_t)weight * (y - box.y);
            }
        }
    }
    to->x = blob->x_q16 / 256;
    to->y = blob->y_q16 / 256;
    if (sum > 0) {
        to->x = box.x * 256 + (int32_t)((x_sum * 256 + sum / 2) / sum);
        to->y = box.y * 256 + (int32_t)((y_sum * 256 + sum / 2) / sum);
    }
}

/* Circles that stand out against the mean of so many pixels around by so many levels. */
static iris_status seek(search *s, int32_t radius, int32_t contrast)
{
    iris_blob_config config;
    iris_blob_table table = {s->blobs, s->lattice.room, 0};
    iris_blob_defaults(&config);
    config.filter.min_area = AREA_MIN;
    config.filter.max_area = AREA_MAX;
    config.filter.inside = 1;
    iris_status status =
        iris_threshold_adaptive(&s->mask, s->gray, radius, s->bright ? -contrast : contrast,
                                s->bright ? IRIS_SELECT_BRIGHT : IRIS_SELECT_DARK, s->scratch);
    status = status == IRIS_OK ? iris_blobs(&table, &s->mask, NULL, &config, s->scratch) : status;
    s->lattice.count = 0;
    for (int32_t k = 0; k < table.count && k < table.capacity; k++) {
        if (is_ellipse(&s->blobs[k])) {
            const uint32_t diameter = iris_sqrt_u64((uint64_t)s->blobs[k].area * 326); /* 4 / pi, in 1/16 */
            iris_candidate *to = &s->lattice.all[s->lattice.count++];
            *to = (iris_candidate){.i = INT16_MAX, .j = INT16_MAX, .size = (int16_t)diameter};
            weigh(to, s, &s->blobs[k]);
        }
    }
    return status == IRIS_ERR_FULL ? IRIS_OK : status;
}

/* --- lattices --- */

static int64_t apart(const iris_candidate *a, const iris_candidate *b)
{
    const int64_t x = a->x - b->x, y = a->y - b->y;
    return x * x + y * y;
}

static int are_alike(const iris_candidate *a, const iris_candidate *b)
{
    return a->size < 2 * b->size && b->size < 2 * a->size;
}

/* The nearest ones of a similar size: how many there are. */
static int neighbors_of(int32_t nearest[NEIGHBORS], const iris_lattice *lattice, int32_t seed)
{
    const iris_candidate *from = &lattice->all[seed];
    int count = 0;
    for (int32_t k = 0; k < lattice->count; k++) {
        const int64_t away = apart(from, &lattice->all[k]);
        if (k == seed || !are_alike(from, &lattice->all[k]) ||
            (count == NEIGHBORS && away >= apart(from, &lattice->all[nearest[NEIGHBORS - 1]]))) {
            continue;
        }
        int at = count < NEIGHBORS ? count++ : NEIGHBORS - 1;
        for (; at > 0 && apart(from, &lattice->all[nearest[at - 1]]) > away; at--) {
            nearest[at] = nearest[at - 1];
        }
        nearest[at] = k;
    }
    return count;
}

/* Has the lattice gone past circles: is one nearer to its places than the next place is? */
static int leaves_out(const iris_lattice *lattice)
{
    for (int32_t k = 0; k < lattice->count; k++) {
        const iris_candidate *other = &lattice->all[k];
        const int32_t reach = lattice->reach;
        if (other->i >= -reach && other->i <= reach && other->j >= -reach && other->j <= reach &&
            *iris_lattice_at(lattice, other->i, other->j) == k) {
            continue;
        }
        for (int32_t m = 0; m < lattice->count; m++) {
            const iris_candidate *c = &lattice->all[m];
            if (c->i < -reach || c->i > reach || c->j < -reach || c->j > reach ||
                *iris_lattice_at(lattice, c->i, c->j) != m || !are_alike(c, other)) {
                continue;
            }
            const int64_t a = (int64_t)c->step[0][0] * c->step[0][0] + (int64_t)c->step[0][1] * c->step[0][1];
            const int64_t b = (int64_t)c->step[1][0] * c->step[1][0] + (int64_t)c->step[1][1] * c->step[1][1];
            if (apart(c, other) * 16 < (a < b ? a : b) * 9) {
                return 1;
            }
        }
    }
    return 0;
}

/* Grows from a circle and two neighbors, b a quarter turn ahead of a, more or less. */
static int grow(search *s, int32_t seed, int32_t a, int32_t b)
{
    iris_lattice *lattice = &s->lattice;
    const iris_candidate *from = &lattice->all[seed], *one = &lattice->all[a], *two = &lattice->all[b];
    int32_t step[2][2] = {{one->x - from->x, one->y - from->y}, {two->x - from->x, two->y - from->y}};
    const int64_t across = (int64_t)step[0][0] * step[1][1] - (int64_t)step[0][1] * step[1][0];
    const int64_t longer = apart(from, one) > apart(from, two) ? apart(from, one) : apart(from, two);
    if (across * 4 < longer) {
        return 0;
    }
    iris_lattice_grow(lattice, seed, step);
    if (!s->order.shifted) {
        iris_lattice_trim(lattice, s->order.grid);
    }
    return iris_lattice_orient(&s->order, lattice) && !leaves_out(lattice);
}

static void remember(search *s)
{
    const iris_lattice *lattice = &s->lattice;
    const int32_t whole = s->order.grid->columns * s->order.grid->rows;
    if (lattice->placed < 4 || lattice->placed <= s->report->seen) {
        return;
    }
    if (s->order.shifted) {
        *s->report = (iris_board_report){lattice->placed > whole ? IRIS_BOARD_LARGER : IRIS_BOARD_PARTLY,
                                         lattice->placed, 0, 0};
    } else {
        iris_lattice_report(s->report, lattice, s->order.grid, (iris_size){s->gray->w, s->gray->h});
    }
}

/* Lattices from all circles, and all pairs of neighbors, until one is the board. */
static int look(search *s)
{
    iris_lattice *lattice = &s->lattice;
    int32_t nearest[NEIGHBORS];
    for (int32_t seed = 0; seed < lattice->count; seed++) {
        if (lattice->all[seed].tried >= IRIS_CANDIDATE_TIRED) {
            continue;
        }
        const int count = neighbors_of(nearest, lattice, seed);
        for (int pair = 0; pair < count * count; pair++) {
            if (pair / count != pair % count) {
                if (grow(s, seed, nearest[pair / count], nearest[pair % count])) {
                    return 1;
                }
                remember(s);
            }
        }
    }
    return 0;
}

/* --- the circles' own centers --- */

/* Adds how a step along an axis differs from the one before, at the nearest place that has both. */
static void add_bend(int64_t bend[2], const iris_lattice *lattice, const iris_candidate *c, int axis)
{
    static const int8_t nearer[3] = {0, 1, -1};
    for (int k = 0; k < 3; k++) {
        const iris_candidate *at[3] = {NULL, NULL, NULL};
        for (int n = 0; n < 3; n++) {
            const int32_t i = c->i + (axis == 0 ? nearer[k] + n - 1 : 0),
                          j = c->j + (axis == 1 ? nearer[k] + n - 1 : 0);
            const int inside = i >= -lattice->reach && i <= lattice->reach && j >= -lattice->reach &&
                               j <= lattice->reach && *iris_lattice_at(lattice, i, j) >= 0;
            at[n] = inside ? &lattice->all[*iris_lattice_at(lattice, i, j)] : NULL;
        }
        if (at[0] && at[1] && at[2]) {
            bend[0] += at[0]->x - 2 * at[1]->x + at[2]->x;
            bend[1] += at[0]->y - 2 * at[1]->y + at[2]->y;
            return;
        }
    }
}

/* From the center of an ellipse to that of the circle: half of the bends, times the square of the radius in steps. */
static void put_right(iris_vec2 *centers, const search *s)
{
    const iris_lattice *lattice = &s->lattice;
    for (int32_t k = 0; k < s->order.grid->columns * s->order.grid->rows; k++) {
        const iris_candidate *c = &lattice->all[iris_lattice_member(&s->order, lattice, k)];
        int64_t bend[2] = {0, 0};
        int64_t cell = (int64_t)c->step[0][0] * c->step[1][1] - (int64_t)c->step[0][1] * c->step[1][0];
        cell = cell < 65536 ? 65536 : cell;
        add_bend(bend, lattice, c, 0);
        add_bend(bend, lattice, c, 1);
        int64_t share = ((int64_t)c->size * c->size << 20) / cell; /* (diameter / step)^2, 2^12 for 1 */
        share = share > 4096 ? 4096 : share;
        centers[k].x -= bend[0] * share * (IRIS_Q32_ONE / (256 * 4096 * 8));
        centers[k].y -= bend[1] * share * (IRIS_Q32_ONE / (256 * 4096 * 8));
    }
}

/* --- all of it --- */

static iris_status prepare(search *s, iris_scratch *scratch)
{
    const iris_image *gray = s->gray;
    const int32_t columns = s->order.grid->columns, rows = s->order.grid->rows;
    const size_t n = IRIS_BOARD_CANDIDATES(columns, rows);
    const size_t bytes = ((size_t)gray->w + 31u) / 32u * 4u * (size_t)gray->h;
    void *mask = iris_scratch_take(scratch, bytes);
    s->lattice.all = iris_scratch_take(scratch, n * IRIS_BOARD_CANDIDATE_BYTES);
    s->lattice.cells = iris_scratch_take(scratch, IRIS_BOARD_CIRCLE_CELLS_(columns, rows) * 2);
    s->blobs = iris_scratch_take(scratch, n * sizeof(iris_blob));
    s->lattice.room = (int32_t)n;
    s->lattice.reach = columns + rows + 1;
    s->scratch = scratch;
    const size_t mark = iris_scratch_mark(scratch);
    const void *rest =
        iris_scratch_take(scratch, IRIS_THRESHOLD_SCRATCH_BYTES(gray->w, IRIS_THRESHOLD_RADIUS_MAX) +
                                       IRIS_BLOB_SCRATCH_BYTES(gray->w, n));
    iris_scratch_release(scratch, mark);
    return !mask || !s->lattice.all || !s->lattice.cells || !s->blobs || !rest
               ? IRIS_ERR_SCRATCH
               : iris_image_wrap(&s->mask, mask, bytes, (iris_size){gray->w, gray->h}, 0, IRIS_MASK1);
}

iris_status iris_board_circles(iris_vec2 *centers, iris_board_report *report, const iris_image *gray,
                               const iris_board_grid *grid, iris_board_circle_rows rows,
                               iris_scratch *scratch)
{
    static const uint8_t contrasts[2] = {24, 8}, parts[2] = {6, 20};
    if (!centers || !report || !gray || !grid || !scratch ||
        (rows != IRIS_BOARD_CIRCLES && rows != IRIS_BOARD_CIRCLES_SHIFTED)) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_lattice_check(gray, grid);
    if (status != IRIS_OK) {
        return status;
    }
    search s = {.gray = gray,
                .order = {.grid = grid, .shifted = rows == IRIS_BOARD_CIRCLES_SHIFTED},
                .report = report};
    const size_t mark = iris_scratch_mark(scratch);
    status = prepare(&s, scratch);
    if (status == IRIS_OK) {
        int found = 0;
        *report = (iris_board_report){IRIS_BOARD_UNSEEN, 0, 0, 0};
        for (int way = 0; way < WAYS && !found && status == IRIS_OK; way++) {
            const int32_t radius = (gray->w > gray->h ? gray->w : gray->h) / parts[way / 2 % 2];
            s.bright = way & 1;
            status = seek(&s,
                          radius < 2                           ? 2
                          : radius > IRIS_THRESHOLD_RADIUS_MAX ? IRIS_THRESHOLD_RADIUS_MAX
                                                               : radius,
                          contrasts[way / 4]);
            found = status == IRIS_OK && look(&s);
        }
        if (found) {
            iris_lattice_places(centers, report, &s.order, &s.lattice);
            put_right(centers, &s);
        } else {
            status = status == IRIS_OK ? IRIS_ERR_DATA : status;
        }
    }
    iris_scratch_release(scratch, mark);
    return status;
}
