/* Which point of the board is where in a lattice: see board_find.h for the order. */
#include "lattice.h"

void iris_lattice_cell(int32_t cell[2], const iris_lattice_order *order, int32_t k)
{
    const int32_t column = k % order->grid->columns, row = k / order->grid->columns;
    const int32_t right = order->shifted ? column + (row + 1) / 2 : column;
    const int32_t down = order->shifted ? row / 2 - column : row;
    cell[0] = order->from[0] + (order->turn == 0   ? right
                                : order->turn == 1 ? -down
                                : order->turn == 2 ? -right
                                                   : down);
    cell[1] = order->from[1] + (order->turn == 0   ? down
                                : order->turn == 1 ? right
                                : order->turn == 2 ? -down
                                                   : -right);
}

int32_t iris_lattice_member(const iris_lattice_order *order, const iris_lattice *lattice, int32_t k)
{
    int32_t cell[2];
    iris_lattice_cell(cell, order, k);
    return *iris_lattice_at(lattice, cell[0], cell[1]);
}

int iris_lattice_fits(iris_lattice_order *order, const iris_lattice *lattice)
{
    const iris_lattice_box *box = &lattice->box;
    const int32_t count = order->grid->columns * order->grid->rows;
    int32_t low[2] = {INT32_MAX, INT32_MAX}, high[2] = {INT32_MIN, INT32_MIN};
    if (lattice->placed != count) {
        return 0;
    }
    order->from[0] = order->from[1] = 0;
    for (int32_t k = 0; k < count; k++) {
        int32_t cell[2];
        iris_lattice_cell(cell, order, k);
        for (int axis = 0; axis < 2; axis++) {
            low[axis] = cell[axis] < low[axis] ? cell[axis] : low[axis];
            high[axis] = cell[axis] > high[axis] ? cell[axis] : high[axis];
        }
    }
    for (int axis = 0; axis < 2; axis++) {
        if (high[axis] - low[axis] != box->high[axis] - box->low[axis]) {
            return 0;
        }
        order->from[axis] = box->low[axis] - low[axis];
    }
    for (int32_t k = 0; k < count; k++) {
        if (iris_lattice_member(order, lattice, k) < 0) {
            return 0;
        }
    }
    return 1;
}

/* What speaks against a way round: the less the better; -1: it is none. */
static int32_t against(iris_lattice_order *order, const iris_lattice *lattice)
{
    if (!iris_lattice_fits(order, lattice)) {
        return -1;
    }
    const iris_candidate *first = &lattice->all[iris_lattice_member(order, lattice, 0)];
    const iris_candidate *last = &lattice->all[iris_lattice_member(order, lattice, order->grid->columns - 1)];
    const int32_t angle = iris_atan2_angle(last->y - first->y, last->x - first->x);
    const int bright = lattice->picture && ((first->i + first->j + order->turn) & 1) == 0;
    return bright * 131072 + 2 * (angle < 0 ? -angle : angle) + (angle < 0);
}

int iris_lattice_orient(iris_lattice_order *order, const iris_lattice *lattice)
{
    int best = -1;
    int32_t least = INT32_MAX;
    for (order->turn = 0; order->turn < 4; order->turn++) {
        const int32_t bad = against(order, lattice);
        if (bad >= 0 && bad < least) {
            least = bad;
            best = order->turn;
        }
    }
    order->turn = best;
    return best >= 0 && iris_lattice_fits(order, lattice);
}

void iris_lattice_places(iris_vec2 *places, iris_board_report *report, const iris_lattice_order *order,
                         const iris_lattice *lattice)
{
    const iris_board_grid *grid = order->grid;
    for (int32_t k = 0; k < grid->columns * grid->rows; k++) {
        const iris_candidate *c = &lattice->all[iris_lattice_member(order, lattice, k)];
        places[k] = (iris_vec2){c->x * (IRIS_Q32_ONE / 256), c->y * (IRIS_Q32_ONE / 256)};
    }
    *report = (iris_board_report){IRIS_BOARD_SEEN, lattice->placed, grid->columns, grid->rows};
    if (grid->columns < grid->rows) {
        report->columns = grid->rows;
        report->rows = grid->columns;
    }
}

iris_status iris_lattice_check(const iris_image *gray, const iris_board_grid *grid)
{
    iris_status status = iris_image_check(gray);
    if (status != IRIS_OK || gray->format != IRIS_GRAY8) {
        return status == IRIS_OK ? IRIS_ERR_FORMAT : status;
    }
    return grid->columns < IRIS_BOARD_SIDE_MIN || grid->columns > IRIS_BOARD_SIDE_MAX ||
                   grid->rows < IRIS_BOARD_SIDE_MIN || grid->rows > IRIS_BOARD_SIDE_MAX
               ? IRIS_ERR_RANGE
               : IRIS_OK;
}
