/* From candidates to a board: a lattice of places, each with its neighbors, that grows where it predicts one. */
#ifndef IRIS_CALIB_LATTICE_H
#define IRIS_CALIB_LATTICE_H

#include "iris/3d/board_find.h"
#include "iris/fixed.h"

/* A place that may belong to a board. Lengths in 1/256 pixel. */
typedef struct {
    int32_t x, y;
    int32_t step[2][2]; /* to the next one along each axis: x and y; set where the lattice goes */
    int32_t next;       /* in the queue while it grows; -1: the last */
    int16_t i, j;       /* its cell */
    iris_angle axis
        [2]; /* corners: directions of the edges that are bright, and dark, on the side to which angles grow,
                           the second half a turn at most ahead of the first */
    int16_t size;     /* corners: bright minus dark, levels; circles: the diameter, 1/16 pixel */
    int16_t strength; /* the strongest candidates are kept */
    int16_t uneven;   /* corners: how much opposite sides differ, 1/1000 of what bright and dark do */
    int8_t tried;     /* was a part of a lattice */
} iris_candidate;

#define IRIS_CANDIDATE_TIRED 120

typedef struct {
    int32_t low[2], high[2]; /* cells, inclusive */
} iris_lattice_box;

typedef struct {
    const iris_image *picture; /* corners: where to look for edges; null: circles */
    iris_candidate *all;
    int32_t count, room;
    int16_t *cells; /* candidates by cell: -1 free */
    int32_t reach;  /* cells go from -reach to reach */
    int32_t placed;
    iris_lattice_box box;
} iris_lattice;

/* The candidate of a cell; -1: none. */
static inline int16_t *iris_lattice_at(const iris_lattice *lattice, int32_t i, int32_t j)
{
    return lattice->cells + ((j + lattice->reach) * (2 * lattice->reach + 1) + i + lattice->reach);
}

/* Grows from one candidate, whose first axis is that of its axis[0], by steps along both axes. */
void iris_lattice_grow(iris_lattice *lattice, int32_t seed, int32_t step[2][2]);

/* The board's points in the lattice: which way round, by quarters, and from which cell. */
typedef struct {
    const iris_board_grid *grid;
    int shifted; /* every second row: axes of the lattice go from a row to the next one, to both sides */
    int turn;
    int32_t from[2];
} iris_lattice_order;

/* Is the lattice the board, by order->grid, shifted, and turn? Sets order->from. */
int iris_lattice_fits(iris_lattice_order *order, const iris_lattice *lattice);

/* The cell of point k, row by row, from order->from on. */
void iris_lattice_cell(int32_t cell[2], const iris_lattice_order *order, int32_t k);

/* The candidate of point k; -1: none. */
int32_t iris_lattice_member(const iris_lattice_order *order, const iris_lattice *lattice, int32_t k);

/* Which way round is it the board? Sets order->turn and from: as board_find.h has it. Returns 0 when it is not. */
int iris_lattice_orient(iris_lattice_order *order, const iris_lattice *lattice);

/* The board's places, with 32 fraction bits, and the report of a board that is seen. */
void iris_lattice_places(iris_vec2 *places, iris_board_report *report, const iris_lattice_order *order,
                         const iris_lattice *lattice);

/* What both kinds of boards ask of picture and grid. */
iris_status iris_lattice_check(const iris_image *gray, const iris_board_grid *grid);

/* Takes off outer lines that stand half empty, or whose corners are no good ones (a board's edge before a frame), as
 * long as it is larger than the board. */
void iris_lattice_trim(iris_lattice *lattice, const iris_board_grid *grid);

/* What a lattice that is not the board looks like. */
void iris_lattice_report(iris_board_report *report, const iris_lattice *lattice, const iris_board_grid *grid,
                         iris_size size);

#endif
