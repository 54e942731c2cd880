/* How a lattice grows: see board_find.h for the method. */
#include "lattice.h"

#include "corner.h"

#define PIXEL    256
#define UNEVEN   140
#define NEAR_MIN PIXEL /* a place is taken within that of the prediction, or within 3/8 of the step */

static int32_t larger(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

static int64_t square(int64_t x, int64_t y)
{
    return x * x + y * y;
}

static void place(iris_lattice *lattice, int32_t index, int32_t i, int32_t j)
{
    iris_candidate *c = &lattice->all[index];
    iris_lattice_box *box = &lattice->box;
    c->i = (int16_t)i;
    c->j = (int16_t)j;
    c->tried = (int8_t)(c->tried + (c->tried < IRIS_CANDIDATE_TIRED));
    c->next = -1;
    *iris_lattice_at(lattice, i, j) = (int16_t)index;
    box->low[0] = i < box->low[0] ? i : box->low[0];
    box->low[1] = j < box->low[1] ? j : box->low[1];
    box->high[0] = larger(i, box->high[0]);
    box->high[1] = larger(j, box->high[1]);
    lattice->placed++;
}

/* Is the candidate in the lattice already? */
static int is_placed(const iris_lattice *lattice, int32_t index)
{
    const iris_candidate *c = &lattice->all[index];
    return c->i >= -lattice->reach && c->i <= lattice->reach && c->j >= -lattice->reach &&
           c->j <= lattice->reach && *iris_lattice_at(lattice, c->i, c->j) == index;
}

/* Is b what is to follow a along this axis? */
static int follows(const iris_lattice *lattice, const iris_candidate *a, const iris_candidate *b, int axis)
{
    if (!lattice->picture) {
        return b->size < 2 * a->size && a->size < 2 * b->size;
    }
    return iris_corner_joined(a, b, ((a->i + a->j + axis) & 1) == 0, lattice->picture);
}

/* The candidate nearest to a place that may follow; -1: there is none within the distance. */
static int32_t nearest(const iris_lattice *lattice, const iris_candidate *from, int axis, const int32_t at[2],
                       int64_t within)
{
    int32_t best = -1;
    for (int32_t k = 0; k < lattice->count; k++) {
        const iris_candidate *c = &lattice->all[k];
        const int64_t away = square(c->x - at[0], c->y - at[1]);
        if (away < within && !is_placed(lattice, k) && follows(lattice, from, c, axis)) {
            within = away;
            best = k;
        }
    }
    return best;
}

/* A corner at a place where no candidate is; -1: there is none. */
static int32_t look_there(iris_lattice *lattice, const iris_candidate *from, int axis, const int32_t at[2],
                          int64_t within)
{
    const iris_image *picture = lattice->picture;
    const int32_t margin = IRIS_CORNER_MARGIN * PIXEL;
    iris_q16 settled[2] = {0, 0};
    if (!picture || lattice->count >= lattice->room || at[0] < margin || at[1] < margin ||
        at[0] > (picture->w - 1) * PIXEL - margin || at[1] > (picture->h - 1) * PIXEL - margin) {
        return -1;
    }
    settled[0] = at[0] * PIXEL;
    settled[1] = at[1] * PIXEL;
    iris_candidate made = {.i = INT16_MAX, .j = INT16_MAX};
    if (!iris_corner_settle(settled, picture, 4)) {
        return -1;
    }
    made.x = (int32_t)iris_round_shift(settled[0], 8);
    made.y = (int32_t)iris_round_shift(settled[1], 8);
    if (square(made.x - at[0], made.y - at[1]) >= within || !iris_corner_look(&made, picture) ||
        !follows(lattice, from, &made, axis)) {
        return -1;
    }
    lattice->all[lattice->count] = made;
    return lattice->count++;
}

/* Where the next one is to be: as far as the last step was, which the step of the row beside corrects. */
static void predict(int32_t at[2], int32_t step[2], const iris_candidate *from, int axis, int sign)
{
    for (int k = 0; k < 2; k++) {
        step[k] = sign * from->step[axis][k];
        at[k] = (k == 0 ? from->x : from->y) + step[k];
    }
}

/* The neighbor of a candidate in a free cell; -1: there is none. */
static int32_t extend(iris_lattice *lattice, int32_t index, int axis, int sign)
{
    const iris_candidate from = lattice->all[index];
    const int32_t i = from.i + (axis == 0 ? sign : 0), j = from.j + (axis == 1 ? sign : 0);
    int32_t at[2], step[2];
    if (i < -lattice->reach || i > lattice->reach || j < -lattice->reach || j > lattice->reach ||
        *iris_lattice_at(lattice, i, j) >= 0) {
        return -1;
    }
    predict(at, step, &from, axis, sign);
    const int64_t length = square(step[0], step[1]);
    const int64_t within = length * 9 / 64 > NEAR_MIN * NEAR_MIN ? length * 9 / 64 : NEAR_MIN * NEAR_MIN;
    int32_t found = nearest(lattice, &from, axis, at, within);
    found = found < 0 ? look_there(lattice, &from, axis, at, within) : found;
    if (found >= 0) {
        iris_candidate *to = &lattice->all[found];
        place(lattice, found, i, j);
        to->step[axis][0] = sign * (to->x - from.x);
        to->step[axis][1] = sign * (to->y - from.y);
        to->step[1 - axis][0] = from.step[1 - axis][0];
        to->step[1 - axis][1] = from.step[1 - axis][1];
    }
    return found;
}

void iris_lattice_grow(iris_lattice *lattice, int32_t seed, int32_t step[2][2])
{
    const int32_t side = 2 * lattice->reach + 1;
    for (int32_t k = 0; k < side * side; k++) {
        lattice->cells[k] = -1;
    }
    lattice->placed = 0;
    lattice->box = (iris_lattice_box){{0, 0}, {0, 0}};
    for (int k = 0; k < 4; k++) {
        lattice->all[seed].step[k / 2][k % 2] = step[k / 2][k % 2];
    }
    place(lattice, seed, 0, 0);
    for (int32_t at = seed, last = seed; at >= 0; at = lattice->all[at].next) {
        for (int way = 0; way < 4; way++) {
            int32_t found = extend(lattice, at, way & 1, way & 2 ? -1 : 1);
            if (found >= 0) {
                lattice->all[last].next = found;
                last = found;
            }
        }
    }
}

/* Why an outer line is not the board's, 0 to 1000; it is above 400 when half of it is empty, and above UNEVEN when its
 * corners are none. With `take` they are taken off. */
static int32_t weigh_line(iris_lattice *lattice, int axis, int32_t line, int take)
{
    const int32_t length = lattice->box.high[1 - axis] - lattice->box.low[1 - axis] + 1;
    int32_t count = 0, uneven = 0;
    for (int32_t k = lattice->box.low[1 - axis]; k <= lattice->box.high[1 - axis]; k++) {
        int16_t *cell = axis == 0 ? iris_lattice_at(lattice, line, k) : iris_lattice_at(lattice, k, line);
        uneven += *cell >= 0 ? lattice->all[*cell].uneven : 0;
        count += *cell >= 0;
        *cell = take ? -1 : *cell;
    }
    lattice->placed -= take ? count : 0;
    return count == 0 || 2 * count < length ? 1000 - 500 * count / length : uneven / count;
}

/* Is it larger than the board along an axis, whichever way round the board is? */
static int is_long(const iris_lattice *lattice, const iris_board_grid *grid, int axis)
{
    const iris_lattice_box *box = &lattice->box;
    const int32_t longer = larger(grid->columns, grid->rows), shorter = grid->columns + grid->rows - longer;
    const int32_t own = box->high[axis] - box->low[axis] + 1,
                  other = box->high[1 - axis] - box->low[1 - axis] + 1;
    return own > longer || (own > shorter && own <= other);
}

void iris_lattice_trim(iris_lattice *lattice, const iris_board_grid *grid)
{
    iris_lattice_box *box = &lattice->box;
    for (int worst = 0; worst >= 0;) {
        int32_t most = UNEVEN;
        worst = -1;
        for (int way = 0; way < 4; way++) {
            const int axis = way & 1;
            const int32_t line = way & 2 ? box->high[axis] : box->low[axis];
            const int32_t bad = is_long(lattice, grid, axis) ? weigh_line(lattice, axis, line, 0) : 0;
            if (bad > most) {
                most = bad;
                worst = way;
            }
        }
        if (worst >= 0) {
            const int axis = worst & 1;
            (void)weigh_line(lattice, axis, worst & 2 ? box->high[axis] : box->low[axis], 1);
            box->high[axis] -= worst & 2 ? 1 : 0;
            box->low[axis] += worst & 2 ? 0 : 1;
        }
    }
}

/* Is a cell free where the board goes on, and beyond the picture? */
static int is_beyond(const iris_lattice *lattice, const iris_candidate *from, int way, int whole,
                     iris_size size)
{
    const int axis = way & 1, sign = way & 2 ? -1 : 1;
    const int32_t margin = IRIS_CORNER_MARGIN * PIXEL;
    const int32_t own = axis == 0 ? from->i : from->j;
    int32_t at[2], step[2];
    if (own == (sign > 0 ? lattice->box.high : lattice->box.low)[axis]
            ? whole
            : *iris_lattice_at(lattice, from->i + (axis == 0 ? sign : 0), from->j + (axis == 1 ? sign : 0)) >=
                  0) {
        return 0;
    }
    predict(at, step, from, axis, sign);
    return at[0] < margin || at[1] < margin || at[0] > (size.w - 1) * PIXEL - margin ||
           at[1] > (size.h - 1) * PIXEL - margin;
}

/* Is what is missing beyond the picture? whole: the lattice extends as far as the board, with gaps in it. */
static int is_cut(const iris_lattice *lattice, int whole, iris_size size)
{
    const iris_lattice_box *box = &lattice->box;
    for (int32_t j = box->low[1]; j <= box->high[1]; j++) {
        for (int32_t i = box->low[0]; i <= box->high[0]; i++) {
            const int32_t index = *iris_lattice_at(lattice, i, j);
            for (int way = 0; index >= 0 && way < 4; way++) {
                if (is_beyond(lattice, &lattice->all[index], way, whole, size)) {
                    return 1;
                }
            }
        }
    }
    return 0;
}

void iris_lattice_report(iris_board_report *report, const iris_lattice *lattice, const iris_board_grid *grid,
                         iris_size size)
{
    const int32_t wide = lattice->box.high[0] - lattice->box.low[0] + 1;
    const int32_t high = lattice->box.high[1] - lattice->box.low[1] + 1;
    const int32_t longer = larger(grid->columns, grid->rows), shorter = grid->columns + grid->rows - longer;
    report->seen = lattice->placed;
    report->columns = larger(wide, high);
    report->rows = wide + high - report->columns;
    report->sight = report->columns > longer || report->rows > shorter ? IRIS_BOARD_LARGER
                    : is_cut(lattice, report->columns == longer && report->rows == shorter, size)
                        ? IRIS_BOARD_CUT
                        : IRIS_BOARD_PARTLY;
}
