/* IRIS-3D - boards in pictures: the inner corners of a chessboard, or the circles of a grid, to a fraction of a pixel.
 *
 * What iris_board_calibrate needs of a view. The places come row by row. Along a row and then down the rows is a turn
 * as from x to y in the picture, so no board is seen mirrored. That leaves a choice of two ends, or of four on a board as
 * high as wide. A chessboard begins where the square between the first four corners is dark; a grid of circles whose
 * rows are shifted begins with a row that is not. Where that does not decide (columns + rows is even, or circles in
 * plain rows) the first row points to the right in the picture, or at least more so than the other ones that could be it.
 *
 * Method for corners: the response of a ring of 16 pixels whose opposite pixels are alike and whose quarter turns are
 * not (Bennett and Lasenby, "ChESS: quick and robust detection of chess-board features", 2014), on the levels of a
 * pyramid, the coarsest first; the ring's two changes from dark to bright give the directions of a corner's edges. From
 * a corner and two neighbors along its edges a lattice grows: each place is predicted by the steps beside it, and taken
 * when a corner is there whose colors are the other way round and which an edge joins, bright on the right side. A
 * place that fits the picture between two pixels is where all gradients around are perpendicular to the way to it
 * (Foerstner and Guelch, 1987), by least squares, again and again, down to the picture itself.
 */
#ifndef IRIS_3D_BOARD_FIND_H
#define IRIS_3D_BOARD_FIND_H

#include "iris/3d/camera.h"
#include "iris/image.h"
#include "iris/pyramid.h"
#include "iris/scratch.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_BOARD_SIDE_MIN 3 /* corners or circles in a row, and rows */
#define IRIS_BOARD_SIDE_MAX 64

typedef struct {
    int32_t columns, rows; /* inner corners, or circles: IRIS_BOARD_SIDE_MIN to IRIS_BOARD_SIDE_MAX */
} iris_board_grid;

typedef enum {
    IRIS_BOARD_SEEN = 0,
    IRIS_BOARD_UNSEEN, /* nothing like a board */
    IRIS_BOARD_PARTLY, /* a part of it: the rest is covered, or too bright, dark, or small */
    IRIS_BOARD_CUT,    /* a part of it: the rest is beyond the edge of the picture */
    IRIS_BOARD_LARGER  /* a board of more columns or rows */
} iris_board_sight;

typedef struct {
    iris_board_sight sight;
    int32_t seen;          /* how many corners or circles, of that which is most like the board */
    int32_t columns, rows; /* over which they extend, the larger number first */
} iris_board_report;

/* Working memory: a pyramid of the picture, some rows, candidates, and the lattice. 9x6 in 640x480: 172 KB. */
#define IRIS_BOARD_LEVELS                    6
#define IRIS_BOARD_CANDIDATES(columns, rows) (512u + 4u * (size_t)(columns) * (size_t)(rows))
#define IRIS_BOARD_LONGER_(columns, rows)    ((size_t)((columns) > (rows) ? (columns) : (rows)))
#define IRIS_BOARD_CELLS(columns, rows)                                                                      \
    ((2u * IRIS_BOARD_LONGER_(columns, rows) + 3u) * (2u * IRIS_BOARD_LONGER_(columns, rows) + 3u))
#define IRIS_BOARD_CANDIDATE_BYTES 44
#define IRIS_BOARD_CORNERS_SCRATCH_BYTES(w, h, columns, rows)                                                \
    (IRIS_SCRATCH_ROUND(IRIS_PYRAMID_BYTES(w, h, 1, IRIS_BOARD_LEVELS)) +                                    \
     IRIS_SCRATCH_ROUND((size_t)(w)*14u) +                                                                   \
     IRIS_SCRATCH_ROUND(IRIS_BOARD_CANDIDATES(columns, rows) * IRIS_BOARD_CANDIDATE_BYTES) +                 \
     IRIS_SCRATCH_ROUND(IRIS_BOARD_CELLS(columns, rows) * 2u))

/* The corners of a chessboard: columns * rows places in pixels, where 0, 0 is the middle of the first pixel. gray:
 * IRIS_GRAY8. The squares are 8 pixels high or more, seen at a slant too, and corners 6 pixels inside the picture.
 * IRIS_ERR_ARG: null pointer; errors of iris_image_check; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: a grid beyond its limits;
 * IRIS_ERR_SCRATCH; IRIS_ERR_DATA: no such board is seen: *report says why, and corners are untouched. */
iris_status iris_board_corners(iris_vec2 *corners, iris_board_report *report, const iris_image *gray,
                               const iris_board_grid *grid, iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
