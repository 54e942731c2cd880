/* The corners of a chessboard: see board_find.h for the method. */
#include "corner.h"

#define SIDE_MIN 20 /* of a level */

typedef struct {
    iris_pyramid pyramid;
    iris_lattice lattice;
    int16_t *responses;
    const iris_board_grid *grid;
    iris_lattice_order order;
    iris_board_report *report;
} search;

/* The candidate to which an edge leads: along axis 0 bright on the side to which angles grow, along axis 1 dark. */
static int32_t neighbor(const iris_lattice *lattice, int32_t seed, int axis)
{
    const iris_candidate *from = &lattice->all[seed];
    const int64_t c = iris_cos_q30(from->axis[axis]) >> 16, s = iris_sin_q30(from->axis[axis]) >> 16;
    int64_t best = INT64_MAX;
    int32_t found = -1;
    for (int32_t k = 0; k < lattice->count; k++) {
        const iris_candidate *to = &lattice->all[k];
        const int64_t along = c * (to->x - from->x) + s * (to->y - from->y);
        if (k != seed && along > 0 && along < best &&
            iris_corner_joined(from, to, axis == 0, lattice->picture)) {
            best = along;
            found = k;
        }
    }
    return found;
}

static int grow_from(iris_lattice *lattice, int32_t seed)
{
    int32_t step[2][2];
    for (int axis = 0; axis < 2; axis++) {
        const int32_t to = neighbor(lattice, seed, axis);
        if (to < 0) {
            return 0;
        }
        step[axis][0] = lattice->all[to].x - lattice->all[seed].x;
        step[axis][1] = lattice->all[to].y - lattice->all[seed].y;
    }
    iris_lattice_grow(lattice, seed, step);
    return lattice->placed >= 4;
}

/* Grows lattices on a level until one is the board: s->order. Returns 0, with the best one in the report, when none
 * is. */
static int look(search *s, const iris_image *level)
{
    iris_lattice *lattice = &s->lattice;
    iris_corner_seek(lattice, s->responses, level);
    for (int32_t seed = 0; seed < lattice->count; seed++) {
        if (lattice->all[seed].tried || !grow_from(lattice, seed)) {
            continue;
        }
        iris_lattice_trim(lattice, s->grid);
        if (iris_lattice_orient(&s->order, lattice)) {
            return 1;
        }
        if (lattice->placed > s->report->seen) {
            iris_lattice_report(s->report, lattice, s->grid, (iris_size){level->w, level->h});
        }
    }
    return 0;
}

/* How far gradients count, in pixels: no other edge is as near, though the outermost squares may be halves. Places
 * have 16 fraction bits. */
static int32_t reach_of(const iris_vec2 *corners, const iris_board_grid *grid, int32_t k)
{
    const int32_t column = k % grid->columns, row = k / grid->columns;
    int64_t least = 32 * 65536;
    for (int side = 0; side < 4; side++) {
        const int32_t x = column + (side & 1 ? -1 : 1), y = row + (side & 2 ? -1 : 1);
        if (x < 0 || y < 0 || x >= grid->columns || y >= grid->rows) {
            continue;
        }
        const iris_vec2 *at = &corners[k], *a = &corners[row * grid->columns + x],
                        *b = &corners[y * grid->columns + column];
        const int64_t ax = (a->x - at->x) >> 8, ay = (a->y - at->y) >> 8, bx = (b->x - at->x) >> 8,
                      by = (b->y - at->y) >> 8;
        int64_t across = ax * by - ay * bx;
        across = across < 0 ? -across : across;
        const int32_t al = (int32_t)iris_hypot((int32_t)ax, (int32_t)ay),
                      bl = (int32_t)iris_hypot((int32_t)bx, (int32_t)by);
        const int64_t high = across / (al > bl ? al + 1 : bl + 1) * 256;
        least = high < least ? high : least;
    }
    const int is_outer = column == 0 || row == 0 || column == grid->columns - 1 || row == grid->rows - 1;
    const int32_t reach = (int32_t)(least * (is_outer ? 9 : 12) / 16 / 65536);
    return reach < 2 ? 2 : reach > 12 ? 12 : reach;
}

/* From a level down to the picture: places on the level with 32 fraction bits become those in the picture. */
static void settle(iris_vec2 *corners, const search *s, int level)
{
    const int32_t count = s->grid->columns * s->grid->rows;
    for (int32_t k = 0; k < count; k++) {
        corners[k] = (iris_vec2){corners[k].x / 65536, corners[k].y / 65536};
    }
    for (; level >= 0; level--) {
        for (int32_t k = 0; k < count; k++) {
            iris_q16 at[2] = {(iris_q16)corners[k].x, (iris_q16)corners[k].y};
            if (iris_corner_settle(at, &s->pyramid.level[level], reach_of(corners, s->grid, k))) {
                corners[k] = (iris_vec2){at[0], at[1]};
            }
        }
        for (int32_t k = 0; level > 0 && k < count; k++) {
            corners[k] = (iris_vec2){2 * corners[k].x, 2 * corners[k].y};
        }
    }
    for (int32_t k = 0; k < count; k++) {
        corners[k] = (iris_vec2){corners[k].x * 65536, corners[k].y * 65536};
    }
}

/* Takes the memory, and makes the pyramid. */
static iris_status prepare(search *s, const iris_image *gray, iris_scratch *scratch)
{
    const size_t n = IRIS_BOARD_CANDIDATES(s->grid->columns, s->grid->rows);
    const size_t bytes = IRIS_PYRAMID_BYTES((size_t)gray->w, (size_t)gray->h, 1, IRIS_BOARD_LEVELS);
    const iris_border border = {IRIS_BORDER_REPLICATE, 0};
    void *levels = iris_scratch_take(scratch, bytes);
    const size_t mark = iris_scratch_mark(scratch);
    s->responses = iris_scratch_take(scratch, 14 * (size_t)gray->w);
    s->lattice.all = iris_scratch_take(scratch, n * IRIS_BOARD_CANDIDATE_BYTES);
    s->lattice.cells = iris_scratch_take(scratch, 2 * IRIS_BOARD_CELLS(s->grid->columns, s->grid->rows));
    s->lattice.room = (int32_t)n;
    s->lattice.reach = (int32_t)IRIS_BOARD_LONGER_(s->grid->columns, s->grid->rows) + 1;
    if (!levels || !s->responses || !s->lattice.all || !s->lattice.cells) {
        return IRIS_ERR_SCRATCH;
    }
    iris_scratch_release(scratch, mark); /* building needs less, and before */
    iris_status status = iris_pyramid_wrap(&s->pyramid, gray, IRIS_BOARD_LEVELS, levels, bytes);
    return status == IRIS_OK ? iris_pyramid_build(&s->pyramid, border, scratch) : status;
}

iris_status iris_board_corners(iris_vec2 *corners, iris_board_report *report, const iris_image *gray,
                               const iris_board_grid *grid, iris_scratch *scratch)
{
    if (!corners || !report || !gray || !grid || !scratch) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_lattice_check(gray, grid);
    if (status != IRIS_OK) {
        return status;
    }
    search s = {.grid = grid, .order = {.grid = grid}, .report = report};
    const size_t mark = iris_scratch_mark(scratch);
    status = prepare(&s, gray, scratch);
    if (status == IRIS_OK) {
        int found = 0, level = IRIS_BOARD_LEVELS;
        *report = (iris_board_report){IRIS_BOARD_UNSEEN, 0, 0, 0};
        while (!found && level > 0) {
            const iris_image *at = &s.pyramid.level[--level];
            found = at->w >= SIDE_MIN && at->h >= SIDE_MIN && look(&s, at);
        }
        status = found ? IRIS_OK : IRIS_ERR_DATA;
        if (found) {
            iris_lattice_places(corners, report, &s.order, &s.lattice);
            settle(corners, &s, level);
        }
    }
    iris_scratch_release(scratch, mark);
    return status;
}
